"""Elliptic Hertz contact in multiple precision, straight from the textbook relations (Johnson 1985,
section 4.2).
"""

from __future__ import annotations

from typing import NamedTuple

import mpmath

__all__ = ["ReferenceContact", "contact_at_load", "curvature_ratio", "parameter_of"]

DIGITS = 50


class ReferenceContact(NamedTuple):
    approach: float  # [m]
    a: float  # [m]
    b: float  # [m]
    peak_pressure: float  # [Pa]


def curvature_ratio(parameter: mpmath.mpf) -> mpmath.mpf:
    """`Omega(m) = ((2-m) E(m) - 2 (1-m) K(m)) / (m E(m))`, m in (0, 1)."""
    integral_k, integral_e = mpmath.ellipk(parameter), mpmath.ellipe(parameter)
    return ((2 - parameter) * integral_e - 2 * (1 - parameter) * integral_k) / (parameter * integral_e)


def parameter_of(omega: mpmath.mpf) -> tuple[mpmath.mpf, mpmath.mpf]:
    """m and 1 - m of a given Omega in (0, 1), by bisection in ln((1-m)/m)."""
    low, high = mpmath.mpf(-90), mpmath.mpf(60)  # logit of 1 - m
    for _ in range(200):
        middle = (low + high) / 2
        complement = 1 / (1 + mpmath.exp(-middle))
        if curvature_ratio(1 - complement) > omega:
            low = middle
        else:
            high = middle
    complement = 1 / (1 + mpmath.exp(-(low + high) / 2))
    return 1 - complement, complement


def contact_at_load(curvature_a: float, curvature_b: float, modulus: float, load: float) -> ReferenceContact:
    """Contact of the gap `A x^2 + B y^2`, 0 < A < B [1/m], E* [Pa], load [N]."""
    with mpmath.workdps(DIGITS):
        small, large = mpmath.mpf(curvature_a), mpmath.mpf(curvature_b)
        total = small + large
        parameter, complement = parameter_of((large - small) / total)
        integral_k, integral_e = mpmath.ellipk(parameter), mpmath.ellipe(parameter)
        cube = 3 * mpmath.mpf(load) * mpmath.mpf(modulus) ** 2 * total**2 / (2 * mpmath.pi)
        peak = mpmath.cbrt(cube) * complement ** (mpmath.mpf(1) / 6) / integral_e ** (mpmath.mpf(2) / 3)
        b = peak * integral_e / (modulus * total)
        approach = peak * b * integral_k / modulus
        return ReferenceContact(float(approach), float(b / mpmath.sqrt(complement)), float(b), float(peak))
