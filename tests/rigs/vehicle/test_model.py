"""What the build makes of a scene: each effect's numbers where it is named, None where it is not."""

import numpy
import pytest
from tests.run.scenes import resolved

from contact_sim_lab.twins import general_law
from contact_sim_pkg.laws.parameters import GeneralDissipative, NormalDissipative
from contact_sim_pkg.pressure.settings import BeltSettings
from contact_sim_pkg.rigs.vehicle.model import build
from contact_sim_pkg.rigs.vehicle.motion.spring import Spring
from contact_sim_pkg.rigs.vehicle.tire.parameters import Brush

TIRE = "effects.tire"


def model(*values, name="tire_half_space"):
    return build(resolved(name, *values))


def test_a_loss_by_damping_or_by_default_reaches_the_contact():
    assert model().tire_contact.dissipative == NormalDissipative(0.015)
    assert model(f"{TIRE}.normal_dissipative={{damping: 0.5}}").tire_contact.dissipative == NormalDissipative(0.5)
    assert model(
        "effects.seat={normal_elastic: {}, normal_dissipative: {}}", name="seat_ride"
    ).rig.seat_contact.dissipative == (NormalDissipative(1.0))


def test_a_loss_by_restitution_gives_that_restitution():
    given = model(f"{TIRE}.normal_dissipative={{restitution: 0.5, reference_speed: 2.0}}")
    d = given.tire_contact.dissipative.damping * 2.0
    assert d * 1.5 == pytest.approx(numpy.log((1.0 + d) / (1.0 - 0.5 * d)), rel=1e-9)


def test_effects_that_a_scene_does_not_name_are_none():
    plain = model()
    parts = (plain.quarter.sidewalls, plain.tread, plain.rolling_friction, plain.asperities)
    assert parts == (None, None, None, None)
    assert plain.tire_field.usual.settings.belt is None
    assert plain.quarter.wheel.mass == 40.0


def test_the_belt_of_a_rigid_ring_is_no_part_of_the_wheel():
    made = model(f"{TIRE}.rigid_ring={{belt_mass: 9, stiffness: 4e5, damping: 50}}").quarter
    assert made.sidewalls == Spring(made.belt.place, made.wheel.place, 4e5, 50.0)
    assert (made.belt.mass, made.wheel.mass) == (9.0, 31.0)


def test_the_numbers_of_belt_brush_tread_and_asperities_arrive():
    made = model(
        f"{TIRE}.envelopment={{tension: 5000, foundation: 2e6}}",
        f"{TIRE}.brush={{stiffness_x: 1e8, coefficient_static: 1.2}}",
        f"{TIRE}.tread_viscoelasticity={{retardation_time: 0.01, branches: [[0.3, 0.02]]}}",
        f"{TIRE}.asperity_impulses={{spacing: 0.03, share: 0.2, window: raised_cosine}}",
        "slip={points: [[0, 0, 0], [2, -0.4, 0.1]]}",
    )
    settings = made.tire_field.usual.settings
    assert settings.belt == BeltSettings(5000.0, 2e6)
    assert made.rolling_friction.brush == Brush(1e8, 9.6e7, 1.2, 0.8, 4.0)
    assert made.rolling_friction.slips.at(1.0) == pytest.approx((-0.2, 0.05))
    assert made.rolling_friction.slips.at(9.0) == pytest.approx((-0.4, 0.1))
    assert made.tread.relaxed.modulus == pytest.approx(4e6)
    step = made.tread.step
    assert 0.01 / step == pytest.approx(round(0.01 / step))  # a field every 0.01 s is one of its instants
    assert (
        10.0 * step <= 0.125 * made.tire_geometry.footprint_length
    )  # [m] at 10 m/s: an eighth of the footprint at most
    raised = 1.0 + 0.01 / step + 0.3 * (0.02 / step) * (1.0 - numpy.exp(-step / 0.02))
    assert settings.modulus == pytest.approx(4e6 * raised)
    assert (made.asperities.spacing, made.asperities.share, made.asperities.raised_cosine) == (0.03, 0.2, True)
    assert made.asperities.contact_length == pytest.approx(2.0 * 0.04605558, rel=1e-4)


def seat_loss(*settings):
    effects = f"effects.seat={{normal_elastic: {{}}, general_dissipative: {{{', '.join(settings)}}}}}"
    return model(effects, name="seat_ride").rig.seat_contact.dissipative


def test_the_general_law_takes_the_place_of_the_usual_loss():
    assert seat_loss() == GeneralDissipative(2.73e5, 1.5, 1.0, 0.0, 0.0)
    pulling = seat_loss("coefficient: 400", "approach_exponent: 0", "rate_exponent: 0.5", "end: gap")
    assert pulling == GeneralDissipative(400.0, 0.0, 0.5, 0.5e-6, -numpy.inf)


def test_the_general_law_delivers_the_requested_restitution_of_the_whole_occupant():
    loss = seat_loss("restitution: 0.6", "reference_speed: 0.4", "approach_exponent: 0.5")
    mass, stiffness, n = 50.8, 2.73e5, 1.5
    length = (mass * 0.4**2 / stiffness) ** (1.0 / (n + 1.0))
    severity = loss.coefficient * length ** (0.5 - n) * 0.4 / stiffness
    assert general_law.restitution(severity, n, 0.5, 1.0, "force") == pytest.approx(0.6, abs=1e-9)


def test_the_general_law_is_none_where_the_scene_does_not_name_it():
    assert isinstance(model(name="seat_ride").rig.seat_contact.dissipative, NormalDissipative)
