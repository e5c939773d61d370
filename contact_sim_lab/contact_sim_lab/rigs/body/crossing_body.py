"""A box that slides on its face across a slope: its slip turns downhill, and the friction with it.

The box does not turn, so that its centre of mass moves as a point with friction, `v' = g_t - mu g_n
v/|v|`, g_t and g_n the parts of gravity along and across the slope. The reference is scipy's DOP853
at 1e-13 on this equation, which shares no code with the rigid bodies.
"""

from __future__ import annotations

import functools
import math

import numpy
from scipy.integrate import solve_ivp

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.rigid.bodies.body import box, placed, slope
from contact_sim_pkg.rigid.motion.located import LocatedBody
from contact_sim_pkg.rigid.problem import SPACE
from contact_sim_pkg.rigid.results import SENTENCES, SOLVED

__all__ = ["REFERENCE", "cross", "cross_error"]

REFERENCE = "scipy DOP853 at 1e-13 on a point with friction, no shared code"
GRAVITY = 9.81  # [m/s^2]
SIDES, FRICTION, ANGLE = (0.2, 0.2, 0.02), 0.35, 0.3
UPHILL, ACROSS, DURATION = 0.5, 1.0, 0.3  # [m/s], [m/s], [s]


def cross(tolerance: float) -> LocatedBody:
    """The box after 0.3 [s] in one call, at a dimensionless tolerance; ArithmeticError where it has
    no answer.
    """
    rotation = numpy.array(
        [[math.cos(ANGLE), 0.0, -math.sin(ANGLE)], [0.0, 1.0, 0.0], [math.sin(ANGLE), 0.0, math.cos(ANGLE)]]
    )
    start = rotation @ [UPHILL, ACROSS, 0.0]
    motion = placed(
        box(SIDES, 1.0, FRICTION, 0.0),
        0.5 * SIDES[2] * rotation[:, 2],
        numpy.concatenate([start, numpy.zeros(3)]),
        rotation=rotation,
    )
    located = LocatedBody(box(SIDES, 1.0, FRICTION, 0.0), slope(SPACE, ANGLE), motion, tolerance=tolerance)
    status = located.advance(DURATION)
    if status != SOLVED:
        raise ArithmeticError(SENTENCES[status])
    return located


def cross_error(tolerance: float) -> float:
    """Distance of the centre of mass from where the point is at the end, over the length of the
    box: dimensionless, as is the tolerance.
    """
    position = cross(tolerance).motion.position
    uphill = math.cos(ANGLE) * position[0] + math.sin(ANGLE) * position[2]
    return float(math.hypot(*(numpy.array([uphill, position[1]]) - _reference()))) / SIDES[0]


@functools.cache
def _reference() -> Vector:
    """Where the point is at the end, uphill and across, [2] in [m]."""
    downhill, press = numpy.array([-GRAVITY * math.sin(ANGLE), 0.0]), GRAVITY * math.cos(ANGLE)

    def rate(_time: float, state: Vector) -> Vector:
        gain = downhill - FRICTION * press * state[2:] / numpy.linalg.norm(state[2:])
        return numpy.concatenate([state[2:], gain])

    path = solve_ivp(rate, (0.0, DURATION), [0.0, 0.0, UPHILL, ACROSS], "DOP853", rtol=1e-13, atol=1e-15)
    return numpy.asarray(path.y[:2, -1])
