"""One mass over a support that moves as a sine, by scipy's DOP853 from event to event: slow, and
free of kernel code.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

__all__ = ["Slap", "final_state"]

State = NDArray[numpy.float64]
RELATIVE, ABSOLUTE = 3.0e-14, 1.0e-16
# Events are looked for in intervals, so that no touch falls between two steps.
INTERVALS_A_PERIOD = 32


class Slap(NamedTuple):
    """`m z'' = F - m g`, `F = A x^n max(0, 1 + damping x')` for `x = amplitude sin(w t) - z >
    0`.
    """

    mass: float  # [kg]
    gravity: float  # [m/s^2]
    amplitude: float  # [m]
    frequency: float  # [rad/s], 0 for a support at rest
    coefficient: float  # [N/m^n]
    exponent: float
    damping: float  # [s/m]


def final_state(slap: Slap, start: State, end_time: float, interval: float | None = None) -> State:
    """State [z, v] in [m, m/s] at `end_time` [s], from `start` at time 0, to about 1e-13.

    `interval`: longest span in [s] that is integrated at once; a 32nd of the support's period where
    not given.
    """
    if interval is None:
        interval = 2.0 * math.pi / slap.frequency / INTERVALS_A_PERIOD if slap.frequency > 0.0 else end_time / 200.0
    time, state = 0.0, numpy.array(start, dtype=float)
    touching = _approach(slap, time, state)[0] > 0.0 or _approach(slap, time, state)[1] > 0.0
    while time < end_time:
        until = min(end_time, time + interval)
        time, state, changed = _advance(slap, touching, time, until, state)
        touching = touching != changed
    return state


def _approach(slap: Slap, time: float, state: State) -> tuple[float, float]:
    phase = slap.frequency * time
    rate = slap.amplitude * slap.frequency * math.cos(phase) - state[1]
    return slap.amplitude * math.sin(phase) - state[0], rate


def _advance(slap: Slap, touching: bool, time: float, until: float, state: State) -> tuple[float, State, bool]:
    """Up to `until` or to the change of contact; the law of the side on which the interval starts
    holds throughout.
    """

    def rate(t: float, y: State) -> list[float]:
        force = 0.0
        if touching:
            x, speed = _approach(slap, t, y)
            force = slap.coefficient * max(x, 0.0) ** slap.exponent * max(0.0, 1.0 + slap.damping * speed)
        return [y[1], force / slap.mass - slap.gravity]

    def change(t: float, y: State) -> float:
        return _approach(slap, t, y)[0]

    return integrate_to_event(rate, change, -1.0 if touching else 1.0, time, until, state)


def integrate_to_event(
    rate: Callable[[float, State], list[float]],
    change: Callable[[float, State], float],
    direction: float,
    time: float,
    until: float,
    state: State,
) -> tuple[float, State, bool]:
    """Integrate from `time` [s] until `change` passes zero in `direction`, at most to `until` [s].

    state: [states]. Returns the time [s] and the state reached, and whether it was the zero.
    """
    change.terminal, change.direction = True, direction  # type: ignore[attr-defined]
    found = solve_ivp(rate, (time, until), state, "DOP853", events=change, rtol=RELATIVE, atol=ABSOLUTE)
    return float(found.t[-1]), numpy.asarray(found.y[:, -1]), found.status == 1
