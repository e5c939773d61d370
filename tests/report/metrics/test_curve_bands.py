"""Bands round curves: how far a curve lies beyond, and what is no band."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.files import FileRefusedError
from contact_sim_pkg.records.metric import EVENT, OUTSIDE, STATIONARY
from contact_sim_pkg.report.metrics import curve_bands
from contact_sim_pkg.report.metrics.requirements import bands_of, read_requirements, required
from contact_sim_pkg.sweep.plan import judged_rows, read_plan, run_plan, status_of

BAND = curve_bands.CurveBand("seat.transmissibility", (0.0, 10.0), (0.0, 0.0), (1.0, 2.0))


def of(x, y, band=BAND, unit="Hz"):
    return curve_bands._beyond(band, np.asarray(x, float), np.asarray(y, float), unit)


@pytest.mark.parametrize(("lift", "value"), [(-0.5, -0.5), (0.25, 0.25), (-1.75, 0.75)])
def test_a_curve_is_beyond_by_its_worst_point(lift, value):
    """The upper end rises along 1 + x / 10; the curve runs beside it, `lift` above."""
    x = np.linspace(0.0, 10.0, 41)
    found = of(x, 1.0 + x / 10.0 + lift)
    assert found.value == pytest.approx(value)
    assert (found.size, found.basis) == (41, STATIONARY)
    assert of(x, x, unit="s").basis == EVENT


def test_the_worst_point_is_named():
    x = np.linspace(-5.0, 15.0, 81)
    assert of(x, np.where(x == 4.0, 3.0, 0.5)).remark == "at 4 Hz"
    assert of(x, np.where(x == 4.0, 3.0, 0.5)).value == pytest.approx(3.0 - 1.4)


@pytest.mark.parametrize(
    ("x", "says"),
    [
        (np.linspace(2.0, 10.0, 81), "81 points from 2 to 10 Hz"),
        ([20.0, 30.0], "nowhere in it"),
        ([0.0, 5.0, 10.0], "3 points"),
    ],
)
def test_a_curve_that_is_not_known_all_along_is_not_judged(x, says):
    found = of(x, np.ones(len(x)))
    assert math.isnan(found.value)
    assert says in found.remark
    gap = of(np.linspace(0.0, 10.0, 41), np.where(np.arange(41) < 30, 0.5, np.nan))
    assert math.isnan(gap.value)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("x,low,high\n1,0,1\n", "two rows or more"),
        ("f,low,high\n1,0,1\n2,0,1\n", "begins with f,low,high"),
        ("x,low,high\n1,0,1\n2,0,a\n", "three numbers"),
        ("x,low,high\n1,0,1\n1,0,1\n", "line 3: x 1 does not come after"),
        ("x,low,high\n1,0,1\n2,2,1\n", "line 3: low 2 is above high 1"),
        ("x,low,high\n1,0,inf\n2,0,1\n", "finite"),
    ],
)
def test_what_is_no_band_is_one_sentence(tmp_path, text, says):
    (tmp_path / "band.csv").write_text(text)
    with pytest.raises(BagError, match=says):
        curve_bands.read_curve_band("tire.load", tmp_path / "band.csv")


def test_a_file_of_requirements_takes_a_band_beside_it(tmp_path):
    (tmp_path / "band.csv").write_text("# own\nx,low,high\n0,0,1\n10,0,2\n")
    file = tmp_path / "own.yaml"
    file.write_text("seat.transmissibility: {within: band.csv}\n")
    requirements = read_requirements([str(file)])
    assert bands_of(requirements) == (BAND,)
    (found,) = required([of(np.linspace(0.0, 10.0, 41), np.full(41, 3.0))], requirements)
    assert (found.verdict, found.value) == (OUTSIDE, pytest.approx(2.0))
    file.write_text("seat.transmissibility: {within: none.csv}\n")
    with pytest.raises(FileRefusedError, match=r"none\.csv"):
        read_requirements([str(file)])


def test_a_curve_that_the_run_lacks_gives_no_number(monkeypatch):
    monkeypatch.setattr(curve_bands, "curves_of", lambda _recording: {})
    assert curve_bands.beyond_bands(SimpleNamespace(), [BAND]) == []


def test_a_plan_judges_the_load_of_a_wheel_at_rest_by_its_band(tmp_path):
    """Before its bump the wheel carries (300 + 40) kg × 9.81 m/s² = 3335.4 N."""
    for name, high in (("wide", 3340.0), ("narrow", 3300.0)):
        (tmp_path / f"{name}.csv").write_text(f"x,low,high\n0,3300,{high}\n0.19,3300,{high}\n")
    plan = tmp_path / "plan.yaml"
    plan.write_text(
        "sweeps:\n"
        "  wide: {scene: tire_bump, vary: ['duration=0.2'], require: {tire.load: {within: wide.csv}}}\n"
        "  narrow: {scene: tire_bump, vary: ['duration=0.2'], require: {tire.load: {within: narrow.csv}}}\n"
    )
    outcomes, _ = run_plan(read_plan(str(plan)), tmp_path / "out", jobs=1, notify=lambda _text, _done: None)
    wide, narrow = judged_rows(outcomes)
    assert (wide.verdict, narrow.verdict, status_of(outcomes)) == ("pass", "MISS", 1)
    assert float(wide.margin) == pytest.approx(4.6, abs=0.05)
    assert float(narrow.margin) == pytest.approx(-35.4, abs=0.05)
