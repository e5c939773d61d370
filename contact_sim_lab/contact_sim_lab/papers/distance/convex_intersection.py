"""Polyhedra, and what several convex bodies share, with the point inside that the searches start
from.

That point is the centre of the largest ball inside (`papers/distance/largest_ball.py`), bounded by
a box for bodies without bounds.

Source: Driver and Seat eqs 1 and 2 (bounding surface constraints).
"""

from __future__ import annotations

import numpy
from numpy.typing import ArrayLike, NDArray

from contact_sim_lab.papers.distance.convex_body import BodyError, ConvexBody, box, joined, planes
from contact_sim_lab.papers.distance.largest_ball import largest_ball

__all__ = ["intersection", "polyhedron"]

Field = NDArray[numpy.float64]

SEARCH_BOXES = (10.0, 1e3, 1e5)
"""Half sides, in units of the body's size, of the boxes in which the point inside is looked for,
one after the other.
"""

SMALLEST_INSIDE = 1e-9
"""Radius that a ball inside must have, relative to the body's size."""


def polyhedron(normals: ArrayLike, offsets: ArrayLike) -> ConvexBody:
    """All of `n_i^T p <= o_i` [m], n_i the unit vectors along `normals` [planes, 3]; it may be
    unbounded.

    Raises `BodyError` where it is empty or flat.
    """
    directions, bounds = numpy.asarray(normals, dtype=float), numpy.asarray(offsets, dtype=float)
    if bounds.ndim != 1 or bounds.size == 0 or directions.shape != (bounds.size, 3):
        raise BodyError(
            f"convex body: normals {directions.shape} and offsets {bounds.shape} must be [planes, 3], [planes]"
        )
    lengths = numpy.linalg.norm(directions, axis=1)
    if not (numpy.isfinite(lengths) & (lengths > 0.0) & numpy.isfinite(bounds)).all():
        raise BodyError("convex body: a plane has a normal or an offset that is zero or not finite")
    return _with_inside(planes(directions / lengths[:, None], bounds, numpy.zeros(3)))


def intersection(*bodies: ConvexBody) -> ConvexBody:
    """What all the bodies share. Raises `BodyError` where that is empty or flat."""
    if not bodies:
        raise BodyError("convex body: an intersection needs at least one body")
    return _with_inside(joined(bodies))


def _with_inside(body: ConvexBody) -> ConvexBody:
    origin, size = body.inside, _size(body)
    for share in SEARCH_BOXES:
        ball = largest_ball(body, box(origin, numpy.full(3, share * size)), origin, size)
        if ball.radius > SMALLEST_INSIDE * size:
            return body._replace(inside=ball.centre)
    raise BodyError("convex body: it is empty or flat, its constraints leave no inside")


def _size(body: ConvexBody) -> float:
    """A length of the order of the body [m]."""
    axes = body.half_axes[numpy.isfinite(body.half_axes)]
    away = numpy.linalg.norm(body.centres - body.inside, axis=1)
    deep = abs(body.offsets - body.normals @ body.inside)
    return float(max([0.0, *axes, *away, *deep])) or 1.0
