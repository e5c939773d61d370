"""Restitution of the Hunt-Crossley law, exactly: which dissipation gives a requested ratio of
speeds.

In a free impact at speed v0, d = damping v0: ``d (1 + e) = ln[(1 + d)/(1 - d e)]``, whatever
stiffness, exponent and mass.

Source: Hunt and Crossley, J. Appl. Mech. 42 (1975) 440; Driver and Seat eqs 8 and 11.
"""

from __future__ import annotations

import math

from contact_sim_pkg.compiled.guards import require

LOWEST_RESTITUTION = 0.01
SLOWEST_IMPACT = 1.0e-3  # [m/s]; B = A d / v0 grows beyond use below (grazing impacts)
FASTEST_IMPACT = 1.0e6  # [m/s]
SMALL_DAMPING = 1.0e-4  # below, e = 1 - 2/3 d + 4/9 d^2 is exact to d^3/3


def damping_of_restitution(restitution: float, impact_speed: float) -> float:
    """Damping in [s/m] with which a free impact at ``impact_speed`` [m/s] ends with ``restitution``
    times that speed.

    Range: 0.01 <= restitution <= 1; impact speeds: 0 to 1e6 m/s, below 1 mm/s they count as 1 mm/s.
    Raises ValueError outside.
    """
    check_restitution(restitution)
    speed = effective_speed(impact_speed)
    if restitution == 1.0:
        return 0.0
    return (_damping_near_pole(restitution) if restitution < 0.4 else _damping(restitution)) / speed


def check_restitution(restitution: float) -> None:
    """Raises ValueError for a coefficient of restitution [1] outside 0.01 to 1."""
    if not LOWEST_RESTITUTION <= restitution <= 1.0:
        raise ValueError(f"restitution {restitution} is outside {LOWEST_RESTITUTION} to 1; below, use a plastic stop")


def effective_speed(impact_speed: float) -> float:
    """``impact_speed`` [m/s], at least 1 mm/s. Raises ValueError outside 0 to 1e6 m/s."""
    require("impact speed [m/s]", impact_speed, least=0.0, most=FASTEST_IMPACT)
    return max(impact_speed, SLOWEST_IMPACT)


def _damping(e: float) -> float:
    """Newton on d, from 3 (1 - e)/(2 e); for e >= 0.4 the start lies below the pole d = 1/e."""
    d = 1.5 * (1.0 - e) / e
    if d < SMALL_DAMPING:
        return 3.0 * (1.0 - e) / (1.0 + math.sqrt(1.0 - 4.0 * (1.0 - e)))
    for _ in range(50):
        value = d * (1.0 + e) - math.log1p(d) + math.log1p(-d * e)
        slope = 1.0 + e - 1.0 / (1.0 + d) - e / (1.0 - d * e)
        step = value / slope
        d = min(max(d - step, 0.5 * d), 0.5 * (d + 1.0 / e))
        if abs(step) <= 1.0e-15 * d:
            break
    return d


def _damping_near_pole(e: float) -> float:
    """Newton on y = ln(1 - d e), where d tends to the pole 1/e from below."""
    y = -(1.0 + e) / e + math.log((1.0 + e) / e)
    for _ in range(50):
        d = -math.expm1(y) / e
        value = d * (1.0 + e) - math.log1p(d) + y
        slope = -math.exp(y) / e * (1.0 + e - 1.0 / (1.0 + d)) + 1.0
        step = value / slope
        y -= step
        if abs(step) <= 1.0e-15 * abs(y):
            break
    return -math.expm1(y) / e
