"""Whether the flights fall as gravity and the known wrench say: the acceleration that they have besides.

Position and velocity of the samples of a flight differ from those of the model by `c0 + c1 t + a t^2 / 2` and `c1 + a t` where an
acceleration a is missing in it. Least squares of each flight, weighted by the noise; the mean of all flights, weighted by theirs.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy

from .problem import Problem
from .rotation import Array
from .stacked import Estimate

__all__ = ["FEWEST", "MissingAcceleration", "extra_acceleration", "missing_acceleration"]

FEWEST = 4  # samples of a flight that tells an acceleration


class MissingAcceleration(NamedTuple):
    """Acceleration of the centre of mass in flight beyond that of the model."""

    value: Array  # [3], [m/s^2], world axes
    deviation: float  # standard deviation of a component, [m/s^2]; infinite where no flight tells
    longest: float  # [s], of the flights


def missing_acceleration(found: Estimate, problem: Problem) -> MissingAcceleration:
    """Mean over all flights of what `found` leaves of their samples."""
    total: Array = numpy.zeros(3)
    weights, longest = 0.0, 0.0
    for (first, last), rest in zip(problem.flights, found.residuals, strict=True):
        if last - first + 1 < FEWEST:
            continue
        time = problem.states.time[first : last + 1]
        spreads = problem.noise.position, problem.noise.velocity
        value, weight = extra_acceleration(time - time[0], rest[:, :3], rest[:, 3:6], *spreads)
        total = total + weight * value
        weights, longest = weights + weight, max(longest, float(time[-1] - time[0]))
    if weights == 0.0:
        return MissingAcceleration(numpy.zeros(3), numpy.inf, 0.0)
    return MissingAcceleration(total / weights, 1.0 / float(numpy.sqrt(weights)), longest)


def extra_acceleration(
    time: Array, places: Array, rates: Array, place_noise: float, rate_noise: float
) -> tuple[Array, float]:
    """Acceleration [3] in what is left of places and of their rates [n, 3] at `time` [n], and one over its variance."""
    spreads = numpy.repeat([place_noise, rate_noise], len(time))
    one, nothing = numpy.ones_like(time), numpy.zeros_like(time)
    columns = [
        numpy.concatenate(pair) / spreads for pair in ((one, nothing), (time, one), (0.5 * time**2, time))
    ]  # fmt: skip
    orthogonal, triangle = numpy.linalg.qr(numpy.stack(columns, axis=1))
    measured = numpy.concatenate([places, rates]) / spreads[:, None]
    return numpy.asarray(orthogonal[:, 2] @ measured / triangle[2, 2]), float(triangle[2, 2] ** 2)
