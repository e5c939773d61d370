"""Free impact on the general law `m x'' = -(A x^n + B x^p sgn(x') |x'|^q)` by scipy's DOP853, and
Kelvin-Voigt in closed form.

In units of `L = (m v0^2/A)^(1/(n+1))` and v0 the impact depends on `Z = B L^(p-n) v0^q / A` alone.
Slow, free of kernel code.
"""

from __future__ import annotations

import math

import mpmath
import numpy
from scipy.integrate import solve_ivp

__all__ = ["kelvin_voigt_at_force", "kelvin_voigt_at_gap", "restitution"]


def restitution(severity: float, n: float, p: float, q: float, end: str) -> float:
    """Ratio of the speeds after and before, for `severity` Z; `end` is "force" or "gap". To about
    1e-11 for q >= 1.

    All numbers: [1].
    """

    def force(x: float, v: float) -> float:
        x = max(x, 0.0)
        return float(x**n + severity * x**p * math.copysign(abs(v) ** q, v)) if v != 0.0 else float(x**n)

    def turning(_t: float, y: list[float]) -> float:
        return y[1]

    def leaving(_t: float, y: list[float]) -> float:
        return y[0] if end == "gap" else force(y[0], y[1])

    turning.terminal = leaving.terminal = True  # type: ignore[attr-defined]
    accuracy = {"method": "DOP853", "rtol": 1e-13, "atol": 1e-15}
    closing = solve_ivp(lambda _t, y: [y[1], -force(*y)], (0.0, 100.0), [0.0, 1.0], events=turning, **accuracy)
    deepest = [closing.y[0, -1], 0.0]
    opening = solve_ivp(lambda _t, y: [y[1], -force(*y)], (0.0, 1000.0), deepest, events=leaving, **accuracy)
    return float(-numpy.asarray(opening.y)[1, -1])


def kelvin_voigt_at_force(ratio: float) -> float:
    """e of a linear spring and damper with damping `ratio` zeta >= 0 that parts where the force is
    zero, in 40 digits.

    ratio and the result: [1].
    """
    with mpmath.workdps(40):
        z = mpmath.mpf(ratio)
        if z == 1:
            return float(mpmath.exp(-2))
        if z < 1:
            s = mpmath.sqrt(1 - z**2)
            return float(mpmath.exp(-z / s * (mpmath.pi - mpmath.atan2(2 * z * s, 1 - 2 * z**2))))
        s = mpmath.sqrt(z**2 - 1)
        return float(((z - s) / (z + s)) ** (z / s))


def kelvin_voigt_at_gap(ratio: float) -> float:
    """e where the bodies part at x = 0, after a tensile end: `exp(-pi zeta / sqrt(1 - zeta^2))`; 0
    for zeta >= 1.

    ratio and the result: [1].
    """
    if ratio >= 1.0:
        return 0.0
    with mpmath.workdps(40):
        z = mpmath.mpf(ratio)
        return float(mpmath.exp(-mpmath.pi * z / mpmath.sqrt(1 - z**2)))
