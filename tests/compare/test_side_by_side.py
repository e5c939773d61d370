"""Runs side by side: order, differences, tolerances of metrics and of curves."""

import math
from xml.etree import ElementTree

import numpy as np
import pytest

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.compare.side_by_side import (
    Compared,
    ComparedMetric,
    Curve,
    misses,
    read_tolerances,
    side_by_side,
    undecided,
)
from contact_sim_pkg.files import FileRefusedError
from contact_sim_pkg.records.metric import EVENT, LIMIT, STATIONARY, Band, Metric
from contact_sim_pkg.report.comparison.rows import junit_text_of, rows_of, table_rows


def metric(key, value, verdict="good"):
    return Metric(key, key, value, "N", verdict, None)


def run(name, shift=0.0, **values):
    x = np.linspace(0.0, 10.0, 101)
    return Compared(name, [metric(key, value) for key, value in values.items()], {"curve": Curve("Hz", x, x + shift)})


def test_what_moved_most_stands_first():
    sides = side_by_side([run("A", a=10.0, b=1.0, c=0.0), run("B", a=11.0, b=3.0, c=0.0, d=4.0)])
    assert [side.key for side in sides] == ["b", "a", "c", "d"]
    assert (sides[0].change, sides[0].relative) == (2.0, 2.0)
    assert math.isnan(sides[-1].values[0])
    assert sides[-1].verdict == "absent → good"


def test_each_side_keeps_its_spread_and_its_numerical_error():
    one, other = (
        metric("a", value)._replace(basis="event", error=error, spread=0.5)
        for value, error in ((1.0, 0.25), (2.0, math.nan))
    )
    (side,) = side_by_side([Compared("A", [one], {}), Compared("B", [other], {})])
    (row,) = rows_of(["A", "B"], [side])
    assert (row["basis"], row["error of A"], row["error of B"], row["spread of B"]) == ("event", 0.25, None, 0.5)
    (line,) = table_rows(["A", "B"], [side])
    assert (line["A"], line["rests on"]) == ("1 ± 0.5", "event, error 0.25")


@pytest.fixture
def tolerances(tmp_path):
    def read(text):
        (tmp_path / "tolerances.yaml").write_text(text)
        return read_tolerances(tmp_path / "tolerances.yaml")

    return read


def test_a_tolerance_is_absolute_plus_relative(tolerances):
    first, second = run("A", a=100.0), run("B", a=106.0)
    for text, count in (("a: {absolute: 6}", 0), ("a: {absolute: 5}", 1), ("a: {absolute: 1, relative: 0.05}", 0)):
        ((_, found),) = misses([first, second], tolerances(text))
        assert len(found) == count
    ((_, (miss,)),) = misses([first, second], tolerances("a: {relative: 0.05}"))
    assert miss.sentence == "a is 106 N, 6 from 100; 5 allowed"


def test_what_is_defined_in_no_run_cannot_be_judged(tolerances):
    runs = [run("A", a=math.nan, b=math.nan), run("B", a=math.nan, b=1.0)]
    wanted = tolerances("'*': {absolute: 6}")
    (found,) = undecided(runs, wanted)
    assert found.sentence == "a is defined in no run"
    suite = ElementTree.fromstring(junit_text_of(["A", "B"], [(wanted[0], [])], [found]))
    assert [each.get("message") for each in suite.iter("error")] == [found.sentence]
    assert undecided(runs, tolerances("b: {absolute: 6}")) == []


def test_a_curve_has_a_band_round_it_in_a_range(tolerances):
    first, second = run("A", a=1.0), run("B", shift=0.3, a=1.0)
    assert misses([first, second], tolerances("curve: {absolute: 0.31}"))[0][1] == []
    assert misses([first, second], tolerances("curve: {relative: 0.1, from: 5, to: 8}"))[0][1] == []
    (miss,) = misses([first, second], tolerances("curve: {relative: 0.1}"))[0][1]
    assert "curve is 0.3 at 0 Hz, 0.3 from 0; 0 allowed (30 of 101 points outside)" in miss.sentence


def test_one_line_may_hold_for_many_and_a_third_run_counts_too(tolerances):
    runs = [run("A", ab=1.0, ac=2.0), run("B", ab=1.0, ac=2.0), run("C", ab=1.5, ac=2.0)]
    ((_, found),) = misses(runs, tolerances("a*: {relative: 0.1}"))
    assert [(each.run, each.key) for each in found] == [("C", "ab")]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("a: 5", "needs absolute or relative"), ("a: {absolut: 5}", "needs absolute or relative"),
        ("a: {absolute: -1}", "it must be 0 or more"), ("a: {absolute: many}", "must be a number"), ("", "is empty"),
        ("[]", "holds no tolerances"),
    ],
)  # fmt: skip
def test_a_file_of_something_else_is_refused(tolerances, text, words):
    with pytest.raises(BagError, match=words):
        tolerances(text)


def test_a_tolerance_of_nothing_is_refused_with_what_there_is(tolerances, tmp_path):
    with pytest.raises(BagError, match=r"tolerance q: A has no such metric or curve; it has a, curve"):
        misses([run("A", a=1.0), run("B", a=1.0)], tolerances("q: {absolute: 1}"))
    with pytest.raises(FileRefusedError, match="No such file"):
        read_tolerances(tmp_path / "absent.yaml")


@pytest.mark.parametrize(
    ("values", "spread", "limit", "expected"),
    [
        ((60.0, 50.0), 1.0, Band(-math.inf, 100.0, LIMIT, "s"), "better"),
        ((60.0, 70.0), 1.0, Band(-math.inf, 100.0, LIMIT, "s"), "worse"),
        ((60.0, 70.0), 1.0, Band(1.0, math.inf, LIMIT, "s"), "better"),
        ((60.0, 64.0), 3.0, Band(-math.inf, 100.0, LIMIT, "s"), "no difference beyond ±"),  # 4 below sqrt(18)
        ((60.0, 64.5), 3.0, Band(-math.inf, 100.0, LIMIT, "s"), "worse"),
        ((60.0, 70.0), 1.0, None, ""),
        ((60.0, 60.0), math.nan, None, "the same"),
        ((60.0, math.nan), 1.0, None, ""),
    ],
)
def test_a_change_is_judged_by_its_limit_and_its_uncertainty(values, spread, limit, expected):
    side = ComparedMetric("a", "a", "", values, ("good", "good"), (), spreads=(spread, spread), limit=limit)
    assert side.comparison == expected


@pytest.mark.parametrize(("basis", "expected"), [(STATIONARY, "spread not known"), (EVENT, "better")])
def test_a_stationary_number_whose_spread_nobody_knows_is_not_called_better(basis, expected):
    band = Band(-math.inf, 100.0, LIMIT, "s")
    side = ComparedMetric("a", "a", "", (60.0, 50.0), ("good", "good"), (), basis, (0.1, 0.1), (1.0, math.nan), band)
    assert side.comparison == expected


def test_what_differs_by_rounding_is_the_same():
    (side,) = side_by_side([run("A", a=0.457), run("B", a=0.457 * (1.0 + 1e-15))])
    assert (side.change, side.comparison) == (0.0, "the same")
    (side,) = side_by_side([run("A", a=0.457), run("B", a=0.457 * (1.0 + 1e-9))])
    assert side.change > 0.0
