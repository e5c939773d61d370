"""Elliptic Hertz contact of smooth bodies: load <-> approach, semi-axes, peak pressure, in closed
form.

Gap `A x^2 + B y^2`, 0 < A <= B. With m the parameter of the complete elliptic integrals (m = 1 -
(b/a)^2), H = A + B:

    Omega = (B - A) / (A + B) = ((2 - m) E - 2 (1 - m) K) / (m E)
    delta = (9 P^2 H / (4 pi^2 E*^2))^(1/3) (1 - m)^(1/3) K E^(-1/3),     P = c delta^(3/2)
    p0 = (3 P E*^2 H^2 / (2 pi))^(1/3) E^(-2/3) (1 - m)^(1/6),   b = p0 E / (E* H),   a = b / sqrt(1 - m)

m is found from ln(1 - m), with K and E from 1 - m by the arithmetic-geometric mean, so that slender
ellipses keep their digits: valid for Omega from 0 to 1 - 1e-12 (b/a down to 1e-8), all results to
3e-15. Near the circle the relation is 0/0, so below Omega = 0.02 its power series is used. Source:
Johnson (1985), Contact Mechanics, section 4.2.
"""

from __future__ import annotations

import math
from fractions import Fraction
from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.jit import entry, kernel

__all__ = [
    "EllipseShape",
    "HertzContact",
    "HertzError",
    "contact_at_approach",
    "contact_at_load",
    "ellipse_shape",
    "hertz_contact",
    "hertz_contact_at_approach",
    "power_law",
]

SERIES_BELOW = 0.02
"""Omega below which the series is used: m stays below 0.053, and the closed form loses less than a
digit above.
"""

SERIES_TERMS = 14
"""0.053^14 = 1e-18."""

LARGEST_OMEGA = 1.0 - 1e-12

CURE = "use the pressure field (effect contact_field) instead"


def _omega_series(count: int) -> tuple[float, ...]:
    """c_1, c_2, … of `Omega = sum c_j m^j` (3/8, 3/16, 111/1024, …), by division of the series of K
    and E.
    """
    root = [Fraction(1)]
    for n in range(1, count + 2):
        root.append(root[-1] * Fraction(2 * n - 1, 2 * n))
    k = [x * x for x in root]  # K = pi/2 sum k_n m^n
    e = [-x / (2 * n - 1) for n, x in enumerate(k)]
    above = [2 * (e[n] - k[n]) + ((2 * k[n - 1] - e[n - 1]) if n else 0) for n in range(count + 2)]
    series: list[Fraction] = []
    for n in range(count + 1):  # Omega E = above / m
        series.append(above[n + 1] - sum((series[j] * e[n - j] for j in range(n)), Fraction(0)))
    return tuple(float(c) for c in series[1:])


OMEGA_SERIES = _omega_series(SERIES_TERMS)


class HertzError(ValueError):
    """The surfaces have no elliptic point contact; the text says why."""


class EllipseShape(NamedTuple):
    """What depends on the ratio of curvatures alone."""

    complement: float  # [1] 1 - m = (b/a)^2
    integral_k: float  # [1] K(m)
    integral_e: float  # [1] E(m)


class HertzContact(NamedTuple):
    load: float  # [N]
    approach: float  # [m]
    a: float  # [m] the larger, along the smaller curvature A
    b: float  # [m] the smaller, along the larger curvature B
    peak_pressure: float  # [Pa]


def hertz_contact(curvature_a: float, curvature_b: float, modulus: float, load: float) -> HertzContact:
    """Contact under a load [N]; zeros for load <= 0.

    curvature_a, curvature_b: coefficients of the gap A x^2 + B y^2 [1/m] (half the relative
    curvatures), in either order; a of the result lies along the smaller one. modulus: E* [Pa].
    Raises `HertzError` for conforming, saddle or line contact and for values that are not finite.
    """
    smaller, larger = _ordered(curvature_a, curvature_b, modulus, load, "load [N]")
    return contact_at_load(smaller, larger, float(modulus), float(load))


def hertz_contact_at_approach(curvature_a: float, curvature_b: float, modulus: float, approach: float) -> HertzContact:
    """Contact at an approach [m]; zeros for approach <= 0.

    Arguments and errors as `hertz_contact`.
    """
    smaller, larger = _ordered(curvature_a, curvature_b, modulus, approach, "approach [m]")
    return contact_at_approach(smaller, larger, float(modulus), float(approach))


def power_law(curvature_a: float, curvature_b: float, modulus: float) -> float:
    """Coefficient c [N/m^1.5] of `P = c delta^1.5`. Arguments and errors as `hertz_contact`."""
    smaller, larger = _ordered(curvature_a, curvature_b, modulus, 0.0, "load [N]")
    return float(stiffness_coefficient(smaller, larger, float(modulus)))


def _ordered(curvature_a: float, curvature_b: float, modulus: float, value: float, name: str) -> tuple[float, float]:
    """The smaller and the larger curvature; raises `HertzError` where there is no elliptic
    contact.
    """
    curvatures = (("curvature A [1/m]", curvature_a), ("curvature B [1/m]", curvature_b))
    for label, number in (*curvatures, ("E* [Pa]", modulus), (name, value)):
        if not math.isfinite(number):
            raise HertzError(f"Hertz contact: {label} is {number}, it must be a finite number")
    if modulus <= 0.0:
        raise HertzError(f"Hertz contact: E* is {modulus} Pa, it must be above 0")
    # An elliptic contact needs both curvatures above 0, and their ratio within the range of doubles
    smaller, larger = sorted((float(curvature_a), float(curvature_b)))
    total = smaller + larger
    if total <= 0.0:
        raise HertzError(f"Hertz contact: the surfaces conform (A + B = {total} 1/m, it must be above 0); {CURE}")
    if smaller <= 0.0:
        raise HertzError(f"Hertz contact: a line contact or a saddle (A = {smaller} 1/m, it must be above 0); {CURE}")
    if (larger - smaller) / total > LARGEST_OMEGA:
        raise HertzError(
            f"Hertz contact: practically a line (A/B = {smaller / larger:.3g}, allowed from 5e-13); {CURE}"
        )
    return smaller, larger


@entry
def contact_at_load(curvature_a: float, curvature_b: float, modulus: float, load: float) -> HertzContact:
    """`hertz_contact` for compiled callers: A <= B. Not checked.

    Curvatures: [1/m]; modulus: E* [Pa]; load: [N].
    """
    if not load > 0.0:
        return HertzContact(0.0, 0.0, 0.0, 0.0, 0.0)
    return contact_of_shape(ellipse_shape(curvature_a, curvature_b), curvature_a + curvature_b, modulus, load)


@kernel
def contact_of_shape(shape: EllipseShape, mean: float, modulus: float, load: float) -> HertzContact:
    """The contact from 1 - m, K and E, and the mean curvature H = A + B [1/m]; load > 0."""
    peak = numpy.cbrt(1.5 * load * (modulus * mean) ** 2 / math.pi) * shape.complement ** (1.0 / 6.0)
    peak /= numpy.cbrt(shape.integral_e) ** 2
    semi_b = peak * shape.integral_e / (modulus * mean)
    approach = peak * semi_b * shape.integral_k / modulus
    return HertzContact(load, approach, semi_b / math.sqrt(shape.complement), semi_b, peak)


@entry
def contact_at_approach(curvature_a: float, curvature_b: float, modulus: float, approach: float) -> HertzContact:
    """`hertz_contact_at_approach` for compiled callers: A <= B. Not checked.

    Curvatures: [1/m]; modulus: E* [Pa]; approach: [m].
    """
    if not approach > 0.0:
        return HertzContact(0.0, 0.0, 0.0, 0.0, 0.0)
    load = stiffness_coefficient(curvature_a, curvature_b, modulus) * approach * math.sqrt(approach)
    contact = contact_at_load(curvature_a, curvature_b, modulus, load)
    return HertzContact(load, approach, contact.a, contact.b, contact.peak_pressure)


@entry
def stiffness_coefficient(curvature_a: float, curvature_b: float, modulus: float) -> float:
    """`c = (2 pi / 3) E* sqrt(E / (H (1 - m) K^3))` [N/m^1.5]."""
    shape = ellipse_shape(curvature_a, curvature_b)
    below = (curvature_a + curvature_b) * shape.complement * shape.integral_k**3
    return 2.0 * math.pi / 3.0 * modulus * math.sqrt(shape.integral_e / below)


@entry
def ellipse_shape(curvature_a: float, curvature_b: float) -> EllipseShape:
    """1 - m, K(m) and E(m) from 0 < A <= B by Newton steps in s = ln(1 - m), kept inside a bracket.

    The relation of Omega and m, written for A/B and without loss of digits near a line contact, is
    `A/B = (1 - m) (K - E) / (E - (1 - m) K)`, falling from 1 to 0 while m goes from 0 to 1.
    Not checked: `hertz_contact` is.
    Curvatures: [1/m]; the results: [1].
    """
    omega = (curvature_b - curvature_a) / (curvature_a + curvature_b)
    if omega < SERIES_BELOW:
        parameter = 0.0
        for _ in range(12):  # the error shrinks by m/2 < 0.03 each time
            quotient = 0.0
            for j in range(SERIES_TERMS):
                quotient = quotient * parameter + OMEGA_SERIES[SERIES_TERMS - 1 - j]
            parameter = omega / quotient
        integral_k, integral_e, _ = elliptic_integrals(1.0 - parameter)
        return EllipseShape(1.0 - parameter, integral_k, integral_e)
    target = math.log(curvature_a / curvature_b)
    low, high = -60.0, 0.0  # (b/a)^2 from 9e-27: beyond LARGEST_OMEGA
    unknown = max(4.0 / 3.0 * target, low)  # b/a ~ (A/B)^(2/3)
    for _ in range(60):
        complement = math.exp(unknown)
        integral_k, integral_e, difference = elliptic_integrals(complement)
        ratio = complement * difference / (integral_e - complement * integral_k)
        error = math.log(ratio * (curvature_b / curvature_a))
        if error > 0.0:
            high = unknown
        else:
            low = unknown
        moved = unknown - error / log_ratio_slope(complement, integral_k, integral_e, difference)
        if not low < moved < high:
            moved = 0.5 * (low + high)
        if abs(moved - unknown) <= 4e-16 * abs(unknown):
            break
        unknown = moved
    # A last step on 1 - m itself: its logarithm is a large number near a line and has lost a digit.
    complement = math.exp(unknown)
    integral_k, integral_e, difference = elliptic_integrals(complement)
    error = math.log(complement * difference / (integral_e - complement * integral_k) * (curvature_b / curvature_a))
    complement -= complement * error / log_ratio_slope(complement, integral_k, integral_e, difference)
    integral_k, integral_e, _ = elliptic_integrals(complement)
    return EllipseShape(complement, integral_k, integral_e)


@kernel
def log_ratio_slope(complement: float, integral_k: float, integral_e: float, difference: float) -> float:
    """Derivative [1] of `ln(A/B)` by `s = ln(1 - m)`, with D = K - E and N = E - (1-m) K.

    `1 - (1-m) (D'/D - N'/N)`, where `D' = dD/dm = (N / (1-m) + D) / (2 m)` and `N' = K / 2`.
    complement: 1 - m [1]; integral_k, integral_e, difference: K, E, K - E [1].
    """
    parameter = 1.0 - complement
    below = integral_e - complement * integral_k
    difference_slope = (below / complement + difference) / (2.0 * parameter)
    below_slope = 0.5 * integral_k
    return 1.0 - complement * (difference_slope / difference - below_slope / below)


@entry
def elliptic_integrals(complement: float) -> tuple[float, float, float]:
    """K(m), E(m) and K(m) - E(m) [1] from the complement 1 - m in (0, 1] by the
    arithmetic-geometric mean.

    `K = pi / (2 agm)`, `K - E = K sum 2^(n-1) c_n^2`; the sum starts with c_0^2 = m.
    """
    mean, root, power = 1.0, math.sqrt(complement), 1.0
    total = 0.5 * (1.0 - complement)
    for _ in range(40):
        difference = 0.5 * (mean - root)
        mean, root = 0.5 * (mean + root), math.sqrt(mean * root)
        total += power * difference * difference
        power *= 2.0
        if difference <= 1e-17 * mean:
            break
    integral_k = 0.5 * math.pi / mean
    return integral_k, integral_k * (1.0 - total), integral_k * total
