"""An impact of a sphere under its weight by scipy: `m x'' = m g - A x^1.5 - B sqrt(x) x'` in `u =
sqrt(x)`, `dt = 2 u ds`.

Slow twin of `rigs/impact/theory/contact.py`, with events of scipy's DOP853.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from scipy.integrate import solve_ivp
from scipy.optimize import minimize_scalar

__all__ = ["impact_under_weight"]

State = Any


def impact_under_weight(
    mass: float, gravity: float, elastic: float, viscous: float, speed: float, pulls: bool, tolerance: float = 1e-13
) -> tuple[float, float, float, float]:
    """Restitution, duration [s], depth [m] and peak force [N] from the touch at ``speed`` to the
    loss of force.
    """
    # Scaled motion in the variable s with dt = 2 u ds, u the root of the depth.
    length = (mass * speed**2 / elastic) ** 0.4
    fall, zeta = gravity * length / speed**2, viscous * length**1.5 / (mass * speed)

    def rate(_s: float, y: State) -> list[float]:
        u, v = float(y[0]), float(y[1])
        return [v, 2.0 * u * (fall - u * (u * u + zeta * v)), 2.0 * u]

    def turn(_s: float, y: State) -> float:
        return float(y[1])

    def lost(_s: float, y: State) -> float:
        if y[1] >= 0.0:
            return 1.0
        return float(y[0] if pulls or zeta == 0.0 else y[0] ** 2 + zeta * y[1])

    events: list[Callable[[float, State], float]] = [turn, lost]
    turn.direction, lost.direction, lost.terminal = -1, -1, True  # type: ignore[attr-defined]
    found = solve_ivp(
        rate, (0.0, 50.0), [0.0, 1.0, 0.0], method="DOP853", events=events, rtol=tolerance, atol=tolerance,
        dense_output=True,
    )  # fmt: skip
    # Turning point, end of the contact, and the largest force between them.
    turned, ended = found.y_events[0][0], found.y_events[1][-1]

    def pull(s: float) -> float:
        u, v = found.sol(s)[:2]
        return float(-u * (u * u + zeta * v))

    span = (0.0, float(found.t_events[0][0]))
    peak = -minimize_scalar(pull, bounds=span, method="bounded", options={"xatol": 1e-10}).fun
    return (
        float(-ended[1]), float(ended[2] * length / speed), float(turned[0] ** 2 * length),
        float(max(peak, -pull(span[1])) * mass * speed**2 / length),
    )  # fmt: skip
