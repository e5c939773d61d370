"""Steps of a lasting contact: each interval gives one balance (Identifiability, eq 39
corrected).

Instant and point of an impact: the root of the gap on the incoming flight, and on the outgoing
one where it lasts.

Source: Identifiability eqs 10 and 19 to 31.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy

from contact_sim_pkg.identify.contact.noise import (
    FREE_MOTION_MISSING,
    ContactNote,
    NoteKind,
    cure_without_flights,
)
from contact_sim_pkg.identify.contact.slides import sliding_friction
from contact_sim_pkg.identify.motion.flight import FlightModel, FlightState, plain_motion
from contact_sim_pkg.identify.motion.geometry import UP, GroundPlane, Shape, arm, arms, gaps, size
from contact_sim_pkg.identify.motion.rotation import Array
from contact_sim_pkg.identify.motion.segments import LONGEST_IMPACT, SHORTEST_FLIGHT, Segments
from contact_sim_pkg.identify.motion.states import SampleNoise
from contact_sim_pkg.identify.problem import ContactSpan, IdentificationProblem

__all__ = ["ContactEvent", "lasting_note", "locate", "nothing_to_identify_from", "with_steps"]


MOST = 60  # steps taken, evenly spread
APART = 1e-3  # of the body's size: the next corner must be this much higher
SIGMAS = 6.0
HIGH = 0.1  # of the body's size: a gap that is no contact
STILL = 1e-9  # of the largest speed: slip that counts as none
FEW = 0.05  # share of the samples that is ignored


def with_steps(problem: IdentificationProblem, parts: Segments) -> IdentificationProblem:
    """The problem with the steps of all lasting contacts on one corner: a flight of one sample at
    each end of a step.
    """
    steps = [
        step for first, last in parts.contacts if last - first + 1 > LONGEST_IMPACT for step in range(first + 1, last)
    ]
    # Steps that rest on one corner, spread over the motion where there are many
    steps = [step for step in steps if _one_corner(problem, step)]
    if len(steps) > MOST:
        steps = [steps[place] for place in numpy.linspace(0, len(steps) - 1, MOST).round().astype(int)]
    flights, contacts, time = list(problem.flights), list(problem.contacts), problem.states.time
    # Neighbouring steps share the flight of the sample between them
    numbers: dict[int, int] = {}
    for step in steps:
        for sample in (step, step + 1):
            if sample not in numbers:
                numbers[sample] = len(flights)
                flights.append((sample, sample))
        point = int(_heights(problem, step).argmin())
        contacts.append(ContactSpan(numbers[step], numbers[step + 1], float(time[step]), float(time[step + 1]), point))
    return problem._replace(flights=flights, contacts=contacts, step_noise=_step_noise(problem, steps))


def lasting_note(problem: IdentificationProblem, first: int, last: int) -> ContactNote:
    """Finding about a lasting contact over the intervals first to last: it sticks, slides (with its
    friction), or both.
    """
    states, noise = problem.states, problem.noise
    samples = range(first + 1, last + 1)
    lifts = numpy.array([_heights(problem, sample).min() for sample in samples])
    # A body inside the ground, or above it: the input contradicts a contact
    lift, deep = float(numpy.median(lifts)), HIGH * size(problem.shape) + SIGMAS * noise.position
    if lift < -deep:
        return ContactNote(NoteKind.BELOW_GROUND, {"depth": -lift})
    if numpy.mean(lifts > _highest_hop(problem)) > FEW:
        return ContactNote(NoteKind.ABOVE_GROUND, {"height": float(lifts.max())})
    limit = SIGMAS * (noise.velocity + size(problem.shape) * noise.angular_velocity)
    # Share of the time in which the contact slides
    slips = numpy.array([_slip(problem, sample) for sample in samples])
    floor = STILL * float(abs(states.velocity).max() + size(problem.shape) * abs(states.angular_velocity).max())
    share = float(numpy.mean(slips > max(limit, floor)))
    depth = f", {-lift:.2g} m deep" if -lift > _highest_hop(problem) else ""
    if share < FEW:
        return ContactNote(NoteKind.LASTING, {"depth": depth, "motion": "sticks"})
    slides = "slides" if share > 1.0 - FEW else f"slides {share:.0%} of the time"
    found = None if problem.model.wrench.present else sliding_friction(problem, samples)
    friction = found.in_words() if found else ""
    motion = f"{slides} with {friction}" if friction else slides
    return ContactNote(NoteKind.LASTING, {"depth": depth, "motion": motion})


def nothing_to_identify_from(problem: IdentificationProblem, notes: Iterable[ContactNote]) -> str:
    """Why a motion without a flight identifies nothing, and a cure; ``notes``: of its lasting
    contacts.
    """
    strange = [note for note in notes if note.kind in FREE_MOTION_MISSING]
    if strange:
        return f"{strange[0].sentence}{_missing_in_the_air(problem)}"
    cure = cure_without_flights(no_friction=problem.friction is None, no_force=problem.model.wrench.force is None)
    return f"there is no flight of {SHORTEST_FLIGHT} samples or more between contacts; {cure}"


def _missing_in_the_air(problem: IdentificationProblem) -> str:
    """By how much the body accelerates beyond gravity where it is off the ground, in words; empty
    where a known wrench acts.

    A median over the intervals, for where no run of them fits free motion: exact samples contradict
    a wrong gravity in each.
    """
    states = problem.states
    lifts = numpy.array([_heights(problem, sample).min() for sample in range(len(states.time))])
    high = numpy.minimum(lifts[1:], lifts[:-1]) > _highest_hop(problem)
    if problem.model.wrench.present or not high.any():
        return ""
    rates = numpy.diff(states.velocity, axis=0) / numpy.diff(states.time)[:, None] + problem.model.gravity * UP
    x, y, z = numpy.median(rates[high], axis=0)
    return f"; there it accelerates by ({x:.3g}, {y:.3g}, {z:.3g}) m/s^2 more than gravity makes it"


def _highest_hop(problem: IdentificationProblem) -> float:
    """Height in [m] of a hop between two impacts that is too short to be a flight, g T^2 / 8, and
    what noise adds.
    """
    longest = (LONGEST_IMPACT + 1) * float(numpy.median(numpy.diff(problem.states.time)))
    noise, length = problem.noise, size(problem.shape)
    return (
        problem.model.gravity * longest**2 / 8.0 + SIGMAS * (noise.position + length * noise.rotation) + 1e-9 * length
    )


def _slip(problem: IdentificationProblem, sample: int) -> float:
    """Speed of the lowest point along the ground, [m/s]."""
    states, normal = problem.states, problem.ground.normal
    point = int(_heights(problem, sample).argmin())
    reach = arm(problem.shape, problem.ground, states.rotation[sample], point)
    velocity = states.velocity[sample] + numpy.cross(states.angular_velocity[sample], reach)
    return float(numpy.linalg.norm(velocity - (velocity @ normal) * normal))


def _step_noise(problem: IdentificationProblem, steps: list[int]) -> SampleNoise:
    """Noise of the samples at the ends of steps: the error of the midpoint rule, from third
    differences, counts as noise.
    """
    states, noise = problem.states, problem.noise
    inner = [step for step in steps if 1 <= step < len(states.time) - 2]
    errors = []
    for values in (states.velocity, states.angular_velocity):
        third = [values[k + 2] - 3.0 * values[k + 1] + 3.0 * values[k] - values[k - 1] for k in inner]
        errors.append(float(abs(numpy.array(third)).max(initial=0.0)) / 12.0)
    return noise._replace(
        velocity=max(noise.velocity, errors[0]), angular_velocity=max(noise.angular_velocity, errors[1])
    )


def _heights(problem: IdentificationProblem, sample: int) -> Array:
    states = problem.states
    return gaps(problem.shape, problem.ground, states.position[sample], states.rotation[sample])


def _one_corner(problem: IdentificationProblem, step: int) -> bool:
    """Whether the same corner, and no other, is down at both ends of a step; a soft ground lets it
    in.
    """
    ends = [_heights(problem, sample) for sample in (step, step + 1)]
    if max(end.min() for end in ends) > _highest_hop(problem):
        return False
    if len(ends[0]) == 1:
        return True
    length = float(numpy.ptp(problem.shape.points))
    pressed = -size(problem.shape)  # deeper than that is no soft ground, but another one than specified
    levels = [max(end.min(), 0.0) if end.min() > pressed else end.min() for end in ends]
    second = min(float(numpy.partition(end, 1)[1] - level) for end, level in zip(ends, levels, strict=True))
    same = ends[0].argmin() == ends[1].argmin()
    return bool(same and second > APART * length + SIGMAS * problem.noise.position)


STEPS = 12
SAME = 1e-7  # of the body's size: corners this close touch together


class ContactEvent(NamedTuple):
    """Where and when a flight meets the ground."""

    time: float  # [s]
    point: int  # of the shape
    together: int  # points that touch at once, this one included
    found: bool  # whether the gap has a root in the interval
    gap: float  # [m], at `time`


def locate(
    flight: FlightState,
    parameters: Array,
    model: FlightModel,
    shape: Shape,
    ground: GroundPlane,
    bounds: tuple[float, float],
    start: float,
    deviation: float,
    *,
    leaving: bool = False,
) -> ContactEvent:
    """Touch on a flight within `bounds`, by Newton's method on the gap of the point that touches first.

    Args:
        flight: the incoming flight.
        parameters: of the model, [parameters].
        model: of flights.
        shape: of the body.
        ground: below it.
        bounds: where to look, [s].
        start: where to begin with it, [s].
        deviation: standard deviation of the gap, [m]: points within three of it touch together.
        leaving: the flight comes after the contact, and the root is where it leaves the ground.
    """  # fmt: skip
    time, point = start, 0
    lifts: Array = numpy.zeros(1)
    for _ in range(STEPS):
        position, velocity, rotation, spin = (
            field[0] for field in plain_motion(flight, parameters, model, numpy.array([time]))
        )
        lifts = gaps(shape, ground, position, rotation)
        rates = ground.normal @ velocity + numpy.cross(spin, arms(shape, ground, rotation)) @ ground.normal
        point = _next(lifts, rates, time, bounds, leaving=leaving)
        rate = float(rates[point])
        if (rate <= 0.0) if leaving else (rate >= 0.0):
            return ContactEvent(time, point, _together(lifts, shape, deviation), False, float(lifts[point]))
        last, time = time, float(numpy.clip(time - lifts[point] / rate, *bounds))
        if abs(time - last) <= 1e-15 * max(1.0, abs(time)):
            break
    closed = abs(lifts[point]) <= max(6.0 * deviation, 1e-9 * size(shape))
    return ContactEvent(time, point, _together(lifts, shape, deviation), bool(closed), float(lifts[point]))


def _next(lifts: Array, rates: Array, time: float, bounds: tuple[float, float], *, leaving: bool) -> int:
    """The point whose gap closes first within the bounds, or opens last; the lowest where none
    does.

    The lowest may be one that has just touched and goes up, while another comes down.
    """
    turned = rates > 0.0 if leaving else rates < 0.0
    roots = time - lifts / numpy.where(turned, rates, 1.0)
    within = numpy.flatnonzero(turned & (roots >= bounds[0]) & (roots <= bounds[1]))
    if not len(within):
        return int(lifts.argmin())
    return int(within[roots[within].argmax() if leaving else roots[within].argmin()])


def _together(lifts: Array, shape: Shape, deviation: float) -> int:
    return int(numpy.sum(lifts <= lifts.min() + max(3.0 * deviation, SAME * size(shape))))
