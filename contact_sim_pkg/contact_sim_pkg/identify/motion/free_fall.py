"""Whether the flights fall as gravity and the known wrench say: the acceleration that they have
besides.

Position and velocity of the samples of a flight differ from those of the model by `c0 + c1 t + a
t^2 / 2` and `c1 + a t` where an acceleration a is missing in it. Least squares of each flight,
weighted by the noise; the mean of all flights, weighted by theirs.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.identify.contact.stacked import ParameterEstimate
from contact_sim_pkg.identify.diagnostics.noise import sample_noise
from contact_sim_pkg.identify.motion.rotation import Array
from contact_sim_pkg.identify.motion.states import SampleNoise
from contact_sim_pkg.identify.problem import IdentificationProblem

__all__ = ["FEWEST", "MissingAcceleration", "long_flights", "mean_over_flights", "missing_acceleration"]

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
