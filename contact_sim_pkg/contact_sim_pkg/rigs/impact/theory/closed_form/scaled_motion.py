"""The impact in its own units: ``X'' + zeta sqrt(X) X' + X^(3/2) = 0``, X(0) = 0, X'(0) = 1
(Goloshchapov eq 54).

Units: length ``L = (m V0^2/c)^(2/5)``, ``c = 4/3 k_p E' sqrt(R)``, time ``L/V0``, force ``m
V0^2/L``. With ``u = sqrt(X)``, v = X' and ``dt = 2 u ds`` the equation is a polynomial one,

    du/ds = v,   dv/ds = 2 u (weight - u (u^2 + zeta v)),   dt/ds = 2 u,   dh/ds = 2 zeta u^2 v^2,

h the heat in units of ``m V0^2``, weight ``g L/V0^2`` (0 for the free impact of eq 54), so that
touch and lift-off, where x^(3/2) and x^(1/2) have no Taylor series in t, are regular points of it.
It is solved by its own Taylor series of order 20 in about twenty steps, to rounding; events are
roots of the step's polynomials. Contact ends where the force ``u (u^2 + zeta v)`` reaches 0 on the
way out (end rule ``force``) or where u is back at 0 (``gap``). Method: Jorba and Zou, A software
package for the numerical integration of ODEs by Taylor methods, Exp. Math. 14 (2005).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import entry, kernel
from contact_sim_pkg.rigs.impact.theory.checks import check_not_negative, check_number, check_values
from contact_sim_pkg.rigs.impact.theory.closed_form.force import lowest_force
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError

__all__ = ["LARGEST_SEVERITY", "ScaledImpact", "scaled_course", "scaled_impact"]

ORDER = 20
LARGEST_STEPS = 400
LARGEST_SEVERITY = 1000.0
LOCATE_ITERATIONS = 200
LEEWAY = 1.0e-9  # of the duration: by so much a last time may be rounded up
SERIES = 7  # u, v, t, u^2, u^2 + zeta v, u v, heat
HEAT = 6
PEAK, TURNING, END = 0, 1, 2  # in the order in which they come
DURATION, RESTITUTION, DEPTH, TURNING_TIME, PEAK_FORCE, PEAK_TIME = 0, 1, 2, 3, 4, 5
# Where the integration ended, and the heat by then
REACHED_ROOT, REACHED_SPEED, REACHED_TIME, LOST, RESULTS = 6, 7, 8, 9, 10


class ScaledImpact(NamedTuple):
    """One impact in its own units."""

    duration: float  # T_c
    restitution: float  # k, ratio of the speeds
    depth: float  # X_m
    turning_time: float  # T_1, end of compression
    peak_force: float  # largest total force
    peak_time: float
    steps: int


@kernel
def _expand(zeta, weight, series):
    """Taylor coefficients of u, v, t, h in s from those in place 0; returns the step in s that they
    carry.

    Rows: u, v, t, then u^2, u^2 + zeta v, u v and the heat. Step: radius of convergence over e^2,
    where the tail is below rounding.
    """
    u, v, squared, moment, product = series[0], series[1], series[3], series[4], series[5]
    # Coefficients of the next order by Cauchy products.
    for k in range(ORDER):
        total = 0.0
        for i in range(k + 1):
            total += u[i] * u[k - i]
        squared[k] = total
        moment[k] = total + zeta * v[k]
        total = 0.0
        crossed = 0.0
        for i in range(k + 1):
            total += squared[i] * moment[k - i]
            crossed += u[i] * v[k - i]
        product[k] = crossed
        lost = 0.0
        for i in range(k + 1):
            lost += product[i] * product[k - i]
        series[2, k + 1] = 2.0 * u[k] / (k + 1)
        series[HEAT, k + 1] = 2.0 * zeta * lost / (k + 1)
        u[k + 1] = v[k] / (k + 1)
        v[k + 1] = 2.0 * (weight * u[k] - total) / (k + 1)
    # Step from the last two coefficients (Jorba and Zou 2005).
    radius = math.inf
    for k in range(ORDER - 1, ORDER + 1):
        size = max(abs(u[k]), abs(v[k]))
        if size > 0.0:
            radius = min(radius, size ** (-1.0 / k))
    return radius * math.exp(-2.0)


@kernel
def _value(series, s):
    total = series[ORDER]
    for k in range(ORDER - 1, -1, -1):
        total = total * s + series[k]
    return total


@kernel
def _step(series, step):
    """Go on to the end of the step."""
    u, v = _value(series[0], step), _value(series[1], step)
    time, heat = _value(series[2], step), _value(series[HEAT], step)
    series[0, 0] = u
    series[1, 0] = v
    series[2, 0] = time
    series[HEAT, 0] = heat


@kernel
def _event(zeta, weight, pulls, kind, u, v):
    """Event functions, each positive before its event: largest total force, turning, end of
    contact.
    """
    moment = u * u + zeta * v
    if kind == PEAK:
        return v * moment + 2.0 * u * u * (v + zeta * (weight - u * moment))
    if kind == TURNING:
        return v
    if pulls or zeta == 0.0:
        return u
    return moment if u > 0.0 else zeta * v - u * u  # never positive again behind u = 0


@kernel
def _locate(zeta, weight, pulls, kind, u, v, step):
    """Root of an event function within a step in s: regula falsi (Illinois), every fourth time by
    halves.
    """
    low, high = 0.0, step
    low_value = _event(zeta, weight, pulls, kind, u[0], v[0])
    high_value = _event(zeta, weight, pulls, kind, _value(u, step), _value(v, step))
    kept = 0
    for i in range(LOCATE_ITERATIONS):
        s = 0.5 * (low + high)
        if low_value > 0.0 and i % 4 != 3:
            s = high - high_value * (high - low) / (high_value - low_value)
        if not low < s < high:  # an end is the root to rounding: the other one follows by halves
            s = 0.5 * (low + high)
        if not low < s < high:
            break
        value = _event(zeta, weight, pulls, kind, _value(u, s), _value(v, s))
        if value > 0.0:
            low, low_value = s, value
            high_value *= 0.5 if kept == 1 else 1.0
            kept = 1
        else:
            high, high_value = s, value
            low_value *= 0.5 if kept == -1 else 1.0
            kept = -1
    return high if -high_value < low_value else low


@kernel
def _start(u, v, series):
    """From a root of the depth and a speed, at time 0."""
    series[0, 0] = u
    series[1, 0] = v
    series[2, 0] = 0.0
    series[HEAT, 0] = 0.0


@kernel
def _note(zeta, kind, series, s, out):
    """Write down an event that lies at ``s`` of the step."""
    u, v, time = _value(series[0], s), _value(series[1], s), _value(series[2], s)
    if kind == PEAK:
        out[PEAK_FORCE] = u * (u * u + zeta * v)
        out[PEAK_TIME] = time
    elif kind == TURNING:
        out[DEPTH] = u * u
        out[TURNING_TIME] = time
    else:
        out[DURATION] = time
        out[RESTITUTION] = -v
        out[REACHED_ROOT] = u
        out[REACHED_SPEED] = v
        out[REACHED_TIME] = time
        out[LOST] = _value(series[HEAT], s)


@entry
def solve_from(
    zeta: float, weight: float, pulls: bool, u: float, v: float, kind: int, limit: float, out: Vector
) -> int:
    """Follow the contact from ``u``, ``v`` to its end; events from ``kind`` on go to ``out``
    [results].

    u, v, weight in units of L, V0 and V0^2/L, zeta dimensionless. Returns the steps taken; 0 where
    the contact has not ended by ``limit`` or within the largest number of steps: then the last
    places of ``out`` hold how far it came.
    """
    series = numpy.zeros((SERIES, ORDER + 1))
    _start(u, v, series)
    for count in range(1, LARGEST_STEPS + 1):
        # Taylor series of this step, and the events within it.
        step = _expand(zeta, weight, series)
        while kind <= END:
            if _event(zeta, weight, pulls, kind, _value(series[0], step), _value(series[1], step)) > 0.0:
                break
            s = _locate(zeta, weight, pulls, kind, series[0], series[1], step)
            _note(zeta, kind, series, s, out)
            kind += 1
        if kind > END:
            return count
        _step(series, step)
        if series[2, 0] >= limit:
            break
    out[REACHED_ROOT] = series[0, 0]
    out[REACHED_SPEED] = series[1, 0]
    out[REACHED_TIME] = series[2, 0]
    out[LOST] = series[HEAT, 0]
    return 0


@kernel
def _place(series, step, time):
    """s of a time within the step, by Newton's method kept within halves."""
    if time <= series[2, 0]:
        return 0.0
    low, high = 0.0, step
    s = 0.5 * step
    for _ in range(LOCATE_ITERATIONS):
        error = _value(series[2], s) - time
        if error > 0.0:
            high = s
        else:
            low = s
        # Newton, or the middle where it leaves the bracket.
        slope = 2.0 * _value(series[0], s)
        following = s - error / slope if slope > 0.0 else 0.5 * (low + high)
        if not low < following < high:
            following = 0.5 * (low + high)
        if abs(following - s) <= 1.0e-16 * step:
            break
        s = following
    return s


@entry
def sample_from(
    zeta: float, weight: float, u: float, v: float, times: Vector, depth: Vector, speed: Vector, heat: Vector
) -> int:
    """Depth, speed and heat at rising ``times`` in contact, from ``u``, ``v`` on; returns how many
    were reached.

    Those behind the end of the contact get its values and are not counted. times, depth, speed,
    heat: [times], dimensionless: scaled by L/V0, L, V0 and m V0^2.
    """
    series = numpy.zeros((SERIES, ORDER + 1))
    _start(u, v, series)
    i, reached = 0, 0
    for _ in range(LARGEST_STEPS):
        step = _expand(zeta, weight, series)
        last = _value(series[0], step) <= 0.0
        if last:  # behind u = 0 the time would run backwards
            step = _locate(zeta, weight, True, END, series[0], series[1], step)
        end = _value(series[2], step)
        while i < times.shape[0] and (last or times[i] <= end):
            s = _place(series, step, times[i])
            root = _value(series[0], s)
            depth[i] = root * root
            speed[i] = _value(series[1], s)
            heat[i] = _value(series[HEAT], s)
            reached += 1 if times[i] <= end * (1.0 + LEEWAY) else 0
            i += 1
        if i == times.shape[0]:
            break
        _step(series, step)
    return reached


def scaled_impact(severity: float, end: str, weight: float = 0.0) -> ScaledImpact:
    """The impact at ``severity`` zeta, 0 to 1000, to 1e-13, dimensionless, in units of L and V0.

    ``end`` is ``force`` or ``gap``; ``weight`` is ``g L/V0^2``, 0: none. Raises ImpactError outside
    the range and, with ``gap``, where the mass does not come back (zeta above about 8).
    """
    check_number("severity", severity, least=0.0, most=LARGEST_SEVERITY)
    check_not_negative("weight", weight)
    out = numpy.zeros(RESULTS)
    steps = solve_from(
        float(severity), float(weight), pulls=lowest_force(end) < 0.0, u=0.0, v=1.0, kind=PEAK, limit=math.inf, out=out
    )
    if steps == 0:
        raise ImpactError(f"severity {severity:g}: the mass does not leave within {LARGEST_STEPS} steps")
    return ScaledImpact(
        float(out[DURATION]), float(out[RESTITUTION]), float(out[DEPTH]), float(out[TURNING_TIME]), float(out[PEAK_FORCE]),
        float(out[PEAK_TIME]), int(steps),
    )  # fmt: skip


def scaled_course(severity: float, times: Vector) -> tuple[Vector, Vector]:
    """Depth and speed [times] at rising ``times`` >= 0 within the contact, to a few units of
    rounding.

    All are dimensionless, in units of L and V0. Raises ImpactError where a time is not reached, for
    times that do not rise from 0 on and a severity outside 0 to 1000.
    """
    check_number("severity", severity, least=0.0, most=LARGEST_SEVERITY)
    scaled = check_values("times", times, shape=(None,), least=0.0, rising=True)
    depth, speed, heat = (numpy.zeros(len(scaled)) for _ in range(3))
    reached = sample_from(float(severity), 0.0, u=0.0, v=1.0, times=scaled, depth=depth, speed=speed, heat=heat)
    if reached < len(scaled):
        raise ImpactError(f"time {scaled[reached]:g} in units of L/V0 lies behind the end of the contact")
    return depth, speed
