"""Restitution of the linear spring and damper in closed form, and of the general law by one root search.

A free impact on ``F = A x**n + B x**p sgn(x') |x'|**q`` at speed v0 depends, for given n, p, q and end rule, on one number:
``Z = B L**(p-n) v0**q / A`` with ``L = (m v0^2/A)**(1/(n+1))``. The asked restitution is the root of e(Z), which falls from 1.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable

import numpy

from .effects.general_dissipative import SMOOTHING
from .parameters import GeneralDissipative, NormalElastic, PointContact
from .restitution import LOWEST_RESTITUTION, SLOWEST_IMPACT, damping_of_restitution
from .results import DONE, SENTENCES
from .rigs.point_contact import MARGINS
from .rigs.single import empty_mode, run
from .solvers.root_steps import make_workspace

TOLERANCE = 1.0e-13  # of the integrator, relative to L and v0; e is then good to 1e-11
LONGEST = 1.0e3  # [L / v0]
HIGHEST_SEVERITY = 1.0e8
NEVER_PULLS, PULLS = 0.0, -math.inf


def kelvin_voigt_restitution(ratio: float, lowest_force: float) -> float:
    """e of a linear spring and damper with damping ratio ``c / (2 sqrt(k m))`` >= 0.

    ``lowest_force`` 0: the bodies part where the force is zero; -inf: where x = 0, after a tensile end; for a ratio >= 1 never.
    """
    z = ratio
    if lowest_force < 0.0:
        return 0.0 if z >= 1.0 else math.exp(-math.pi * z / math.sqrt(1.0 - z * z))
    if abs(z - 1.0) < 1.0e-6:  # e = exp(-2 - 4/3 (z - 1)) to the second order
        return math.exp(-2.0 - 4.0 / 3.0 * (z - 1.0))
    if z < 1.0:
        s = math.sqrt(1.0 - z * z)
        return math.exp(-z / s * (math.pi - math.atan2(2.0 * z * s, 1.0 - 2.0 * z * z)))
    s = math.sqrt((z - 1.0) * (z + 1.0))
    return math.exp(-2.0 * z / s * math.log(z + s))  # (z - s)(z + s) = 1


def kelvin_voigt_ratio(restitution: float, lowest_force: float) -> float:
    """Damping ratio of a linear spring and damper that delivers ``restitution``; 0.01 to 1. Raises ValueError outside."""
    _check(restitution)
    if lowest_force < 0.0:
        logarithm = math.log(restitution)
        return -logarithm / math.hypot(math.pi, logarithm)
    return _falling_root(lambda ratio: kelvin_voigt_restitution(ratio, lowest_force), restitution, 0.5, 100.0)


def restitution_of_severity(severity: float, n: float, p: float, q: float, lowest_force: float) -> float:
    """e of a free impact with ``severity`` Z >= 0, by the integrator, to 1e-11; 0 where the mass does not come back.

    Raises ArithmeticError where the integration fails.
    """
    smoothing = SMOOTHING if q < 1.0 else 0.0
    rig = PointContact(
        1.0, 0.0, 0.0, 0.0, NormalElastic(1.0, float(n)),
        GeneralDissipative(float(severity), float(p), float(q), smoothing, float(lowest_force)),
    )  # fmt: skip
    state = numpy.array([0.0, -1.0])
    out = numpy.zeros((2, 2))
    times = numpy.array([0.0, LONGEST])
    scale = numpy.full(2, TOLERANCE)
    status = run(rig, empty_mode(), state, scale, make_workspace(2, MARGINS), times, out)
    if status != DONE:
        raise ArithmeticError(SENTENCES[status])
    return max(0.0, float(state[1]))


@functools.lru_cache(maxsize=64)
def severity_of_restitution(restitution: float, n: float, p: float, q: float, lowest_force: float) -> float:
    """Z that delivers ``restitution``, 0.01 to 1: closed form for Hunt-Crossley and Kelvin-Voigt, one root search otherwise.

    Raises ValueError outside the range, and where no loss of this kind gives so small a restitution.
    """
    _check(restitution)
    if restitution == 1.0:
        return 0.0
    if p == n and q == 1.0:  # 1 + damping x' never changes its sign in a free impact: both ends are one
        return damping_of_restitution(restitution, 1.0)
    if n == 1.0 and p == 0.0 and q == 1.0:
        return 2.0 * kelvin_voigt_ratio(restitution, lowest_force)
    return _falling_root(
        lambda severity: restitution_of_severity(severity, n, p, q, lowest_force), restitution, 1.0, HIGHEST_SEVERITY
    )


def coefficient_of_restitution(
    restitution: float,
    impact_speed: float,
    mass: float,
    elastic: NormalElastic,
    p: float,
    q: float,
    lowest_force: float,
) -> float:
    """B in [N/m^p/(m/s)^q] with which a free impact of ``mass`` [kg] at ``impact_speed`` [m/s] ends with ``restitution`` of it.

    Speeds below 1 mm/s count as 1 mm/s. ``B = Z A L**(n-p) / v0**q``. Raises ValueError as ``severity_of_restitution``.
    """
    n, speed = elastic.exponent, max(impact_speed, SLOWEST_IMPACT)
    length = (mass * speed**2 / elastic.coefficient) ** (1.0 / (n + 1.0))
    severity = severity_of_restitution(restitution, n, p, q, lowest_force)
    return float(severity * elastic.coefficient * length ** (n - p) / speed**q)


def _check(restitution: float) -> None:
    if not LOWEST_RESTITUTION <= restitution <= 1.0:
        raise ValueError(f"restitution {restitution} is outside {LOWEST_RESTITUTION} to 1; below, use a plastic stop")


def _falling_root(value: Callable[[float], float], target: float, start: float, highest: float) -> float:
    """Where a falling function of a positive number reaches ``target``: bracket by factors of 4, then Illinois in its logarithm."""
    low, high = math.log(start), math.log(start)
    low_value = high_value = value(start) - target
    while high_value > 0.0:
        low, low_value = high, high_value
        high += math.log(4.0)
        if high > math.log(highest):
            raise ValueError(
                f"this law does not reach the restitution {target}; choose a larger one or another exponent"
            )
        high_value = value(math.exp(high)) - target
    while low_value <= 0.0:
        high, high_value = low, low_value
        low -= math.log(4.0)
        low_value = value(math.exp(low)) - target
    kept = 0
    for _ in range(100):
        middle = high - high_value * (high - low) / (high_value - low_value)
        if not low < middle < high:
            break
        found = value(math.exp(middle)) - target
        if found > 0.0:
            low, low_value = middle, found
            high_value *= 0.5 if kept == 1 else 1.0
            kept = 1
        else:
            high, high_value = middle, found
            low_value *= 0.5 if kept == -1 else 1.0
            kept = -1
        if found == 0.0 or high - low <= 1.0e-15 * (1.0 + abs(low)):
            break
    return math.exp(high if abs(high_value) < abs(low_value) else low)
