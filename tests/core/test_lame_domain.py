"""Lame domain: inside test, arc length and mesh against closed forms, quadrature and multiple precision."""

from __future__ import annotations

import math

import mpmath
import numpy
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from contact_sim_pkg.core.lame import lame_area, lame_moment
from contact_sim_pkg.core.lame_domain import inside, lame_boundary, lame_mesh, perimeter, radial_variable
from contact_sim_pkg.reference import lame as reference

EXPONENTS = (0.1, 0.5, 0.8, 1.0, 1.3, 2.0, 4.0, 20.0, 100.0)


@settings(max_examples=200, deadline=None, derandomize=True)
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
