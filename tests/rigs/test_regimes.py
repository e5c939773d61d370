"""Every shipped scene states what it is there to show, and its run shows it."""

import math

import numpy
import pytest
from scipy.optimize import brentq

from contact_sim_lab.hard import regime_table
from contact_sim_lab.hard.regime_table import MET, MISSED, row_of_scene, study
from contact_sim_pkg.cli.main import main
from contact_sim_pkg.records.registry import rigs, shipped_scenes
from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.resolve import load_resolved

G = 9.81
MIRRORED = "block.rotation=[0.0, 0.463647609, 0.0]"
SOON = {
    # as long as the regime needs; a rig that shows it late shows it sooner by the values beside
    "office_chair": ("duration=1",), "plate": ("duration=1",),
    "seat_ride": ("duration=1",), "seat_ride_full": ("duration=1",), "car_full_bench": ("duration=0.1",),
    "seat_drop": ("duration=0.5",), "seat_shell": ("duration=1",), "seat_shock": ("duration=0.4",), "seat_slip": ("duration=1",),
    "block_painleve": ("duration=0.06",), "block_slope": ("duration=0.25",), "block_fall": ("duration=0.5",),
    "box_3d_tumble": ("duration=1.2",),
    "impact_pendulum": ("duration=2",), "impact_steel": ("duration=0.5",),
    "impact_temperature_sweep": ("duration=6", "impact.repeats=1", "impact.speeds=[1.0]"),
    "roller_flutter": ("duration=1",), "roller_corrugation": ("duration=2",),
    "roller_hour": ("duration=4", "effects.roller.subsurface.instants=[0.0]"),
    "roller_programme": ("duration=4.1", "effects.roller.subsurface.instants=[0.0]"),
    "tire_bump": ("duration=0.2", "road.position=1.0"), "tire_half_space": ("duration=0.05",),
    "tire_cleat": ("duration=0.4", "road.position=0.6"),
    "tire_braking": (
        "duration=0.2", "slip={points: [[0, 0, 0], [0.1, -1.0, 0.0], [0.2, -1.0, 0.0]]}", "expect.at_least=0.08",
        "expect.at_most=0.12",
    ),
    "tire_rough_road": ("duration=0.4",), "tire_belgian_block": ("duration=0.2",), "tire_texture": ("duration=0.02",),
    "tire_irregular_road": ("duration=0.02",),
}  # fmt: skip


@pytest.fixture(scope="module")
def rows():
    return {row["scene"]: row for found in study(lambda _line: None, values=SOON) for row in found}


def test_every_shipped_scene_shows_what_it_is_there_for(rows):
    assert list(rows) == list(shipped_scenes())
    assert {name: row["remark"] for name, row in rows.items() if row["verdict"] != MET} == {}
    assert not regime_table.failed(rows.values())
    assert regime_table.summary([*rows.values()]) == f"{len(rows)} of {len(rows)} scenes show what they are there for"


def test_the_energy_of_every_shipped_scene_closes(rows):
    """To a thousandth of what an energy that was forgotten would leave open."""
    assert {name: row["residual"] for name, row in rows.items() if not 0.0 <= row["residual"] <= 1e-3} == {}


def test_figures_are_those_of_closed_forms(rows):
    """Times of stopping and of infinitely many impacts; passages of two radii; load of the step that yields."""
    slope, friction, fall = math.radians(15.0), 0.3, math.sqrt(2.0 / G)
    expected = {
        "block_slope": (1.0 / (G * (math.sin(slope) + friction * math.cos(slope))), 1.1e-3),
        "block_zeno": (fall * (1.0 + 0.8) / (1.0 - 0.8), 1.1e-3),
        "roller_programme": (4.0, 1e-9),
        "tire_half_space": (2.0, 0.1),
    }  # fmt: skip
    for name, (value, within) in expected.items():
        assert rows[name]["value"] == pytest.approx(value, abs=within), name
    shaft = brentq(lambda t: 0.340 - (0.130 - 0.012 * t) * math.cos(math.pi * t / 2.0) - 0.320 - 0.002 * t, 0.0, 2.0)
    assert float(rows["roller_steady"]["remark"].split()[1].strip(",")) == pytest.approx(shaft, abs=0.02)


def denominator(x, z, friction, mass=1.0, sides=(0.02, 0.4)):
    """Normal acceleration by a unit of normal force at a corner (x, z) from the centre that slides forward."""
    inertia = mass * (sides[0] ** 2 + sides[1] ** 2) / 12.0
    lever = numpy.array([-x, z])  # of normal and friction about +y
    return 1.0 / mass + lever[0] * (lever[0] - friction * lever[1]) / inertia


@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_the_slender_block_jams_when_it_leans_ahead_and_the_mirrored_one_slides_on(rows, sign):
    """Its lowest corner lies ahead of the centre of mass by the first rotation, behind it by the other."""
    angle = sign * 0.463647609
    corners = [(x * math.cos(angle) + z * math.sin(angle), -x * math.sin(angle) + z * math.cos(angle))
               for x in (-0.01, 0.01) for z in (-0.2, 0.2)]  # fmt: skip
    lowest = min(corners, key=lambda corner: corner[1])
    expected = denominator(*lowest, friction=2.0)
    row = rows["block_painleve"]
    if sign > 0.0:
        row = row_of_scene("block_painleve", (*SOON["block_painleve"], MIRRORED))
    assert float(row["remark"].split()[-2]) == pytest.approx(expected, abs=6e-3)
    assert (expected < 0.0) == (row["verdict"] == MET) == (sign < 0.0)
    if sign > 0.0:
        assert row["value"] is None
        assert row["remark"].startswith("it can slide on")


def test_a_scene_says_at_its_end_whether_it_showed_what_it_expects(tmp_path, capsys):
    values = ["--set", "duration=0.06", "--offline", "--strict"]
    assert main(["run", "block_painleve", *values, "--out", str(tmp_path / "met")]) == 0
    assert "expected: jams: met, slip behind the first contact" in capsys.readouterr().out
    values += ["--set", "expect.regime=rests"]
    assert main(["run", "block_painleve", *values, "--out", str(tmp_path / "missed")]) == 1
    assert "expected: rests: MISSED" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("value", "sentence"),
    [
        ("expect.regime=slaps", "the rig block has no regime slaps; it has jams, sticks, rests"),
        ("expect.regime=jam", "'jam' is not allowed"),
        ("expect.at_least=1", "1 is above at_most (0.01)"),
        ("expect={at_least: 1}", "expect.regime: is missing"),
    ],
)
def test_an_expectation_that_is_none_is_refused(value, sentence):
    with pytest.raises(SceneError) as refused:
        load_resolved("block_painleve", "expect.at_most=0.01", value)
    assert sentence in str(refused.value)


def test_an_expectation_stands_in_the_resolved_scene_and_none_where_none_is_given():
    assert load_resolved("block_painleve").data["expect"] == {"regime": "jams"}
    assert "expect" not in load_resolved("block_painleve", "expect=null").data


def test_a_scene_without_one_and_a_run_that_ends_early_fail_the_table(tmp_path):
    row = row_of_scene("block_slope", ("duration=0.02", "expect=null"))
    assert row["verdict"] == "none"
    assert (regime_table.failed([row]), regime_table.unjudged([row])) == (False, True)
    row = row_of_scene("roller_flutter", ("roller.tilt=0.1", "duration=4.0"))
    assert row["verdict"] == MISSED
    assert regime_table.failed([row])
    assert "tips over" in row["remark"]


def test_a_word_that_several_rigs_share_means_the_same():
    seen = {}
    for rig in rigs().values():
        for regime in rig.regimes:
            assert seen.setdefault(regime.name, regime) == regime


def test_a_scene_that_ends_in_doubt_says_so_in_its_first_comment(tmp_path):
    """Each word of an ending is asked for on its own; comments behind the first key do not count."""
    path = tmp_path / "scene.yaml"
    path.write_text("# A ride whose figures\n# are doubtful.\nrig: seat\n# outside, above its request\n")
    comment = regime_table.first_comment(path)
    sure = {"verdict": "good", "broken": []}
    assert regime_table.unsaid({"metrics": [sure]}, comment) == []
    assert regime_table.unsaid({"metrics": [sure, sure | {"broken": ["too short"]}]}, comment) == []
    assert regime_table.unsaid({"metrics": [sure | {"verdict": "outside"}]}, comment) == ["outside"]
    beyond = {"requested": 1e-2, "estimated": {"tire": {"force": 2e-2}}, "not_below": {}}
    assert regime_table.unsaid({"metrics": [sure], "accuracy": beyond}, comment) == ["above its request"]
    assert regime_table.unsaid({"metrics": [sure], "accuracy": beyond | {"requested": 3e-2}}, comment) == []
