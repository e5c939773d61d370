"""Winkler bed: stiffness of the check tire, hand-worked cells, closed form on a paraboloid, exact load on rough gaps."""

from __future__ import annotations

import math

import numpy
import pytest
import scipy.optimize
from hypothesis import given, settings
from hypothesis import strategies as st

from contact_sim_pkg.pressure.closed_form.hertz import hertz_contact
from contact_sim_pkg.pressure.field.winkler import bed_stiffness, winkler_at_approach, winkler_at_load

TIRE = (0.5, 0.5 / 0.3, 4e6, 4000.0)  # A, B, E*, P of the check tire


def test_the_bed_of_the_check_tire() -> None:
    assert bed_stiffness(*TIRE) == pytest.approx(23.8e6, abs=0.05e6)


def test_load_and_approach_of_a_smooth_tire_are_those_of_hertz() -> None:
    stiffness, hertz = bed_stiffness(*TIRE), hertz_contact(*TIRE)
    x, y = (numpy.arange(900) - 449.5) / 900 * 0.30, (numpy.arange(600) - 299.5) / 600 * 0.17
    gap = 0.5 * x[:, None] ** 2 + 0.5 / 0.3 * y[None, :] ** 2
    pressure = numpy.empty(gap.shape)
    cell = 0.30 / 900, 0.17 / 600
    assert winkler_at_approach(gap, stiffness, *cell, hertz.approach, pressure).load == pytest.approx(4000.0, rel=1e-5)
    found = winkler_at_load(gap, stiffness, *cell, 4000.0, pressure)
    assert found.approach == pytest.approx(hertz.approach, rel=1e-5)
    area = math.pi * hertz.approach / math.sqrt(0.5 * 0.5 / 0.3)  # of the overlap
    assert found.cells * cell[0] * cell[1] == pytest.approx(area, rel=1e-3)
    assert pressure.max() == pytest.approx(2.0 * 4000.0 / area, rel=1e-3)


def test_three_cells_by_hand() -> None:
    """Gaps 0, 1, 3 m, k = 2 Pa/m, cells of 0.5 m^2: 1 N/m a cell."""
    gap, pressure = numpy.array([[3.0, 0.0, 1.0]]), numpy.full((1, 3), 9.0)
    for load, approach, cells in ((0.5, 0.5, 1), (1.0, 1.0, 1), (3.0, 2.0, 2), (5.0, 3.0, 2), (8.0, 4.0, 3)):
        assert winkler_at_load(gap, 2.0, 0.5, 1.0, load, pressure) == pytest.approx((load, approach, cells))
        assert pressure == pytest.approx(2.0 * numpy.maximum(approach - gap, 0.0))
        assert winkler_at_approach(gap, 2.0, 0.5, 1.0, approach, pressure) == pytest.approx((load, approach, cells))


@pytest.mark.parametrize("load", [1e-9, 1e-3, 1.0, 50.0, 1e3, 1e7])
@pytest.mark.parametrize("datum", [0.0, 5.0])
def test_the_load_is_exact_on_a_rough_gap(load: float, datum: float) -> None:
    gap = datum + numpy.random.default_rng(3).lognormal(-7.0, 1.5, (40, 30))
    pressure = numpy.empty(gap.shape)
    found = winkler_at_load(gap, 24e6, 2e-3, 3e-3, load, pressure)
    rest = gap - gap.min()
    expected = scipy.optimize.brentq(
        lambda d: 24e6 * 6e-6 * numpy.maximum(d - rest, 0.0).sum() - load, 0.0, 1e3, xtol=1e-18, rtol=1e-15
    )
    assert found.approach - gap.min() == pytest.approx(expected, rel=1e-11, abs=2e-15)
    assert found.load == pytest.approx(load, rel=1e-11, abs=1e-18 + 1e-9 * datum)
    assert pressure.sum() * 6e-6 == pytest.approx(found.load, rel=1e-13)
    assert pressure.min() >= 0.0


def test_equal_gaps_share_the_load() -> None:
    gap, pressure = numpy.full((4, 5), -0.3), numpy.empty((4, 5))
    found = winkler_at_load(gap, 10.0, 1.0, 1.0, 100.0, pressure)
    assert found == pytest.approx((100.0, 0.2, 20))
    assert numpy.all(pressure == pytest.approx(5.0))


def test_without_load_or_overlap_there_is_no_pressure() -> None:
    gap = numpy.array([[0.2, 0.1], [0.4, 0.3]])
    for nothing in (0.0, -5.0):
        pressure = numpy.ones((2, 2))
        assert winkler_at_load(gap, 10.0, 1.0, 1.0, nothing, pressure) == (0.0, 0.1, 0)
        assert numpy.all(pressure == 0.0)
    assert winkler_at_approach(gap, 10.0, 1.0, 1.0, 0.05, pressure) == (0.0, 0.05, 0)


def test_impossible_input_is_refused() -> None:
    gap, pressure = numpy.zeros((2, 2)), numpy.zeros((2, 2))
    with pytest.raises(ValueError, match="stiffness"):
        winkler_at_load(gap, 0.0, 1.0, 1.0, 1.0, pressure)
    with pytest.raises(ValueError, match="cell_y"):
        winkler_at_approach(gap, 1.0, 1.0, math.nan, 1.0, pressure)
    with pytest.raises(ValueError, match="load"):
        winkler_at_load(gap, 1.0, 1.0, 1.0, math.inf, pressure)
    with pytest.raises(ValueError, match="one "):
        winkler_at_load(gap, 1.0, 1.0, 1.0, 1.0, numpy.zeros((2, 3)))
    gap[1, 0] = math.nan
    with pytest.raises(ValueError, match="row 1, column 0"):
        winkler_at_load(gap, 1.0, 1.0, 1.0, 1.0, pressure)
    with pytest.raises(ValueError, match="above 0"):
        bed_stiffness(1.0, 1.0, 1.0, 0.0)


@settings(max_examples=40)
@given(
    st.lists(st.floats(-1e-3, 1e-3), min_size=6, max_size=6),
    *[st.floats(-6.0, 12.0).map(lambda power: 10.0**power)] * 2,
)
def test_the_bed_carries_any_load_on_any_gap(heights, stiffness, load):
    gap, pressure = numpy.array(heights).reshape(2, 3), numpy.empty((2, 3))
    found = winkler_at_load(gap, stiffness, 0.01, 0.02, load, pressure)
    assert found.load == pytest.approx(load, rel=1e-9, abs=1e-12 * stiffness * 2e-4 * 1e-3)
    numpy.testing.assert_array_equal(pressure > 0.0, found.approach > gap)


@pytest.mark.parametrize("load", [math.nan, -1.0, 0.0])
def test_a_bed_without_a_stiffness_is_refused(load: float) -> None:
    with pytest.raises(ValueError, match="load"):
        bed_stiffness(1.0, 1.0, 1.0, load)


def test_an_approach_without_a_square_gives_no_stiffness() -> None:
    with pytest.raises(ValueError, match="gives no stiffness"):
        bed_stiffness(1e-3, 1e-3, 1e12, 1e-280)
