"""Friction of a contact that lasts, from its pushes and its slip.

Friction opposes the slip of each point at every instant, so that the push over the mass of a step
keeps `|pi_t| <= mu pi_n`, and `-sum(d pi_t) / sum(pi_n) <= mu` for any unit vectors d along the
ground. It is mu where all points slip along one d all the time, a lower bound where the slip turns,
reverses, or differs between points. Pushes are taken along d, the direction of the mean slip, since
the noise of |pi_t| would add up; along one d all but that of the first and last velocity cancels.

Source: Identifiability eqs 5 and 42.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.identify.contact.modes import STRAIGHT
from contact_sim_pkg.identify.contact.slides import slip_of
from contact_sim_pkg.identify.geometry import UP, size
from contact_sim_pkg.identify.motion.rotation import Array
from contact_sim_pkg.identify.problem import IdentificationProblem

__all__ = ["SlidingFriction", "sliding_friction"]

SIGMAS = 6.0
SIGNIFICANT = 3.0  # standard deviations: a bound below is empty


class SlidingFriction(NamedTuple):
    """Estimate or lower bound of mu from a slide."""

    value: float
    deviation: float  # standard deviation
    straight: bool  # it is mu; a lower bound otherwise

    def in_words(self) -> str:
        """Such as `friction 0.3 ± 0.001`, or `friction >= 0.3 ± 0.001`; empty where a bound says
        nothing.
        """
        if not self.straight and self.value <= SIGNIFICANT * self.deviation:
            return ""
        return f"friction {'' if self.straight else '>= '}{max(self.value, 0.0):.3g} ± {self.deviation:.1g}"


def sliding_friction(problem: IdentificationProblem, samples: range) -> SlidingFriction | None:
    """From the steps between neighbouring samples of a contact whose points slip at both ends; None
    where there is none.

    No external force may act.
    """
    states, normal = problem.states, problem.ground.normal
    found = [slip_of(problem, sample) for sample in samples]
    slips, alike = numpy.array([slip for slip, _ in found]), numpy.array([same for _, same in found])
    moving = numpy.linalg.norm(slips, axis=1) > 0.0
    steps = moving[1:] & moving[:-1]
    rows = slice(samples.start, samples.stop)
    weight = numpy.diff(states.time[rows])[:, None] * problem.model.gravity * UP
    pushes = (numpy.diff(states.velocity[rows], axis=0) + weight) * steps[:, None]
    total = float(numpy.sum(pushes @ normal))
    if not total > 0.0:
        return None
    used = numpy.concatenate([steps, [False]]) | numpy.concatenate([[False], steps])
    direction = _unit(slips[used].sum(axis=0))
    straight = bool(alike[used].all()) and _along(problem, slips[used], pushes.sum(axis=0), direction)
    middles = slips[1:] + slips[:-1]
    directions = numpy.tile(direction, (len(steps), 1)) if straight else _unit(middles)
    value = -float(numpy.sum(pushes * directions)) / total
    by_push = (directions + value * normal) * steps[:, None] / total
    by_velocity = numpy.diff(by_push, axis=0, prepend=numpy.zeros((1, 3)), append=numpy.zeros((1, 3)))
    deviation = problem.noise.velocity * float(numpy.linalg.norm(by_velocity))
    if straight:  # what slips that turn within their noise would leave out: mean of 1 - cos
        sines = numpy.linalg.norm(numpy.cross(_unit(slips[used]), direction), axis=1)
        deviation = float(numpy.hypot(deviation, value * numpy.mean(0.5 * sines**2)))
    return SlidingFriction(value, deviation, straight)


def _along(problem: IdentificationProblem, slips: Array, push: Array, direction: Array) -> bool:
    """Whether slips [n, 3] lie along a direction and the push against it, within the noise."""
    noise, ground = problem.noise, problem.ground
    spread = noise.velocity + size(problem.shape) * noise.angular_velocity
    along = push - (push @ ground.normal) * ground.normal
    vectors = numpy.concatenate([slips, -along[None]])
    floors = SIGMAS * numpy.append(numpy.full(len(slips), spread), noise.velocity * numpy.sqrt(2.0))
    allowed = numpy.maximum(floors, STRAIGHT * numpy.linalg.norm(vectors, axis=1))
    sideways = numpy.linalg.norm(vectors - numpy.outer(vectors @ direction, direction), axis=1)
    return bool(
        (sideways <= allowed).all() and (vectors @ direction >= -allowed).all() and (slips @ direction > 0.0).all()
    )


def _unit(vectors: Array) -> Array:
    """Their directions; zero where they have none."""
    lengths = numpy.linalg.norm(vectors, axis=-1, keepdims=True)
    directions: Array = vectors / numpy.where(lengths > 0.0, lengths, 1.0)
    return directions
