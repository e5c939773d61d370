"""Where a fit begins, and other places that it may end at: least squares that chance lets be as good as the least one."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.sweep.least_squares import ROUGH, At, Minimum, minimum
from contact_sim_pkg.sweep.variation import Variation, samples_of

__all__ = ["as_good", "far_starts", "followed", "starts"]

Field = NDArray[numpy.float64]
STARTS = 4
"""Cases a parameter, drawn over the ranges, of which the best is the start."""
FOLLOWED = 2
"""Further ones that are followed to where they lead."""
AWAY = 0.2
"""Of the ranges' diagonal, that starts which are followed lie from each other."""
FAR = 10.0
"""Times what chance lets a square grow by, that a short part, or a rough minimum, may err by."""
STRAIGHT = 0.5
"""Of a residual's change from a minimum to a start, that slopes may miss."""
APART = 3.0
"""Half intervals, that two minima lie from each other."""


def starts(at: At, count: int) -> list[Field]:
    """The middle of the ranges of ``count`` keys and `STARTS` cases a key, the least square first."""
    unit = [Variation(str(i), (), 0.0, 1.0) for i in range(count)]
    drawn = samples_of(unit, f"lhs:{STARTS * count}", 0, 1)
    places = [numpy.full(count, 0.5), *(numpy.array([float(each[str(i)]) for i in range(count)]) for each in drawn)]
    squares = [float(each @ each) for each in at(places)]
    return [places[i] for i in numpy.argsort(squares, kind="stable")]


def far_starts(at: At, sorted_places: Sequence[Field], found: Minimum) -> list[Field]:
    """The best of the starts that lie apart from each other, and from a minimum whose slopes do not explain them: where a
    residual is nearly straight from there, there is no other minimum between.
    """
    kept = [sorted_places[0], found.place]
    for place, left in zip(sorted_places[1:], at(sorted_places[1:]), strict=True):
        missed = left - found.left - found.slope @ (place - found.place)
        is_explained = float(numpy.linalg.norm(missed)) < STRAIGHT * float(numpy.linalg.norm(left - found.left))
        is_far = all(float(numpy.linalg.norm(place - each)) > AWAY * math.sqrt(place.size) for each in kept)
        if is_far and not is_explained:
            kept.append(place)
    return kept[2 : 2 + FOLLOWED]


def followed(at: At, places: Sequence[Field], found: Minimum, least: float = 0.0) -> list[Minimum]:
    """Where these lead, of which `as_good` may come; roughly."""
    led = [minimum(at, place, ROUGH, least) for place in places]
    chance = max(found.square / max(found.freedom, 1), least**2)
    return [
        each
        for each in led
        if each.square - found.square <= FAR * chance and _apart(each, found, math.sqrt(chance), 1.0)
    ]


def as_good(others: Sequence[Minimum], found: Minimum, scatter: float, quantile: float) -> list[Minimum]:
    """Those whose square is within the threshold of an interval, ``quantile² scatter²``, each once, and not the least one."""
    kept: list[Minimum] = []
    for each in sorted(others, key=lambda other: other.square):
        is_near = each.square - found.square <= (quantile * scatter) ** 2
        if is_near and all(_apart(each, other, scatter, quantile) for other in [found, *kept]):
            kept.append(each)
    return kept


def _apart(one: Minimum, other: Minimum, scatter: float, quantile: float) -> bool:
    """Whether two minima are two: further from each other than both of their linear intervals reach."""
    way = one.place - other.place
    return all(float(numpy.linalg.norm(each.slope @ way)) > APART * quantile * scatter for each in (one, other))
