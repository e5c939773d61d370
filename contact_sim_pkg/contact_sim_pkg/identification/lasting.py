"""Steps of a lasting contact: each interval gives one balance (identifiability paper, eq 39 corrected)."""

from __future__ import annotations

import numpy

from .geometry import gaps
from .problem import Contact, Problem
from .rotation import Array
from .segments import LONGEST_IMPACT, Segments

__all__ = ["with_steps"]

MOST = 60  # steps taken, evenly spread
APART = 1e-3  # of the body's size: the next corner must be this much higher
SIGMAS = 6.0


def with_steps(problem: Problem, parts: Segments) -> Problem:
    """The problem with the steps of all lasting contacts on one corner: a flight of one sample at each end of a step."""
    steps = [
        step for first, last in parts.contacts if last - first + 1 > LONGEST_IMPACT for step in range(first + 1, last)
    ]
    steps = [step for step in steps if _one_corner(problem, step)]
    if len(steps) > MOST:
        steps = [steps[place] for place in numpy.linspace(0, len(steps) - 1, MOST).round().astype(int)]
    flights, contacts, time = list(problem.flights), list(problem.contacts), problem.states.time
    numbers: dict[int, int] = {}
    for step in steps:
        for sample in (step, step + 1):
            if sample not in numbers:
                numbers[sample] = len(flights)
                flights.append((sample, sample))
        point = int(_heights(problem, step).argmin())
        contacts.append(Contact(numbers[step], numbers[step + 1], float(time[step]), float(time[step + 1]), point))
    return problem._replace(flights=flights, contacts=contacts)


def _heights(problem: Problem, sample: int) -> Array:
    states = problem.states
    return gaps(problem.shape, problem.ground, states.position[sample], states.rotation[sample])


def _one_corner(problem: Problem, step: int) -> bool:
    """Whether the same corner, and no other, is down at both ends of a step."""
    ends = [_heights(problem, sample) for sample in (step, step + 1)]
    if len(ends[0]) == 1:
        return True
    size = float(numpy.ptp(problem.shape.points))
    second = min(float(numpy.partition(end, 1)[1] - end.min()) for end in ends)
    same = ends[0].argmin() == ends[1].argmin()
    return bool(same and second > APART * size + SIGMAS * problem.noise.position)
