"""Closed forms on Lame domains: Hertz at n = 2, load balance, the printed errors, and the pressure field as judge."""

from __future__ import annotations

import math
from functools import cache

import mpmath
import numpy
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

from contact_sim_lab.closed_form.lame_pressure import (
    LamePressureError,
    ansatz_of_curvatures,
    ansatz_on_domain,
    eccentricity,
    equivalent_ellipse,
    lame_pressure,
    printed_approach,
)
from contact_sim_lab.twins import lame_pressure as reference
from contact_sim_pkg.pressure.closed_form.hertz import HertzError, hertz_contact
from contact_sim_pkg.pressure.closed_form.lame import LameFit, fit_patch, lame_area
from contact_sim_pkg.pressure.field.halfspace import make_half_space
from contact_sim_pkg.pressure.field.solver import make_workspace, solve_at_load

TIRE = (0.5, 0.5 / 0.3, 4e6, 4000.0)  # A, B, E*, P of the check tire


@pytest.mark.parametrize("curvatures", [(0.5, 0.5 / 0.3), (0.5 / 0.3, 0.5), (2.0, 2.0), (1e-4, 1.0)])
def test_for_the_ellipse_all_levels_are_hertz(curvatures: tuple[float, float]) -> None:
    hertz = hertz_contact(*curvatures, 4e6, 4000.0)
    a, b = (hertz.a, hertz.b) if curvatures[0] <= curvatures[1] else (hertz.b, hertz.a)
    expected = pytest.approx((4000.0, hertz.approach, a, b, 2.0, hertz.peak_pressure), rel=1e-13)
    assert ansatz_of_curvatures(*curvatures, 2.0, 4e6, 4000.0) == expected
    assert ansatz_on_domain(a, b, 2.0, 4e6, 4000.0) == expected
    assert equivalent_ellipse(a, b, 2.0, 4e6, 4000.0) == expected


@pytest.mark.parametrize("exponent", [0.7, 1.0, 2.0, 3.0, 6.0])
def test_the_ansatz_carries_its_load(exponent: float) -> None:
    known = ansatz_on_domain(0.11, 0.05, exponent, 4e6, 4000.0)
    assert known.peak_pressure * reference.ansatz_load(0.11, 0.05, exponent) == pytest.approx(4000.0, rel=1e-5)
    found = ansatz_of_curvatures(0.5, 0.5 / 0.3, exponent, 4e6, 4000.0)
    assert found.peak_pressure * reference.ansatz_load(found.a, found.b, exponent) == pytest.approx(4000.0, rel=1e-5)
    hertz = hertz_contact(*TIRE)
    assert (found.approach, found.peak_pressure) == (hertz.approach, hertz.peak_pressure)
    assert eccentricity(found.a, found.b, exponent) ** 2 == pytest.approx(1.0 - (hertz.b / hertz.a) ** 2, rel=1e-12)


def test_the_pressure_on_a_grid_sums_to_the_load() -> None:
    contact = ansatz_on_domain(0.11, 0.05, 4.0, 4e6, 4000.0)
    x, y = (numpy.arange(800) - 399.5) / 800 * 0.24, (numpy.arange(600) - 299.5) / 600 * 0.12
    pressure = lame_pressure(contact, x[:, None], y[None, :])
    assert pressure.sum() * 0.24 / 800 * 0.12 / 600 == pytest.approx(4000.0, rel=1e-4)
    assert pressure[0, 300] == 0.0
    assert lame_pressure(contact, 0.0, 0.0) == contact.peak_pressure


def test_the_equivalent_ellipse_keeps_area_and_aspect() -> None:
    ellipse = equivalent_ellipse(2.0, 1.0, 4.0, 1.0, 1.0)
    assert math.pi * ellipse.a * ellipse.b == pytest.approx(
        2.0 * 3.708149354602744, rel=1e-14
    )  # Gamma(1/4)^2 / sqrt(pi) / 2
    assert ellipse.a / ellipse.b == pytest.approx(2.0, rel=1e-15)
    assert ellipse.peak_pressure == pytest.approx(1.5 / (2.0 * 3.708149354602744), rel=1e-14)


@cache
def solved(gap_exponent: float) -> tuple[LameFit, float, float, float]:
    """Fit of the domain, centre and largest pressure, approach for the gap `(|x|^g + |y|^g)/g`, E* = 1, P = 1, by the field."""
    cells, side = 193, 2.3
    cell = side / cells
    x = abs((numpy.arange(cells) - (cells - 1) / 2) * cell) ** gap_exponent / gap_exponent
    half_space = make_half_space(cells, cells, cell, cell, 1.0)
    pressure = numpy.zeros((cells, cells))
    gap = x[:, None] + x[None, :]
    result = solve_at_load(half_space, make_workspace(half_space), gap, 1.0, 1e-6, 400, pressure)
    assert result.status == 0
    fit = fit_patch(pressure, cell, cell, -(cells - 1) / 2 * cell, -(cells - 1) / 2 * cell)
    return fit, float(pressure[cells // 2, cells // 2]), float(pressure.max()), result.approach


TABLE = [  # gap exponent, domain exponent, p centre, p maximum, ansatz p0, approach, of the ansatz, of the ellipse
    (2.0, 2.00, 0.578, 0.578, 0.578, 0.825, 0.825, 0.825),
    (3.0, 3.8, 0.316, 0.400, 0.408, 0.663, 0.593, 0.749),
    (4.0, 6.1, 0.238, 0.374, 0.343, 0.589, 0.510, 0.714),
    (6.0, 11.9, 0.181, 0.387, 0.290, 0.523, 0.445, 0.683),
]
"""Computed beforehand on 384 x 384 cells; here the grid has 193 x 193."""


@pytest.mark.parametrize("row", TABLE)
def test_the_errors_of_the_closed_forms_are_those_announced(row: tuple[float, ...]) -> None:
    gap_exponent, exponent, centre, largest, ansatz_peak, approach, ansatz_approach, ellipse_approach = row
    fit, found_centre, found_largest, found_approach = solved(gap_exponent)
    ansatz = ansatz_on_domain(fit.a, fit.b, fit.exponent, 1.0, 1.0)
    ellipse = equivalent_ellipse(fit.a, fit.b, fit.exponent, 1.0, 1.0)
    assert fit.exponent == pytest.approx(exponent, rel=0.02)
    assert found_centre == pytest.approx(centre, abs=1e-3)
    assert found_largest == pytest.approx(largest, rel=0.02)  # near the edge it still grows with the grid
    assert found_approach == pytest.approx(approach, abs=1e-3)
    assert ansatz.peak_pressure == pytest.approx(ansatz_peak, abs=2e-3)
    assert ansatz.approach == pytest.approx(ansatz_approach, abs=2e-3)
    assert ellipse.approach == pytest.approx(ellipse_approach, abs=2e-3)
    assert fit.deviation < 0.01


@pytest.mark.parametrize(("poisson", "factor"), [(0.5, 0.481), (0.3, 0.529)])
def test_the_printed_approach_is_too_low(poisson: float, factor: float) -> None:
    right = hertz_contact(0.5, 0.5 / 0.3, 3e6 / (1.0 - poisson**2), 4000.0).approach
    assert printed_approach(0.5, 0.5 / 0.3, 3e6, poisson, 4000.0) / right == pytest.approx(factor, abs=5e-4)
    shear = 3e6 / (2.0 * (1.0 + poisson))  # printed with G in place of E it is Hertz
    assert printed_approach(0.5, 0.5 / 0.3, shear, poisson, 4000.0) == pytest.approx(right, rel=1e-14)


def test_the_printed_shape_carries_nine_times_the_load() -> None:
    assert reference.printed_shape_load() == pytest.approx(9.05, abs=5e-3)


@pytest.mark.parametrize("exponent", [1.0, 2.0, 3.0, 5.0])
def test_the_printed_eccentricity_needs_its_radius(exponent: float) -> None:
    a, b = 1.3, 0.6
    right = reference.printed_eccentricity_power(a, b, exponent, (a**exponent + b**exponent) / exponent)
    assert eccentricity(a, b, exponent) ** exponent == pytest.approx(right, rel=1e-13)
    square = reference.printed_eccentricity_power(1.0, 1.0, exponent, 1.0)  # r^n = (a^n + b^n)/2
    assert square == pytest.approx(exponent - 2.0)
    assert eccentricity(1.0, 1.0, exponent) == 0.0


def test_without_load_there_is_no_pressure() -> None:
    for load in (0.0, -3.0):
        assert ansatz_on_domain(0.1, 0.2, 3.0, 4e6, load) == (0.0, 0.0, 0.1, 0.2, 3.0, 0.0)
        nothing = ansatz_of_curvatures(0.5, 1.0, 3.0, 4e6, load)
        assert nothing == (0.0, 0.0, 0.0, 0.0, 3.0, 0.0)
        assert numpy.all(lame_pressure(nothing, numpy.zeros(3), 0.0) == 0.0)


def test_slender_domains_stay_finite() -> None:
    contact = ansatz_on_domain(1.0, 1e-8, 60.0, 4e6, 1.0)
    assert 0.0 < contact.approach < math.inf


def test_impossible_input_is_refused() -> None:
    for bad in ((0.0, 1.0, 2.0), (1.0, math.inf, 2.0), (1.0, 1.0, 0.05), (1.0, 1.0, math.nan)):
        for call in (ansatz_on_domain, equivalent_ellipse):
            with pytest.raises(LamePressureError):
                call(*bad, 4e6, 1.0)
    with pytest.raises(LamePressureError, match=r"E\*"):
        ansatz_on_domain(1.0, 1.0, 2.0, 0.0, 1.0)
    with pytest.raises(LamePressureError, match="load"):
        ansatz_on_domain(1.0, 1.0, 2.0, 1.0, math.nan)
    with pytest.raises(HertzError, match="conform"):
        ansatz_of_curvatures(0.0, 0.0, 2.0, 1.0, 1.0)


@settings(max_examples=40)
@given(
    *[st.floats(-8.0, 4.0).map(lambda power: 10.0**power)] * 2,
    st.one_of(st.just(0.1), st.floats(0.1, 100.0)),
    st.floats(1e-3, 1e12),
    st.floats(0.0, 1e9),
)
def test_both_estimates_carry_their_load_over_the_whole_range(a, b, exponent, modulus, load):
    """The mean of sqrt(1 - rho^n) over the domain by quadrature over rho; the ellipse's is 2/3."""
    ansatz, ellipse = (call(a, b, exponent, modulus, load) for call in (ansatz_on_domain, equivalent_ellipse))
    area = lame_area(a, b, exponent)
    mean = quad(lambda t: 2.0 * t * math.sqrt(1.0 - t**exponent), 0.0, 1.0, epsabs=1e-12)[0]
    assert ansatz.peak_pressure * area * mean == pytest.approx(load, rel=1e-6)
    assert ellipse.peak_pressure * area * 2.0 / 3.0 == pytest.approx(load, rel=1e-12)
    assert ansatz.approach >= 0.0
    slender = max(ellipse.a, ellipse.b) / min(ellipse.a, ellipse.b)
    with mpmath.workdps(30):
        integral = mpmath.ellipk(1 - 1 / mpmath.mpf(slender) ** 2)
    assert ellipse.approach == pytest.approx(
        ellipse.peak_pressure * min(ellipse.a, ellipse.b) * float(integral) / modulus
    )


@pytest.mark.parametrize("bad", [0.0, -1.0, math.nan, math.inf, 5e-324])
def test_what_no_lame_pressure_is_known_for_is_refused(bad):
    for call in (ansatz_on_domain, equivalent_ellipse):
        for values in ((bad, 1.0, 2.0, 1.0), (1.0, bad, 2.0, 1.0), (1.0, 1.0, bad, 1.0)):
            with pytest.raises(LamePressureError):
                call(*values, 1.0)
    with pytest.raises(LamePressureError, match="no finite"):
        ansatz_on_domain(1e-90, 1e-90, 2.0, 1.0, 1e200)
    with pytest.raises(LamePressureError, match="coordinate"):
        lame_pressure(ansatz_on_domain(1.0, 1.0, 2.0, 1.0, 1.0), numpy.array([math.nan]), numpy.zeros(1))
    with pytest.raises(LamePressureError, match="Poisson"):
        printed_approach(1.0, 1.0, 1e6, 1.0, 1.0)
