"""Slow twins of the backrest rig, integrated by scipy; they share no code with the kernels.

``slapping_mass``: one mass on a Hunt-Crossley seat back under preload and a sine, phase by phase
with located events. ``slapping_course``, ``slapping_normal``: motion and force of that mass at given instants.
``sliding_friction``: friction under a given force, step by step. ``slapping_points``: modal
coordinates with many contact points, in one go at a tight tolerance.
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
    """``m w'' = P + m a sin(2 pi f t) - A w**n (1 + damping w')``, the contact force never
    negative.
    """

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
    parts = _phases(body, duration, tolerance)
    ends = [(float(part.t[-1]), touching) for touching, part in parts if part.status == 1]
    touches = numpy.array([time for time, touching in ends if not touching])
    losses = numpy.array([time for time, touching in ends if touching])
    return Slaps(touches, losses, parts[-1][1].y[:, -1])


def slapping_course(body: SlappingMass, times: Vector, tolerance: float = 1e-12) -> NDArray[numpy.float64]:
    """Approach [m], its rate [m/s] and contact force [N], [3, times], of the motion of ``slapping_mass``
    at ascending ``times`` [s] from 0.
    """
    course = numpy.zeros((3, len(times)))
    for touching, part in _phases(body, float(times[-1]), tolerance):
        during = (times >= part.t[0]) & (times <= part.t[-1])
        if not during.any():
            continue
        w, v = part.sol(times[during])
        course[:2, during] = w, v
        if touching:
            force = body.coefficient * numpy.maximum(w, 0.0) ** body.exponent * (1.0 + body.damping * v)
            course[2, during] = numpy.maximum(force, 0.0)
    return course


def slapping_normal(body: SlappingMass, times: Vector, tolerance: float = 1e-12) -> Vector:
    """Contact force [times] [N] of `slapping_course`."""
    return slapping_course(body, times, tolerance)[2]


def sliding_friction(
    normal: Vector, velocity: Vector, step: float, ratio: float, stiffness: float, damping: float
) -> Vector:
    """Friction [samples] [N] of a spring-damper within ``ratio`` times ``normal`` [N].

    normal, velocity [m/s]: [samples], each ``step`` [s]; stiffness [N/m]; damping [N s/m]. Friction
    with stick (Driver and Seat, eq 9) in steps, of first order: trial ``C (s + v h) + D v``; beyond
    the limit the force is the limit and ``C s = F - D v``, at most the limit against the slip;
    without normal force ``s = 0``.
    """
    force, s = numpy.zeros(len(normal)), 0.0
    for k in range(1, len(normal)):
        limit, v = ratio * float(normal[k]), float(velocity[k])
        if limit <= 0.0:
            s = 0.0
            continue
        trial = stiffness * (s + v * step) + damping * v
        # Stick within the limit; else slip, where the spring follows the limit.
        if abs(trial) <= limit:
            s, force[k] = s + v * step, trial
        else:
            sign = math.copysign(1.0, trial)
            force[k] = sign * limit
            s = sign * max(limit - sign * damping * v, -limit) / stiffness
    return force


def _phases(body: SlappingMass, duration: float, tolerance: float) -> list[tuple[bool, Any]]:
    """From loss to touch to loss: whether it touches, and scipy's solution."""
    state = numpy.array([(body.preload / body.coefficient) ** (1.0 / body.exponent), 0.0])
    time, touching = 0.0, True
    parts: list[tuple[bool, Any]] = []
    while time < duration:
        part = _phase(body, touching, (time, duration), state, tolerance)
        parts.append((touching, part))
        time, state = float(part.t[-1]), part.y[:, -1]
        touching = touching != (part.status == 1)
    return parts


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
        dense_output=True,
    )


class SlappingPoints(NamedTuple):
    """``M q'' = P + m a(t) - K q - C q' - sum_c phi_c share_c A d_c**n max(0, 1 + damping d_c')``,
    ``d_c = phi_c q - gap_c``.
    """

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
    """q [m] and q' [m/s], [times, states], at ``times`` [s], from ``start`` [states] at the first
    of them.

    acceleration: time [s] -> [m/s^2].
    """
    # Modal equations with the law of each point; q, then q'.
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
