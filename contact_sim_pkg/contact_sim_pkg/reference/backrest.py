"""Slow twins of the backrest rig, integrated by scipy; they share no code with the kernels.

``slapping_mass``: one mass on a Hunt-Crossley seat back under preload and a sine, phase by phase with located events.
``slapping_points``: modal coordinates with many contact points, in one go at a tight tolerance.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

Vector = NDArray[numpy.float64]


class SlappingMass(NamedTuple):
    """``m w'' = P + m a sin(2 pi f t) - A w**n (1 + damping w')``, the contact force never negative."""

    mass: float  # [kg]
    preload: float  # [N]
    amplitude: float  # [m/s^2]
    frequency: float  # [Hz]
    coefficient: float  # [N/m^n]
    exponent: float
    damping: float  # [s/m]


class Slaps(NamedTuple):
    """What the mass did."""

    touches: Vector  # [s]
    losses: Vector  # [s] of contact, through a gap or through a force that reached zero
    end: Vector  # [2] approach [m] and its rate [m/s] at the end


def slapping_mass(body: SlappingMass, duration: float, tolerance: float = 1e-12) -> Slaps:
    """Motion over ``duration`` [s] from rest under the preload."""
    state = numpy.array([(body.preload / body.coefficient) ** (1.0 / body.exponent), 0.0])
    time, touching = 0.0, True
    touches: list[float] = []
    losses: list[float] = []
    while time < duration:
        part = _phase(body, touching, (time, duration), state, tolerance)
        time, state = float(part.t[-1]), part.y[:, -1]
        if part.status == 1:
            touching = not touching
            (touches if touching else losses).append(time)
    return Slaps(numpy.array(touches), numpy.array(losses), state)


def _phase(body: SlappingMass, touching: bool, span: tuple[float, float], state: Vector, tolerance: float) -> Any:
    """Until contact is lost or made, or to the end of ``span``."""

    def carried(w: float, v: float) -> float:
        return float(max(w, 0.0) ** body.exponent * (1.0 + body.damping * v))

    def rates(t: float, y: Vector) -> tuple[float, float]:
        drive = body.preload / body.mass + body.amplitude * math.sin(2.0 * math.pi * body.frequency * t)
        force = body.coefficient * carried(*y) if touching else 0.0
        return y[1], drive - force / body.mass

    def over(t: float, y: Vector) -> float:
        return float(min(y[0], 0.01 * (1.0 + body.damping * y[1])))

    over.terminal = True  # type: ignore[attr-defined]
    over.direction = -1.0 if touching else 1.0  # type: ignore[attr-defined]
    return solve_ivp(
        rates,
        span,
        state,
        method="DOP853",
        events=over,
        rtol=tolerance,
        atol=1e-14,
        max_step=0.25 / body.frequency / 8.0,
    )


class SlappingPoints(NamedTuple):
    """``M q'' = P + m a(t) - K q - C q' - sum_c phi_c share_c A d_c**n max(0, 1 + damping d_c')``, ``d_c = phi_c q - gap_c``."""

    mass: Vector  # [modes]
    stiffness: Vector
    damping: Vector
    preload: Vector
    shaken: Vector
    shapes: NDArray[numpy.float64]  # [points, modes]
    gaps: Vector  # [points]
    shares: Vector
    coefficient: float
    exponent: float
    loss: float  # [s/m]


def slapping_points(
    body: SlappingPoints, start: Vector, acceleration: Callable[[float], float], times: Vector, tolerance: float = 1e-11
) -> NDArray[numpy.float64]:
    """[len(times), 2 modes] q and q' at ``times`` [s], from ``start`` [2 modes] at the first of them."""
    modes = len(body.mass)

    def rates(t: float, y: Vector) -> Vector:
        q, v = y[:modes], y[modes:]
        depth, rate = body.shapes @ q - body.gaps, body.shapes @ v
        elastic = body.shares * body.coefficient * numpy.maximum(depth, 0.0) ** body.exponent
        force = elastic * numpy.maximum(0.0, 1.0 + body.loss * rate)
        pushed = body.preload + body.shaken * acceleration(t) - body.stiffness * q - body.damping * v
        return numpy.concatenate([v, (pushed - body.shapes.T @ force) / body.mass])

    span = (float(times[0]), float(times[-1]))
    found = solve_ivp(rates, span, start, method="DOP853", t_eval=times, rtol=tolerance, atol=1e-13, max_step=2e-3)
    return numpy.asarray(found.y.T)
