"""A body that tips over on a corner that sticks, or in space on an edge: a compound pendulum, `(J +
m r^2) phi'' = m g r sin phi`.

phi is the angle of the centre of mass from the vertical above the corner, r its distance, J the
moment of inertia about the centre of mass. The reference is scipy's DOP853 at 1e-13 on this
equation, which shares no code with the rigid bodies.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from scipy.integrate import solve_ivp

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.rigid.bodies.body import RigidBody, placed, slope
from contact_sim_pkg.rigid.motion.located import LocatedBody
from contact_sim_pkg.rigid.problem import PLANE
from contact_sim_pkg.rigid.results import SENTENCES, SOLVED

__all__ = ["REFERENCE", "Tipping", "tip", "tip_error", "tipping"]

REFERENCE = "scipy DOP853 at 1e-13 on the equation of a pendulum, no shared code"
FIRST, LAST = 0.1, 0.5  # [rad] of phi; less where another corner comes down before
# of the distance from the corner: corners of one edge; how high the others must be
SAME, CLEAR = 1e-9, 0.02
GRIP = 2.0  # friction: the corner sticks throughout


class Tipping(NamedTuple):
    """The body, the corner that it tips on, and where it is after a time."""

    body: RigidBody
    lever: Vector  # [2], x and z from the centre of mass to the corner in body axes
    turned: float  # [rad] from x to z, at the start
    duration: float  # [s] until phi is `LAST`
    end: float  # [rad] of the same angle, by the reference


def tipping(body: RigidBody) -> Tipping | None:
    """``body`` of high friction and no load but its weight, on the first corner on which it can
    tip; None where there is none.
    """
    if body.radius > 0.0:
        return None
    load = numpy.zeros_like(body.load)
    load[body.width - 1] = -float(numpy.linalg.norm(body.load[: body.width]))
    body = body._replace(friction=GRIP, restitution=0.0, load=load)
    points = body.points[:, [0, body.width - 1]]
    for lever in points:
        upright = 0.5 * math.pi - math.atan2(-lever[1], -lever[0])
        for last in (LAST, 0.5 * LAST, 0.25 * LAST):
            first = FIRST / LAST * last
            if all(_stands_alone(points, lever, upright + angle) for angle in (first, last)):
                duration, reached = _pendulum(body, float(numpy.hypot(*lever)), first, last)
                return Tipping(body, lever, upright + first, duration, upright + reached)
    return None


def _stands_alone(points: Vector, lever: Vector, turned: float) -> bool:
    """Whether all other corners are above the one that the body tips on."""
    heights = (points - lever) @ _turn(turned)[1]
    others = numpy.linalg.norm(points - lever, axis=1) > SAME * float(numpy.hypot(*lever))
    return bool((heights[others] > CLEAR * float(numpy.hypot(*lever))).all())


def _pendulum(body: RigidBody, reach: float, first: float, last: float) -> tuple[float, float]:
    """Time [s] in which phi grows from ``first``, at rest, to ``last`` [rad], and phi then."""
    inertia = float(body.inertia[0] if body.width == PLANE else body.inertia[1])
    # [1/s^2]
    strength = -float(body.load[body.width - 1]) * reach / (inertia + body.mass * reach**2)

    def arrived(_time: float, state: Vector) -> float:
        return float(state[0]) - last

    arrived.terminal = True  # type: ignore[attr-defined]
    path = solve_ivp(
        lambda _time, state: [state[1], strength * math.sin(state[0])], (0.0, 20.0 / math.sqrt(strength)), [first, 0.0],
        "DOP853", rtol=1e-13, atol=1e-15, events=arrived, max_step=0.02 / math.sqrt(strength),
    )  # fmt: skip
    return float(path.t[-1]), float(path.y[0, -1])


def tip(case: Tipping, tolerance: float) -> LocatedBody:
    """The body after ``case.duration`` [s] in one call, at a dimensionless tolerance;
    ArithmeticError where it has no answer.
    """
    body, width = case.body, case.body.width
    place = numpy.zeros(width)
    place[[0, width - 1]] = -_turn(case.turned) @ case.lever
    rotation = numpy.eye(3)
    rotation[numpy.ix_([0, 2], [0, 2])] = _turn(case.turned)
    motion = placed(body, place, numpy.zeros(len(body.load)), case.turned, rotation)
    located = LocatedBody(body, slope(width), motion, tolerance=tolerance)
    status = located.advance(case.duration)
    if status != SOLVED:
        raise ArithmeticError(SENTENCES[status])
    return located


def tip_error(case: Tipping, tolerance: float) -> float:
    """Distance of the centre of mass from where the pendulum has it at the end, over its distance
    from the corner: dimensionless, as is the tolerance.
    """
    position = tip(case, tolerance).motion.position[[0, case.body.width - 1]]
    return float(numpy.linalg.norm(position + _turn(case.end) @ case.lever) / numpy.linalg.norm(case.lever))


def _turn(angle: float) -> Vector:
    """By an angle from x to z, [2, 2]."""
    return numpy.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
