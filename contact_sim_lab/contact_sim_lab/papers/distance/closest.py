"""Minimum distance of two convex bodies, and the points where it is reached.

    minimise |p1 - p2|^2 / 2   where   depth(p1) >= 0 below each constraint of body 1, depth(p2) >= 0
    below each of body 2

The problem is convex: what meets the Karush-Kuhn-Tucker conditions `p1 - p2 + sum lambda n = 0`
(and with the sign changed for body 2), `lambda >= 0`, `lambda depth = 0` is the minimum, n the
outward normals. SLSQP finds the active constraints, Newton steps on the conditions give the last
digits. Further starts are tried until the conditions hold to `CONVERGED`; the residual is part of
the result. Overlapping bodies have distance 0 at some common point; how deep they overlap is in
`papers/distance/interference.py`. Where the closest points are not unique (parallel faces), one
pair is found.

Source: Driver and Seat eq 1.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
import scipy.optimize
from numpy.typing import NDArray

from contact_sim_lab.papers.distance.convex_body import ConvexBody, depths, moved, newton, pair_size, surface

__all__ = ["CONVERGED", "Closest", "conditions", "descended", "minimum_distance", "minimum_distance_from"]

Field = NDArray[numpy.float64]
Bodies = tuple[ConvexBody, ConvexBody]

CONVERGED = 1e-10
"""Residual, relative to the size of the pair, at which no further start is tried."""

MOST_STARTS = 6
ACTIVE = 1e-6
"""Depth, relative to the size of the pair, at which a constraint may carry a multiplier."""

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
        best = (other if other.residual < best.residual else best)._replace(starts=start + 1)
    return best


def minimum_distance_from(body_1: ConvexBody, body_2: ConvexBody, start: int) -> Closest:
    """One descent: start 0 is from the bodies' inside points, others from points beside these."""
    origin, size = 0.5 * (body_1.inside + body_2.inside), pair_size(body_1, body_2)
    bodies = moved(body_1, origin, size), moved(body_2, origin, size)
    direction = start_direction(start)
    begin = [
        body.inside + sign * depths(body, body.inside)[0].min() * direction
        for body, sign in zip(bodies, (0.7, -0.7), strict=True)
    ]
    points = descended(bodies, numpy.array(begin)).x.reshape(2, 3)
    # The pair with the digits of the conditions, or a common point: whichever meets them
    pairs = polished(bodies, points), numpy.tile(points.mean(axis=0), (2, 1))
    residuals = [conditions(bodies, pair)[1] for pair in pairs]
    best = int(numpy.argmin(residuals))
    distance = float(numpy.linalg.norm(pairs[best][0] - pairs[best][1]))
    overlap = distance < TOUCHING
    point_1, point_2 = origin + size * pairs[best]
    return Closest(0.0 if overlap else size * distance, point_1, point_2, overlap, residuals[best], start + 1)


def start_direction(start: int) -> Field:
    """Unit vectors [3] spread over the sphere by the golden angle; zero for start 0."""
    if start == 0:
        return numpy.zeros(3)
    height = 1.0 - 2.0 * ((start * 0.6180339887498949) % 1.0)
    angle, around = 2.399963229728653 * start, math.sqrt(1.0 - height * height)
    return numpy.array([around * math.cos(angle), around * math.sin(angle), height])


def descended(bodies: Bodies, points: Field) -> scipy.optimize.OptimizeResult:
    """SLSQP from a pair of points [2, 3]; bodies and points over the size of the pair."""
    return scipy.optimize.minimize(
        half_square, points.ravel(), jac=True, method="SLSQP", options={"ftol": 1e-16, "maxiter": 300},
        constraints={"type": "ineq", "fun": lambda z: room(bodies, z), "jac": lambda z: room_slopes(bodies, z)},
    )  # fmt: skip


def half_square(unknowns: Field) -> tuple[float, Field]:
    """Half the squared distance of two points [6] over the size [1], and its gradient [6]."""
    gap = unknowns[:3] - unknowns[3:]
    return 0.5 * float(gap @ gap), numpy.concatenate([gap, -gap])


def room(bodies: Bodies, unknowns: Field) -> Field:
    """Depths of both points [6] below the constraints of their body [constraints], over the size."""
    return numpy.concatenate(
        [depths(body, point)[0] for body, point in zip(bodies, unknowns.reshape(2, 3), strict=True)]
    )


def room_slopes(bodies: Bodies, unknowns: Field) -> Field:
    """Derivatives [constraints, 6] of `room`: minus the outward normals."""
    first, second = (depths(body, point)[1] for body, point in zip(bodies, unknowns.reshape(2, 3), strict=True))
    return -numpy.block([[first, numpy.zeros_like(first)], [numpy.zeros_like(second), second]])


def conditions(bodies: Bodies, points: Field, thickness: float = ACTIVE) -> tuple[list[Field], float]:
    """Multipliers of each body's constraints that fit two points [2, 3] best, and the largest
    violation [1] of the conditions, `|min(lambda, depth)|` among them; thickness: depth below which
    a constraint may carry a multiplier."""
    multipliers: list[Field] = []
    worst = 0.0
    for body, point, other in zip(bodies, points, points[::-1], strict=True):
        depth, normals = depths(body, point)
        fitted, active = numpy.zeros(depth.size), depth < thickness
        if active.any():
            fitted[active] = scipy.optimize.nnls(normals[active].T, other - point)[0]
        multipliers.append(fitted)
        worst = max(worst, *abs(point - other + fitted @ normals), *abs(numpy.minimum(fitted, depth)))
    return multipliers, worst


def polished(bodies: Bodies, points: Field) -> Field:
    """The points [2, 3] after steps on the conditions, the active constraints as equations."""
    fitted = conditions(bodies, points)[0]
    held = [multipliers > 0.0 for multipliers in fitted]

    def equations(unknowns: Field) -> tuple[Field, Field]:
        pair, row = unknowns[:6].reshape(2, 3), 6
        values, jacobian = numpy.zeros(unknowns.size), numpy.zeros((unknowns.size, unknowns.size))
        jacobian[:6, :6] = numpy.kron([[1.0, -1.0], [-1.0, 1.0]], numpy.eye(3))
        values[:6] = jacobian[:6, :6] @ unknowns[:6]
        for k, body in enumerate(bodies):
            own = slice(3 * k, 3 * k + 3)
            for constraint in numpy.flatnonzero(held[k]):
                values[row], normal, turn = surface(body, int(constraint), pair[k])
                values[own] += unknowns[row] * normal
                jacobian[own, own] += unknowns[row] * turn
                jacobian[own, row] = jacobian[row, own] = normal
                row += 1
        return values, jacobian

    found = newton(equations, numpy.concatenate([points.ravel(), *(f[h] for f, h in zip(fitted, held, strict=True))]))
    return found[:6].reshape(2, 3)
