"""Minimum distance of two convex bodies, and the points where it is reached.

    minimise |p1 - p2|^2 / 2   where   g(p1) <= 0 for each constraint of body 1, g(p2) <= 0 for each
    of body 2

The problem is convex: what meets the Karush-Kuhn-Tucker conditions `p1 - p2 + sum lambda grad g =
0` (and with the sign changed for body 2), `lambda >= 0`, `lambda g = 0` is the minimum. Newton
steps on these conditions from inside the bodies (`papers/distance/convex_program.py`), then on the
active constraints alone, which gives the last digits. Further starts are tried until the conditions
hold to `CONVERGED`; the residual is part of the result. Overlapping bodies have distance 0 at some
common point; how deep they overlap is in `papers/distance/interference.py`. Where the closest
points are not unique (parallel faces), one pair is found.

Source: Driver and Seat eq 1.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_lab.papers.distance.convex_body import ConvexBody
from contact_sim_lab.papers.distance.convex_program import (
    REGULARISATION,
    Point,
    Program,
    evaluate,
    hessian,
    minimise,
    moved_by,
    stationarity,
)
from contact_sim_pkg.compiled.jit import entry, kernel
from contact_sim_pkg.compiled.linear_solve import solve_linear

__all__ = ["CONVERGED", "Closest", "minimum_distance", "minimum_distance_from"]

Field = NDArray[numpy.float64]

CONVERGED = 1e-10
"""Residual, relative to the size of the pair, at which no further start is tried."""

SMALLEST_GAP = 1e-22
"""Of the cost, relative to the square of the pair's size: the active constraints are known by then.
"""

MOST_STARTS = 6
POLISH_STEPS = 6
TOUCHING = 1e-9
"""Distance, relative to the size of the pair, below which the bodies count as overlapping."""


class Closest(NamedTuple):
    distance: float  # [m] 0 where the bodies overlap
    point_1: Field  # [3] [m] of body 1
    point_2: Field  # [3] [m] of body 2
    overlap: bool  # distance below 1e-9 of the pair's size
    residual: float  # [1] of the KKT conditions, relative to the pair's size
    starts: int  # starting points used


def minimum_distance(body_1: ConvexBody, body_2: ConvexBody) -> Closest:
    """Distance and closest points of two bodies made by `papers/distance/convex_body.py`."""
    best = minimum_distance_from(body_1, body_2, 0)
    for start in range(1, MOST_STARTS):
        if best.residual <= CONVERGED:
            break
        other = minimum_distance_from(body_1, body_2, start)
        if other.residual < best.residual:
            best = other
        best = best._replace(starts=start + 1)
    return best


@entry
def minimum_distance_from(body_1: ConvexBody, body_2: ConvexBody, start: int) -> Closest:
    """One descent: start 0 is from the bodies' inside points, others from points between these and
    the boundary.
    """
    origin, size = moved_by(body_1.inside, 0.5, between(body_2.inside, body_1.inside)), pair_size(body_1, body_2)
    program = pair_program(body_1, body_2, origin, size)
    direction = start_direction(start)
    first, second = (
        toward_boundary(body_1, direction),
        toward_boundary(body_2, moved_by(numpy.zeros(3), -1.0, direction)),
    )
    # Both points, about the middle of the bodies and over their size
    unknowns = numpy.empty(6)
    for j in range(3):
        unknowns[j] = (body_1.inside[j] - origin[j] + first * direction[j]) / size
        unknowns[3 + j] = (body_2.inside[j] - origin[j] - second * direction[j]) / size
    # Interior points, then Newton steps on the active constraints
    found = minimise(program, unknowns, SMALLEST_GAP)
    point = polish(program, evaluate(program, found.unknowns, found.multipliers))
    point_1, point_2 = numpy.empty(3), numpy.empty(3)
    for j in range(3):
        point_1[j] = origin[j] + size * point.unknowns[j]
        point_2[j] = origin[j] + size * point.unknowns[3 + j]
    distance = length_of(between(point_1, point_2))
    overlap = distance < TOUCHING * size
    return Closest(0.0 if overlap else distance, point_1, point_2, overlap, conditions(program, point), start + 1)


@kernel
def between(first: Field, second: Field) -> Field:
    """Difference [3] of two points, `first - second`."""
    return moved_by(first, -1.0, second)


@entry
def pair_size(body_1: ConvexBody, body_2: ConvexBody) -> float:
    """Of the order of both bodies and their distance [m]."""
    return inner_size(body_1) + inner_size(body_2) + length_of(between(body_1.inside, body_2.inside))


@kernel
def length_of(vector: Field) -> float:
    """Euclidean length of a vector [3], in its unit: [m], or over the size [1]."""
    total = 0.0
    for part in vector:
        total += part * part
    return math.sqrt(total)


@kernel
def start_direction(start: int) -> Field:
    """Unit vectors spread over the sphere by the golden angle; zero for start 0.

    The result: [3].
    """
    if start == 0:
        return numpy.zeros(3)
    height = 1.0 - 2.0 * ((start * 0.6180339887498949) % 1.0)
    angle, around = 2.399963229728653 * start, math.sqrt(1.0 - height * height)
    return numpy.array([around * math.cos(angle), around * math.sin(angle), height])


@kernel
def inner_size(body: ConvexBody) -> float:
    """Of the order of the distance of the inside point from the boundary [m]."""
    size = math.inf
    for k in range(body.centres.shape[0]):
        for j in range(3):
            size = min(size, body.half_axes[k, j])
    for i in range(body.offsets.size):
        depth = body.offsets[i]
        for j in range(3):
            depth -= body.normals[i, j] * body.inside[j]
        size = min(size, depth)
    return size


@kernel
def toward_boundary(body: ConvexBody, direction: Field) -> float:
    """0.7 of the way [m] from the inside point to the boundary, and at most 7 inner sizes."""
    way = 10.0 * inner_size(body)
    for i in range(body.offsets.size):
        rise, depth = 0.0, body.offsets[i]
        for j in range(3):
            rise += body.normals[i, j] * direction[j]
            depth -= body.normals[i, j] * body.inside[j]
        # Distance to each plane, then to each quadric, along the direction
        if rise > 0.0:
            way = min(way, depth / rise)
    for k in range(body.centres.shape[0]):
        square, half, rest = 0.0, 0.0, -1.0
        for j in range(3):
            for m in range(3):
                from_j, from_m = body.inside[j] - body.centres[k, j], body.inside[m] - body.centres[k, m]
                square += direction[j] * body.shapes[k, j, m] * direction[m]
                half += direction[j] * body.shapes[k, j, m] * from_m
                rest += from_j * body.shapes[k, j, m] * from_m
        if square > 0.0:
            way = min(way, (math.sqrt(half * half - square * rest) - half) / square)
    return 0.7 * way


@kernel
def pair_program(body_1: ConvexBody, body_2: ConvexBody, origin: Field, size: float) -> Program:
    """The problem in (p1, p2), lengths from `origin` over `size`.

    origin: [3] [m]; size: [m].
    """
    planes, quadrics = body_1.offsets.size, body_1.centres.shape[0]
    all_planes, all_quadrics = planes + body_2.offsets.size, quadrics + body_2.centres.shape[0]
    # Cost: half the squared distance of the two points.
    quadratic = numpy.eye(6)
    for j in range(3):
        quadratic[j, 3 + j], quadratic[3 + j, j] = -1.0, -1.0
    # Planes and quadrics of both bodies.
    rows, bounds = numpy.zeros((all_planes, 6)), numpy.empty(all_planes)
    curved, centres = numpy.zeros((all_quadrics, 6, 6)), numpy.zeros((all_quadrics, 6))
    put_planes(body_1, origin, size, rows, bounds, 0, 0)
    put_planes(body_2, origin, size, rows, bounds, planes, 3)
    put_quadrics(body_1, origin, size, curved, centres, 0, 0)
    put_quadrics(body_2, origin, size, curved, centres, quadrics, 3)
    none = numpy.zeros((all_quadrics, 6))
    return Program(
        quadratic=quadratic,
        linear=numpy.zeros(6),
        flat_rows=rows,
        flat_bounds=bounds,
        curved=curved,
        curved_centres=centres,
        curved_rows=none,
        curved_bounds=numpy.ones(all_quadrics),
    )


@kernel
def put_planes(
    body: ConvexBody, origin: Field, size: float, rows: Field, bounds: Field, first: int, column: int
) -> None:
    """Write the planes of a body as rows [planes, 6] and bounds [planes] [1], from `first` and
    `column` on.

    origin: [3] in [m]; size: [m].
    """
    for i in range(body.offsets.size):
        bounds[first + i] = body.offsets[i] / size
        for j in range(3):
            rows[first + i, column + j] = body.normals[i, j]
            bounds[first + i] -= body.normals[i, j] * origin[j] / size


@kernel
def put_quadrics(
    body: ConvexBody, origin: Field, size: float, curved: Field, centres: Field, first: int, column: int
) -> None:
    """Write the quadrics of a body as matrices [quadrics, 6, 6] and centres [quadrics, 6], from
    `first` and `column` on.

    origin: [3] in [m]; size: [m]; the results are over the size [1].
    """
    for k in range(body.centres.shape[0]):
        for j in range(3):
            centres[first + k, column + j] = (body.centres[k, j] - origin[j]) / size
            for m in range(3):
                curved[first + k, column + j, column + m] = body.shapes[k, j, m] * size * size


@kernel
def polish(program: Program, point: Point) -> Point:
    """Newton steps on the active constraints as equations, as long as they lower the residual."""
    active = active_constraints(point)
    error = conditions(program, point)
    for _ in range(POLISH_STEPS):
        moved = equality_step(program, point, active)
        moved_error = conditions(program, moved)
        if not moved_error < error:
            break
        point, error = moved, moved_error
    return point


@kernel
def active_constraints(point: Point) -> NDArray[numpy.int64]:
    """Those whose multiplier is larger than their distance from the boundary.

    The result: their numbers, [active].
    """
    active = numpy.empty(point.values.size, dtype=numpy.int64)
    number = 0
    for i in range(point.values.size):
        if point.multipliers[i] > -point.values[i]:
            active[number] = i
            number += 1
    return active[:number]


@kernel
def equality_step(program: Program, point: Point, active: NDArray[numpy.int64]) -> Point:
    """One Newton step on stationarity and `g = 0` of the active constraints; the others get no
    multiplier.

    active: numbers of constraints, [active].
    """
    size, number = point.unknowns.size, active.size
    matrix, right = numpy.zeros((size + number, size + number)), numpy.empty(size + number)
    curvature, slope = hessian(program, point.multipliers), stationarity(program, point)
    # Stationarity, and the active constraints as equations.
    for j in range(size):
        right[j] = -slope[j]
        for m in range(size):
            matrix[j, m] = curvature[j, m]
        matrix[j, j] += REGULARISATION
    for a in range(number):
        right[size + a] = -point.values[active[a]]
        matrix[size + a, size + a] = -REGULARISATION
        for j in range(size):
            matrix[j, size + a] = point.gradients[active[a], j]
            matrix[size + a, j] = point.gradients[active[a], j]
    # Newton step of unknowns and multipliers.
    step = solve_linear(matrix, right)
    multipliers = numpy.zeros(point.values.size)
    for a in range(number):
        multipliers[active[a]] = point.multipliers[active[a]] + step[size + a]
    unknowns = numpy.empty(size)
    for j in range(size):
        unknowns[j] = point.unknowns[j] + step[j]
    return evaluate(program, unknowns, multipliers)


@kernel
def conditions(program: Program, point: Point) -> float:
    """Largest violation [1]: of stationarity, and for each constraint `|min(lambda |grad g|, -g /
    |grad g|)|`, lengths over the size.

    The latter is zero where both are not negative and one of them is zero.
    """
    worst = 0.0
    for part in stationarity(program, point):
        worst = max(worst, abs(part))
    for i in range(point.values.size):
        slope = 0.0
        for part in point.gradients[i]:
            slope += part * part
        slope = math.sqrt(slope)
        worst = max(worst, abs(min(point.multipliers[i] * slope, -point.values[i] / slope)))
    return worst
