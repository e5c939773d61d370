"""Steps of a lasting contact that slides with a known friction coefficient: their information on
the mass under a known force.

Points may touch together where all slip alike, as those of a block that slides on its face do.

Friction of a contact that lasts, from its pushes and its slip.

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

from contact_sim_pkg.identify.contact.instant import STRAIGHT
from contact_sim_pkg.identify.contact.noise import limited
from contact_sim_pkg.identify.motion.geometry import UP, arm, gaps, size
from contact_sim_pkg.identify.motion.rotation import Array
from contact_sim_pkg.identify.motion.segments import LONGEST_IMPACT, MEDIAN_OF_GAUSS, Segments
from contact_sim_pkg.identify.motion.states import SampleNoise
from contact_sim_pkg.identify.problem import ContactSpan, IdentificationProblem

__all__ = ["Slide", "SlidingFriction", "slides_of", "sliding_friction", "slip_of", "with_slides"]


MOST = 60  # steps taken
SIGMAS = 6.0
STILL = 1e-6  # of the largest speed: slip that counts as none, and a difference of slip that counts as none
HIGH = 0.1  # of the body's size: a gap that is no contact
TOUCH = 1e-6  # of the body's size: points this close to the lowest one touch with it
FOURTH = 8  # samples that fourth differences need
CURVED = 0.125  # delta^2 / 8: share of the friction that a step misses whose slip turns by delta


class Slide(NamedTuple):
    """A run of samples that slide on."""

    first: int
    last: int
    turn: float  # [rad] by which the slip turns


def slides_of(problem: IdentificationProblem, parts: Segments) -> list[Slide]:
    """All runs of two samples or more, in lasting contacts, of slip that never stops or
    reverses.
    """
    found = []
    for begin, end in parts.contacts:
        if end - begin + 1 <= LONGEST_IMPACT:
            continue
        slips = numpy.array([_slip(problem, sample) for sample in range(begin + 1, end + 1)])
        kept = numpy.linalg.norm(slips, axis=1) > 0.0
        joined = kept[1:] & kept[:-1] & (numpy.einsum("ni,ni->n", slips[1:], slips[:-1]) > 0.0)
        edges = numpy.flatnonzero(numpy.diff(numpy.concatenate([[0], joined.astype(int), [0]])))
        for first, last in edges.reshape(-1, 2):
            found.append(Slide(begin + 1 + int(first), begin + 1 + int(last), _angle(slips[first], slips[last])))
    return found


def with_slides(problem: IdentificationProblem, parts: Segments) -> IdentificationProblem:
    """The problem with steps of all slides; the same where friction is not known or there is no
    force.
    """
    if problem.friction is None or problem.model.wrench.force is None:
        return problem
    slides, noise = slides_of(problem, parts), problem.step_noise or problem.noise
    lengths = [_length(problem, slide) for slide in slides]
    steps = [
        (first, first + length)
        for slide, length in zip(slides, lengths, strict=True)
        for first in range(slide.first, slide.last - length + 1, length)
    ]
    if len(steps) > MOST:
        steps = [steps[place] for place in numpy.linspace(0, len(steps) - 1, MOST).round().astype(int)]
    missed = max((_missed(problem, *pair) for pair in zip(slides, lengths, strict=True)), default=0.0)
    wider = problem._replace(step_noise=noise._replace(velocity=max(noise.velocity, missed)))
    return _joined(wider, steps)


def _joined(problem: IdentificationProblem, steps: list[tuple[int, int]]) -> IdentificationProblem:
    """The problem with these steps, which share the states at their ends."""
    flights, contacts, time = list(problem.flights), list(problem.contacts), problem.states.time
    numbers = {first: number for number, (first, last) in enumerate(flights) if first == last}
    for begin, end in steps:
        for sample in (begin, end):
            if sample not in numbers:
                numbers[sample] = len(flights)
                flights.append((sample, sample))
        point = int(_heights(problem, begin).argmin())
        times = (float(time[begin]), float(time[end]))
        contacts.append(ContactSpan(numbers[begin], numbers[end], *times, point, turns=False, slides=True))
    return problem._replace(flights=flights, contacts=contacts)


def _length(problem: IdentificationProblem, slide: Slide) -> int:
    """Samples of a step: MOST steps in a row, or shorter ones, so that what a turning slip misses
    stays below the noise.
    """
    samples = slide.last - slide.first
    count = numpy.ceil((_missed(problem, slide, samples) / _noise(problem, slide)) ** (1.0 / 3.0))
    return max(1, int(samples / max(MOST, count)))


def _noise(problem: IdentificationProblem, slide: Slide) -> float:
    """Of a velocity component in [m/s], from fourth differences over the slide: smooth motion
    hardly adds to them.
    """
    noise, rounding = problem.noise.velocity, limited(SampleNoise(0.0, 0.0, 0.0, 0.0), problem.states).velocity
    if slide.last - slide.first < FOURTH:
        return noise
    fourth = numpy.diff(problem.states.velocity[slide.first : slide.last + 1], n=4, axis=0)
    spread = float(numpy.median(abs(fourth), axis=0).max()) / MEDIAN_OF_GAUSS / float(numpy.sqrt(70.0))
    return max(rounding, min(noise, spread))


def _missed(problem: IdentificationProblem, slide: Slide, length: int) -> float:
    """Largest error of the balance of a step of `length` samples, since it takes one direction of
    slip: [m/s].
    """
    states, share = problem.states, length / (slide.last - slide.first)
    jump = states.velocity[slide.last] - states.velocity[slide.first]
    return CURVED * slide.turn**2 * float(numpy.linalg.norm(jump)) * share**3


def _slip(problem: IdentificationProblem, sample: int) -> Array:
    """Slip of the points that touch, [3] in [m/s]; zero where they slip slowly, or differently, or
    nothing touches.
    """
    mean, alike = slip_of(problem, sample)
    return mean if alike else numpy.zeros(3)


def slip_of(problem: IdentificationProblem, sample: int) -> tuple[Array, bool]:
    """Mean slip [x, y, z] in [m/s] of the points in contact at a sample, zero where it is slow or
    nothing is; whether all slip alike."""
    states, noise, length = problem.states, problem.noise, size(problem.shape)
    heights, flat = _heights(problem, sample), problem.tangents.T @ problem.tangents
    if heights.min() > HIGH * length + SIGMAS * noise.position:
        return numpy.zeros(3), True
    uncertainty = SIGMAS * (noise.position + length * noise.rotation)
    touching = numpy.flatnonzero(heights <= heights.min() + max(TOUCH * length, uncertainty))
    reaches = [arm(problem.shape, problem.ground, states.rotation[sample], int(point)) for point in touching]
    velocity, spin = states.velocity[sample], states.angular_velocity[sample]
    slips = numpy.array([flat @ (velocity + numpy.cross(spin, reach)) for reach in reaches])
    floor = STILL * float(abs(states.velocity).max() + length * abs(states.angular_velocity).max())
    limit = max(SIGMAS * (noise.velocity + length * noise.angular_velocity), floor)
    mean = slips.mean(axis=0)
    alike = float(numpy.linalg.norm(slips - mean, axis=1).max()) <= limit
    return (mean if float(numpy.linalg.norm(mean)) > limit else numpy.zeros(3)), alike


def _angle(first: Array, last: Array) -> float:
    across = float(numpy.linalg.norm(numpy.cross(first, last)))
    return float(numpy.arctan2(across, float(first @ last)))


def _heights(problem: IdentificationProblem, sample: int) -> Array:
    states = problem.states
    return gaps(problem.shape, problem.ground, states.position[sample], states.rotation[sample])


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
