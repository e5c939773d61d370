"""Between what a fitted parameter lies, and which parameters a recording does not tell apart.

The interval of a parameter ends where the least square over all others has grown by ``t(0.95)^2 s^2``: its profile. The linear
one, ``t s sqrt((J^T J)^-1)``, is where that is sought first, along the covariance; a run there says whether it bends.

A direction in which the parameters move nothing more than differences of two steps disagree is not seen.

Source: Bates and Watts, Nonlinear Regression Analysis and Its Applications (1988), section 6.1.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.sweep.least_squares import STEP, At, Minimum, slopes

__all__ = ["LEVEL", "Interval", "intervals", "unidentified"]

Field = NDArray[numpy.float64]
LEVEL = 0.90
STRAIGHT = 0.05
"""Of an interval's half, that the profile may miss the linear one by."""
UNSEEN = 3.0
"""Times that by which differences of two steps disagree: what moves the residual less is not seen."""
NAMED = 0.3
"""Share of a parameter in an unseen direction of length 1."""
MOST_TRIED = 4
"""Of places on one side of a profile."""


class Interval(NamedTuple):
    """Of a parameter in the measure of its range; an end beyond it is not looked at and stays linear."""

    low: float
    high: float


def unidentified(at: At, found: Minimum, scatter: float) -> NDArray[numpy.bool_]:
    """Of each parameter, whether it lies in a direction in which nothing is seen: differences of two steps disagree by
    as much as they are, or the interval is wider than the range.
    """
    disagreement = slopes(at, found.place, 2.0 * STEP) - found.slope
    _left, sizes, directions = numpy.linalg.svd(found.slope, full_matrices=False)
    blind = numpy.zeros(found.place.size, dtype=bool)
    for size, direction in zip(sizes, directions, strict=True):
        unsure = UNSEEN * float(numpy.linalg.norm(disagreement @ direction))
        if size <= unsure or (math.isfinite(scatter) and 2.0 * scatter > size):
            blind |= abs(direction) > NAMED
    return blind


def intervals(at: At, found: Minimum, scatter: float, quantile: float) -> tuple[list[Interval], Field]:
    """Intervals of all parameters, and the place with the least square that was met.

    Args:
        at: the residual.
        found: its least squares.
        scatter: s of a residual by chance.
        quantile: t.
    """
    covariance = numpy.asarray(scatter**2 * numpy.linalg.inv(found.slope.T @ found.slope), float)
    best = [(found.square, found.place)]
    ends = [
        [_end(at, found, covariance, i, side, scatter, quantile, best) for side in (-1.0, 1.0)]
        for i in range(found.place.size)
    ]
    return [Interval(*both) for both in ends], min(best, key=lambda each: each[0])[1]


def _end(
    at: At, found: Minimum, covariance: Field, i: int, side: float, scatter: float, quantile: float,
    best: list[tuple[float, Field]],
) -> float:  # fmt: skip
    """Where the profile of a parameter ends on one side."""
    deviation = math.sqrt(covariance[i, i])
    along = side * covariance[:, i] / covariance[i, i]  # of all parameters, by 1 of this one
    others = numpy.delete(numpy.arange(found.place.size), i)
    way = quantile * deviation
    # Signed root of the growth over the way: straight for a linear model, so the next way follows from those before
    known = [(0.0, 0.0)]
    for _ in range(MOST_TRIED):
        place = found.place + way * along
        if not ((place >= 0.0) & (place <= 1.0)).all():
            return float(found.place[i] + side * way)
        square, place = _least_beside(at, place, found.slope[:, others], others, scatter)
        best.append((square, place))
        known.append((way, math.sqrt(max(square - found.square, 0.0)) / scatter))
        following = _way_to(known, quantile, 1.0 / deviation)
        if abs(following / way - 1.0) <= STRAIGHT:
            return float(found.place[i] + side * following)
        way = following
    return float(found.place[i] + side * way)


def _least_beside(
    at: At, place: Field, slope: Field, others: NDArray[numpy.int_], scatter: float
) -> tuple[float, Field]:
    """The least square with one parameter held, by one step of the others where that gains what chance could tell."""
    (left,) = at([place])
    if others.size:
        step, *_ = numpy.linalg.lstsq(slope, -left, rcond=None)
        gain = float(left @ left) - float(numpy.sum((left + slope @ step) ** 2))
        if gain > 0.1 * scatter**2:
            moved = place.copy()
            moved[others] = numpy.clip(place[others] + step, 0.0, 1.0)
            (there,) = at([moved])
            if there @ there < left @ left:
                place, left = moved, there
    return float(left @ left), place


def _way_to(known: Sequence[tuple[float, float]], quantile: float, slope: float) -> float:
    """Where a profile reaches the quantile: on the parabola with the linear slope through one place, straight through the
    last two of several; at most twice as far as looked.
    """
    (before, under), (way, reached) = known[-2:]
    if len(known) == 2:
        bend = (reached - slope * way) / way**2
        root = slope**2 + 4.0 * bend * quantile
        found = 2.0 * quantile / (slope + math.sqrt(root)) if root > 0.0 else 2.0 * way
    else:
        rise = (reached - under) / (way - before) if way != before else 0.0
        found = way + (quantile - reached) / rise if rise > 0.0 else 2.0 * way
    return min(max(found, 0.3 * way), 2.0 * way)
