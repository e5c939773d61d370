"""Is the rolling stable? Static angles, linear motion about them, growth rates, and the loads and
dampings at which they pass zero.

About the static angles the motion is `M x'' + D x' + K x = 0` with x = (tilt, yaw), D of damping
and gyroscope, K of suspension less the slopes of the moments. Rolling friction c = f_r F R couples
tilt into yaw; with any spin the characteristic polynomial then has no s^3 term but a linear one, so
without damping a root lies in the right half-plane for either sign (flutter). Source: Rolling
Contact, eqs 8 and 18, about the static angles instead of zero.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.guards import require_fields, require_not_negative, require_positive
from contact_sim_pkg.rigs.roller.theory.ellipse import contact_of_rollers
from contact_sim_pkg.rigs.roller.theory.moments import moments
from contact_sim_pkg.rigs.roller.theory.parameters import Bending, Curvatures, Roller

__all__ = ["Linear", "RollerError", "Stability", "critical_damping", "critical_load", "linearise", "stability"]

Matrix = NDArray[numpy.float64]
Roots = NDArray[numpy.complex128]

ANGLE_STEP = 1e-4
"""[rad] of the differences that give slopes of moments; of fourth order: 1e-11 of the slope."""

ROUNDING = 1e-12
"""Of a root's size: a growth rate below it is none. The roots of an undamped motion lie on the axis
but for rounding.
"""


class RollerError(ValueError):
    """The roller has no static angles, or its inertias are none."""


class Linear(NamedTuple):
    """Small motion about the static angles."""

    tilt: float  # [rad] static
    yaw: float  # [rad]
    inertia: Matrix  # [2, 2] [kg m^2]
    damping: Matrix  # [2, 2] [N m s], with the gyroscope
    stiffness: Matrix  # [2, 2] [N m]


class Stability(NamedTuple):
    """What the roots say."""

    roots: Roots  # [4] [1/s]
    growth_rate: (
        # [1/s] of the fastest growing motion, negative where all decay, 0 where one neither grows
        # nor decays
        float
    )
    frequency: float  # [Hz] of that motion; 0: divergence
    linear: Linear


def linearise(roller: Roller, curvatures: Curvatures, bending: Bending | None, modulus: float, load: float) -> Linear:
    """Static angles under `load` [N] and the linear motion about them.

    Raises `RollerError` where there are none, and for values that are not finite, inertias, a
    radius or E* [Pa] not above 0, a load below 0; `HertzError` where a bent shaft and the roller do
    not touch in an ellipse.
    """
    _check(roller, curvatures, bending, modulus, load)
    if roller.inertia_product**2 >= roller.inertia_tilt * roller.inertia_yaw:
        raise RollerError(
            f"roller: I_yz = {roller.inertia_product} kg m^2 is too large: I_yz^2 must be below I_y I_z = "
            f"{roller.inertia_tilt * roller.inertia_yaw} kg^2 m^4"
        )
    springs = numpy.diag([roller.stiffness_tilt, roller.stiffness_yaw])

    def moment(angles: Matrix) -> Matrix:
        return numpy.array(moments(roller, curvatures, bending, modulus, load, float(angles[0]), float(angles[1])))

    # Static angles by Newton's method.
    angles = numpy.zeros(2)
    for _ in range(50):
        stiffness = springs - _slopes(moment, angles)
        try:
            change = numpy.linalg.solve(stiffness, moment(angles) - springs @ angles)
        except numpy.linalg.LinAlgError:
            raise RollerError(f"roller: no static angles under {load:.6g} N, the stiffness is singular there") from None
        angles += change
        if abs(change).max() <= 1e-14 * max(1.0, abs(angles).max()):
            break
        if not abs(angles).max() < 1.0:
            raise RollerError(f"roller: no static angles below 1 rad under {load:.6g} N")
    # Mass, damping with gyroscopic terms, and stiffness about them.
    gyro = roller.inertia_spin * roller.spin
    return Linear(
        float(angles[0]), float(angles[1]),
        numpy.array([[roller.inertia_tilt, roller.inertia_product], [roller.inertia_product, roller.inertia_yaw]]),
        numpy.array([[roller.damping_tilt, gyro], [-gyro, roller.damping_yaw]]), springs - _slopes(moment, angles),
    )  # fmt: skip


def _check(roller: Roller, curvatures: Curvatures, bending: Bending | None, modulus: float, load: float) -> None:
    positive = "radius inertia_tilt inertia_yaw"
    others = " ".join(name for name in Roller._fields if name not in positive.split())
    require_fields("roller", roller, positive=positive, finite=others, error=RollerError)
    require_fields("curvatures", curvatures, finite=" ".join(Curvatures._fields), error=RollerError)
    require_positive("E*", modulus, "Pa", error=RollerError)
    require_not_negative("load", load, "N", error=RollerError)
    if bending is not None:
        finite = "load contact_distance load_distance friction"
        require_fields("bending", bending, positive="radius second_moment", finite=finite, error=RollerError)
        contact_of_rollers(curvatures, 0.0, modulus, load)


def _slopes(moment: Callable[[Matrix], Matrix], angles: Matrix) -> Matrix:
    """Derivatives of the moments by the angles, [moment, angle]."""
    columns = []
    for axis in numpy.eye(2) * ANGLE_STEP:
        near, far = moment(angles + axis) - moment(angles - axis), moment(angles + 2 * axis) - moment(angles - 2 * axis)
        columns.append((8.0 * near - far) / (12.0 * ANGLE_STEP))
    return numpy.column_stack(columns)


def stability(
    roller: Roller, curvatures: Curvatures, bending: Bending | None, modulus: float, load: float
) -> Stability:
    """Roots of the linear motion under `load` [N] and the fastest growing one. Errors as
    `linearise`.
    """
    linear = linearise(roller, curvatures, bending, modulus, load)
    inverse = numpy.linalg.inv(linear.inertia)
    first_order = numpy.block([
        [numpy.zeros((2, 2)), numpy.eye(2)],
        [-inverse @ linear.stiffness, -inverse @ linear.damping],
    ])  # fmt: skip
    roots = numpy.linalg.eigvals(first_order).astype(complex)
    fastest = roots[roots.real.argmax()]
    growth = float(fastest.real) if abs(fastest.real) > ROUNDING * abs(fastest) else 0.0
    return Stability(roots, growth, float(abs(fastest.imag) / (2.0 * numpy.pi)), linear)


def critical_load(
    roller: Roller, curvatures: Curvatures, bending: Bending | None, modulus: float, largest: float
) -> float | None:
    """Smallest load [N] up to `largest` at which a motion grows; None where none does. By bisection
    after 200 equal steps.

    Raises `RollerError` for values out of range, as `linearise`.
    """
    _check(roller, curvatures, bending, modulus, require_positive("largest load", largest, "N", error=RollerError))

    def grows(load: float) -> bool:
        try:
            return stability(roller, curvatures, bending, modulus, load).growth_rate > 0.0
        except RollerError:
            return True

    # The first growing load of a grid, then bisection below it.
    loads = numpy.linspace(0.0, largest, 201)[1:]
    first = next((i for i, load in enumerate(loads) if grows(float(load))), None)
    if first is None:
        return None
    return _threshold(grows, 0.0 if first == 0 else float(loads[first - 1]), float(loads[first]))


def critical_damping(
    roller: Roller, curvatures: Curvatures, bending: Bending | None, modulus: float, load: float
) -> float:
    """Equal damping [N m s] of tilt and yaw at which no motion grows any more, 0 where none does
    undamped.

    Raises `RollerError` where no damping does it, and as `linearise`.
    """
    _check(roller, curvatures, bending, modulus, load)

    def decays(damping: float) -> bool:
        damped = roller._replace(damping_tilt=damping, damping_yaw=damping)
        return stability(damped, curvatures, bending, modulus, load).growth_rate <= 0.0

    if decays(0.0):
        return 0.0
    # Doubling finds a damping that is enough.
    high = 1e-9
    while not decays(high):
        high *= 2.0
        if high > 1e6:
            raise RollerError(f"roller: no damping stops the motion under {load:.6g} N: it diverges")
    return _threshold(decays, 0.0, high)


def _threshold(holds: Callable[[float], bool], low: float, high: float) -> float:
    """Place between `low`, where it does not hold, and `high`, where it does."""
    while high - low > 1e-13 * high:
        middle = 0.5 * (low + high)
        if not low < middle < high:
            break
        low, high = (low, middle) if holds(middle) else (middle, high)
    return high
