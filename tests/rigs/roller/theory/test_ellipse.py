"""The ellipse of two turned bodies."""

import math

import numpy
import pytest
from tests.rigs.roller.bench import CURVATURES, MODULUS

from contact_sim_pkg.pressure.closed_form.hertz import HertzError, hertz_contact
from contact_sim_pkg.rigs.roller.theory.ellipse import EXACT, POLYNOMIAL, contact_of_rollers, local_coefficients
from contact_sim_pkg.rigs.roller.theory.parameters import Curvatures


def test_the_bench_under_100_newton():
    """Sheet of the paper: p0 1.90 GPa, a 0.215 mm along x, b 0.117 mm along y, approach 4.01 um."""
    contact = contact_of_rollers(CURVATURES, 0.0, MODULUS, 100.0)
    assert contact.peak_pressure == pytest.approx(1.90e9, rel=3e-3)
    assert (contact.along_x, contact.along_y) == pytest.approx((0.215e-3, 0.117e-3), rel=3e-3)
    assert contact.approach == pytest.approx(4.01e-6, rel=1e-3)
    assert contact.angle == 0.0


@pytest.mark.parametrize(("load", "a", "b", "peak", "approach"), [
    (200.0, 545e-6, 121e-6, 1449e6, 4.43e-6), (500.0, 739e-6, 164e-6, 1967e6, 8.16e-6),
])  # fmt: skip
def test_crossed_cylinders_of_steel(load, a, b, peak, approach):
    """Radii 5 and 50 mm, published figures."""
    crossed = contact_of_rollers(Curvatures(20.0, 0.0, 200.0, 0.0), 0.0, MODULUS, load)
    assert (crossed.along_x, crossed.along_y) == pytest.approx((a, b), rel=6e-3)
    assert (crossed.peak_pressure, crossed.approach) == pytest.approx((peak, approach), rel=2e-3)


def test_only_one_body_turns_with_the_yaw():
    """With the curvatures of the bench the ellipse turns by -1/3 of the yaw."""
    contact = contact_of_rollers(CURVATURES, 1e-4, MODULUS, 100.0)
    assert contact.angle == pytest.approx(-1e-4 / 3.0, rel=1e-6)


@pytest.mark.parametrize("yaw", [-1.4, -0.3, 0.0, 0.2, 0.9, 1.5])
def test_the_axes_are_those_of_the_gap(yaw):
    turn = numpy.array([[math.cos(yaw), -math.sin(yaw)], [math.sin(yaw), math.cos(yaw)]])
    gap = 0.5 * (turn @ numpy.diag([100.0, 50.0]) @ turn.T + numpy.diag([0.0, 200.0]))
    values, directions = numpy.linalg.eigh(gap)
    contact = contact_of_rollers(CURVATURES, yaw, MODULUS, 100.0)
    expected = hertz_contact(*values, MODULUS, 100.0)
    assert sorted((contact.along_x, contact.along_y)) == pytest.approx([expected.b, expected.a])
    major = directions[:, 0] if contact.along_x >= contact.along_y else directions[:, 1]
    along = numpy.array([math.cos(contact.angle), math.sin(contact.angle)])
    assert abs(float(along @ major)) == pytest.approx(1.0)


def test_the_names_of_the_axes_do_not_jump_where_they_grow_past_each_other():
    """Figures 9 and 10: the major axis lies along y at t = 0 and 4 s, along x at 2 and 6 s."""
    flat = [contact_of_rollers(Curvatures(3.0, 0.0, k, 0.0), 0.0, MODULUS, 70.0) for k in (2.99, 3.01)]
    assert flat[0].along_x == pytest.approx(flat[1].along_x, rel=0.01)
    assert flat[0].along_x < flat[0].along_y
    assert flat[1].along_x > flat[1].along_y


def figure_10(time):
    """A set of curves that meets every statement of the paper: crossed cylinders, R11 along y and R21 along x."""
    profile = 0.320 + 0.002 * time
    shaft = 0.340 - (0.130 - 0.012 * time) * math.cos(0.5 * math.pi * time)
    load = 72.0 - 15.0 * math.sin(0.25 * math.pi * time) ** 2
    return contact_of_rollers(Curvatures(1.0 / shaft, 0.0, 1.0 / profile, 0.0), 0.0, MODULUS, load)


@pytest.mark.parametrize(("time", "along_y", "along_x", "area", "peak", "approach"), [
    (0.0, 5.682e-4, 4.292e-4, 0.766e-6, 141.0e6, 9.43e-7), (2.0, 4.671e-4, 5.779e-4, 0.848e-6, 100.8e6, 7.11e-7),
    (4.0, 5.568e-4, 4.745e-4, 0.830e-6, 130.1e6, 9.09e-7), (6.0, 4.823e-4, 5.443e-4, 0.825e-6, 103.7e6, 7.22e-7),
])  # fmt: skip
def test_the_contact_of_figure_10(time, along_y, along_x, area, peak, approach):
    contact = figure_10(time)
    assert (contact.along_x, contact.along_y) == pytest.approx((along_x, along_y), rel=2e-3)
    assert contact.area == pytest.approx(area, rel=2e-3)
    assert (contact.peak_pressure, contact.approach) == pytest.approx((peak, approach), rel=2e-3)


def test_the_statements_about_figure_10():
    start, second, fourth, sixth = (figure_10(time) for time in (0.0, 2.0, 4.0, 6.0))
    assert start.area < fourth.area
    assert start.peak_pressure > fourth.peak_pressure
    assert sixth.area < second.area
    assert sixth.peak_pressure > second.peak_pressure


def test_the_polynomial_is_close_where_the_ellipse_is_round():
    """Below Omega = 0.3 within 2e-4; at 0.7 the ratio of the axes is 0.27 % off."""
    for omega, error in ((0.3, 2e-4), (0.7, 0.0027)):
        curvatures = Curvatures(1.0 - omega, 0.0, 1.0 + omega, 0.0)
        exact, fit = (contact_of_rollers(curvatures, 0.0, MODULUS, 10.0, kind) for kind in (EXACT, POLYNOMIAL))
        off = (fit.along_y / fit.along_x) / (exact.along_y / exact.along_x) - 1.0
        assert off == pytest.approx(error, abs=0.1 * error)


def test_bodies_without_an_elliptic_contact_are_refused():
    with pytest.raises(HertzError, match=r"-50 .* must be above 0"):
        contact_of_rollers(Curvatures(-100.0, 50.0, 200.0, 0.0), 0.0, MODULUS, 10.0)
    with pytest.raises(HertzError, match="finite"):
        contact_of_rollers(CURVATURES, math.nan, MODULUS, 10.0)


def test_no_load_is_no_contact():
    assert contact_of_rollers(CURVATURES, 0.1, MODULUS, 0.0) == (0.0,) * 6


def test_a_place_that_curves_otherwise_has_its_own_softness():
    """k_c where the shaft curves by k21 - W'': the contact of that shaft; too hollow is told."""
    bends, out = numpy.array([-30.0, 0.0, 60.0]), numpy.empty(3)
    assert local_coefficients(CURVATURES, 0.2, MODULUS, EXACT, bends, out)
    for bend, value in zip(bends, out, strict=True):
        here = CURVATURES._replace(shaft_rolling=200.0 - bend)
        assert value == pytest.approx(
            contact_of_rollers(here, 0.2, MODULUS, 50.0).approach / 50.0 ** (2.0 / 3.0), rel=1e-12
        )
    assert not local_coefficients(CURVATURES, 0.0, MODULUS, EXACT, numpy.array([250.0]), out)


@pytest.mark.parametrize(("curvature", "exact"), [(60.0, False), (10.0, True)])
def test_the_polynomial_is_left_where_it_no_longer_holds(curvature, exact):
    """Crossed cylinders, Omega 0.54 and 0.905: beyond 0.85 the exact root, as the sheet of the paper allows."""
    bodies = Curvatures(curvature, 0.0, 200.0, 0.0)
    contacts = [contact_of_rollers(bodies, 0.0, MODULUS, 100.0, kind) for kind in (EXACT, POLYNOMIAL)]
    assert (contacts[0] == contacts[1]) is exact
