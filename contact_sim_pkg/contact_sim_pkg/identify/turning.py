"""Whether rotation and spin of the flights belong together, and turn as inertia and the known
torque say.

What `found` leaves of them is measured minus model, in world axes: small rotations r and spins s.
Where an angular acceleration a is missing in the model, r and s are `c0 + c1 t + a t^2 / 2` and `c1
+ a t`, as for position and velocity (`identify/turning.py`). Where the spin is recorded
1/k times too fast, the rate of r along the spin less s is `(k - 1) w`, whatever the model has made
of both: in space to first order in k - 1, of a spin whose axis hardly turns within a flight.

Whether the flights fall as gravity and the known wrench say: the acceleration that they have
besides.

Position and velocity of the samples of a flight differ from those of the model by `c0 + c1 t + a
t^2 / 2` and `c1 + a t` where an acceleration a is missing in it. Least squares of each flight,
weighted by the noise; the mean of all flights, weighted by theirs.

Whether impacts happen where the ground is: the gap of the lowest point in the interval that
holds the impact.

The contact of an impact lies between the last sample of the flight before and the first of the
flight after. Where the gap has its root just outside, within what the noise of one flight may do,
the gap that is left at the end of the interval counts against its deviation; the mean of many
impacts shows a shape or a ground that is wrong by less than a single one could.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.identify.contact.noise import first_guess, sample_noise
from contact_sim_pkg.identify.contact.stacked import ParameterEstimate
from contact_sim_pkg.identify.motion.flight import state_at
from contact_sim_pkg.identify.motion.geometry import gaps, size
from contact_sim_pkg.identify.motion.rotation import Array, logarithm
from contact_sim_pkg.identify.motion.states import BodyStates, SampleNoise
from contact_sim_pkg.identify.problem import ContactSpan, IdentificationProblem

__all__ = [
    "FEWEST",
    "MeanGap",
    "MissingAcceleration",
    "SpinScale",
    "gap_deviation",
    "long_flights",
    "mean_gap",
    "mean_over_flights",
    "missing_acceleration",
    "missing_spin_rate",
    "rate_of_turn",
    "spin_scale",
]


ROUGH = 5.0  # times the noise of neighbouring samples: what flights leave beyond that is no noise
SIGNIFICANT = 20.0  # times its noise: a spin that identifies a rate of rotation
TURN = 0.2  # [rad] by the spin, over which rotations are compared
ROTATION = 6  # column of what is left, of 12


class SpinScale(NamedTuple):
    """By how much faster than the spin says the rotations turn."""

    excess: float  # k - 1
    deviation: float  # standard deviation; infinite where no flight identifies it


def missing_spin_rate(found: ParameterEstimate, problem: IdentificationProblem) -> MissingAcceleration:
    """Angular acceleration of all flights beyond that of the model, [rad/s^2], world axes."""
    return mean_over_flights(found, problem, ROTATION, _noise(problem))


def spin_scale(found: ParameterEstimate, problem: IdentificationProblem) -> SpinScale:
    """k - 1, where the rotations of the flights turn k times as fast as the spin says."""
    noise, total, weights = _noise(problem), 0.0, 0.0
    for run, rest in long_flights(found, problem):
        turns, spins = rest[:, ROTATION : ROTATION + 3], rest[:, ROTATION + 3 :]
        spin = problem.states.angular_velocity[run] - spins
        speed = numpy.linalg.norm(spin, axis=1)
        if not (speed > 0.0).all():
            continue
        along, time = spin / speed[:, None], problem.states.time[run]
        centred, size = time - time.mean(), float(speed.mean())
        lever = float(centred @ centred)
        # Rate at which the rotations run ahead of the spin, along the spin
        rate = float(centred @ numpy.einsum("ni,ni->n", turns, along)) / lever
        excess = rate - float(numpy.einsum("ni,ni->n", spins, along).mean())
        spin_noise = float(sample_noise(noise, problem.rounding, problem.states, run)[ROTATION + 3 :].max())
        weight = 1.0 / (noise.rotation**2 / lever + spin_noise**2 / len(time))
        total, weights = total + weight * size * excess, weights + weight * size**2
    if weights == 0.0:
        return SpinScale(0.0, numpy.inf)
    return SpinScale(total / weights, 1.0 / float(numpy.sqrt(weights)))


def rate_of_turn(states: BodyStates, noise: float) -> float | None:
    """How many times as fast as the spin says the rotations turn: a median over spans of TURN; None
    where that is open.

    Before any flight is known: for spins in another unit. It needs spins of SIGNIFICANT times their
    `noise` [rad/s], and a radian in all. Spans of a turn that shows beside rounded rotations.
    """
    if len(states.time) < FEWEST:
        return None
    steps, spin = numpy.diff(states.time), 0.5 * (states.angular_velocity[1:] + states.angular_velocity[:-1])
    speed = numpy.linalg.norm(spin, axis=1)
    usual, total = float(numpy.median(speed)), float(speed @ steps)
    if total < 1.0 or usual < SIGNIFICANT * noise:
        return None
    span = min(max(1, round(TURN * len(steps) / total)), len(steps) // 2)
    # Rotation over each span: by the spins, and by the rotations
    recorded = numpy.concatenate([numpy.zeros((1, 3)), numpy.cumsum(spin * steps[:, None], axis=0)])
    recorded = recorded[span:] - recorded[:-span]
    turns = logarithm(states.rotation[span:] @ numpy.swapaxes(states.rotation[:-span], -1, -2))
    squares = numpy.einsum("ni,ni->n", recorded, recorded)
    fast = squares >= numpy.median(squares)
    return float(numpy.median(numpy.einsum("ni,ni->n", turns, recorded)[fast] / squares[fast]))


def _noise(problem: IdentificationProblem) -> SampleNoise:
    """Of rotation and spin that of the flights, but no more than ROUGH times that of neighbours,
    which no misfit raises.
    """
    rough, noise = first_guess(problem.states), problem.noise
    return noise._replace(
        rotation=min(noise.rotation, ROUGH * rough.rotation),
        angular_velocity=min(noise.angular_velocity, ROUGH * rough.angular_velocity),
    )


FEWEST = 4  # samples of a flight that identifies an acceleration


class MissingAcceleration(NamedTuple):
    """Acceleration in flight beyond that of the model."""

    value: Array  # [3], [m/s^2] or [rad/s^2], world axes
    deviation: float  # standard deviation of a component; infinite where no flight identifies it
    longest: float  # [s], of the flights


def missing_acceleration(found: ParameterEstimate, problem: IdentificationProblem) -> MissingAcceleration:
    """Of the centre of mass: mean over all flights of what `found` leaves of their positions and
    velocities.
    """
    return mean_over_flights(found, problem, 0, problem.noise)


def mean_over_flights(
    found: ParameterEstimate, problem: IdentificationProblem, first: int, noise: SampleNoise
) -> MissingAcceleration:
    """Of the places in the columns `first` to `first` + 2 of what is left [n, 12], and of their
    rates in the next three.

    `noise`: of the samples; with what rounding they share.
    """
    total: Array = numpy.zeros(3)
    weights, longest = 0.0, 0.0
    for run, rest in long_flights(found, problem):
        time = problem.states.time[run] - problem.states.time[run.start]
        columns = slice(first, first + 6)
        # Of the three axes the largest: one weight a flight
        spreads = sample_noise(noise, problem.rounding, problem.states, run)[columns].reshape(2, 3).max(axis=1)
        value, weight = _of_flight(time, rest[:, columns], spreads)
        total = total + weight * value
        weights, longest = weights + weight, max(longest, float(time[-1]))
    if weights == 0.0:
        return MissingAcceleration(numpy.zeros(3), numpy.inf, 0.0)
    return MissingAcceleration(total / weights, 1.0 / float(numpy.sqrt(weights)), longest)


def long_flights(found: ParameterEstimate, problem: IdentificationProblem) -> list[tuple[slice, Array]]:
    """Samples of each flight of FEWEST samples or more, and what is left of them [n, 12]."""
    pairs = zip(problem.flights, found.residuals, strict=True)
    return [(slice(first, last + 1), rest) for (first, last), rest in pairs if last - first + 1 >= FEWEST]


def _of_flight(time: Array, rest: Array, noise: Array) -> tuple[Array, float]:
    """Acceleration [3] in what is left of places and rates [n, 6], of this noise [2], at `time`
    [n], and one over its variance.
    """
    spreads = numpy.repeat(noise, len(time))
    one, nothing = numpy.ones_like(time), numpy.zeros_like(time)
    columns = [
        numpy.concatenate(pair) / spreads for pair in ((one, nothing), (time, one), (0.5 * time**2, time))
    ]  # fmt: skip
    orthogonal, triangle = numpy.linalg.qr(numpy.stack(columns, axis=1))
    measured = numpy.concatenate([rest[:, :3], rest[:, 3:]]) / spreads[:, None]
    return numpy.asarray(orthogonal[:, 2] @ measured / triangle[2, 2]), float(triangle[2, 2] ** 2)


FINEST = (
    1e-4  # of the body's size: deviation below which no gap is reported, of impacts that are short instead of instants
)


class MeanGap(NamedTuple):
    """Weighted mean of the gaps at the impacts."""

    value: float  # [m]; below zero: the body as specified is in the ground
    deviation: float  # [m]; infinite where there is no impact


def gap_deviation(problem: IdentificationProblem, flight: int) -> float:
    """Standard deviation of the gap of a point on a fitted flight, [m]."""
    noise, (first, last) = problem.noise, problem.flights[flight]
    return 2.0 * (noise.position + size(problem.shape) * noise.rotation) / float(numpy.sqrt(last - first + 1))


def mean_gap(found: ParameterEstimate, problem: IdentificationProblem) -> MeanGap:
    """Of all contacts of a single interval."""
    weights, total, least = 0.0, 0.0, FINEST * size(problem.shape)
    for contact in problem.contacts:
        begin, end = problem.flights[contact.before][1], problem.flights[contact.after][0]
        if end == begin + 1:
            weight = (gap_deviation(problem, contact.before) ** 2 + least**2) ** -1.0
            gap = _gap(found, problem, contact, problem.states.time[[begin, end]])
            weights, total = weights + weight, total + weight * gap
    if weights == 0.0:
        return MeanGap(0.0, numpy.inf)
    return MeanGap(total / weights, 1.0 / float(numpy.sqrt(weights)))


def _gap(found: ParameterEstimate, problem: IdentificationProblem, contact: ContactSpan, interval: Array) -> float:
    """Gap of the contact's point on the flight before, at its begin or at the end of the interval
    that is next to it, [m].
    """
    time = float(numpy.clip(contact.begin, *interval))
    if time == contact.begin:
        return 0.0
    state = state_at(found.flights[contact.before], found.parameters, problem.model, time)
    return float(gaps(problem.shape, problem.ground, state.position[None], state.rotation[None])[0, contact.point])
