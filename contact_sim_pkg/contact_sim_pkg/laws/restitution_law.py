"""Restitution of the linear spring and damper in closed form, and of the general law by one root
search.

A free impact on ``F = A x**n + B x**p sgn(x') |x'|**q`` at speed v0 depends, for given n, p, q and
end rule, on one number: ``Z = B L**(p-n) v0**q / A`` with ``L = (m v0^2/A)**(1/(n+1))``. The
requested restitution is the root of e(Z), which falls from 1.

For q >= 1 e(Z) is integrated forward. For q < 1 the mass may creep on the way out, in time without
bound: there the motion is followed backward in time from its end, where creeping is a fast
departure, until the mass is out again or faster than it came.

Where p > n and q is small, friction holds the mass: for q = 0 as soon as ``X**n < Z X**p`` at the
largest approach X, for q > 0 it creeps at ``(x**(n-p)/Z)**(1/q)``. A mass is held where it needs
more than 1000 L/v0 for that. For q = 0 the law reaches restitutions down to ``sqrt((p-n)/(p+n+2))``
only.

Source: Driver and Seat eqs 8, 10 and 11.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import Any

import numpy
import scipy  # its parts are imported on use: they take 0.1 to 0.3 s

from contact_sim_pkg.compiled.guards import require
from contact_sim_pkg.compiled.results import DONE, SENTENCES
from contact_sim_pkg.integrate.root_steps import make_workspace
from contact_sim_pkg.laws.general_dissipative import SMOOTHING
from contact_sim_pkg.laws.one_mass.parameters import PointContact
from contact_sim_pkg.laws.one_mass.point_contact import EVENT_FUNCTIONS
from contact_sim_pkg.laws.one_mass.single import empty_mode, run
from contact_sim_pkg.laws.parameters import GeneralDissipative, NormalElastic
from contact_sim_pkg.laws.restitution import check_restitution, damping_of_restitution, effective_speed

TOLERANCE = 1.0e-13  # of the integrator, relative to L and v0; e is then good to 1e-11
LONGEST = 1.0e3  # [L / v0]
# e = 0.01 is reached below 1e16 by all powers that are allowed
LEAST_SEVERITY, HIGHEST_SEVERITY = 1.0e-12, 1.0e20
SMALLEST_DISSIPATION = 1.0e-9  # 1 - e, below which e = 1 - (first order) Z is good to 1e-11
LEAST_RATIO = 1.0e-4  # of the speeds: a slower return counts as none where q < 1
# [v0^2] energy of the backward motion with which it cannot have come from the speed v0
RUNAWAY = 2.0
SIZES = (1.0e-20, 1.0e20)  # of mass and stiffness
EXPONENTS = {"elastic exponent n": (1.0, 10.0), "approach exponent p": (0.0, 4.0), "rate exponent q": (0.0, 3.0)}
NEVER_PULLS, PULLS = 0.0, -math.inf


def kelvin_voigt_restitution(ratio: float, lowest_force: float) -> float:
    """e of a linear spring and damper with damping ratio ``c / (2 sqrt(k m))`` >= 0.

    ``lowest_force`` 0: the bodies part where the force is zero; -inf: where x = 0, after a tensile
    end; for a ratio >= 1 never. Raises ValueError for a ratio outside 0 to 1e100 and another lowest
    force.
    ratio: [1]; lowest_force: [N].
    """
    require("damping ratio", ratio, least=0.0, most=1.0e100)
    _check_end(lowest_force)
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
    """Damping ratio of a linear spring and damper that delivers ``restitution``; 0.01 to 1. Raises
    ValueError outside.

    restitution and the result: [1]; lowest_force: [N].
    """
    check_restitution(restitution)
    _check_end(lowest_force)
    if restitution == 1.0:
        return 0.0
    if lowest_force < 0.0:
        logarithm = math.log(restitution)
        return -logarithm / math.hypot(math.pi, logarithm)
    return _falling_root(lambda ratio: kelvin_voigt_restitution(ratio, lowest_force), restitution, 0.5, 100.0)


def restitution_of_severity(severity: float, n: float, p: float, q: float, lowest_force: float) -> float:
    """e of a free impact with ``severity`` Z, to 1e-11; 0 where the mass does not come back within
    1000 L/v0.

    Z: 0 to 1e20; n: 1 to 10; p: 0 to 4; q: 0 to 3; ``lowest_force``: 0 or -inf. Below q = 1 a
    return with less than 1e-4 of the speed counts as 0. Raises ValueError outside, ArithmeticError
    where the integration fails.
    severity, n, p, q and the result: [1]; lowest_force: [N].
    """
    require("severity Z", severity, least=0.0, most=HIGHEST_SEVERITY)
    _check_law(n, p, q, lowest_force)
    if q >= 1.0:
        return _forward(severity, n, p, q, lowest_force)
    if severity == 0.0:
        return 1.0
    if _holding_margin(severity, n, p, q) > 0.0:
        return 0.0
    return _speed_after(severity, n, p, q, lowest_force, LEAST_RATIO, TOLERANCE)


def _forward(severity: float, n: float, p: float, q: float, lowest_force: float) -> float:
    rig = PointContact(
        1.0, 0.0, 0.0, 0.0, NormalElastic(1.0, float(n)),
        GeneralDissipative(float(severity), float(p), float(q), 0.0, float(lowest_force)),
    )  # fmt: skip
    state = numpy.array([0.0, -1.0])
    out = numpy.zeros((2, 2))
    times = numpy.array([0.0, LONGEST])
    scale = numpy.full(2, TOLERANCE)
    status = run(rig, empty_mode(), state, scale, make_workspace(2, EVENT_FUNCTIONS), times, out)
    if status != DONE:
        raise ArithmeticError(SENTENCES[status])
    return max(0.0, float(state[1]))


def _course(
    severity: float, n: float, p: float, q: float, start: tuple[float, float], *ends: Callable[..., float]
) -> Any:
    """Approach and its rate [2, times] from ``start`` to the first of ``ends``, in units of L and
    v0; a severity < 0 runs backward.
    """

    def rate(_time: float, state: tuple[float, float]) -> tuple[float, float]:
        x, v = max(state[0], 0.0), state[1]
        size = v * v + SMOOTHING * SMOOTHING
        return v, -(x**n) - severity * x**p * v * size ** (0.5 * (q - 1.0))

    # A trial step of a runaway motion may overflow; it is taken again
    with numpy.errstate(all="ignore"):
        return scipy.integrate.solve_ivp(rate, (0.0, LONGEST), start, "DOP853", events=ends, rtol=1.0e-12, atol=1.0e-14)


def _speed_before(severity: float, restitution: float, n: float, p: float, q: float, lowest_force: float) -> float:
    """Speed, over v0, before an impact that ends with ``restitution``, for q < 1; at most 2. It
    rises with Z and e.
    """
    depth = 0.0
    if lowest_force == 0.0 and p < n:  # the bodies part where x^n = Z x^p e^q
        logarithm = (math.log(severity) + q * math.log(restitution)) / (n - p)
        if (n + 1.0) * logarithm > math.log((n + 1.0) * RUNAWAY):
            return 2.0
        depth = math.exp(logarithm)

    def out(_time: float, state: tuple[float, float]) -> float:
        return state[0]

    def too_fast(_time: float, state: tuple[float, float]) -> float:
        return float(0.5 * state[1] ** 2 + max(state[0], 0.0) ** (n + 1.0) / (n + 1.0) - RUNAWAY)

    out.terminal = too_fast.terminal = True  # type: ignore[attr-defined]
    out.direction = -1.0  # type: ignore[attr-defined]
    course = _course(-severity, n, p, q, (depth, restitution), out, too_fast)
    return min(2.0, float(-course.y[1, -1])) if course.t_events[0].size else 2.0


def _speed_after(
    severity: float, n: float, p: float, q: float, lowest_force: float, least: float, tolerance: float
) -> float:
    """e of ``severity`` > 0 for q < 1, ``least`` to 1; 0 below ``least``."""

    def surplus(restitution: float) -> float:
        return _speed_before(severity, restitution, n, p, q, lowest_force) - 1.0

    if surplus(1.0) <= 0.0:
        return 1.0
    return float(scipy.optimize.brentq(surplus, least, 1.0, xtol=tolerance)) if surplus(least) < 0.0 else 0.0


def _holding_margin(severity: float, n: float, p: float, q: float) -> float:
    """``q ln(T/1000)``, T the least time to creep out of the largest approach; above 0 friction
    holds the mass (p > n, q < 1).
    """
    if p <= n or q >= 1.0:
        return -math.inf

    def turned(_time: float, state: tuple[float, float]) -> float:
        return state[1]

    turned.terminal = True  # type: ignore[attr-defined]
    largest = math.log(_course(severity, n, p, q, (0.0, 1.0), turned).y[0, -1])
    # The creep speed grows as x**((n-p)/q)
    growth = q * math.log((q + p - n) / q) if q > 0.0 else 0.0
    return q * (largest - math.log(LONGEST)) - growth - (n - p) * largest + math.log(severity)


@functools.lru_cache(maxsize=64)
def severity_of_restitution(restitution: float, n: float, p: float, q: float, lowest_force: float) -> float:
    """Z that delivers ``restitution``, 0.01 to 1: closed form for Hunt-Crossley and Kelvin-Voigt,
    one root search otherwise.

    n: 1 to 10; p: 0 to 4; q: 0 to 3; ``lowest_force``: 0 or -inf. Raises ValueError outside, and
    where no dissipation of this kind gives so small a restitution, with the range that it reaches.
    restitution, n, p, q and the result: [1]; lowest_force: [N].
    """
    check_restitution(restitution)
    _check_law(n, p, q, lowest_force)
    if restitution == 1.0:
        return 0.0
    # 1 + damping x' never changes its sign in a free impact: both ends are one
    if p == n and q == 1.0:
        return damping_of_restitution(restitution, 1.0)
    if n == 1.0 and p == 0.0 and q == 1.0:
        return 2.0 * kelvin_voigt_ratio(restitution, lowest_force)
    if 1.0 - restitution < SMALLEST_DISSIPATION:
        return (1.0 - restitution) / _dissipation_of_small_severity(n, p, q)
    if q >= 1.0:
        return _falling_root(lambda severity: _forward(severity, n, p, q, lowest_force), restitution)
    if p > n:
        _refuse_held(restitution, n, p, q, lowest_force)
    return _falling_root(
        lambda severity: restitution / _speed_before(severity, restitution, n, p, q, lowest_force), restitution
    )


def _dissipation_of_small_severity(n: float, p: float, q: float) -> float:
    """``(1 - e)/Z`` for Z -> 0: twice the integral of ``x**p v**q`` over the way in of the elastic
    impact.
    """
    power = (p + 1.0) / (n + 1.0)
    beta = math.exp(math.lgamma(power) + math.lgamma(0.5 * q + 1.0) - math.lgamma(power + 0.5 * q + 1.0))
    return float(2.0 * (0.5 * (n + 1.0)) ** power / (n + 1.0) * beta)


def _refuse_held(restitution: float, n: float, p: float, q: float, lowest_force: float) -> None:
    """Raises ValueError where friction holds the mass before so small a restitution is reached,
    with the range that is.
    """
    if _holding_margin(HIGHEST_SEVERITY, n, p, q) <= 0.0:
        return
    ends = math.log(LEAST_SEVERITY), math.log(HIGHEST_SEVERITY)
    at_hold = math.exp(
        scipy.optimize.brentq(lambda logarithm: _holding_margin(math.exp(logarithm), n, p, q), *ends, xtol=1.0e-6)
    )
    if _speed_before(at_hold, restitution, n, p, q, lowest_force) >= 1.0:
        return
    lowest = _speed_after(at_hold, n, p, q, lowest_force, restitution, 1.0e-5)
    raise ValueError(
        f"this law reaches restitutions from {math.floor(1e3 * lowest) / 1e3 + 1e-3:g} to 1, not {restitution}: "
        "with more dissipation its friction holds the mass in the contact; choose a larger one or other exponents"
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
    """B in [N/m^p/(m/s)^q] with which a free impact of ``mass`` [kg] at ``impact_speed`` [m/s] ends
    with ``restitution`` of it.

    Speeds below 1 mm/s count as 1 mm/s. ``B = Z A L**(n-p) / v0**q``. Mass and A: 1e-20 to 1e20;
    speed: 0 to 1e6 m/s. Raises ValueError outside, and as ``severity_of_restitution``.
    """
    require("mass [kg]", mass, least=SIZES[0], most=SIZES[1])
    require("elastic coefficient A [N/m^n]", elastic.coefficient, least=SIZES[0], most=SIZES[1])
    n, speed = elastic.exponent, effective_speed(impact_speed)
    severity = severity_of_restitution(restitution, n, p, q, lowest_force)
    # Length scale L of the impact turns the dimensionless severity Z into B
    length = (mass * speed**2 / elastic.coefficient) ** (1.0 / (n + 1.0))
    return float(severity * elastic.coefficient * length ** (n - p) / speed**q)


def _check_law(n: float, p: float, q: float, lowest_force: float) -> None:
    for (name, (low, high)), value in zip(EXPONENTS.items(), (n, p, q), strict=True):
        require(name, value, least=low, most=high)
    _check_end(lowest_force)


def _check_end(lowest_force: float) -> None:
    if lowest_force not in (NEVER_PULLS, PULLS):
        raise ValueError(f"lowest force is {lowest_force} N, it must be 0 or -inf")


def _falling_root(
    value: Callable[[float], float], target: float, start: float = 1.0, highest: float = HIGHEST_SEVERITY
) -> float:
    """Where a falling function of a positive number reaches ``target``: bracket by factors of 4,
    then Illinois in its logarithm.

    At most 55 + 100 evaluations. Raises ValueError where the function is above ``target`` up to
    ``highest``.
    """
    # Bracket of factors of 4.
    low, high = math.log(start), math.log(start)
    low_value = high_value = value(start) - target
    while high_value > 0.0:
        low, low_value = high, high_value
        high += math.log(4.0)
        if high > math.log(highest):
            raise ValueError(
                f"this law reaches restitutions from {high_value + target:.3g} to 1, not {target}; choose a larger one or "
                "other exponents"
            )
        high_value = value(math.exp(high)) - target
    while low_value <= 0.0 and low > math.log(LEAST_SEVERITY):
        high, high_value = low, low_value
        low -= math.log(4.0)
        low_value = value(math.exp(low)) - target
    # Regula falsi (Illinois) on the logarithm.
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
