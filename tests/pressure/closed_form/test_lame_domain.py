"""Lame domain: inside test, arc length and mesh against closed forms, quadrature and multiple precision."""

from __future__ import annotations

import math
import re

import mpmath
import numpy
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from contact_sim_lab.closed_form.lame_domain import (
    inside,
    lame_boundary,
    lame_mesh,
    perimeter,
    radial_variable,
)
from contact_sim_lab.twins import lame as reference
from contact_sim_pkg.pressure.closed_form.lame import lame_area, lame_moment

EXPONENTS = (0.1, 0.5, 0.8, 1.0, 1.3, 2.0, 4.0, 20.0, 100.0)


@settings(max_examples=200)
@given(st.floats(0.1, 100.0), st.floats(-2.0, 2.0), st.floats(-2.0, 2.0))
def test_the_radial_variable_is_that_of_multiple_precision(exponent: float, x: float, y: float) -> None:
    with mpmath.workdps(60):
        n = mpmath.mpf(exponent)
        exact = (abs(mpmath.mpf(x) / 1.5) ** n + abs(mpmath.mpf(y) / 0.7) ** n) ** (1 / n)
    found = radial_variable(numpy.array(x), numpy.array(y), 1.5, 0.7, exponent)
    assert float(found) == pytest.approx(float(exact), rel=1e-12, abs=1e-300)
    if abs(exact - 1) > 1e-12:
        assert bool(inside(numpy.array(x), numpy.array(y), 1.5, 0.7, exponent)) is bool(exact < 1)


@pytest.mark.parametrize("exponent", EXPONENTS)
def test_tips_belong_to_the_domain_and_the_origin_has_radius_zero(exponent: float) -> None:
    x, y = numpy.array([0.3, -0.3, 0.0, 0.0, 0.0, 1e-320]), numpy.array([0.0, 0.0, 0.7, -0.7, 0.0, 0.0])
    assert inside(x, y, 0.3, 0.7, exponent).all()
    assert radial_variable(x, y, 0.3, 0.7, exponent)[:5].tolist() == [1.0, 1.0, 1.0, 1.0, 0.0]
    assert not inside(x[:4] * 1.0001, y[:4] * 1.0001, 0.3, 0.7, exponent).any()


def test_a_point_at_infinity_is_outside() -> None:
    far = numpy.array([math.inf, 1e300, 0.0])
    assert not inside(far, far[::-1], 1.0, 1.0, 0.1).any()


@pytest.mark.parametrize(
    ("axes", "exponent", "length"),
    [
        ((3.0, 1.0), 2.0, float(12 * mpmath.ellipe(mpmath.mpf(8) / 9))),
        ((3.0, 4.0), 1.0, 20.0),
        ((1.0, 1.0), 2.0 / 3.0, 6.0),
    ],
)
def test_the_perimeter_of_ellipse_rhombus_and_astroid(
    axes: tuple[float, float], exponent: float, length: float
) -> None:
    assert perimeter(*axes, exponent) == pytest.approx(length, rel=1e-13)


@pytest.mark.parametrize("exponent", [0.4, 0.8, 1.3, 3.7, 15.0])
def test_the_perimeter_is_that_of_quadrature(exponent: float) -> None:
    assert perimeter(0.3, 0.7, exponent) == pytest.approx(reference.perimeter(0.3, 0.7, exponent), rel=1e-8)


def test_the_perimeter_goes_to_a_cross_and_to_a_rectangle() -> None:
    assert 7.99 < perimeter(1.0, 1.0, 0.1) < 8.0
    assert 7.95 < perimeter(1.0, 1.0, 100.0) < 8.0


@pytest.mark.parametrize("exponent", EXPONENTS)
@pytest.mark.parametrize("axes", [(0.3, 0.7), (1.0, 0.02)])
def test_boundary_points_lie_on_the_curve_at_equal_arc_lengths(exponent: float, axes: tuple[float, float]) -> None:
    x, y = lame_boundary(*axes, exponent, 4000)
    assert radial_variable(x, y, *axes, exponent) == pytest.approx(1.0, rel=1e-12)
    assert (x[0], y[0]) == (axes[0], 0.0)
    assert y[1] > 0.0
    chords = numpy.hypot(numpy.diff(x), numpy.diff(y)) * 4000 / perimeter(*axes, exponent)
    assert chords.max() <= 1.0 + 1e-9
    # A chord is the arc but where the curve turns within it, which is at tips and corners.
    assert numpy.sort(chords)[40] > 0.999


def test_a_square_of_exponent_100_keeps_its_points_along_the_sides() -> None:
    x, y = lame_boundary(1.0, 1.0, 100.0, 400)
    on_right = (x > 0.99) & (abs(y) < 0.9)
    assert on_right.sum() == pytest.approx(90, abs=2)


@pytest.mark.parametrize("exponent", EXPONENTS)
def test_the_areas_of_the_mesh_add_up_to_the_domain(exponent: float) -> None:
    mesh = lame_mesh(0.3, 0.7, exponent, 5, 24)
    assert mesh.area.size == mesh.x.size == mesh.y.size == 5 * 24
    assert mesh.area.sum() == pytest.approx(lame_area(0.3, 0.7, exponent), rel=1e-12)
    assert mesh.area.min() > 0.0
    assert abs((mesh.area * mesh.x).sum()) < 1e-15
    assert abs((mesh.area * mesh.y).sum()) < 1e-15


@pytest.mark.parametrize("exponent", [1.0, 2.0, 4.0, 100.0])
def test_integrals_over_the_mesh_converge_with_the_second_order(exponent: float) -> None:
    expected = reference.moment(0.3, 0.7, exponent, 2.0, 2.0)
    errors = []
    for size in (8, 16, 32):
        mesh = lame_mesh(0.3, 0.7, exponent, size, 8 * size)
        errors.append(abs((mesh.area * mesh.x**2 * mesh.y**2).sum() / expected - 1.0))
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.15)
    assert errors[1] / errors[2] == pytest.approx(4.0, rel=0.15)
    assert errors[2] < 4e-3


@pytest.mark.parametrize("exponent", [0.5, 1.0, 2.0, 5.0])
@pytest.mark.parametrize("powers", [(0.0, 0.0), (1.0, 0.0), (2.0, 2.0), (4.0, 1.0), (0.5, 3.0)])
def test_moments_are_those_of_quadrature(exponent: float, powers: tuple[float, float]) -> None:
    expected = reference.moment(0.3, 0.7, exponent, *powers)
    assert lame_moment(0.3, 0.7, exponent, *powers) == pytest.approx(expected, rel=1e-9)


def test_a_function_of_rho_has_twice_the_area_times_its_radial_integral() -> None:
    mesh = lame_mesh(0.3, 0.7, 4.0, 200, 80)
    rho = radial_variable(mesh.x, mesh.y, 0.3, 0.7, 4.0)
    expected = lame_area(0.3, 0.7, 4.0) * 0.5 * float(mpmath.beta(0.5, 1.5))  # (1 - rho^4)^(1/2)
    assert (mesh.area * numpy.sqrt(1.0 - rho**4)).sum() == pytest.approx(expected, rel=2e-3)


def test_what_is_no_lame_domain_is_refused() -> None:
    for call in (perimeter, lambda *domain: lame_boundary(*domain, 8), lambda *domain: lame_mesh(*domain, 2, 8)):
        for exponent, reason in ((0.05, r"allowed from 0\.1"), (101.0, "go to 100"), (math.nan, "allowed from")):
            with pytest.raises(ValueError, match=reason):
                call(1.0, 1.0, exponent)
        with pytest.raises(ValueError, match=r"half axis b = 0\.0 m"):
            call(1.0, 0.0, 2.0)
    with pytest.raises(ValueError, match="at least 1"):
        lame_boundary(1.0, 1.0, 2.0, 0)
    with pytest.raises(ValueError, match="multiple of 4"):
        lame_mesh(1.0, 1.0, 2.0, 3, 10)


QUICK = settings(max_examples=40)
AXIS = st.floats(-6.0, 6.0).map(lambda power: 10.0**power)
SLENDER = st.one_of(st.just(1.0), st.floats(-12.0, 12.0).map(lambda power: 10.0**power))
EXPONENT = st.one_of(st.sampled_from([0.1, 1.0, 2.0, 100.0]), st.floats(0.1, 100.0))


def test_a_needle_has_a_boundary():
    """A panel at its tip is shorter than the rounding of the whole: the points there were not numbers."""
    x, y = lame_boundary(1e-12, 0.1, 3.0, 16)
    assert numpy.isfinite(x).all()
    assert numpy.isfinite(y).all()
    numpy.testing.assert_allclose(y[:5], [0.0, 0.025, 0.05, 0.075, 0.1], atol=1e-9)


@QUICK
@given(AXIS, SLENDER, EXPONENT, st.integers(1, 40))
def test_the_boundary_lies_on_the_curve_over_the_whole_range(a, ratio, exponent, count):
    b = a * ratio * (1.0 - 1e-12 if ratio > 1.0 else 1.0 + 1e-12)
    x, y = lame_boundary(a, b, exponent, count)
    numpy.testing.assert_allclose(radial_variable(x, y, a, b, exponent), 1.0, rtol=1e-9)
    length = perimeter(a, b, exponent)
    assert 4.0 * math.hypot(a, b) * (1.0 - 1e-6) <= length <= 4.0 * (a + b) * (1.0 + 1e-9)
    polygon = numpy.hypot(numpy.diff(x, append=x[0]), numpy.diff(y, append=y[0]))
    assert (polygon <= length / count * (1.0 + 1e-6)).all()  # a chord is not longer than its arc


@QUICK
@given(AXIS, SLENDER, EXPONENT, st.integers(1, 5), st.integers(1, 6))
def test_the_mesh_fills_the_domain_over_the_whole_range(a, ratio, exponent, rings, quarter):
    b = a * ratio * (1.0 - 1e-12 if ratio > 1.0 else 1.0 + 1e-12)
    mesh = lame_mesh(a, b, exponent, rings, 4 * quarter)
    assert (mesh.area >= 0.0).all()
    assert mesh.area.sum() == pytest.approx(lame_area(a, b, exponent), rel=1e-7)
    assert (mesh.area @ mesh.x**2) <= lame_moment(a, b, exponent, 2.0, 0.0) * (1.0 + 1e-6)
    assert (abs(mesh.x) <= a).all()
    assert (abs(mesh.y) <= b).all()


@QUICK
@given(AXIS, AXIS, st.one_of(EXPONENT, st.floats(100.0, 1e300), st.just(math.inf)), *[st.floats(-0.999, 12.0)] * 2)
def test_moments_are_dirichlet_s_integral_over_the_whole_range(a, b, exponent, i, j):
    with mpmath.workdps(40):
        u, v = (mpmath.mpf(i) + 1) / exponent, (mpmath.mpf(j) + 1) / exponent
        exact = 4 * mpmath.mpf(a) ** (mpmath.mpf(i) + 1) * mpmath.mpf(b) ** (mpmath.mpf(j) + 1)
        exact *= mpmath.gammaprod([u + 1, v + 1], [u + v + 1]) / ((mpmath.mpf(i) + 1) * (mpmath.mpf(j) + 1))
        assert lame_moment(a, b, exponent, i, j) == pytest.approx(float(exact), rel=1e-11)


@pytest.mark.parametrize("bad", [0.0, -1.0, math.nan, math.inf, 5e-324, 1e101])
def test_half_axes_outside_their_range_are_refused(bad):
    for call in (perimeter, lame_area, lambda *n: lame_boundary(*n, 8), lambda *n: lame_mesh(*n, 2, 8),
                 lambda *n: lame_moment(*n, 2.0, 0.0), lambda *n: inside(0.0, 0.0, *n)):  # fmt: skip
        with pytest.raises(ValueError, match=re.escape(f"half axis b = {bad} m")):
            call(1.0, bad, 2.0)
        with pytest.raises(ValueError, match=re.escape(f"half axis a = {bad} m")):
            call(bad, 1.0, 2.0)


@pytest.mark.parametrize("bad", [-1.0, 101.0, math.nan, math.inf])
def test_powers_outside_their_range_are_refused(bad):
    with pytest.raises(ValueError, match="power i"):
        lame_moment(1.0, 1.0, 2.0, bad, 0.0)
    with pytest.raises(ValueError, match="power j"):
        lame_moment(1.0, 1.0, 2.0, 0.0, bad)


def test_more_that_a_lame_curve_cannot_do_is_refused():
    with pytest.raises(ValueError, match="range of numbers"):
        lame_moment(1e100, 1.0, 2.0, 5.0, 0.0)
    with pytest.raises(ValueError, match="ratio of 1e"):
        perimeter(1.0, 2e-13, 2.0)
    with pytest.raises(ValueError, match="coordinate"):
        radial_variable(numpy.array([0.0, math.nan]), 0.0, 1.0, 1.0, 2.0)
