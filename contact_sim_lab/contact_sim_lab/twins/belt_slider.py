"""Stick-slip of a mass on a spring over a belt: closed form of the rigid law, and the spring-damper
law by scipy.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

__all__ = ["StickSlip", "period_of_rigid_law", "slip_starts", "state_at"]

RELATIVE, ABSOLUTE = 1.0e-13, 1.0e-16


class StickSlip(NamedTuple):
    """Mass [kg] on a spring [N/m], belt speed [m/s], load [N]; friction spring C [N/m], damper D [N
    s/m], two ratios.
    """

    mass: float
    spring: float
    belt_speed: float
    load: float
    stiffness: float
    damping: float
    coefficient_static: float
    coefficient_kinetic: float


def period_of_rigid_law(case: StickSlip) -> float:
    """Period [s] without friction spring: `2 u0/v_b + (2/w)(pi - atan(u0 w/v_b))`, `u0 = (mu_s -
    mu_k) N/k`.
    """
    jump = (case.coefficient_static - case.coefficient_kinetic) * case.load / case.spring
    frequency = math.sqrt(case.spring / case.mass)
    return 2.0 * jump / case.belt_speed + 2.0 / frequency * (math.pi - math.atan(jump * frequency / case.belt_speed))


def slip_starts(case: StickSlip, count: int) -> list[float]:
    """Times [s] at which the mass breaks away, from rest in stick at x = 0 on the belt; the first
    `count`.

    Stick: `F = C s + D v`, `s' = v = v_b - x'`, up to `|F| = mu_s N`. Slip: `F = mu_k N`, `C s = F
    - D v`, until `v = s'`.
    """
    time, state = 0.0, numpy.array([0.0, case.belt_speed, 0.0])
    starts: list[float] = []
    while len(starts) < count:
        time, state = _stick(case, time, state)
        starts.append(time)
        time, state = _slip(case, time, state)
    return starts


def state_at(case: StickSlip, end: float) -> NDArray[numpy.float64]:
    """State at `end` [s], from the same start: position [m], speed [m/s], spring deflection [m],
    which is that of stick; [states]."""
    time, state, sticks = 0.0, numpy.array([0.0, case.belt_speed, 0.0]), True
    while time < end:
        time, state = (_stick if sticks else _slip)(case, time, state, end)
        sticks = not sticks
    return state


def _trial(case: StickSlip, y: NDArray[numpy.float64]) -> float:
    return float(case.stiffness * y[2] + case.damping * (case.belt_speed - y[1]))


def _stick(
    case: StickSlip, time: float, state: NDArray[numpy.float64], end: float = math.inf
) -> tuple[float, NDArray[numpy.float64]]:
    def rate(_t: float, y: NDArray[numpy.float64]) -> list[float]:
        return [y[1], (_trial(case, y) - case.spring * y[0]) / case.mass, case.belt_speed - y[1]]

    def breaks(_t: float, y: NDArray[numpy.float64]) -> float:
        return case.coefficient_static * case.load - _trial(case, y)

    return _until(rate, breaks, time, state, end)


def _slip(
    case: StickSlip, time: float, state: NDArray[numpy.float64], end: float = math.inf
) -> tuple[float, NDArray[numpy.float64]]:
    force = case.coefficient_kinetic * case.load

    def acceleration(y: NDArray[numpy.float64]) -> float:
        return float((force - case.spring * y[0]) / case.mass)

    def rate(_t: float, y: NDArray[numpy.float64]) -> list[float]:
        return [y[1], acceleration(y), 0.0]

    def slip_rate(_t: float, y: NDArray[numpy.float64]) -> float:
        return float(case.belt_speed - y[1] - case.damping * acceleration(y) / case.stiffness)

    time, state = _until(rate, slip_rate, time, state, end)
    state[2] = (force - case.damping * (case.belt_speed - state[1])) / case.stiffness
    return time, state


def _until(
    rate: Callable[[float, NDArray[numpy.float64]], list[float]],
    margin: Callable[[float, NDArray[numpy.float64]], float],
    time: float,
    state: NDArray[numpy.float64],
    end: float,
) -> tuple[float, NDArray[numpy.float64]]:
    """Time [s] and state where `margin` falls through zero, or `end` where that comes first."""
    event: Any = margin  # scipy reads what to do from attributes of the function
    event.terminal, event.direction = True, -1.0
    span = (time, min(end, time + 10.0))
    found = solve_ivp(rate, span, state, "DOP853", events=event, rtol=RELATIVE, atol=ABSOLUTE)
    return float(found.t[-1]), numpy.array(found.y[:, -1])
