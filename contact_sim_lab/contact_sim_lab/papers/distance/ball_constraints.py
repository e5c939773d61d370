"""What bounds a ball inside two bodies: all their constraints in relative lengths, depths below
them, supporting planes.

Source: Driver and Seat eq 2.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_lab.papers.distance.convex_body import ConvexBody
from contact_sim_lab.papers.distance.ellipsoid import supporting_plane
from contact_sim_pkg.compiled.jit import kernel

__all__ = ["Constraints", "Cuts", "add_cuts", "depth_below", "gather", "least_depth", "make_cuts"]

Field = NDArray[numpy.float64]
Indices = NDArray[numpy.int64]

REFLECTIONS = 8


class Constraints(NamedTuple):
    """Planes first, then quadrics; in each kind those of body 1 first. Lengths from an origin, over
    a size.
    """

    normals: Field  # [planes, 3]
    offsets: Field  # [planes]
    centres: Field  # [quadrics, 3]
    half_axes: Field  # [quadrics, 3]
    rotations: Field  # [quadrics, 3, 3]
    shapes: Field  # [quadrics, 3, 3]
    owners: Indices  # [planes + quadrics] 1 or 2


class Cuts(NamedTuple):
    """Supporting planes, in arrays with room for all rounds; the first `used[0]` are set."""

    normals: Field  # [room, 3]
    offsets: Field  # [room]
    constraints: Indices  # [room] the constraint that each supports
    used: Indices  # [1]


@kernel
def gather(body_1: ConvexBody, body_2: ConvexBody, origin: Field, size: float) -> Constraints:
    """The constraints of both bodies.

    origin: [3] [m] of the local lengths; size: [m], their unit.
    """
    planes, quadrics = body_1.offsets.size, body_1.centres.shape[0]
    all_planes, all_quadrics = planes + body_2.offsets.size, quadrics + body_2.centres.shape[0]
    found = Constraints(
        numpy.empty((all_planes, 3)),
        numpy.empty(all_planes),
        numpy.empty((all_quadrics, 3)),
        numpy.empty((all_quadrics, 3)),
        numpy.empty((all_quadrics, 3, 3)),
        numpy.empty((all_quadrics, 3, 3)),
        numpy.empty(all_planes + all_quadrics, dtype=numpy.int64),
    )
    put_body(found, body_1, origin, size, 0, 0, 1)
    put_body(found, body_2, origin, size, planes, quadrics, 2)
    return found


@kernel
def put_body(
    found: Constraints, body: ConvexBody, origin: Field, size: float, plane: int, quadric: int, owner: int
) -> None:
    """Write the planes and quadrics of a body from the numbers `plane` and `quadric` on; lengths
    over `size` [m].
    """
    for i in range(body.offsets.size):
        found.offsets[plane + i] = body.offsets[i] / size
        found.owners[plane + i] = owner
        for j in range(3):
            found.normals[plane + i, j] = body.normals[i, j]
            found.offsets[plane + i] -= body.normals[i, j] * origin[j] / size
    for k in range(body.centres.shape[0]):
        # Quadrics are numbered behind all planes
        found.owners[found.offsets.size + quadric + k] = owner
        for j in range(3):
            found.centres[quadric + k, j] = (body.centres[k, j] - origin[j]) / size
            found.half_axes[quadric + k, j] = body.half_axes[k, j] / size
            for m in range(3):
                found.rotations[quadric + k, j, m] = body.rotations[k, j, m]
                found.shapes[quadric + k, j, m] = body.shapes[k, j, m] * size * size


@kernel
def make_cuts(constraints: Constraints, rounds: int) -> Cuts:
    """Room for `rounds` calls of `add_cuts`, the planes already in it."""
    planes = constraints.offsets.size
    room = planes + rounds * REFLECTIONS * constraints.centres.shape[0]
    cuts = Cuts(
        numpy.empty((room, 3)), numpy.empty(room), numpy.empty(room, dtype=numpy.int64), numpy.zeros(1, numpy.int64)
    )
    for i in range(planes):
        put_cut(cuts, constraints.normals[i], constraints.offsets[i], i)
    return cuts


@kernel
def put_cut(cuts: Cuts, normal: Field, offset: float, constraint: int) -> None:
    """Append the plane `normal . p <= offset` of a constraint; normal: [3]; offset: over the size
    [1]."""
    row = cuts.used[0]
    for j in range(3):
        cuts.normals[row, j] = normal[j]
    cuts.offsets[row] = offset
    cuts.constraints[row] = constraint
    cuts.used[0] = row + 1


@kernel
def add_cuts(constraints: Constraints, cuts: Cuts, point: Field) -> None:
    """The supporting planes at the feet of a point on every quadric, and their reflections in its
    planes of symmetry.

    point: [3] in units of the size.
    """
    local, foot, mirrored, normal = numpy.empty(3), numpy.empty(3), numpy.empty(3), numpy.empty(3)
    for k in range(constraints.centres.shape[0]):
        to_local(constraints, k, point, local)
        distance = supporting_plane(constraints.half_axes[k], local, foot)
        for reflection in range(REFLECTIONS):
            new = True
            for j in range(3):
                flipped = (reflection >> j) & 1 == 1
                mirrored[j] = -foot[j] if flipped else foot[j]
                new = new and not (flipped and foot[j] == 0.0)
            if new:
                offset = to_world(constraints, k, mirrored, normal) + distance
                put_cut(cuts, normal, offset, constraints.offsets.size + k)


@kernel
def to_local(constraints: Constraints, k: int, point: Field, local: Field) -> None:
    """Coordinates of a point in the axes of quadric k.

    point, local: [3] in units of the size.
    """
    for j in range(3):
        local[j] = 0.0
        for m in range(3):
            local[j] += constraints.rotations[k, m, j] * (point[m] - constraints.centres[k, m])


@kernel
def to_world(constraints: Constraints, k: int, local: Field, normal: Field) -> float:
    """Write the direction of quadric k in the world into `normal`; returns its product with the
    centre, over the size [1].

    local, normal: [3].
    """
    product = 0.0
    for j in range(3):
        normal[j] = 0.0
        for m in range(3):
            normal[j] += constraints.rotations[k, j, m] * local[m]
        product += normal[j] * constraints.centres[k, j]
    return product


@kernel
def depth_below(constraints: Constraints, constraint: int, point: Field) -> float:
    """Minus the signed distance of a point [3] from one constraint, both over the size [1]."""
    planes = constraints.offsets.size
    if constraint < planes:
        depth = constraints.offsets[constraint]
        for j in range(3):
            depth -= constraints.normals[constraint, j] * point[j]
        return float(depth)
    local, normal = numpy.empty(3), numpy.empty(3)
    to_local(constraints, constraint - planes, point, local)
    depth = supporting_plane(constraints.half_axes[constraint - planes], local, normal)
    for j in range(3):
        depth -= normal[j] * local[j]
    return float(depth)


@kernel
def least_depth(constraints: Constraints, point: Field) -> float:
    """Radius of the largest ball about a point [3]; negative outside; lengths over the size [1]."""
    least = math.inf
    for constraint in range(constraints.owners.size):
        least = min(least, depth_below(constraints, constraint, point))
    return least
