"""Lame curve through scattered contact points: the fit of `pressure/closed_form/lame.py` to their
convex hull.

Taken are the corners of the hull and the points on its sides, about the centroid of the hull. A
hull is convex, so the exponent comes out at 1 or above but for scatter; concave domains need the
cells (`lame.fit_patch`). Points inside the true border, as those of a coarse lattice, give half
axes that are short by up to one spacing.

Source: Driver and Seat eqs 4 and 5, figure 3.
"""

from __future__ import annotations

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.jit import entry, kernel
from contact_sim_pkg.pressure.closed_form.lame import LameFit, fit_centred

__all__ = ["FEWEST_POINTS", "fit_points", "hull"]

Field = NDArray[numpy.float64]

FEWEST_POINTS = 5
"""With fewer on the hull the half axes and the exponent cannot be distinguished."""

FLAT = 1e-9
"""Of the hull's extent: how far from a side a point may lie and still be on it."""


def fit_points(points: Field) -> LameFit:
    """Lame curve through contact points [points, 2], x and y [m].

    With fewer than 5 points on the hull, or all on one line: half extents, n = 2 and `fitted`
    False; without points a curve of size 0 at the origin. Raises `ValueError` for a wrong shape and
    values that are not finite.
    """
    points = numpy.asarray(points, dtype=float)
    if points.ndim != 2 or points.shape[1] != 2:
        raise ValueError(f"Lame fit: points have the shape {points.shape}, it must be (points, 2)")
    if not numpy.isfinite(points).all():
        raise ValueError("Lame fit: a contact point is not a finite number")
    if points.shape[0] == 0:
        return LameFit(0.0, 0.0, 2.0, 0.0, 0.0, 0.0, False)
    low, high = points.min(axis=0), points.max(axis=0)
    # Too few corners, or a hull without area: its half extents
    border = hull(points)
    half, centre = 0.5 * (high - low), 0.5 * (low + high)
    area, centroid = _centroid(border)
    if len(border) < FEWEST_POINTS or not area > FLAT * half[0] * half[1]:
        return LameFit(float(half[0]), float(half[1]), 2.0, float(centre[0]), float(centre[1]), 0.0, False)
    # The exponent about the centroid, from the extents of the hull on
    x, y = border.T.copy()
    start = abs(border - centroid).max(axis=0)
    return fit_centred(x, y, float(start[0]), float(start[1]), float(centroid[0]), float(centroid[1]))


def hull(points: Field) -> Field:
    """Corners of the convex hull and the points on its sides, anticlockwise [points, 2] (Andrew's
    monotone chain).
    """
    points = numpy.asarray(points, dtype=float)
    ordered = points[numpy.lexsort((points[:, 1], points[:, 0]))]
    new = numpy.ones(len(ordered), dtype=bool)
    new[1:] = (ordered[1:] != ordered[:-1]).any(axis=1)
    ordered = numpy.ascontiguousarray(ordered[new])
    if len(ordered) < 3:
        return ordered
    extent = ordered.max(axis=0) - ordered.min(axis=0)
    slack = FLAT * float(extent[0] * extent[1])
    chain = numpy.empty(2 * len(ordered), dtype=numpy.int64)
    border = ordered[chain[: monotone_chain(ordered, slack, chain)]]
    # Points that all lie on one line are on the way there and on the way back.
    return border if _centroid(border)[0] > slack else ordered


@entry
def monotone_chain(ordered: Field, slack: float, chain: NDArray[numpy.int64]) -> int:
    """Write the rows of `ordered` [points, 2] (by x, then y) that lie on the hull into `chain` [2
    points + 1]; returns their number.

    slack: twice an area [m^2].
    """
    count = one_side(ordered, 0, 1, slack, chain, 0) - 1
    return one_side(ordered, ordered.shape[0] - 1, -1, slack, chain, count) - 1


@kernel
def one_side(ordered: Field, first: int, step: int, slack: float, chain: NDArray[numpy.int64], start: int) -> int:
    """Append the lower side (step 1) or the upper side (step -1) of the hull to `chain`, from
    `start` on; returns the end.

    ordered: [points, 2] [m] by x, then y; slack: twice an area [m^2], by which no corner turns
    right.
    """
    count = start
    for k in range(ordered.shape[0]):
        row = first + step * k
        while count > start + 1 and turn(ordered, chain[count - 2], chain[count - 1], row) < -slack:
            count -= 1
        chain[count] = row
        count += 1
    return count


@kernel
def turn(points: Field, first: int, middle: int, last: int) -> float:
    """Twice the area of a triangle [m^2], positive for a turn to the left."""
    to_middle_x, to_middle_y = points[middle, 0] - points[first, 0], points[middle, 1] - points[first, 1]
    to_last_x, to_last_y = points[last, 0] - points[first, 0], points[last, 1] - points[first, 1]
    return float(to_middle_x * to_last_y - to_middle_y * to_last_x)


def _centroid(border: Field) -> tuple[float, Field]:
    """Area [m^2] and centroid [m] of a polygon, corners anticlockwise."""
    origin = border[0]
    x, y = (border - origin).T
    next_x, next_y = numpy.roll(x, -1), numpy.roll(y, -1)
    cross = x * next_y - next_x * y
    area = 0.5 * float(cross.sum())
    if area <= 0.0:
        return 0.0, origin
    first = numpy.array([((x + next_x) * cross).sum(), ((y + next_y) * cross).sum()])
    return area, origin + first / (6.0 * area)
