"""Tests of foam from files: the points and the share of a loop in closed form, and one sentence for each that is none."""

import shutil
from pathlib import Path

import numpy
import pytest

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.load import load_scene
from contact_sim_pkg.scene.overrides import set_value
from contact_sim_pkg.scene.resolve import load_resolved, read_explicit, read_resolved
from contact_sim_pkg.scene.schema.foam_file import read_foam_file
from contact_sim_pkg.scene.schema.foam_points import elastic_of, share_of
from contact_sim_pkg.sweep.case import case_name

SAMPLE = Path(__file__).parents[3] / "examples" / "inputs" / "foam.csv"
CURVE = "effects.seat.cushion.curve"
WAY = [3.0 * number for number in range(12)]  # [mm]
NAMES = "deflection [mm],force [N]"


def force(way):
    """[N]"""
    return 400.0 * (1.0 - numpy.exp(-numpy.asarray(way) / 10.0)) + 10.0 * numpy.asarray(way)


UP, DOWN = 1.2 * force(WAY), 0.8 * force(WAY)


def written(path, names=NAMES, way=(*WAY, *WAY[::-1]), load=(*UP, *DOWN[::-1])):
    path.write_text(
        "\n".join([names, *(f"{x!r},{y!r}" for x, y in zip(map(float, way), map(float, load), strict=True))])
    )
    return path


def points_of(path, area=0.01, thickness=0.05):
    return read_foam_file(path, area, thickness, None, CURVE)


def test_strain_and_stress_are_those_of_the_specimen(tmp_path):
    points = numpy.array(points_of(written(tmp_path / "foam.csv")))
    assert points[:, 0] == pytest.approx(numpy.array(WAY[1:]) / 50.0, rel=1e-9)
    assert points[:, 1] == pytest.approx(UP[1:] / 0.01, rel=1e-9)
    assert points[:, 2] == pytest.approx(DOWN[1:] / 0.01, rel=1e-9)
    _strain, stress = elastic_of(points.tolist())
    assert stress == pytest.approx(force(WAY[1:]) / 0.01, rel=1e-9)
    assert share_of(points.tolist()) == pytest.approx(0.2, rel=1e-9)


@pytest.mark.parametrize(
    ("names", "way", "load"),
    [
        ("deflection_mm,force_N", 1.0, 1.0), ("Indentation (cm),Load (kN)", 0.1, 1e-3), ("weg [mm],kraft [N]", 1.0, 1.0),
        ("strain [%],stress [kPa]", 2.0, 0.1), ("strain_1,stress_kPa", 0.02, 0.1),
    ],
)  # fmt: skip
def test_units_stand_in_the_names(tmp_path, names, way, load):
    expected = points_of(written(tmp_path / "plain.csv"))
    scaled = written(
        tmp_path / "foam.csv", names, way * numpy.array([*WAY, *WAY[::-1]]), load * numpy.array([*UP, *DOWN[::-1]])
    )
    assert numpy.array(points_of(scaled)) == pytest.approx(numpy.array(expected), rel=1e-8)


def test_a_loading_alone_has_no_share(tmp_path):
    points = points_of(written(tmp_path / "foam.csv", way=WAY, load=UP))
    assert {len(each) for each in points} == {2}
    assert share_of(points) is None


def test_samples_that_are_held_at_the_largest_deflection_are_passed_over(tmp_path):
    path = written(
        tmp_path / "foam.csv", way=(*WAY, WAY[-1], *WAY[::-1]), load=(*UP, 0.9 * UP[-1], *DOWN[::-1])
    )  # fmt: skip
    assert points_of(path) == points_of(written(tmp_path / "plain.csv"))


def test_an_unloading_that_ends_at_a_set_is_zero_below(tmp_path):
    """Released to 6 mm without force: nothing is carried below."""
    points = points_of(written(tmp_path / "foam.csv", way=(*WAY, *WAY[:1:-1]), load=(*UP, *DOWN[:2:-1], 0.0)))
    assert [each[2] for each in points[:2]] == [0.0, 0.0]
    assert [each[2] for each in points[2:]] == pytest.approx(DOWN[3:] / 0.01)


def test_many_samples_with_noise_become_a_hundred_points(tmp_path):
    way = numpy.linspace(0.0, 35.0, 5000)
    noise = numpy.random.default_rng(1).normal(0.0, 0.2, 10_000)
    both = numpy.concatenate((1.2 * force(way), 0.8 * force(way[::-1]))) + noise
    points = numpy.array(points_of(written(tmp_path / "foam.csv", way=(*way, *way[::-1]), load=both)))
    assert len(points) <= 100
    inner = points[(points[:, 0] > 0.05) & (points[:, 0] < 0.68)]
    assert inner[:, 1] == pytest.approx(1.2 * force(50.0 * inner[:, 0]) / 0.01, rel=3e-3)
    assert share_of(points.tolist()) == pytest.approx(0.2, rel=5e-3)


FOLDED = UP.copy()
FOLDED[7] = 300.0


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"load": (*FOLDED, *DOWN[::-1])}, "line 9: 'force' is 300 N; while loading it falls back from"),
        ({"load": (*UP, *DOWN[:-5:-1], 800.0, *DOWN[-6::-1])}, "line 18: 'force' is 800 N; while unloading it rises again"),
        ({"way": (*WAY, *WAY[::-1]) * 2, "load": (*UP, *DOWN[::-1]) * 2}, "cut other cycles"),
        ({"load": (*DOWN, *UP[::-1])}, "line 14: 'force' is 858.3 N; while unloading it is above the loading, 572.2 N there"),
        ({"way": WAY[:4], "load": UP[:4]}, "the loading has 3 points that rise, at least 5 are needed"),
        ({"way": (*WAY, 20.0, 0.0), "load": (*UP, 300.0, 0.0)}, "the unloading has 2 points"),
        ({"names": "deflection,force"}, "column 'deflection' has no unit that fits; write it behind the name"),
        ({"names": "deflection [mm],force"}, "column 'force' has no unit that fits"),
        ({"names": "deflection [mm],force [s]"}, "column 'force' has no unit that fits"),
        ({"names": "strain [1],stress [kPa]"}, "'strain' is 3; a strain is below 1; one in percent has the unit %"),
        ({"thickness": 0.03}, "line 12: 'deflection' is 30 mm; it is not below the thickness of 30 mm"),
        ({"area": None}, f"'force' is a force; give the area that it acts on in m^2, {CURVE}.area"),
        ({"way": [-x for x in (*WAY, *WAY[::-1])]}, "line 3: 'deflection' is -3 mm; compression is counted positive"),
        ({"load": [-x for x in (*UP, *DOWN[::-1])]}, "compression is counted positive; turn its sign"),
        ({"way": WAY, "load": UP + 30.0}, "line 2: 'force' is 30 N; without deflection it is 0; take a preload off"),
        ({"load": (*UP, *(0.04 * DOWN[::-1]))}, "the loop has a share of 0.948, at most 0.9 are allowed"),
    ],
)  # fmt: skip
def test_what_is_no_curve_of_a_foam_is_refused(tmp_path, changes, said):
    settings = {name: changes.pop(name) for name in ("area", "thickness") if name in changes}
    path = written(tmp_path / "foam.csv", **changes)
    with pytest.raises(ExcitationError) as refused:
        points_of(path, **settings)
    assert str(path) in str(refused.value)
    assert said in str(refused.value)


def resolved(path, *values, area=0.01):
    return load_resolved("seat_ride", f"{CURVE}={{file: {path}, area: {area}, thickness: 0.05}}", *values)


def test_the_resolved_scene_carries_the_points_and_needs_no_file(tmp_path):
    path = written(tmp_path / "foam.csv")
    scene = resolved(path)
    curve = scene.data["effects"]["seat"]["cushion"]["curve"]
    assert curve["points"] == points_of(path)
    assert curve["file"] == "foam.csv"
    assert len(curve["sha256"]) == 64
    path.unlink()
    again = read_resolved(scene.to_yaml(), folder=tmp_path)
    assert again.data == scene.data


def test_a_case_of_a_sweep_knows_the_content(tmp_path):
    path = written(tmp_path / "foam.csv")
    first = case_name(resolved(path), "")
    assert case_name(resolved(path), "") == first
    written(path, load=(*(1.01 * UP), *DOWN[::-1]))
    assert case_name(resolved(path), "") != first


def test_another_file_takes_the_place_of_the_points(tmp_path):
    text = resolved(written(tmp_path / "foam.csv")).to_yaml()
    other = written(tmp_path / "other.csv", load=(*(2.0 * UP), *DOWN[::-1]))
    data = read_explicit(text, "a bag", [set_value(f"{CURVE}.file={other}")])
    assert data["effects"]["seat"]["cushion"]["curve"]["points"] == points_of(other)


def test_the_loop_gives_the_share_that_a_scene_leaves_open(tmp_path):
    path = written(tmp_path / "foam.csv")
    share = "effects.seat.foam_hysteresis"
    assert resolved(path, f"{share}={{}}").data["effects"]["seat"]["foam_hysteresis"]["share"] == pytest.approx(0.2)
    assert resolved(path, f"{share}={{share: 0.3}}").data["effects"]["seat"]["foam_hysteresis"]["share"] == 0.3
    usual = load_resolved("seat_ride", f"{share}={{}}").data["effects"]["seat"]["foam_hysteresis"]["share"]
    assert usual == 0.12


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ([f"{CURVE}={{file: none.csv}}"], "the file 'none.csv' is not there"),
        ([f"{CURVE}={{file: foam.csv}}"], "'force' is a force; give the area"),
        ([f"{CURVE}={{}}"], "is missing; give the file of the test, or points"),
        ([f"{CURVE}={{points: [[0.1, 1], [0.2, 2], [0.3, 1], [0.4, 4], [0.5, 5]]}}"], "point 3: stress 1 Pa is not above 2 Pa"),
        ([f"{CURVE}={{points: [[0.1, 1], [0.2, 2], [0.3, 3], [0.4, 4], [1, 5]]}}"], "strain 1 is not above 0.4 and below 1"),
        ([f"{CURVE}={{points: [[0.1, 1, 2], [0.2, 2, 2], [0.3, 3, 2], [0.4, 4, 2], [0.5, 5, 2]]}}"], "while unloading is not from"),
        ([f"{CURVE}={{points: [[0.1, 1, 1], [0.2, 2], [0.3, 3], [0.4, 4], [0.5, 5]]}}"], "point 2 has 2 numbers, point 1 has 3"),
        ([f"{CURVE}={{points: [[0.1, 1]]}}"], "5 to 200 points"),
        ([f"{CURVE}={{area: 1, points: [[0.1, 1], [0.2, 2], [0.3, 3], [0.4, 4], [0.5, 5]]}}"], "belongs to a file"),
        ([f"{CURVE}={{file: foam.csv, sha256: {64 * '0'}, area: 0.01}}"], "has another content than the scene states"),
        *(
            ([f"{CURVE}={{file: foam.csv, area: 0.01}}", f"effects.seat.cushion.{key}"], "is a stress of the formula")
            for key in ("modulus=50000", "plateau=3000", "densification=90", "densification_exponent=2", "hardness=7000")
        ),
        (
            [f"{CURVE}={{file: foam.csv, area: 0.01}}", "effects.seat.cushion.carrier=plate", "effects.seat.cushion.tissue=2000"],
            "acts in foam, the carrier is a plate",
        ),
    ],
)  # fmt: skip
def test_a_scene_that_does_not_fit_its_curve_is_refused(tmp_path, monkeypatch, values, said):
    shutil.copy(SAMPLE, tmp_path / "foam.csv")
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SceneError) as refused:
        load_scene("seat_ride", map(set_value, values))
    assert said in str(refused.value)
