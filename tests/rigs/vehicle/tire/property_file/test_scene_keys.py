"""From a property file to scene keys: closed forms, and tires that are found again from their own
stiffness and contact."""

import math

import numpy
import pytest
from tests.rigs.vehicle.tire.property_file.tir_file import write

from contact_sim_lab.rigs.vehicle.machines.flat_track import flat_track
from contact_sim_pkg.rigs.vehicle.tire.body import tire_body
from contact_sim_pkg.rigs.vehicle.tire.force_table import tire_table
from contact_sim_pkg.rigs.vehicle.tire.property_file.errors import PropertyFileError
from contact_sim_pkg.rigs.vehicle.tire.property_file.fit import standing_on_belt
from contact_sim_pkg.rigs.vehicle.tire.property_file.reading import read_property_file
from contact_sim_pkg.rigs.vehicle.tire.property_file.scene_keys import scene_tire
from contact_sim_pkg.rigs.vehicle.tire.schema import Inflation
from contact_sim_pkg.rigs.vehicle.tire.size import read_size

RADIUS, WIDTH, LOAD = 0.316, 0.205, 4000.0


def keys_of(folder, **keys):
    return scene_tire(read_property_file(write(folder, **keys)))


def coefficients(stiffness, length, width):
    """Keys of a file whose tire has this stiffness and contact under 4 kN."""
    relative = LOAD / (stiffness * RADIUS)
    return {
        "VERTICAL_STIFFNESS": float(stiffness), "Q_RA1": 0.5 * length / RADIUS / math.sqrt(relative),
        "Q_RB1": 0.5 * width / WIDTH / relative ** (1.0 / 3.0),
    }  # fmt: skip


def test_the_ring_is_that_of_belt_mass_frequency_and_damping(tmp_path):
    """K = m (2 pi f)^2 at 180 kPa; a quarter of it stays without inflation. Damping at the 240 kPa of the run."""
    found = keys_of(tmp_path, NOMPRES=180000, INFLPRES=240000, VERTICAL_STIFFNESS=None).effects
    at_220 = 7.0 * (2.0 * math.pi * 70.0) ** 2 / (0.25 + 0.75 * 180.0 / 220.0)
    at_240 = at_220 * (0.25 + 0.75 * 240.0 / 220.0)
    assert found["inflation"]["ring_stiffness"] == pytest.approx(at_220, rel=1e-5)
    assert found["rigid_ring"] == pytest.approx(
        {"belt_mass": 7.0, "damping": 2.0 * 0.045 * math.sqrt(7.0 * at_240)}, rel=1e-5
    )


@pytest.mark.parametrize(("angle", "modulus"), [(1.2, 6e6), (1.5, 3e6), (1.0, 4e6)])
def test_a_tire_is_found_again_from_its_stiffness_and_contact(tmp_path, angle, modulus):
    tire = standing_on_belt(Inflation(sidewall_angle=angle, tread_modulus=modulus), LOAD)
    ring = {"FREQ_LONG": math.sqrt(1.4e6 / 7.0) / (2.0 * math.pi)}
    found = keys_of(tmp_path, **ring, **coefficients(tire.stiffness, tire.length, tire.width))
    assert found.effects["inflation"]["sidewall_angle"] == pytest.approx(angle, abs=0.02)
    assert found.effects["inflation"]["tread_modulus"] == pytest.approx(modulus, rel=0.02)
    assert found.fit[0].difference == pytest.approx(0.0, abs=1e-3)
    assert found.fit[3].tire == pytest.approx(tire.deflection, rel=5e-3)


def test_the_default_tire_is_found_again_from_the_table_that_a_run_uses(tmp_path):
    """Its contact counts whole cells, up to 1.6 % more than the fit, which a modulus of 6 % makes."""
    size, keys = read_size("205/55 R16"), Inflation().model_dump()
    table = tire_table(
        tire_body({"inflation": {**keys, "sidewall_chord": size.sidewall_chord, "belt_width": size.belt_width}})
    )
    stiffness = numpy.interp(LOAD, table.force, numpy.gradient(table.force, table.spacing))
    length, width, _ = table.contact_at(LOAD)
    # The fit sees the tire of the run, but for whole cells of 2.5 mm.
    seen = standing_on_belt(Inflation(), LOAD)
    assert seen.stiffness == pytest.approx(stiffness, rel=1e-3)
    assert seen.deflection == pytest.approx(
        numpy.interp(LOAD, table.force, table.spacing * numpy.arange(len(table.force))), rel=1e-4
    )
    assert abs(seen.length - length) < 2.5e-3
    assert abs(seen.width - width) < 2.5e-3
    ring = {"FREQ_LONG": math.sqrt(1.4e6 / 7.0) / (2.0 * math.pi)}
    found = keys_of(tmp_path, **ring, **coefficients(stiffness, length, width)).effects
    assert found["inflation"]["size"] == "205/55 R16"
    assert found["inflation"]["pressure"] == 220e3
    assert found["inflation"]["ring_stiffness"] == pytest.approx(1.4e6, rel=1e-5)
    assert found["inflation"]["sidewall_angle"] == pytest.approx(1.431, abs=0.06)
    assert found["inflation"]["tread_modulus"] == pytest.approx(4e6, rel=0.08)


def test_without_a_contact_the_stiffness_is_met_and_a_note_says_so(tmp_path):
    found = keys_of(tmp_path, VERTICAL_STIFFNESS=240000.0, PFZ1=0.7)
    assert [row.quantity.partition(" ")[0] for row in found.fit] == ["stiffness", "deflection", "stiffness"]
    assert found.fit[0].difference == pytest.approx(0.0, abs=1e-3)
    assert found.fit[2].file == pytest.approx(0.69, abs=0.02)  # ln(1 + 0.07) / ln 1.1 = 0.71, less q_2 = 0
    assert any("no Q_RA or Q_RB" in note for note in found.notes)


def test_what_a_tire_cannot_be_is_left_as_a_difference(tmp_path):
    found = keys_of(tmp_path, **coefficients(220e3, 0.08, 0.2))
    assert found.fit[0].difference == pytest.approx(0.0, abs=0.02)
    assert found.fit[1].difference > 0.1
    assert found.fit[2].difference < -0.1


@pytest.mark.parametrize(
    ("keys", "note"),
    [
        ({"UNLOADED_RADIUS": 0.310}, r"UNLOADED_RADIUS is 0.31 m, the size has 0.316 m"),
        ({"UNLOADED_RADIUS": None}, "no UNLOADED_RADIUS; that of the size, 0.316 m"),
        ({"ASPECT_RATIO": None}, "ASPECT_RATIO 0.55 follows from"),
        ({"RIM_RADIUS": 0.209}, "the size is rounded: 205.0 mm, 55.0 % and 16.46 in to 205/55 R16"),
        ({"INFLPRES": None, "NOMPRES": None}, "no INFLPRES; inflation 220000 Pa is assumed"),
        ({"BELT_MASS": None}, "no BELT_MASS and FREQ_LONG; ring_stiffness 1.4e+06 N/m is the usual one"),
        ({"FNOMIN": None}, "not fitted: FNOMIN and VERTICAL_STIFFNESS are needed"),
        ({"INFLPRES": 320000}, "the tire is valid for 120000 to 300000 Pa"),
    ],
)
def test_what_is_assumed_is_said(tmp_path, keys, note):
    assert any(note in each for each in keys_of(tmp_path, **keys).notes)


@pytest.mark.parametrize(
    ("keys", "sentence"),
    [
        ({"WIDTH": None}, "WIDTH, ASPECT_RATIO and RIM_RADIUS are needed"),
        ({"WIDTH": 0.08}, "RIM_RADIUS make the size '80/55 R16'"),
        ({"INFLPRES": 650000}, "inflation 650000 Pa; the inflated tire of a scene takes 100000 to 400000 Pa"),
        ({"FREQ_LONG": 5.0}, "make a ring stiffness of 6909 N/m at 220000 Pa; 100000 to 1e\\+08 N/m"),
        ({"FNOMIN": 190000}, "carries FNOMIN 190000 N"),
    ],
)
def test_a_tire_that_no_scene_takes_is_refused(tmp_path, keys, sentence):
    with pytest.raises(PropertyFileError, match=sentence):
        keys_of(tmp_path, **keys)


CONTACT = coefficients(225e3, 0.143, 0.150)


def test_bristles_and_sidewalls_make_the_stiffnesses_of_the_file(tmp_path):
    """Slip stiffness and side stiffness of the scene's tire, rolled: those of PKX1 and LATERAL_STIFFNESS."""
    given = {"PKX1": 22.0, "LATERAL_STIFFNESS": 150e3, "YAW_STIFFNESS": 5000, "FREQ_WINDUP": 60.0}
    found = keys_of(tmp_path, **CONTACT, **given)
    brush, belt = found.effects["brush"], found.effects["sidewall_compliance"]
    assert belt["rotational"] == pytest.approx(0.6 * (2.0 * math.pi * 60.0) ** 2, rel=1e-5)
    values = [
        f"effects.tire.{effect}={{{', '.join(f'{key}: {value!r}' for key, value in keys.items())}}}"
        for effect, keys in found.effects.items()
    ]
    track = flat_track(4000.0, 16.7, 0.5, *values, "slip={longitudinal: -0.002}")
    assert track.force[-200:, 0].mean() / -0.002 == pytest.approx(22.0 * 4000.0, rel=0.15)
    series = 1.0 / (1.0 / belt["lateral"] + 1.0 / (brush["stiffness_y"] * 0.0196))
    assert series == pytest.approx(150e3, rel=0.02)


def test_without_a_contact_the_slip_stiffness_is_left_with_a_note(tmp_path):
    found = keys_of(tmp_path, PKX1=22.0)
    assert "brush" not in found.effects
    assert any("PKX1 is not used" in note for note in found.notes)


def test_side_stiffness_above_the_bristles_is_left_with_a_note(tmp_path):
    given = {"PKX1": 5.0, "LATERAL_STIFFNESS": 1e7}
    found = keys_of(tmp_path, **CONTACT, **given)
    assert "lateral" not in found.effects["sidewall_compliance"]
    assert any("above that of the bristles alone" in note for note in found.notes)
