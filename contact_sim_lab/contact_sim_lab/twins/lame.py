"""Lame curves by quadrature and by a general least-squares solver."""

from __future__ import annotations

import mpmath
import numpy
import scipy.optimize
from numpy.typing import NDArray

__all__ = ["area", "fit", "moment", "perimeter", "points", "second_moment"]

Points = NDArray[numpy.float64]


def area(a: float, b: float, exponent: float) -> float:
    """`4 b integral of (1 - (x/a)^n)^(1/n) dx` over 0..a, by quadrature [m^2]."""
    n = mpmath.mpf(exponent)
    quarter = mpmath.quad(lambda u: (1 - u**n) ** (1 / n), [0, 0.25, 0.5, 0.75, 0.9, 0.99, 1])
    return float(4 * a * b * quarter)


def second_moment(a: float, b: float, exponent: float) -> float:
    """`4 b integral of x^2 (1 - (x/a)^n)^(1/n) dx` over 0..a, by quadrature [m^4]."""
    n = mpmath.mpf(exponent)
    quarter = mpmath.quad(lambda u: u**2 * (1 - u**n) ** (1 / n), [0, 0.25, 0.5, 0.75, 0.9, 0.99, 1])
    return float(4 * a**3 * b * quarter)


def points(a: float, b: float, exponent: float, count: int) -> tuple[Points, Points]:
    """Boundary points [m] `a sgn(cos t) |cos t|^(2/n)`, `b sgn(sin t) |sin t|^(2/n)`, t evenly
    spaced.
    """
    angle = 2.0 * numpy.pi * (numpy.arange(count) + 0.5) / count
    x, y = numpy.cos(angle), numpy.sin(angle)
    return a * numpy.sign(x) * abs(x) ** (2 / exponent), b * numpy.sign(y) * abs(y) ** (2 / exponent)


def fit(x: Points, y: Points, half_x: float, half_y: float) -> tuple[float, float, float]:
    """(a, b, n) that minimise `sum (rho - 1)^2` for centred points, by scipy's trust-region
    solver.

    x, y: [n] [m]; half_x, half_y: [m].
    """

    def deviation(unknown: Points) -> Points:
        a, b, n = numpy.exp(unknown)
        return numpy.asarray((abs(x / a) ** n + abs(y / b) ** n) ** (1 / n) - 1.0)

    bounds = ([-numpy.inf, -numpy.inf, numpy.log(0.3)], [numpy.inf, numpy.inf, numpy.log(20.0)])
    start = numpy.log([half_x, half_y, 2.0])
    found = scipy.optimize.least_squares(deviation, start, bounds=bounds, xtol=1e-14, ftol=1e-14, gtol=1e-14)
    a, b, n = numpy.exp(found.x)
    return float(a), float(b), float(n)


def perimeter(a: float, b: float, exponent: float) -> float:
    """Length of the curve [m]: `y(x)` and `x(y)` up to the diagonal, by quadrature with 50
    digits.
    """
    with mpmath.workdps(50):
        return float(4 * (_graph(a, b, mpmath.mpf(exponent)) + _graph(b, a, mpmath.mpf(exponent))))


def _graph(along: float, across: float, n: mpmath.mpf) -> mpmath.mpf:
    """Length of `across (1 - u^n)^(1/n)` over `along u`, u from 0 to the diagonal."""
    slope, diagonal = mpmath.mpf(across) / along, mpmath.mpf(2) ** (-1 / n)
    return along * mpmath.quad(
        lambda u: mpmath.hypot(1, slope * u ** (n - 1) * (1 - u**n) ** (1 / n - 1)), [0, diagonal / 2, diagonal]
    )


def moment(a: float, b: float, exponent: float, power_x: float, power_y: float) -> float:
    """Integral of `|x|^i |y|^j` over the domain [m^(i+j+2)], by quadrature in x; a, b: half axes
    [m]; exponent, i, j: [1]."""
    n, i, j = (mpmath.mpf(value) for value in (exponent, power_x, power_y))
    quarter = mpmath.quad(lambda u: u**i * (1 - u**n) ** ((j + 1) / n) / (j + 1), [0, 0.25, 0.5, 0.75, 0.9, 0.99, 1])
    return float(4 * a ** (i + 1) * b ** (j + 1) * quarter)
