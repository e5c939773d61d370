"""Closed-form pressure on a Lame (superelliptic) contact domain: Tire/Road Contact's eqs 5-9,
corrected, and its errors.

Domain `rho <= 1`, `rho^n = |x/a|^n + |y/b|^n`, area S. For n = 2 every form here is the elliptic
Hertz contact. For other n no closed form exists; these are estimates, and the pressure field
(`pressure/field/solver.py`) is what they are measured with:

* ansatz: `p = p0 (1 - rho^n)^(1/2)`, generalised eccentricity `k = (1 - (b/a)^n)^(1/n)`, parameter
  m = k^2;
* equivalent ellipse: Hertz on the ellipse of the same area and aspect, `a_e = sqrt(S a / (pi b))`.

Measured on gaps `(|x|^g + |y|^g)/g` under one load: g = 3, 4, 6 make domains of n = 3.8, 6.1, 11.9.
There the ansatz is 29, 44, 60 % high in the centre, 2 % above to 25 % below the true maximum (which
lies near the edge) and 11 to 15 % low in the approach; the ellipse is 13 to 31 % high in the
approach.

Of the printed formulas eq 9 is kept (`printed_approach`), to show its error. The printed eq 7 is
infinite at the edge and carries 9.05 times the load on a circle; it is not offered.

Source: Tire/Road Contact, eqs 5-9; Johnson (1985), Contact Mechanics, section 4.2.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.pressure.closed_form.hertz import elliptic_integrals, hertz_contact
from contact_sim_pkg.pressure.closed_form.lame import lame_area

__all__ = [
    "LamePressure",
    "LamePressureError",
    "ansatz_of_curvatures",
    "ansatz_on_domain",
    "eccentricity",
    "equivalent_ellipse",
    "lame_pressure",
    "printed_approach",
]

Field = NDArray[numpy.float64]

SMALLEST_COMPLEMENT = 1e-300
"""Floor of 1 - m, so that K stays finite for a slender domain of large exponent."""


class LamePressureError(ValueError):
    """The domain, the modulus or the load is not possible; the text says why."""


class LamePressure(NamedTuple):
    load: float  # [N]
    approach: float  # [m]
    a: float  # [m] along x
    b: float  # [m] along y
    exponent: float  # [1] n
    peak_pressure: float  # [Pa] in the centre


def eccentricity(a: float, b: float, exponent: float) -> float:
    """`(1 - (b/a)^n)^(1/n)` of the smaller over the larger semi-axis [1]: 0 for a = b, towards 1
    for a needle.

    a, b: semi-axes [m]. The printed `(n r^n - 2 b^n)^(1/n) / a` with r undefined is this for `r^n =
    (a^n + b^n)/n`.
    """
    _refuse_domain(a, b, exponent)
    ratio = min(a, b) / max(a, b)
    return float((-math.expm1(exponent * math.log(ratio))) ** (1.0 / exponent)) if ratio < 1.0 else 0.0


def ansatz_on_domain(a: float, b: float, exponent: float, modulus: float, load: float) -> LamePressure:
    """Ansatz on a known domain: `p0 = P / (S (2/n) B(2/n, 3/2))`, `approach = p0 b K(m) / E*`.

    a, b: half axes along x and y [m]; exponent: n >= 0.1; modulus: E* [Pa]; load: [N], <= 0 gives
    no pressure. Raises `LamePressureError`.
    """
    _refuse_domain(a, b, exponent)
    _refuse_modulus(modulus)
    load = _carried(load)
    peak = load / (lame_area(a, b, exponent) * _mean_over_peak(exponent))
    approach = peak * min(a, b) * _integral_k(min(a, b) / max(a, b), exponent) / modulus
    if not peak + approach < math.inf:
        raise LamePressureError(f"Lame pressure: {load} N on a = {a} m, b = {b} m give no finite pressure and approach")
    return LamePressure(load, approach, a, b, exponent, peak)


def ansatz_of_curvatures(
    curvature_a: float, curvature_b: float, exponent: float, modulus: float, load: float
) -> LamePressure:
    """Ansatz where only the gap's curvatures A, B [1/m] and n are known.

    p0 and the approach are those of the corrected eqs 8 and 9, which are Hertz's and give m; the
    aspect follows from `m = k^2`, `b/a = (1 - m^(n/2))^(1/n)`, and a from the load balance. a lies
    along the smaller curvature. Raises `LamePressureError`, and `HertzError` for conforming, saddle
    and line contact.
    """
    _refuse_domain(1.0, 1.0, exponent)
    load = _carried(load)
    hertz = hertz_contact(curvature_a, curvature_b, modulus, load)
    if load == 0.0:
        return LamePressure(0.0, 0.0, 0.0, 0.0, exponent, 0.0)
    # Aspect of the domain from the parameter m of the Hertz ellipse
    complement = (hertz.b / hertz.a) ** 2
    power = 0.5 * exponent * math.log1p(-complement) if complement < 1.0 else -math.inf
    aspect = (-math.expm1(power)) ** (1.0 / exponent)
    # Size from the load, orientation from the curvatures
    unit_area = lame_area(1.0, aspect, exponent) * _mean_over_peak(exponent)
    a = math.sqrt(load / (hertz.peak_pressure * unit_area))
    along_x, along_y = (a, aspect * a) if curvature_a <= curvature_b else (aspect * a, a)
    return LamePressure(load, hertz.approach, along_x, along_y, exponent, hertz.peak_pressure)


def equivalent_ellipse(a: float, b: float, exponent: float, modulus: float, load: float) -> LamePressure:
    """Hertz pressure on the ellipse with the area S and the aspect of a Lame domain: `p0 = 3 P / (2
    S)`.

    Arguments and errors as `ansatz_on_domain`; the result has n = 2 and the semi-axes of the
    ellipse.
    a, b: [m]; modulus: E* [Pa]; load: [N].
    """
    _refuse_domain(a, b, exponent)
    scale = math.sqrt(lame_area(a, b, exponent) / (math.pi * a * b))
    return ansatz_on_domain(a * scale, b * scale, 2.0, modulus, load)


def lame_pressure(contact: LamePressure, x: Field, y: Field) -> Field:
    """`p0 sqrt(1 - rho^n)` [Pa] at x, y [m] (arrays that fit together), 0 outside. Raises
    `LamePressureError` for nan.
    """
    x, y = numpy.asarray(x, dtype=float), numpy.asarray(y, dtype=float)
    if numpy.isnan(x).any() or numpy.isnan(y).any():
        raise LamePressureError("Lame pressure: a coordinate is nan, it must be a number")
    if contact.peak_pressure == 0.0:
        return numpy.zeros(numpy.broadcast(x, y).shape)
    with numpy.errstate(over="ignore"):
        power = abs(x / contact.a) ** contact.exponent + abs(y / contact.b) ** contact.exponent
    return numpy.asarray(contact.peak_pressure * numpy.sqrt(numpy.maximum(1.0 - power, 0.0)))


def printed_approach(curvature_a: float, curvature_b: float, young: float, poisson: float, load: float) -> float:
    """Eq 9 as printed [m], with Young's modulus [Pa] where the shear modulus belongs: too low by (2
    (1 + nu))^(-2/3).

    With G in place of E it is Hertz. Raises `LamePressureError` for a Poisson ratio outside -1 to
    0.5, `HertzError` as `hertz_contact`.
    """
    if not -1.0 <= poisson <= 0.5:
        raise LamePressureError(f"Lame pressure: Poisson ratio {poisson}, it must be a number from -1 to 0.5")
    return hertz_contact(curvature_a, curvature_b, 2.0 * young / (1.0 - poisson), load).approach


def _mean_over_peak(exponent: float) -> float:
    """`(2/n) B(2/n, 3/2)` [1]: 2/3 for the ellipse, 1 for the rectangle."""
    first = 2.0 / exponent
    return first * math.exp(math.lgamma(first) + math.lgamma(1.5) - math.lgamma(first + 1.5))


def _integral_k(aspect: float, exponent: float) -> float:
    """Complete elliptic integral K of m = k^2, from `1 - m = 1 - (1 - aspect^n)^(2/n)` without
    cancellation.
    """
    power = math.exp(exponent * math.log(aspect))
    complement = -math.expm1(2.0 / exponent * math.log1p(-power)) if power < 1.0 else 1.0
    return float(elliptic_integrals(max(complement, SMALLEST_COMPLEMENT))[0])


def _carried(load: float) -> float:
    if not math.isfinite(load):
        raise LamePressureError(f"Lame pressure: the load is {load} N, it must be a finite number")
    return max(float(load), 0.0)


def _refuse_modulus(modulus: float) -> None:
    if not 0.0 < modulus < math.inf:
        raise LamePressureError(f"Lame pressure: E* is {modulus} Pa, it must be a finite number above 0")


def _refuse_domain(a: float, b: float, exponent: float) -> None:
    if not (1e-100 <= a <= 1e100 and 1e-100 <= b <= 1e100):
        raise LamePressureError(
            f"Lame pressure: half axes a = {a} m, b = {b} m, both must be numbers from 1e-100 to 1e100"
        )
    if not 0.1 <= exponent < math.inf:
        raise LamePressureError(f"Lame pressure: exponent n = {exponent}, allowed from 0.1")
