"""Motions of rigid bodies whose end is known in closed form: for work-precision studies, hard cases
and the goals.
"""

from __future__ import annotations

import math

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.rigid.bodies.body import box, placed, regular_block, slope, sphere
from contact_sim_pkg.rigid.motion.located import LocatedBody
from contact_sim_pkg.rigid.results import SENTENCES, SOLVED

__all__ = [
    "BOUNCE_TIME", "SLIDE", "SPEED", "bounce_to_rest", "creep", "cube_for_a_second", "elastic_drift",
    "slid", "slide_error",
]  # fmt: skip

GRAVITY, SIDE, RADIUS = 9.81, 0.1, 0.05
SPEED, FRICTION, SLOPE = 2.0, 0.3, math.radians(15.0)
SLIDE = SPEED**2 / (2.0 * FRICTION * GRAVITY)  # [m]
HEIGHT, RESTITUTION = 1.0, 0.8
BOUNCE_TIME = math.sqrt(2.0 * HEIGHT / GRAVITY) * (1.0 + RESTITUTION) / (1.0 - RESTITUTION)  # [s]
TICK = 1e-3  # [s]


def _checked(status: int) -> None:
    if status != SOLVED:
        raise ArithmeticError(SENTENCES[status])


def cube_for_a_second(speed: float) -> None:
    """A cube on a plane for 1 s with states at every tick; ``speed`` [m/s] along the plane at the
    start.
    """
    cube = box((SIDE, SIDE, SIDE), 1.0, FRICTION, 0.0)
    motion = placed(cube, numpy.array([0.0, 0.0, 0.5 * SIDE]), numpy.array([speed, 0.0, 0.0, 0.0, 0.0, 0.0]))
    _checked(LocatedBody(cube, slope(3), motion).advance_over(TICK, round(1.0 / TICK))[0])


def slid(tick: float = TICK) -> LocatedBody:
    """A block after a second, that slid from 2 m/s to a stop."""
    block = regular_block(SIDE, 1.0, FRICTION, 0.0)
    motion = placed(block, numpy.array([0.0, 0.5 * SIDE]), numpy.array([SPEED, 0.0, 0.0]))
    body = LocatedBody(block, slope(2), motion)
    for _ in range(round(1.0 / tick)):
        _checked(body.advance(tick))
    return body


def slide_error(tick: float = TICK) -> float:
    """Relative error of its distance; the argument as of `slid`."""
    return abs(float(slid(tick).motion.position[0]) / SLIDE - 1.0)


def bounce_to_rest(restitution: float = RESTITUTION, tick: float = 0.05) -> tuple[float, int]:
    """Time in [s] at which a ball dropped from 1 m rests, and its number of impacts."""
    ball = sphere(RADIUS, 1.0, FRICTION, restitution)
    motion = placed(ball, numpy.array([0.0, 0.0, HEIGHT + RADIUS]), numpy.zeros(6))
    body, impacts = LocatedBody(ball, slope(3), motion), 0
    for count in range(10_000):
        _checked(body.advance(tick))
        impacts += len(body.impacts)
        if not math.isnan(body.rested):
            return count * tick + body.rested, impacts
    return math.nan, impacts


def creep(duration: float = 10.0, tick: float = 0.01) -> float:
    """Mean speed in [m/s] of a block at rest on a slope of 15 degrees, friction 0.3."""
    angle = SLOPE
    block = regular_block(SIDE, 1.0, FRICTION, 0.3)
    normal: Vector = numpy.array([-math.sin(angle), math.cos(angle)])
    motion = placed(block, 0.5 * SIDE * normal, numpy.zeros(3), angle=angle)
    start, body = motion.position.copy(), LocatedBody(block, slope(2, angle), motion)
    for _ in range(round(duration / tick)):
        _checked(body.advance(tick))
    return float(numpy.abs(motion.position - start).max()) / duration


def elastic_drift(bounces: int = 1000) -> tuple[float, int]:
    """Largest change of the energy of a ball over elastic bounces, of its energy: dimensionless; and its impacts."""
    ball = sphere(RADIUS, 1.0, 0.0, 1.0)
    motion = placed(ball, numpy.array([0.0, 0.0, 0.1 + RADIUS]), numpy.zeros(6))
    body, impacts = LocatedBody(ball, slope(3), motion), 0
    start, worst = GRAVITY * float(motion.position[2]), 0.0
    while impacts < bounces:
        _checked(body.advance(0.1))
        impacts += len(body.impacts)
        worst = max(worst, abs((body.kinetic_energy() + GRAVITY * float(motion.position[2])) / start - 1.0))
    return worst, impacts
