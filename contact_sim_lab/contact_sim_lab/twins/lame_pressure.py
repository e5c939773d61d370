"""Lame pressures by quadrature, and Tire/Road Contact's formulas as they are printed."""

from __future__ import annotations

import math

import mpmath
import scipy.integrate

__all__ = ["ansatz_load", "printed_eccentricity_power", "printed_shape_load"]


def ansatz_load(a: float, b: float, exponent: float) -> float:
    """Load [N] of `(1 - |x/a|^n - |y/b|^n)^(1/2)` by quadrature over the quarter domain."""
    n = exponent

    def width(x: float) -> float:
        return float((1.0 - x**n) ** (1.0 / n))

    value, _ = scipy.integrate.dblquad(
        lambda y, x: math.sqrt(max(1.0 - x**n - y**n, 0.0)), 0.0, 1.0, 0.0, width, epsabs=1e-9, epsrel=1e-9
    )
    return float(4.0 * a * b * value)


def printed_eccentricity_power(a: float, b: float, exponent: float, radius_power: float) -> float:
    """`k^n = (n r^n - 2 b^n) / a^n` [1], printed below eq 7, with r^n given; a, b: half axes
    [m].
    """
    return float((exponent * radius_power - 2.0 * b**exponent) / a**exponent)


def printed_shape_load() -> float:
    """Load of the printed eq 7 over the right load [1], on a circle: shape `E(arcsin(1 - r),
    0)^(-2/3)`, 1 in the centre."""
    integral = mpmath.quad(lambda r: r * (mpmath.asin(1 - r) * 2 / mpmath.pi) ** (-mpmath.mpf(2) / 3), [0, 0.5, 1])
    return float(3 * integral)
