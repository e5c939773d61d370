"""Flights and contacts of a sampled motion.

An interval between two samples holds a contact where `v2 - v1 + h g z - kappa int F dt` is larger
than noise explains (the 0.9999 quantile of chi-square) and the body is close to the ground, or is
far larger; or where the body stays on the ground. Neighbouring ones are one contact; more than
three in a row are a lasting one.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy
from scipy.stats import chi2

from contact_sim_pkg.identify.contact.wrench import ExternalWrench
from contact_sim_pkg.identify.geometry import UP, GroundPlane, Shape, gaps, size
from contact_sim_pkg.identify.motion.rotation import Array
from contact_sim_pkg.identify.motion.states import BodyStates

__all__ = [
    "LONGEST_IMPACT",
    "SHORTEST_FLIGHT",
    "Segments",
    "gap_uncertainty",
    "inverse_mass_guess",
    "segments",
    "velocity_noise",
]

QUANTILE = 0.9999
LONGEST_IMPACT = 3  # intervals
SHORTEST_FLIGHT = 3  # samples
CERTAIN = 25.0  # times the limit: a jump that counts as a contact wherever it is, so that no flight runs over it
SIGMAS = 6.0
TOUCH = 1e-9  # of the body's size: a gap that counts as none
FLOOR = 1e-9  # of the largest speed: what counts as noise at least
MEDIAN_OF_GAUSS = 0.6744897501960817


class Segments(NamedTuple):
    """Runs of samples in flight, and of intervals in contact; both ends belong to the run."""

    flights: list[tuple[int, int]]  # first and last sample
    contacts: list[tuple[int, int]]  # first and last interval; interval i lies between samples i and i + 1


def velocity_noise(states: BodyStates) -> float:
    """Standard deviation of a velocity component in [m/s], from the median change of the
    acceleration between intervals.

    Impacts do not move the median. Intervals may differ; stamps that are off count as noise of the
    velocity.
    """
    if len(states.time) < 5:
        return 0.0
    steps = numpy.diff(states.time)[:, None]
    change = numpy.diff(numpy.diff(states.velocity, axis=0) / steps, axis=0)
    share = 1.0 / steps[:-1] + 1.0 / steps[1:]
    spread = numpy.sqrt(share**2 + 1.0 / steps[:-1] ** 2 + 1.0 / steps[1:] ** 2)
    return float(numpy.median(abs(change) / spread, axis=0).max() / MEDIAN_OF_GAUSS)


def inverse_mass_guess(
    states: BodyStates, lifts: Array, wrench: ExternalWrench, gravity: float, uncertainty: float = 0.0
) -> float:
    """1/m in [1/kg] from the intervals off the ground: median of e.f/f.f; 0 without a force, or
    where all are on the ground.

    Below zero where the body moves against the force.

    `lifts` [samples]: smallest gaps, known to `uncertainty`, in [m].
    """
    pushes = _pushes(states, wrench)
    strength = numpy.einsum("ni,ni->n", pushes, pushes)
    chosen = (strength > 0.0) & (
        numpy.minimum(lifts[1:], lifts[:-1]) > max(uncertainty, 0.02 * float(numpy.ptp(lifts)))
    )
    if not chosen.any():
        return 0.0
    jumps = _jumps(states, gravity)
    return float(numpy.median(numpy.einsum("ni,ni->n", jumps, pushes)[chosen] / strength[chosen]))


def segments(
    states: BodyStates,
    shape: Shape,
    ground: GroundPlane,
    wrench: ExternalWrench,
    gravity: float,
    noise: float,
    place_noise: tuple[float, float] = (0.0, 0.0),
) -> Segments:
    """Split the motion.

    Args:
        states: the motion.
        shape: of the body.
        ground: below it.
        wrench: known force and torque.
        gravity: [m/s^2], downward.
        noise: of one velocity component, [m/s].
        place_noise: of one component of position [m] and of rotation [rad].
    """
    lifts = gaps(shape, ground, states.position, states.rotation).min(axis=1)
    uncertainty = gap_uncertainty(shape, place_noise)
    inverse_mass = inverse_mass_guess(states, lifts, wrench, gravity, uncertainty)
    # Changes of velocity that gravity and the wrench do not explain
    jumps = _jumps(states, gravity) - inverse_mass * _pushes(states, wrench)
    deviation = max(noise, FLOOR * float(abs(states.velocity).max()))
    strength = numpy.einsum("ni,ni->n", jumps, jumps) / (chi2.ppf(QUANTILE, 3) * 2.0 * deviation**2 + 1e-300)
    # A contact: a change beyond noise near the ground, a certain one anywhere, or rest on it
    near = _near(states, lifts, ground, place_noise[0])
    hit = (strength > 1.0) & (near | (strength > CERTAIN)) | _down(states, lifts, gravity, uncertainty)
    return Segments(*_runs(hit | _pressed_in(jumps, lifts < -uncertainty, deviation)))


def gap_uncertainty(shape: Shape, place_noise: tuple[float, float]) -> float:
    """Largest gap in [m] that noise can feign."""
    length = size(shape)
    return SIGMAS * (place_noise[0] + length * place_noise[1]) + TOUCH * length


def _down(states: BodyStates, lifts: Array, gravity: float, uncertainty: float) -> Array:
    """Intervals in which the body stays on the ground for longer than a hop that noise could hide
    would last.
    """
    low = abs(lifts) <= uncertainty
    joined = low[1:] & low[:-1]
    edges = numpy.flatnonzero(numpy.diff(numpy.concatenate([[0], joined.astype(int), [0]])))
    longest = numpy.sqrt(8.0 * uncertainty / gravity) if gravity > 0.0 else numpy.inf
    for first, last in edges.reshape(-1, 2):
        joined[first:last] = states.time[last] - states.time[first] > longest
    return numpy.asarray(joined)


def _pressed_in(jumps: Array, below: Array, deviation: float) -> Array:
    """Intervals of soft contacts: the body comes from above, is below the ground, and is pushed
    more than noise explains.

    A push of many short intervals may hide in the noise of each. Where one interval holds all of
    it, it was an impact.
    """
    found = numpy.zeros(len(jumps), dtype=bool)
    edges = numpy.flatnonzero(numpy.diff(numpy.concatenate([[0], below.astype(int), [0]])))
    limit = chi2.ppf(QUANTILE, 3) * 2.0 * deviation**2
    for first, last in edges.reshape(-1, 2):
        run = slice(max(first - 1, 0), min(last, len(jumps)))
        pushed = numpy.sum(jumps[run], axis=0)
        found[run] = first > 0 and float(pushed @ pushed) > limit and not _at_once(jumps[run], limit)
    return found


def _at_once(jumps: Array, limit: float) -> bool:
    """Whether one interval holds all of a push: it was an impact, and the ground or the shape is
    not where it is specified.
    """
    sizes = numpy.einsum("ni,ni->n", jumps, jumps)
    largest = int(sizes.argmax())
    rest = numpy.sum(jumps, axis=0) - jumps[largest]
    return bool(sizes[largest] > limit >= 0.5 * float(rest @ rest))


def _near(states: BodyStates, lifts: Array, ground: GroundPlane, position_noise: float) -> Array:
    """Intervals in which the body can reach the ground: the gap is within one interval's way."""
    steps = numpy.diff(states.time)
    rates = abs(numpy.diff(lifts)) / steps
    fastest = abs(states.velocity @ ground.normal)
    reach = 2.0 * steps * (numpy.maximum(fastest[1:], fastest[:-1]) + rates) + 6.0 * position_noise + 1e-9
    return numpy.asarray(numpy.minimum(lifts[1:], lifts[:-1]) <= reach)


def _runs(hit: Array) -> tuple[list[tuple[int, int]], list[tuple[int, int]]]:
    """Runs of samples between hits, and runs of hits."""
    edges = numpy.flatnonzero(numpy.diff(numpy.concatenate([[0], hit.astype(int), [0]])))
    contacts = [(int(first), int(last) - 1) for first, last in edges.reshape(-1, 2)]
    begins = [0, *(last + 1 for _, last in contacts)]
    ends = [*(first for first, _ in contacts), len(hit)]
    return list(zip(begins, ends, strict=True)), contacts


def _jumps(states: BodyStates, gravity: float) -> Array:
    falling = numpy.diff(states.time)[:, None] * gravity * UP
    return numpy.asarray(numpy.diff(states.velocity, axis=0) + falling)


def _pushes(states: BodyStates, wrench: ExternalWrench) -> Array:
    if wrench.force is None:
        return numpy.zeros((len(states.time) - 1, 3))
    pushes: Array = numpy.diff(wrench.push(float(states.time[0]), states.time), axis=0)
    return pushes
