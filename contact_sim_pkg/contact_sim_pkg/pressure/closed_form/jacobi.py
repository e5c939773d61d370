"""Jacobi's elliptic function cn by theta series (Abramowitz and Stegun 16.36), from the complement
m1 = 1 - m.

m is the parameter (the square of the modulus), 0 <= m <= 1. m = 0 is the cosine, m = 1 the
hyperbolic secant. ``cn(u) = theta_4(0)/theta_2(0) theta_2(z)/theta_4(z)``, ``z = pi u/(2 K)``. For
m <= 1/2 the series in the nome, which is below exp(-pi); above, the same functions as sums of
Gaussians about the lattice (Jacobi's transformation): four terms give all digits.
"""

from __future__ import annotations

import math

import numpy
from numpy.typing import ArrayLike, NDArray

from contact_sim_pkg.pressure.closed_form.hertz import elliptic_integrals

Array = NDArray[numpy.float64]

TERMS = 5


def quarter_period(complement: float) -> tuple[float, float]:
    """K(m) and E(m) [1] from ``complement`` 1 - m, 0 <= 1 - m <= 1; at 0 they are infinite and 1.
    Raises ValueError outside."""
    if not 0.0 <= complement <= 1.0:
        raise ValueError(f"the complement 1 - m of an elliptic function is {complement}, it must be 0 to 1")
    if complement == 0.0:
        return math.inf, 1.0
    integral_k, integral_e, _difference = elliptic_integrals(complement)
    return float(integral_k), float(integral_e)


def jacobi_cn(argument: ArrayLike, complement: float) -> Array:
    """cn(u; m) [1] at ``argument`` u [arguments], any real numbers, from ``complement`` 1 - m [1].

    The result has the shape of the argument; its absolute error is about 1e-15 within a few
    periods. Raises ValueError where 1 - m is outside 0 to 1.
    """
    u = numpy.asarray(argument, dtype=numpy.float64)
    integral_k, _e = quarter_period(complement)
    if complement == 0.0:
        return numpy.asarray(1.0 / numpy.cosh(numpy.minimum(numpy.abs(u), 700.0)))
    if complement == 1.0:
        return numpy.cos(u)
    half_turns = numpy.round(u / (2.0 * integral_k))  # cn(u + 2 K) = -cn(u)
    sign = 1.0 - 2.0 * numpy.abs(numpy.remainder(half_turns, 2.0))
    z = 0.5 * math.pi * (u / integral_k - 2.0 * half_turns)
    ratio = quarter_period(1.0 - complement)[0] / integral_k
    series = _nome_series if complement >= 0.5 else _lattice_series
    at_zero, at_z = series(numpy.zeros(1), ratio), series(z, ratio)
    return numpy.asarray(sign * (at_zero[1] / at_zero[0]) * at_z[0] / at_z[1])


def cn_squared(argument: ArrayLike, complement: float) -> Array:
    """cn(u; m)^2 [1], of period 2 K, at u [arguments]; arguments and errors as ``jacobi_cn``."""
    return jacobi_cn(argument, complement) ** 2


def _nome_series(z: Array, ratio: float) -> tuple[Array, Array]:
    """theta_2 over ``2 q^(1/4)``, and theta_4, from ``q = exp(-pi ratio)``."""
    q = math.exp(-math.pi * ratio)
    second, fourth = numpy.cos(z), numpy.ones_like(z)
    for n in range(1, TERMS):
        second = second + q ** (n * (n + 1)) * numpy.cos((2 * n + 1) * z)
        fourth = fourth + 2.0 * (-1) ** n * q ** (n * n) * numpy.cos(2 * n * z)
    return second, fourth


def _lattice_series(z: Array, ratio: float) -> tuple[Array, Array]:
    """theta_2 and theta_4 at |z| <= pi/2 over one factor, as sums of Gaussians of width ``pi
    ratio``.
    """
    second, fourth = numpy.zeros_like(z), numpy.zeros_like(z)
    for n in range(-TERMS, TERMS + 1):
        second = second + (-1) ** n * numpy.exp(-((z + n * math.pi) ** 2) / (math.pi * ratio))
        fourth = fourth + numpy.exp(-((z + (n + 0.5) * math.pi) ** 2) / (math.pi * ratio))
    return second, fourth
