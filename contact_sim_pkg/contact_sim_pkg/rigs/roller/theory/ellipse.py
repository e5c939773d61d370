"""The elliptic contact of two bodies turned against each other: semi-axes named by their direction,
not by their size.

The gap is `x^T G x` with `G = (Rot(yaw) diag(k11, k12) Rot(-yaw) + diag(k22, k21)) / 2`. Its
principal curvatures are the A and B of `pressure/closed_form/hertz.py`, its principal axes those of
the ellipse: only one body turns with the yaw, so the ellipse turns by

    tan 2 phi = (k11 - k12) sin 2 yaw / ((k11 - k12) cos 2 yaw + k22 - k21)

The paper (eq 12) takes phi = yaw. The semi-axis `along_x` is the one nearer to x: it may be the
smaller, and it does not change its name where the two grow past each other. Source: Johnson (1985),
section 4.1.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.guards import require, require_choice, require_fields, require_positive
from contact_sim_pkg.compiled.jit import entry
from contact_sim_pkg.pressure.closed_form.hertz import HertzError, contact_of_shape, ellipse_shape
from contact_sim_pkg.pressure.closed_form.hertz_fits import shape_of_polynomial
from contact_sim_pkg.rigs.roller.theory.parameters import Curvatures

__all__ = [
    "EXACT",
    "POLYNOMIAL",
    "RollingContact",
    "contact_of_rollers",
    "local_coefficients",
    "principal_curvatures",
    "rolling_contact",
    "rolling_contacts",
]

EXACT, POLYNOMIAL = 0, 1

Values = NDArray[numpy.float64]

POLYNOMIAL_TO = 0.85
"""Omega up to which POLYNOMIAL takes the polynomial, whose b/a is then 1 % high; beyond, the exact
root.
"""

FLATTEST = 5e-13
"""Of the larger curvature of the gap: a smaller one below it is a line."""


class RollingContact(NamedTuple):
    """Zeros without load."""

    along_x: float  # [m] semi-axis nearer to x
    along_y: float  # [m] the other
    angle: float  # [rad] of `along_x` from x about z, -pi/4 to pi/4
    peak_pressure: float  # [Pa]
    approach: float  # [m]
    load: float  # [N]

    @property
    def area(self) -> float:
        """S = pi a b [m^2]."""
        return math.pi * self.along_x * self.along_y


class PrincipalCurvatures(NamedTuple):
    """Of the gap, [1/m]."""

    near_x: float
    near_y: float
    angle: float  # [rad] of the first from x


def contact_of_rollers(
    curvatures: Curvatures, yaw: float, modulus: float, load: float, kind: int = EXACT
) -> RollingContact:
    """Contact under a load [N] at a yaw [rad]; modulus: E* [Pa]; kind: EXACT or POLYNOMIAL (the
    paper's eq 10).

    Zeros for a load <= 0. Raises `HertzError` where the bodies do not touch in an ellipse, for
    values that are not finite and for another kind.
    """
    require_fields("curvatures", curvatures, finite=" ".join(Curvatures._fields), error=HertzError)
    require("roller contact: yaw", yaw, "rad", error=HertzError)
    require_positive("roller contact: E*", modulus, "Pa", error=HertzError)
    require("roller contact: load", load, "N", error=HertzError)
    require_choice("roller contact: kind", kind, (EXACT, POLYNOMIAL), error=HertzError)
    # Bodies that conform or touch along a line are no elliptic contact.
    principal = principal_curvatures(curvatures, yaw)
    smaller, larger = sorted(principal[:2])
    if smaller <= 0.0 or smaller < FLATTEST * larger:
        raise HertzError(
            f"roller contact: the curvatures of the gap are {smaller:.6g} and {larger:.6g} 1/m at a yaw of {yaw:.6g} rad; both "
            "must be above 0: bodies that conform, a saddle or a line are no elliptic contact"
        )
    return rolling_contact(curvatures, float(yaw), float(modulus), float(load), kind)


@entry
def principal_curvatures(curvatures: Curvatures, yaw: float) -> PrincipalCurvatures:
    """Coefficients of the gap along its principal axes. Not checked.

    yaw: [rad]; the results: [1/m].
    """
    differ = curvatures.roller_axial - curvatures.roller_rolling
    mean = 0.25 * (
        curvatures.roller_axial + curvatures.roller_rolling + curvatures.shaft_axial + curvatures.shaft_rolling
    )
    even = 0.25 * (differ * math.cos(2.0 * yaw) + curvatures.shaft_axial - curvatures.shaft_rolling)
    odd = 0.25 * differ * math.sin(2.0 * yaw)
    half_difference = math.hypot(even, odd)
    if even >= 0.0:
        return PrincipalCurvatures(mean + half_difference, mean - half_difference, 0.5 * math.atan2(odd, even))
    return PrincipalCurvatures(mean - half_difference, mean + half_difference, 0.5 * math.atan2(-odd, -even))


@entry
def rolling_contact(curvatures: Curvatures, yaw: float, modulus: float, load: float, kind: int) -> RollingContact:
    """`contact_of_rollers` for compiled callers. Not checked.

    yaw: [rad]; modulus: E* [Pa]; load: [N].
    """
    if not load > 0.0:
        return RollingContact(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    principal = principal_curvatures(curvatures, yaw)
    smaller, larger = min(principal.near_x, principal.near_y), max(principal.near_x, principal.near_y)
    round_enough = larger - smaller <= POLYNOMIAL_TO * (larger + smaller)
    fitted = kind == POLYNOMIAL and round_enough
    shape = shape_of_polynomial(smaller, larger) if fitted else ellipse_shape(smaller, larger)
    contact = contact_of_shape(shape, smaller + larger, modulus, load)
    if principal.near_x <= principal.near_y:
        return RollingContact(contact.a, contact.b, principal.angle, contact.peak_pressure, contact.approach, load)
    return RollingContact(contact.b, contact.a, principal.angle, contact.peak_pressure, contact.approach, load)


@entry
def rolling_contacts(
    curvatures: Values, yaws: Values, modulus: float, loads: Values, kind: int, out: Values
) -> None:  # fmt: skip
    """`rolling_contact` of many instants into `out` [rows, 6], columns as its fields.

    curvatures: [rows, 4] [1/m] as `Curvatures`; yaws: [rows] [rad]; modulus: E* [Pa]; loads: [rows]
    [N]. Not checked.
    """
    for i in range(yaws.shape[0]):
        here = Curvatures(curvatures[i, 0], curvatures[i, 1], curvatures[i, 2], curvatures[i, 3])
        contact = rolling_contact(here, yaws[i], modulus, loads[i], kind)
        out[i, 0], out[i, 1], out[i, 2] = contact.along_x, contact.along_y, contact.angle
        out[i, 3], out[i, 4], out[i, 5] = contact.peak_pressure, contact.approach, contact.load


@entry
def local_coefficients(
    curvatures: Curvatures, yaw: float, modulus: float, kind: int, bends: Values, out: Values
) -> bool:
    """k_c [n] where the shaft curves by `k21 - bend` along rolling, bends [n] [1/m]; False where a
    place is too hollow to touch in an ellipse. Not checked.
    """
    for i in range(bends.shape[0]):
        here = Curvatures(
            curvatures.roller_axial,
            curvatures.roller_rolling,
            curvatures.shaft_rolling - bends[i],
            curvatures.shaft_axial,
        )
        principal = principal_curvatures(here, yaw)
        smaller, larger = min(principal.near_x, principal.near_y), max(principal.near_x, principal.near_y)
        if not (smaller > 0.0 and smaller >= FLATTEST * larger):
            return False
        out[i] = rolling_contact(here, yaw, modulus, 1.0, kind).approach
    return True
