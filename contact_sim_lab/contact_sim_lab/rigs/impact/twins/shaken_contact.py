"""A sphere pressed on a half-space and shaken, by scipy in time: `m x'' + A x^1.5 + B sqrt(x) x' =
F0 (1 + a cos(w t))`.
"""

from __future__ import annotations

import math

import numpy
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

__all__ = ["last_period"]

Vector = NDArray[numpy.float64]


def last_period(
    mass: float,
    elastic: float,
    viscous: float,
    load: float,
    part: float,
    frequency: float,
    periods: int,
    samples: int,
    tolerance: float,
) -> Vector:
    """Depth [samples] [m] at even instants of the last of ``periods`` periods, from rest on the
    static depth.

    mass: [kg]; elastic: [N/m^1.5]; viscous: [N s/m^1.5]; load: [N]; part: amplitude over load [1];
    frequency: [rad/s].
    """

    def rate(time: float, state: Vector) -> list[float]:
        depth = max(float(state[0]), 0.0)
        root = math.sqrt(depth)
        force = load * (1.0 + part * math.cos(frequency * time)) - elastic * depth * root - viscous * root * state[1]
        return [float(state[1]), force / mass]

    # Last of many periods, from the static depth.
    period = 2.0 * math.pi / frequency
    start = (load / elastic) ** (2.0 / 3.0)
    times = (periods - 1 + numpy.arange(samples) / samples) * period
    found = solve_ivp(
        rate,
        (0.0, periods * period),
        [start, 0.0],
        method="DOP853",
        rtol=tolerance,
        atol=tolerance * start,
        t_eval=times,
    )
    depth: Vector = found.y[0]
    return depth
