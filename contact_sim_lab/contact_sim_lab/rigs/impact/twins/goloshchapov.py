"""Free impact of a viscoelastic sphere, `X'' + zeta sqrt(X) X' + X^(3/2) = 0`, by scipy's DOP853 in
time, and its elastic limit.

Slow, in the plain variables X and X', free of the bench's own code. Source: Goloshchapov, eqs 8, 9,
54.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import mpmath
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

__all__ = ["Reference", "elastic_limit", "front_time", "impact", "severity"]

ACCURACY = {"method": "DOP853", "rtol": 1e-13, "atol": 1e-16}


class Reference(NamedTuple):
    """One impact in units of L = (m V0^2/c)^(2/5) and V0."""

    duration: float
    restitution: float
    depth: float
    turning_time: float
    peak_force: float


def impact(zeta: float, end: str) -> Reference:
    """The impact at severity `zeta` [1] with end rule "force" or "gap"; errors about 1e-11.

    Results in units of L, V0 and L/V0.
    """

    def rate(_t: float, y: list[float]) -> list[float]:
        root = math.sqrt(max(y[0], 0.0))
        return [y[1], -root * (y[0] + zeta * y[1])]

    def turning(_t: float, y: list[float]) -> float:
        return y[1]

    def leaving(_t: float, y: list[float]) -> float:
        return y[0] if end == "gap" or zeta == 0.0 else y[0] + zeta * y[1]

    turning.terminal = leaving.terminal = True  # type: ignore[attr-defined]
    # Closing and opening phase.
    closing = solve_ivp(rate, (0.0, 10.0), [0.0, 1.0], events=turning, dense_output=True, **ACCURACY)
    opening = solve_ivp(rate, (0.0, 1e3), [closing.y[0, -1], 0.0], events=leaving, **ACCURACY)
    first = float(closing.t[-1])

    def force(t: float) -> float:
        return -rate(t, closing.sol(t))[1]

    peak = _largest(force, first)
    return Reference(first + float(opening.t[-1]), float(-opening.y[1, -1]), float(closing.y[0, -1]), first, peak)


def severity(loss_tangent: float, end: str) -> float:
    """zeta [1] of the consistent impact: `tan(beta) = pi zeta/(3 T_c)`, by Brent's method;
    loss_tangent: [1].
    """
    high = 2.2353 if end == "gap" else 12.0
    return float(brentq(lambda z: math.pi * z / (3.0 * impact(z, end).duration) - loss_tangent, 1e-9, high, xtol=1e-14))


def front_time(
    mass: float, radius: float, elastic: float, viscous: float, speed: float, shape: float, shear_speed: float
) -> float:
    """Time [s] at which `(1 + sqrt 2)/4 k_p sqrt(R/x) x'` has come down to `shear_speed`, on `m x''
    = -A x^1.5 - B x^0.5 x'`.
    """
    factor = (1.0 + math.sqrt(2.0)) / 4.0 * shape * math.sqrt(radius)

    def rate(_t: float, y: list[float]) -> list[float]:
        root = math.sqrt(max(y[0], 0.0))
        return [y[1], -root * (elastic * y[0] + viscous * y[1]) / mass]

    def down(_t: float, y: list[float]) -> float:
        return factor * y[1] - shear_speed * math.sqrt(max(y[0], 0.0))

    down.terminal = True  # type: ignore[attr-defined]
    first = (factor / shear_speed) ** 2 * speed
    run = solve_ivp(
        rate, (0.0, 10.0), [0.0, speed], events=down, first_step=1e-3 * first, max_step=0.1 * first, **ACCURACY
    )
    return float(run.t[-1])


def elastic_limit() -> tuple[float, float]:
    """T_c and X_m without loss, in units of L/V0 and L [1]: `X_m = (5/4)^(2/5)`, `T_c = (4/5)
    B(2/5, 1/2) X_m`.
    """
    with mpmath.workdps(30):
        depth = mpmath.mpf("1.25") ** mpmath.mpf("0.4")
        return float(mpmath.mpf("0.8") * mpmath.beta(mpmath.mpf("0.4"), 0.5) * depth), float(depth)


def _largest(force, last: float) -> float:  # type: ignore[no-untyped-def]
    """Largest value over 0..last, by golden section."""
    low, high = 0.0, last
    ratio = (math.sqrt(5.0) - 1.0) / 2.0
    for _ in range(90):
        a, b = high - ratio * (high - low), low + ratio * (high - low)
        if force(a) < force(b):
            low = a
        else:
            high = b
    return float(force(0.5 * (low + high)))
