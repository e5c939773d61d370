"""Shape of the body and of the ground: gaps and arms of contact.

A body is the convex hull of points in body axes (origin: centre of mass), grown by a radius: box,
polygon, hull (radius 0), sphere (one point). The ground is a plane. Gap of point i: `phi_i = n.(x +
R p_i) - radius - height`.

Source: Identifiability eqs 10, 11 and 40.
"""

from __future__ import annotations

import itertools
from typing import NamedTuple

import numpy
from numpy.typing import ArrayLike

from contact_sim_pkg.identify.errors import IdentificationError
from contact_sim_pkg.identify.motion.rotation import Array

__all__ = [
    "UP",
    "GroundPlane",
    "Shape",
    "arm",
    "arms",
    "box",
    "flattened",
    "gaps",
    "hull",
    "inertia_guess",
    "plane",
    "size",
    "sphere",
]


SMALLEST, LARGEST = 1e-9, 1e6  # [m], size of a body
SAME = 1e-9  # of the size: points closer than that are one
FARTHEST = 1e9  # [m], height of the ground
UP = numpy.array([0.0, 0.0, 1.0])


class Shape(NamedTuple):
    """Points of the hull and the radius that it is grown by."""

    points: Array  # [k, 3], [m], body axes
    radius: float  # [m]


class GroundPlane(NamedTuple):
    """The plane `n.x = height`; n points out of it."""

    normal: Array  # [3], of length 1
    height: float  # [m]


def box(lengths: ArrayLike) -> Shape:
    """Box of the lengths [x, y, z] in [m] along the body axes, its centre of mass in the middle."""
    sides = numpy.asarray(lengths, dtype=numpy.float64)
    if sides.shape != (3,) or not (numpy.isfinite(sides).all() and (sides > 0.0).all()):
        raise IdentificationError(f"a box needs three lengths above 0 m, not {sides.tolist()}")
    return _of_a_size(0.5 * sides * numpy.array(list(itertools.product((-1.0, 1.0), repeat=3))), 0.0)


def sphere(radius: float) -> Shape:
    """Sphere of `radius` [m] about the centre of mass."""
    if not (numpy.isfinite(radius) and radius > 0.0):
        raise IdentificationError(f"a sphere needs a radius above 0 m, not {radius:g}")
    return _of_a_size(numpy.zeros((1, 3)), float(radius))


def hull(points: ArrayLike, radius: float = 0.0) -> Shape:
    """Hull of the points [k, 3] in [m], body axes from the centre of mass, grown by `radius` >= 0
    [m].
    """
    corners = numpy.asarray(points, dtype=numpy.float64)
    if corners.ndim != 2 or corners.shape[1:] != (3,) or not len(corners) or not numpy.isfinite(corners).all():
        raise IdentificationError(f"a hull needs points of three finite coordinates, not an array of {corners.shape}")
    if not (numpy.isfinite(radius) and radius >= 0.0):
        raise IdentificationError(f"the radius of a hull must be 0 m or more, not {radius:g}")
    return _of_a_size(corners, float(radius))


def _of_a_size(points: Array, radius: float) -> Shape:
    """The shape; IdentificationError where its size is none of a body."""
    largest = float(abs(points).max()) + radius
    if not SMALLEST <= largest <= LARGEST:
        raise IdentificationError(
            f"the surface of a body lies {SMALLEST:g} m to {LARGEST:g} m from its centre of mass, not {largest:.3g} m: give metres"
        )
    return Shape(points, radius)


def plane(normal: ArrayLike = UP, height: float = 0.0) -> GroundPlane:
    """Ground with a normal [x, y, z] of any length above 0, at `height` [m] along it."""
    direction = numpy.asarray(normal, dtype=numpy.float64)
    length = float(numpy.linalg.norm(direction))
    if direction.shape != (3,) or not (numpy.isfinite(length) and length > 0.0 and abs(height) <= FARTHEST):
        raise IdentificationError(
            f"the ground needs a normal that is not zero and a height of at most {FARTHEST:g} m, not {direction.tolist()} and "
            f"{height:g}"
        )
    return GroundPlane(direction / length, float(height))


def gaps(shape: Shape, ground: GroundPlane, position: Array, rotation: Array) -> Array:
    """Gaps [m] of the points [points, 3] of the shape at positions [..., 3] and rotations [..., 3,
    3]: [..., points].

    Negative inside the ground.
    """
    heights = numpy.einsum("i,...ij,kj->...k", ground.normal, rotation, shape.points)
    lift: Array = (position @ ground.normal)[..., None] + heights - shape.radius - ground.height
    return lift


def arm(shape: Shape, ground: GroundPlane, rotation: Array, point: int) -> Array:
    """Vector [x, y, z] in [m] from the centre of mass to the contact of `point`, world axes;
    rotation: [3, 3]."""
    reach: Array = rotation @ shape.points[point] - shape.radius * ground.normal
    return reach


def arms(shape: Shape, ground: GroundPlane, rotation: Array) -> Array:
    """`arm` of all points, [k, 3] in [m]."""
    reaches: Array = shape.points @ rotation.T - shape.radius * ground.normal
    return reaches


def size(shape: Shape) -> float:
    """Largest distance of the surface from the centre of mass in [m]."""
    return float(numpy.linalg.norm(shape.points, axis=1).max()) + shape.radius


def flattened(shape: Shape, axis: Array, angle_error: float = 0.0) -> Shape:
    """The same shape seen along `axis` (body axes): points in the plane through the centre of mass.

    Points that lie behind each other are one, in their middle: an axis that is wrong by
    `angle_error` [rad] separates them by that times their distance along it.
    """
    depths = shape.points @ axis
    flat = shape.points - depths[:, None] * axis
    groups: list[list[int]] = []
    for place in range(len(flat)):
        group = next(
            (each for each in groups if _behind(flat, depths, each[0], place, angle_error, SAME * size(shape))), None
        )
        if group is None:
            groups.append([place])
        else:
            group.append(place)
    return Shape(numpy.array([flat[group].mean(axis=0) for group in groups]), shape.radius)


def _behind(flat: Array, depths: Array, first: int, second: int, angle_error: float, same: float) -> bool:
    """Whether two points are one, seen along the axis."""
    separation = float(numpy.linalg.norm(flat[second] - flat[first]))
    return separation <= same + angle_error * abs(float(depths[second] - depths[first]))


def inertia_guess(shape: Shape) -> Array:
    """I0/m [3, 3] in [m^2] of a homogeneous box around the shape: where a search starts, and the
    size of its unknowns.
    """
    sides = numpy.ptp(shape.points, axis=0) + 2.0 * shape.radius
    return numpy.diag((numpy.sum(sides**2) - sides**2) / 12.0)
