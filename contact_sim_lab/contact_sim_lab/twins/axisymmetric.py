"""Sneddon's integrals in multiple precision, straight from the textbook: d'(s) with the second
derivative of the profile.
"""

from __future__ import annotations

from collections.abc import Callable

import mpmath

__all__ = ["approach", "load", "pressure"]

DIGITS = 40
"""The integrands are infinite at the edge: half of the digits are spent there."""

Function = Callable[[mpmath.mpf], mpmath.mpf]


def approach(slope: Function, radius: float, breaks: tuple[float, ...] = ()) -> float:
    """`integral over 0..a of a f'(r) / sqrt(a^2 - r^2) dr` [m]."""
    with mpmath.workdps(DIGITS):
        a = mpmath.mpf(radius)
        return float(mpmath.quad(lambda r: a * slope(r) / mpmath.sqrt((a - r) * (a + r)), _edges(0.0, breaks, radius)))


def load(slope: Function, modulus: float, radius: float, breaks: tuple[float, ...] = ()) -> float:
    """`2 E* integral over 0..a of r^2 f'(r) / sqrt(a^2 - r^2) dr` [N]."""
    with mpmath.workdps(DIGITS):
        a = mpmath.mpf(radius)
        integral = mpmath.quad(lambda r: r**2 * slope(r) / mpmath.sqrt((a - r) * (a + r)), _edges(0.0, breaks, radius))
        return float(2 * modulus * integral)


def pressure(slope: Function, second: Function, modulus: float, radius: float, r: float) -> float:
    """`(E*/pi) integral over r..a of d'(s) / sqrt(s^2 - r^2) ds` [Pa], `d'(s)` = integral of (r
    f')' / sqrt(s^2 - r^2).
    """

    def approach_slope(s: mpmath.mpf) -> mpmath.mpf:
        return mpmath.quad(
            lambda t: slope(s * mpmath.sin(t)) + s * mpmath.sin(t) * second(s * mpmath.sin(t)), [0, mpmath.pi / 2]
        )

    near = mpmath.mpf(r)
    value = mpmath.quad(lambda u: approach_slope(near * mpmath.cosh(u)), [0, mpmath.acosh(radius / near)])
    return float(modulus / mpmath.pi * value)


def _edges(low: float, breaks: tuple[float, ...], high: float) -> list[float]:
    return [low, *(b for b in breaks if low < b < high), high]
