"""From a property file to scene keys: closed forms, and tires that are found again from their own
stiffness and contact."""

import math
import re

import numpy
import pytest
from tests.rigs.vehicle.tire.property_file.tir_file import text, write

from contact_sim_pkg.rigs.vehicle.machines.flat_track import flat_track
from contact_sim_pkg.rigs.vehicle.tire.body import tire_body
from contact_sim_pkg.rigs.vehicle.tire.force_table import tire_table
from contact_sim_pkg.rigs.vehicle.tire.property_file import scene_keys
from contact_sim_pkg.rigs.vehicle.tire.property_file.errors import PropertyFileError
from contact_sim_pkg.rigs.vehicle.tire.property_file.fit import standing_on_belt
from contact_sim_pkg.rigs.vehicle.tire.property_file.reading import read_property_file
from contact_sim_pkg.rigs.vehicle.tire.property_file.scene_keys import scene_tire
from contact_sim_pkg.rigs.vehicle.tire.schema import Inflation
from contact_sim_pkg.rigs.vehicle.tire.size import read_size

RADIUS, WIDTH, LOAD = 0.316, 0.205, 4000.0


def keys_of(folder, **keys):
    return scene_tire(read_property_file(write(folder, **keys)))


def coefficients(stiffness, length, width, deflection=None):
    """Keys of a file whose tire has this stiffness and contact under 4 kN; load over stiffness is its
    deflection without another.
    """
    relative, x = LOAD / (stiffness * RADIUS), (deflection or LOAD / stiffness) / RADIUS
    return {
        "Q_FZ2": (1.0 / relative - 1.0 / x) / x,  # of q_1 x + q_2 x^2 = 1, slope q_1 + 2 q_2 x
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


@pytest.mark.parametrize(("angle", "modulus"), [(1.2, 6e6), (1.5, 3e6)])
def test_a_tire_is_found_again_from_its_stiffness_and_contact(tmp_path, angle, modulus):
    """To 1 %, though half and one and a half of the load, where the formulas are another tire, count too."""
    tire = standing_on_belt(Inflation(sidewall_angle=angle, tread_modulus=modulus), LOAD)
    ring = {"FREQ_LONG": math.sqrt(1.4e6 / 7.0) / (2.0 * math.pi)}
    shape = tire.stiffness, tire.length, tire.width, tire.deflection
    found = keys_of(tmp_path, **ring, **coefficients(*shape))
    names = ["radius", "stiffness", "deflection", "length of the contact", "width of the contact"]
    assert [row.quantity for row in found.fit[:5]] == names
    assert [row.difference for row in found.fit[:3]] == pytest.approx([0.0] * 3, abs=0.01)
    assert [row.difference for row in found.fit[3:5]] == pytest.approx([0.0] * 2, abs=0.05)
    assert found.usable


def test_the_fit_sees_the_tire_of_the_table_that_a_run_uses():
    size, keys = read_size("205/55 R16"), Inflation().model_dump()
    table = tire_table(
        tire_body({"inflation": {**keys, "sidewall_chord": size.sidewall_chord, "belt_width": size.belt_width}})
    )
    stiffness = numpy.interp(LOAD, table.force, numpy.gradient(table.force, table.spacing))
    length, width, _ = table.contact_at(LOAD)
    # But for whole cells of 2.5 mm.
    seen = standing_on_belt(Inflation(), LOAD)
    assert seen.stiffness == pytest.approx(stiffness, rel=1e-3)
    assert seen.deflection == pytest.approx(
        numpy.interp(LOAD, table.force, table.spacing * numpy.arange(len(table.force))), rel=1e-4
    )
    assert abs(seen.length - length) < 2.5e-3
    assert abs(seen.width - width) < 2.5e-3


KINDS = {
    "205/55 R16": ({}, 4000.0, 210e3),
    "265/70 R18": ({"UNLOADED_RADIUS": 0.409, "WIDTH": 0.265, "ASPECT_RATIO": 0.7, "RIM_RADIUS": 0.2286}, 4000.0, 248e3),
    "180/55 R17": ({"UNLOADED_RADIUS": 0.315, "WIDTH": 0.18, "RIM_RADIUS": 0.2159}, 1600.0, 170e3),
    "335/65 R22.5": (
        {"UNLOADED_RADIUS": 0.4987, "WIDTH": 0.335, "ASPECT_RATIO": 0.65, "RIM_RADIUS": 0.2858, "INFLPRES": 275790}, 17e3, 406e3,
    ),
}  # fmt: skip


@pytest.mark.parametrize("size", KINDS)
def test_car_suv_motorcycle_and_truck_are_met_in_radius_stiffness_and_deflection(tmp_path, size):
    """A linear load: the deflection is load over stiffness. Judged by the tire that a run has, not by the row."""
    keys, load, stiffness = KINDS[size]
    given = {"NOMPRES": None, "BELT_MASS": None, "FNOMIN": load, "VERTICAL_STIFFNESS": stiffness}
    found = keys_of(tmp_path, **given, **keys)
    assert found.effects["inflation"]["size"] == size
    standing = standing_on_belt(Inflation(**found.effects["inflation"]), load)
    assert standing.stiffness == pytest.approx(stiffness, rel=0.1)
    assert standing.deflection == pytest.approx(load / stiffness, rel=0.1)
    assert Inflation(**found.effects["inflation"]).radius == keys.get("UNLOADED_RADIUS")
    assert found.usable
    assert any("no Q_RA or Q_RB" in note for note in found.notes)


@pytest.mark.parametrize(
    ("format_", "words", "pressure", "notes"),
    [
        ("'PAC2002'", {"IP": 250000, "IP_NOM": 230000}, 250e3, [r"IP 250000 Pa \(line 26\) is .* IP_NOM 230000 Pa \(l"]),
        ("'PAC_MC'", {"INFLPRES": 200000, "IP": 250000}, 250e3, [r"IP 250000 Pa \(line 27\) counts, not INFLPRES 200000 Pa \(l"]),
        ("'MF_05'", {"INFLPRES": 200000, "IP": 250000}, 200e3, [r"INFLPRES 200000 Pa \(line 17\) counts, not IP 250000 Pa \(l"]),
        ("'5.2.1'", {"IP_NOM": 180000}, 180e3, [r"no operating inflation; IP_NOM 180000 Pa \(line 26\) counts"]),
        ("'UATIRE'", {"INFLATION_PRESSURE": 240000, "LIP": 0.5}, 120e3, []),
        ("'FIALA'", {"TIRE_PRESSURE": 240000, "PRESSURE": 240500}, 240e3, []),
        ("'MF-TYRE'", {}, 220e3, ["no INFLPRES, IP or other inflation; 220000 Pa is assumed"]),
    ],
)  # fmt: skip
def test_the_inflation_is_taken_in_the_words_of_each_format(tmp_path, format_, words, pressure, notes):
    given = {"INFLPRES": None, "NOMPRES": None, "VERTICAL_STIFFNESS": None, **words, "PROPERTY_FILE_FORMAT": format_}
    found = keys_of(tmp_path, **given)
    assert found.effects["inflation"]["pressure"] == pytest.approx(pressure)
    assert sum("IP" in note or "inflation" in note for note in found.notes) == len(notes)
    for wanted in notes:
        assert any(re.match(wanted, note) for note in found.notes)


def test_the_inflation_of_a_comment_counts_where_no_key_states_one(tmp_path):
    content = "! Infl. pressure (Pa) 180000\n" + text(INFLPRES=None, NOMPRES=None, VERTICAL_STIFFNESS=None)
    found = scene_tire(read_property_file(write(tmp_path, content)))
    assert found.effects["inflation"]["pressure"] == 180e3
    assert any("that of the comment in line 1" in note for note in found.notes)
    content = content.replace("180000", "800000")
    with pytest.raises(
        PropertyFileError, match=r"line 1: the inflation of a comment is 800000 Pa; .* takes 100000 to 400000"
    ):
        scene_tire(read_property_file(write(tmp_path, content)))


CURVE = "[DEFLECTION_LOAD_CURVE]\n{pen fz}\n0 0\n0.010 3000\n0.020 6400\n"


def test_a_table_of_loads_counts_and_its_contradiction_is_said(tmp_path):
    """4000 N lie on the line from 3000 N at 10 mm to 6400 N at 20 mm: 340 kN/m, 12.94 mm."""
    found = scene_tire(read_property_file(write(tmp_path, text(BELT_MASS=None) + CURVE)))
    assert [row.file for row in found.judged] == pytest.approx([0.316, 340e3, 0.01 + 1000.0 / 340e3])
    said = next(note for note in found.notes if "contradicts itself" in note)
    assert "under 4000 N [DEFLECTION_LOAD_CURVE] (line 28) has 3.4e+05 N/m and 12.9 mm" in said
    assert "VERTICAL_STIFFNESS (line 23) 2.2e+05 N/m and 18.2 mm" in said


def test_a_table_of_loads_that_agrees_within_10_percent_is_not_spoken_of(tmp_path, monkeypatch):
    monkeypatch.setattr(scene_keys, "fitted", lambda inflation, aim, ring: inflation)
    for factor, spoken in ((1.0, False), (1.09, False), (1.12, True), (0.88, True)):
        curve = f"[DEFLECTION_LOAD_CURVE]\n{{pen fz}}\n0 0\n0.05 {0.05 * 220e3 * factor}\n"
        found = scene_tire(read_property_file(write(tmp_path, text() + curve)))
        assert any("contradict" in note for note in found.notes) == spoken


def test_a_tire_that_cannot_be_met_is_not_usable(tmp_path):
    """A radius of 0.461 m in a file of 254/60 R15, 0.343 m by its size, and ten times the stiffness of any such tire."""
    given = {
        "UNLOADED_RADIUS": 0.461,
        "WIDTH": 0.254,
        "ASPECT_RATIO": 0.6,
        "RIM_RADIUS": 0.19,
        "VERTICAL_STIFFNESS": 2.1e6,
    }
    found = keys_of(tmp_path, **given, BELT_MASS=None)
    assert found.effects["inflation"]["radius"] == 0.461
    assert [row.quantity for row in found.judged] == ["radius", "stiffness", "deflection"]
    assert found.judged[0].difference == pytest.approx(0.0, abs=1e-12)
    assert found.judged[1].difference < -0.1
    assert not found.usable


def test_without_a_nominal_load_the_fit_is_at_15_percent_of_the_section_height(tmp_path, monkeypatch):
    """205/55: 0.15 * 0.11275 m at 220 kN/m are 3720.75 N."""
    monkeypatch.setattr(scene_keys, "fitted", lambda inflation, aim, ring: inflation)
    found = keys_of(tmp_path, FNOMIN=None, RIM_RADIUS=None, UNLOADED_RADIUS=0.31595)
    assert any("no FNOMIN; the fit is under 3721 N" in note for note in found.notes)
    assert any(
        "RIM_RADIUS 0.2032 m follows from UNLOADED_RADIUS, ASPECT_RATIO and WIDTH" in note for note in found.notes
    )
    assert found.judged[2].file == pytest.approx(0.15 * 0.55 * 0.205)


def test_what_a_tire_cannot_be_is_left_as_a_difference(tmp_path):
    found = keys_of(tmp_path, **coefficients(220e3, 0.06, 0.26))
    assert found.fit[3].difference > 0.1
    assert found.fit[4].difference < -0.1


@pytest.mark.parametrize(
    ("keys", "note"),
    [
        ({"UNLOADED_RADIUS": 0.310}, r"UNLOADED_RADIUS 0.31 m counts; the size alone would make 0.316 m"),
        ({"UNLOADED_RADIUS": None}, "no UNLOADED_RADIUS; that of the size, 0.316 m"),
        ({"ASPECT_RATIO": None}, "ASPECT_RATIO 0.55 follows from"),
        ({"RIM_RADIUS": 0.2075}, "the size is rounded: 205.0 mm, 55.0 % and 16.34 in to 205/55 R16.5"),
        ({"INFLPRES": None, "NOMPRES": None}, "no INFLPRES, IP or other inflation; 220000 Pa is assumed"),
        ({"BELT_MASS": None}, "no BELT_MASS and FREQ_LONG; ring_stiffness is fitted too"),
        (
            {"BELT_MASS": None, "VERTICAL_STIFFNESS": None},
            "no BELT_MASS and FREQ_LONG; ring_stiffness 1.19e+06 N/m is the usual one",
        ),
        ({"VERTICAL_STIFFNESS": None}, "not fitted: the file has no VERTICAL_STIFFNESS, Q_FZ1 or"),
        ({"INFLPRES": 320000}, "the tire is valid for 120000 to 300000 Pa"),
    ],
)
def test_what_is_assumed_is_said(tmp_path, monkeypatch, keys, note):
    monkeypatch.setattr(scene_keys, "fitted", lambda inflation, aim, ring: inflation)
    assert any(note in each for each in keys_of(tmp_path, **keys).notes)


@pytest.mark.parametrize(
    ("keys", "sentence"),
    [
        ({"WIDTH": None}, "WIDTH and two of .* are needed for the size of the tire; WIDTH are missing"),
        ({"WIDTH": 0.08}, "RIM_RADIUS make the size '80/55 R16'"),
        (
            {"INFLPRES": 650000},
            "line 17: the inflation of INFLPRES is 650000 Pa; the inflated tire of a scene takes 100000 to 400000 Pa",
        ),
        ({"IP": 800000, "INFLPRES": None}, "line 28: the inflation of IP is 800000 Pa; "),
        (
            {"UNLOADED_RADIUS": 0.22},
            r"line 12: UNLOADED_RADIUS: a radius of 0\.22 m is less than 0\.025 m above the rim",
        ),
        ({"UNLOADED_RADIUS": 0.2}, "line 12: UNLOADED_RADIUS 0.2 m is not above RIM_RADIUS 0.2032 m in line 15"),
        (
            {"UNLOADED_RADIUS": 1.2},
            "line 12: UNLOADED_RADIUS 1.2 m; a scene takes 0.15 to 0.8 m",
        ),
        ({"FREQ_LONG": 5.0}, "make a ring stiffness of 6909 N/m at 220000 Pa; 100000 to 1e\\+08 N/m"),
        ({"FNOMIN": 190000}, "carries FNOMIN 190000 N"),
    ],
)
def test_a_tire_that_no_scene_takes_is_refused(tmp_path, keys, sentence):
    with pytest.raises(PropertyFileError, match=sentence):
        keys_of(tmp_path, **keys)


CONTACT = coefficients(225e3, 0.143, 0.150, 0.023)


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


def test_without_a_contact_the_slip_stiffness_is_left_with_a_note(tmp_path, monkeypatch):
    monkeypatch.setattr(scene_keys, "fitted", lambda inflation, aim, ring: inflation)
    found = keys_of(tmp_path, PKX1=22.0)
    assert "brush" not in found.effects
    assert any("PKX1 is not used" in note for note in found.notes)


def test_side_stiffness_above_the_bristles_is_left_with_a_note(tmp_path, monkeypatch):
    monkeypatch.setattr(scene_keys, "fitted", lambda inflation, aim, ring: inflation)
    given = {"PKX1": 5.0, "LATERAL_STIFFNESS": 1e7}
    found = keys_of(tmp_path, **CONTACT, **given)
    assert "lateral" not in found.effects["sidewall_compliance"]
    assert any("above that of the bristles alone" in note for note in found.notes)
