"""Volume, centre of mass and inertia of a homogeneous convex hull, in the plane and in space.

The hull is cut into simplices from one point: ``integral x x' = d V (S S' + sum p p') /
((n+1)(n+2))`` over a simplex of corners p, S their sum, n the dimension.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
import scipy  # its parts are imported on use: they take 0.1 to 0.3 s
from numpy.typing import NDArray

__all__ = ["Hull", "homogeneous_hull"]

Array = NDArray[numpy.float64]


class Hull(NamedTuple):
    """A hull in principal axes about its centre of mass."""

    volume: float  # [m^2] in the plane, [m^3] in space
    centre: Array  # [n] of mass, as the points were given
    # [n, n] principal axes as columns, as the points were given; the unit matrix in the plane
    axes: Array
    corners: Array  # [corners, n] from the centre, in principal axes
    inertia: Array  # [1] or [3] in [kg m^2]


def homogeneous_hull(points: list[list[float]], mass: float) -> Hull:
    """Hull of ``points`` [m] with ``mass`` [kg]; ArithmeticError where they span no volume."""
    given = numpy.array(points, dtype=numpy.float64)
    size = given.shape[1]
    try:
        hull = scipy.spatial.ConvexHull(given)
    except (scipy.spatial.QhullError, ValueError):
        raise ArithmeticError("the points span no volume") from None
    middle = given.mean(axis=0)
    volume, first, second = 0.0, numpy.zeros(size), numpy.zeros((size, size))
    # volume and moments of the simplices about the middle of the points
    for simplex in hull.simplices:
        corners = given[simplex] - middle
        part = abs(float(numpy.linalg.det(corners))) / math.factorial(size)
        total = corners.sum(axis=0)
        volume += part
        first += part * total / (size + 1)
        second += part * (numpy.outer(total, total) + corners.T @ corners) / ((size + 1) * (size + 2))
    centre = first / volume
    # second moments about the centre of mass; the principal axes are right-handed
    spread = mass * (second / volume - numpy.outer(centre, centre))
    outer = given[hull.vertices] - middle - centre
    if size == 2:
        return Hull(volume, middle + centre, numpy.eye(2), outer, numpy.array([float(numpy.trace(spread))]))
    inertia, axes = numpy.linalg.eigh(numpy.trace(spread) * numpy.eye(3) - spread)
    if numpy.linalg.det(axes) < 0.0:
        axes[:, 0] *= -1.0
    return Hull(volume, middle + centre, axes, outer @ axes, inertia)
