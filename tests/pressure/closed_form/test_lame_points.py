"""Lame curve through scattered points: the hull against scipy's, the fit against known curves."""

from __future__ import annotations

import math

import numpy
import pytest
import scipy.spatial
from hypothesis import given, settings
from hypothesis import strategies as st

from contact_sim_lab.closed_form.lame_domain import inside, lame_boundary
from contact_sim_lab.closed_form.lame_points import fit_points, hull


@settings(max_examples=60)
@given(st.integers(0, 2**32 - 1), st.integers(5, 80))
def test_the_hull_is_that_of_scipy(seed: int, count: int) -> None:
    points = numpy.random.default_rng(seed).standard_normal((count, 2)) * (1.0, 0.1)
    expected = scipy.spatial.ConvexHull(points)
    found = hull(points)
    assert {tuple(point) for point in found} == {tuple(point) for point in points[expected.vertices]}
    following = numpy.roll(found, -1, axis=0)
    area = 0.5 * (found[:, 0] * following[:, 1] - following[:, 0] * found[:, 1]).sum()
    assert area == pytest.approx(expected.volume, rel=1e-12)


def test_the_hull_of_a_lattice_keeps_the_points_on_its_sides() -> None:
    lattice = numpy.stack(numpy.meshgrid(0.1 * numpy.arange(7), 0.3 * numpy.arange(5)), axis=-1).reshape(-1, 2)
    assert len(hull(numpy.concatenate([lattice, lattice]))) == 2 * (7 + 5) - 4


@pytest.mark.parametrize("exponent", [1.0, 1.5, 2.0, 3.3, 8.0, 15.0])
@pytest.mark.parametrize("count", [12, 60, 400])
def test_points_on_a_curve_and_within_it_give_the_curve(exponent: float, count: int) -> None:
    x, y = lame_boundary(0.08, 0.03, exponent, count)
    within = numpy.random.default_rng(2).uniform(-0.02, 0.02, (50, 2)) * (1.0, 0.4)
    points = numpy.concatenate([numpy.stack([x, y], axis=1), within]) + numpy.array([1.0, -2.0])
    fit = fit_points(points)
    assert fit.fitted
    assert (fit.a, fit.b, fit.exponent) == pytest.approx((0.08, 0.03, exponent), rel=1e-4)
    assert (fit.centre_x, fit.centre_y) == pytest.approx((1.0, -2.0), abs=1e-12)
    assert fit.deviation < 1e-5


def test_points_scattered_over_a_domain_give_it_within_their_spacing() -> None:
    points = numpy.random.default_rng(0).uniform(-1.0, 1.0, (2000, 2))
    fit = fit_points(points[inside(points[:, 0], points[:, 1], 0.8, 0.5, 3.0)])
    assert (fit.a, fit.b) == pytest.approx((0.8, 0.5), abs=0.02)
    assert fit.exponent == pytest.approx(3.0, abs=0.1)


@settings(max_examples=40)
@given(st.integers(0, 2**32 - 1), st.floats(1e-3, 1e3), st.floats(-10.0, 10.0))
def test_scale_place_and_order_of_the_points_do_not_matter(seed: int, scale: float, shift: float) -> None:
    random = numpy.random.default_rng(seed)
    points = random.standard_normal((40, 2))
    one, other = fit_points(points), fit_points(random.permutation(points)[:, ::-1] * scale + shift * scale)
    assert (other.b / scale, other.a / scale, other.exponent) == pytest.approx((one.a, one.b, one.exponent), rel=1e-6)
    assert other.centre_y / scale - shift == pytest.approx(one.centre_x, abs=1e-9)


@pytest.mark.parametrize("count", [1, 2, 3, 4])
def test_one_to_four_points_are_not_fitted_and_say_so(count: int) -> None:
    points = numpy.array([[1.0, 5.0], [3.0, 6.0], [2.0, 8.0], [1.0, 7.0]])[:count]
    fit = fit_points(points)
    half = 0.5 * numpy.ptp(points, axis=0)
    assert (fit.a, fit.b, fit.exponent, fit.fitted) == (*half, 2.0, False)
    assert (fit.centre_x, fit.centre_y) == tuple(0.5 * (points.min(axis=0) + points.max(axis=0)))


def test_many_points_with_few_corners_or_on_one_line_are_not_fitted() -> None:
    inner = numpy.random.default_rng(3).uniform(-0.2, 0.2, (30, 2))
    corners = numpy.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]])
    assert fit_points(numpy.concatenate([corners, inner])).fitted is False
    assert fit_points(numpy.tile(corners[0], (9, 1))) == (0.0, 0.0, 2.0, 1.0, 0.0, 0.0, False)
    steps = numpy.linspace(0.0, 1.0, 11)
    for line in (steps * 0.0, steps, -3.0 * steps):
        fit = fit_points(numpy.stack([steps, line], axis=1))
        assert (fit.exponent, fit.fitted) == (2.0, False)
        assert fit.a == pytest.approx(0.5)
        assert fit.b == pytest.approx(0.5 * abs(line[-1]))


def test_no_points_give_a_curve_of_size_zero_and_bad_ones_are_refused() -> None:
    assert fit_points(numpy.zeros((0, 2))) == (0.0, 0.0, 2.0, 0.0, 0.0, 0.0, False)
    with pytest.raises(ValueError, match=r"it must be \(points, 2\)"):
        fit_points(numpy.zeros((3, 3)))
    with pytest.raises(ValueError, match="not a finite number"):
        fit_points(numpy.array([[0.0, math.nan]]))
