"""Convex bodies as sets of constraints: ellipsoids, elliptic cylinders, boxes, half-spaces.

A body is where all its constraint functions are at most zero:

    quadric   g(p) = |R^T (p - c) / h|^2 - 1       half axes h along the columns of R; inf: a cylinder along that axis
    plane     g(p) = n^T p - o                     n the unit outward normal

Polyhedra and what several bodies share: `papers/distance/convex_intersection.py`.
Source: Driver and Seat eqs 1 and 2 (bounding surface constraints).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy
from numpy.typing import ArrayLike, NDArray

from contact_sim_lab.papers.distance.ellipsoid import supporting_plane

__all__ = [
    "BodyError",
    "ConvexBody",
    "box",
    "depths",
    "ellipsoid",
    "half_space",
    "joined",
    "moved",
    "newton",
    "pair_size",
    "planes",
    "quadric",
    "sphere",
    "surface",
]

Field = NDArray[numpy.float64]

IDENTITY = numpy.eye(3)
DEEP = 1.0  # [m] how far below its plane the inside point of a half-space lies
NEWTON_STEPS = 10
SMALLEST = 1e-100  # [m] of a coordinate: its square is a number


class BodyError(ValueError):
    """The body is not possible or empty; the text says why."""


class ConvexBody(NamedTuple):
    """Quadrics and planes that bound it, and a point strictly inside."""

    centres: Field  # [quadrics, 3] [m]
    half_axes: Field  # [quadrics, 3] [m]
    rotations: Field  # [quadrics, 3, 3] columns: directions of the axes
    shapes: Field  # [quadrics, 3, 3] Q [1/m^2], g = (p - c)^T Q (p - c) - 1
    normals: Field  # [planes, 3]
    offsets: Field  # [planes] [m]
    inside: Field  # [3] [m]


def sphere(centre: ArrayLike, radius: float) -> ConvexBody:
    """Ball of a radius [m] about `centre` [x, y, z] in [m]. Raises `BodyError`."""
    return ellipsoid(centre, (radius, radius, radius))


def ellipsoid(centre: ArrayLike, half_axes: ArrayLike, rotation: ArrayLike = IDENTITY) -> ConvexBody:
    """Ellipsoid with half axes [3] [m], one or two of them may be inf, along the columns of
    `rotation` [3, 3].

    Raises `BodyError` for axes that are not positive and matrices that are not orthogonal.
    """
    middle, axes, turn = _vector(centre, "centre"), _axes(half_axes), _rotation(rotation)
    shape = (turn / axes**2) @ turn.T
    nothing = numpy.zeros((0, 3)), numpy.zeros(0)
    return ConvexBody(middle[None].copy(), axes[None].copy(), turn[None].copy(), shape[None].copy(), *nothing, middle)


def quadric(centre: ArrayLike, matrix: ArrayLike) -> ConvexBody:
    """`(p - c)^T Q (p - c) <= 1` of a symmetric, positive semidefinite `matrix` Q [3, 3] [1/m^2],
    not zero.

    Raises `BodyError`.
    """
    given = numpy.asarray(matrix, dtype=float)
    if given.shape != (3, 3) or not numpy.isfinite(given).all() or not numpy.allclose(given, given.T, atol=0.0):
        raise BodyError("convex body: the matrix of a quadric must be symmetric [3, 3] and finite")
    values, vectors = numpy.linalg.eigh(given)
    values[abs(values) < 1e-14 * abs(values).max()] = 0.0
    if values.min() < 0.0 or values.max() == 0.0:
        raise BodyError(
            f"convex body: the matrix of a quadric has the eigenvalues {values}, none may be below 0, not all 0"
        )
    with numpy.errstate(divide="ignore"):
        return ellipsoid(centre, 1.0 / numpy.sqrt(values), vectors)


def half_space(normal: ArrayLike, offset: float) -> ConvexBody:
    """`n^T p <= offset` [m], n the unit vector along `normal` [x, y, z]. Raises `BodyError`."""
    direction = _vector(normal, "normal")
    length = float(numpy.linalg.norm(direction))
    if length == 0.0 or not math.isfinite(offset):
        raise BodyError(
            f"convex body: a half-space has the normal {normal!r} and the offset {offset} m, one is not possible"
        )
    unit = direction / length
    return planes(unit[None], numpy.array([float(offset)]), (offset - DEEP) * unit)


def box(centre: ArrayLike, half_sides: ArrayLike, rotation: ArrayLike = IDENTITY) -> ConvexBody:
    """Box with half sides [3] [m] along the columns of `rotation` [3, 3]. Raises `BodyError`."""
    middle, sides, turn = _vector(centre, "centre"), _axes(half_sides), _rotation(rotation)
    normals = numpy.concatenate([turn.T, -turn.T])
    return planes(normals, normals @ middle + numpy.tile(sides, 2), middle)


def planes(normals: Field, offsets: Field, inside: Field) -> ConvexBody:
    """A body of planes alone, nothing checked: unit normals [planes, 3], offsets [planes] [m], a
    point inside [3] [m].
    """
    none, matrices = numpy.zeros((0, 3)), numpy.zeros((0, 3, 3))
    return ConvexBody(none, none, matrices, matrices, numpy.ascontiguousarray(normals), offsets, inside)


def joined(bodies: Sequence[ConvexBody]) -> ConvexBody:
    """All constraints of several bodies, those of the first one first; inside: the mean of their
    inside points, which may lie outside."""
    parts = [numpy.concatenate(values) for values in zip(*(body[:-1] for body in bodies), strict=True)]
    return ConvexBody._make([*parts, numpy.mean([body.inside for body in bodies], axis=0)])


def moved(body: ConvexBody, origin: Field, size: float) -> ConvexBody:
    """The body in lengths from `origin` [3] [m], over `size` [m]."""
    return ConvexBody(
        (body.centres - origin) / size, body.half_axes / size, body.rotations, body.shapes * size**2, body.normals,
        (body.offsets - body.normals @ origin) / size, (body.inside - origin) / size,
    )  # fmt: skip


def depths(body: ConvexBody, point: Field) -> tuple[Field, Field]:
    """Depth [constraints] [m] of a point [3] [m] below each constraint, quadrics first, negative
    outside; and the outward unit normal at its foot [constraints, 3]."""
    curved = len(body.centres)
    found, normals = numpy.empty(curved + len(body.offsets)), numpy.empty((curved + len(body.offsets), 3))
    for k in range(curved):
        local, normal = (point - body.centres[k]) @ body.rotations[k], numpy.empty(3)
        local[abs(local) < SMALLEST] = 0.0
        found[k] = supporting_plane(body.half_axes[k], local, normal) - normal @ local
        normals[k] = body.rotations[k] @ normal
    found[curved:], normals[curved:] = body.offsets - body.normals @ point, body.normals
    return found, normals


def surface(body: ConvexBody, constraint: int, point: Field) -> tuple[float, Field, Field]:
    """Height [m] of a point [3] [m] above one constraint, right to first order in it, the outward
    unit normal [3] of the level there and the normal's derivative [3, 3] [1/m]."""
    curved = len(body.centres)
    if constraint >= curved:
        normal = body.normals[constraint - curved]
        return float(normal @ point - body.offsets[constraint - curved]), normal, numpy.zeros((3, 3))
    local, half_axes = (point - body.centres[constraint]) @ body.rotations[constraint], body.half_axes[constraint]
    slope = body.rotations[constraint] @ (local / half_axes**2)
    length = float(numpy.linalg.norm(slope))
    normal = slope / length
    turn = (body.shapes[constraint] - numpy.outer(normal, normal @ body.shapes[constraint])) / length
    return float((((local / half_axes) ** 2).sum() - 1.0) / (2.0 * length)), normal, turn


def newton(equations: Callable[[Field], tuple[Field, Field]], start: Field) -> Field:
    """Unknowns [n] after Newton steps on equations that return values [m] and Jacobian [m, n], as
    long as they come closer; least squares, for the Jacobian may be singular."""
    values, jacobian = equations(start)
    for _ in range(NEWTON_STEPS):
        moved_start = start + numpy.linalg.lstsq(jacobian, -values, rcond=1e-13)[0]
        moved_values, jacobian = equations(moved_start)
        if not numpy.linalg.norm(moved_values) < numpy.linalg.norm(values):
            break
        start, values = moved_start, moved_values
    return start


def pair_size(body_1: ConvexBody, body_2: ConvexBody) -> float:
    """Of the order of two bodies and their distance [m]."""
    inner = (min([*body.half_axes.ravel(), *(body.offsets - body.normals @ body.inside)]) for body in (body_1, body_2))
    return float(numpy.linalg.norm(body_1.inside - body_2.inside) + sum(inner))


def _vector(values: ArrayLike, name: str) -> Field:
    vector = numpy.array(values, dtype=float)
    if vector.shape != (3,) or not numpy.isfinite(vector).all():
        raise BodyError(f"convex body: {name} is {values!r}, it must be three finite numbers")
    return vector


def _axes(values: ArrayLike) -> Field:
    axes = numpy.array(values, dtype=float)
    if axes.shape != (3,) or not (axes > 0.0).all() or numpy.isinf(axes).all():
        raise BodyError(
            f"convex body: half axes are {values!r} m, they must be three numbers above 0, not all infinite"
        )
    return axes


def _rotation(values: ArrayLike) -> Field:
    turn = numpy.array(values, dtype=float)
    if turn.shape != (3, 3) or not numpy.allclose(turn @ turn.T, IDENTITY, atol=1e-9):
        raise BodyError("convex body: a rotation must be an orthogonal [3, 3] matrix")
    return turn
