"""This project: events located in time; no step to choose, so the step is the interval between outputs."""

from __future__ import annotations

import math

import numpy

from comparisons.dynamics.problems import SIDE, Array, Start
from contact_sim_pkg.rigid.bodies.body import box, placed, slope, sphere
from contact_sim_pkg.rigid.motion.located import LocatedBody
from contact_sim_pkg.rigid.parameters import ENERGETIC, NEWTON
from contact_sim_pkg.rigid.results import SENTENCES, SOLVED

__all__ = ["SETTINGS", "STEPS", "Ours", "version"]

SETTINGS = "located events; energetic restitution, that of Newton where e is 0, as the others; states every step, all in one call"
STEPS = (5e-3, 1e-3)
RADIUS = 0.05


def version() -> str:
    """Of this project."""
    return "this checkout"


class Ours:
    """One body."""

    def __init__(self, step: float) -> None:
        self._step = step

    def place(self, start: Start) -> None:
        """Make the world anew."""
        shape = (
            sphere(RADIUS, 1.0, start.friction, start.restitution)
            if start.ball
            else box((SIDE, SIDE, SIDE), 1.0, start.friction, start.restitution)
        )
        load = numpy.concatenate([numpy.array(start.gravity), numpy.zeros(3)])
        if not any(start.gravity):
            load[2] = -1e-12  # the speed that counts as rest is taken from the weight
        cosine, sine = math.cos(start.pitch), math.sin(start.pitch)
        turned = numpy.array([[cosine, 0.0, sine], [0.0, 1.0, 0.0], [-sine, 0.0, cosine]])
        velocity = numpy.array([*start.velocity, 0.0, start.spin, 0.0])
        motion = placed(shape, numpy.array([0.0, 0.0, start.height]), velocity, rotation=turned)
        self._body = LocatedBody(
            shape._replace(load=load), slope(3), motion, NEWTON if start.restitution == 0.0 else ENERGETIC
        )

    def run(self, seconds: float) -> None:
        """Go on for a time."""
        count = max(1, math.ceil(seconds / self._step - 1e-9))
        status, track = self._body.advance_over(seconds / count, count)
        if status != SOLVED:
            raise ArithmeticError(SENTENCES[status])
        self._last = track.impulse[-1]

    def state(self) -> tuple[Array, Array, Array]:
        """Position, velocity and angular velocity in world axes."""
        motion = self._body.motion
        return motion.position.copy(), motion.velocity[:3].copy(), motion.velocity[3:].copy()

    def loads(self) -> Array:
        """Normal forces [N] over the last interval."""
        normal = self._last[::3] / self._step
        return numpy.asarray(normal[normal > 0.0])
