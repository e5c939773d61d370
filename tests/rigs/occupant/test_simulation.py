"""An occupant on a pan and against a back: the two rigs side by side, and the maps of both."""

import numpy
import pytest
from tests.run.scenes import FRICTIONLESS, resolved

from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.records.messages import BodyMotion, ContactForce, ContactPatch, EnergyLedger
from contact_sim_pkg.run.rigs import make_simulation, result_topics
from contact_sim_pkg.run.sources import make_sources

FORWARD = ("vibration={kind: sine, axis: x, frequency: 5.25, amplitude: 25}", "duration=0.6")
DROP = ("vibration={kind: half_sine, axis: z, amplitude: -40, duration: 0.1, start: 0.05}", "duration=0.6")


def messages_of(scene):
    """Every message by topic."""
    simulation, sources = make_simulation(scene), make_sources(scene)
    simulation.prepare()
    found = {topic: [] for topic in result_topics(scene)}
    for block in range(simulation.blocks):
        given = {topic: source.block(block) for topic, source in sources.items()}
        for topic, _stamp, data in simulation.advance(block, given).messages:
            found[topic].append(data)
    return found


@pytest.fixture(scope="module")
def shaken():
    return messages_of(resolved("seat_ride_full", *FORWARD))


@pytest.fixture(scope="module")
def dropped():
    return messages_of(resolved("seat_ride_full", *DROP))


def forces(found, contact):
    return numpy.concatenate([decode(ContactForce, data).normal for data in found[f"{contact}/force"]])


@pytest.mark.parametrize("contact", ["seat", "backrest"])
def test_a_map_is_one_sided_and_its_integral_is_the_force(shaken, dropped, contact):
    for found in (shaken, dropped):
        force = forces(found, contact)
        fields = [decode(ContactPatch, data) for data in found[f"{contact}/patch"]]
        every = len(force) // len(fields)
        for number, field in enumerate(fields):
            pressure = field.pressure.astype(float)
            assert (pressure >= 0.0).all()
            expected = pytest.approx(force[number * every], rel=1e-6)
            assert pressure.sum() * field.cell_x * field.cell_y == expected
            assert field.load == expected


def test_the_occupant_lifts_off_the_pan_of_a_dropped_seat_and_the_back_stays(dropped):
    assert (forces(dropped, "seat") == 0.0).any()
    assert forces(dropped, "backrest") == pytest.approx(80.0, rel=1e-9)


def test_the_back_leaves_a_seat_shaken_forward_and_the_pan_keeps_its_load(shaken):
    assert (forces(shaken, "backrest") == 0.0).any()
    assert forces(shaken, "seat") == pytest.approx(50.8 * 9.81, rel=1e-3)


def test_each_contact_does_what_it_does_in_its_own_rig(shaken):
    effects = resolved("seat_ride_full").data["effects"]
    back = resolved(
        "seat_slap",
        *FRICTIONLESS,
        *FORWARD,
        "backrest.mass=20",
        "backrest.preload=80",
        f"effects.backrest={effects['backrest']}",
    )
    assert messages_of(back)["backrest/force"] == shaken["backrest/force"]


def test_motions_stand_side_by_side_and_energies_add_up(dropped):
    motion = decode(BodyMotion, dropped["bench/motion"][0])
    assert motion.bodies == ("floor_z", "seat_frame_z", "occupant1_z", "occupant2_z", "seat_back_x", "occupant_x")
    ledgers = [decode(EnergyLedger, data) for data in dropped["bench/energy"]]
    supplied = max(abs(each.supplied) for each in ledgers)
    assert supplied > 10.0
    assert max(abs(each.residual) for each in ledgers) <= 1e-6 * supplied


def test_foam_bottoms_out_under_an_occupant_who_falls_back():
    with_it = messages_of(resolved("seat_drop", "duration=0.8"))
    without = messages_of(resolved("seat_drop", "duration=0.8", "effects.seat.foam.densification=0"))
    depths = [
        max(decode(ContactForce, data).approach.max() for data in found["seat/force"]) for found in (with_it, without)
    ]
    assert (forces(with_it, "seat") == 0.0).any()
    assert 0.6 * 0.08 < depths[0] < depths[1] - 0.003
