"""Whether impacts happen where the ground is: the gap of the lowest point in the interval that
holds the impact.

The contact of an impact lies between the last sample of the flight before and the first of the
flight after. Where the gap has its root just outside, within what the noise of one flight may do,
the gap that is left at the end of the interval counts against its deviation; the mean of many
impacts shows a shape or a ground that is wrong by less than a single one could.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.identify.contact.stacked import ParameterEstimate
from contact_sim_pkg.identify.geometry import gaps, size
from contact_sim_pkg.identify.motion.flight import state_at
from contact_sim_pkg.identify.motion.rotation import Array
from contact_sim_pkg.identify.problem import ContactSpan, IdentificationProblem

__all__ = ["MeanGap", "gap_deviation", "mean_gap"]

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
