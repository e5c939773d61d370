"""Distance and interference of convex bodies by a genetic search, as Driver and Seat solves its eqs
1 and 2.

scipy's differential evolution (a population that crosses and mutates, seed fixed) finds the region;
a local search from its best point gives the digits. It needs thousands of evaluations where
`papers/distance/closest.py` needs some tens of Newton steps, and is here to be compared with it.
The residual is that of the optimality conditions at the point found, with the multipliers that fit
best.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy
import scipy.optimize
from numpy.typing import NDArray

from contact_sim_lab.papers.distance.convex_body import ConvexBody
from contact_sim_lab.papers.distance.ellipsoid import supporting_plane

__all__ = ["GeneticResult", "constraint_values", "genetic_distance", "genetic_interference"]

Field = NDArray[numpy.float64]

GENERATIONS, POPULATION = 300, 15
"""At most; the population is this many a coordinate."""

SPREAD = 1e-6
"""Of the costs of the population, relative, at which the search ends."""

ACTIVE = 1e-4
"""Distance from a constraint, relative to the pair, at which it may carry a multiplier."""


class GeneticResult(NamedTuple):
    value: float  # [m] distance, or interference d
    points: Field  # [2, 3] closest points, or [1, 3] centre of the ball [m]
    residual: float  # [1] of the optimality conditions, lengths relative to the pair
    evaluations: int  # of the cost, local search included


def genetic_distance(body_1: ConvexBody, body_2: ConvexBody, seed: int = 1, polish: bool = True) -> GeneticResult:
    """Distance [m] of two bodies; a point outside its body counts as the boundary point towards the
    inside point.
    """
    bodies, size = (body_1, body_2), _size(body_1, body_2)

    def gaps(genes: Field) -> Field:
        points = [_pulled_in(body, genes[3 * k : 3 * k + 3]) for k, body in enumerate(bodies)]
        return numpy.asarray(((points[0] - points[1]) ** 2).sum(axis=0))

    bounds = [bound for body in bodies for bound in _bounds(body, size)]
    found = _evolve(gaps, bounds, seed)
    points = numpy.stack([_pulled_in(body, found.x[3 * k : 3 * k + 3]) for k, body in enumerate(bodies)])
    evaluations = _evaluations(found)
    if polish:
        local = _slsqp_distance(bodies, points, size)
        points, evaluations = local.x.reshape(2, 3), evaluations + int(local.nfev)
    distance = float(numpy.linalg.norm(points[0] - points[1]))
    return GeneticResult(distance, points, _distance_residual(bodies, points, size), evaluations)


def genetic_interference(body_1: ConvexBody, body_2: ConvexBody, seed: int = 1, polish: bool = True) -> GeneticResult:
    """Interference d [m]: twice the largest depth below every constraint of both bodies."""
    bodies, size = (body_1, body_2), _size(body_1, body_2)

    def cost(genes: Field) -> Field:
        points = genes.reshape(3, -1).T
        return numpy.array([-_depths(bodies, point)[0].min() for point in points])

    found = _evolve(cost, _bounds(body_1, size), seed)
    point, evaluations = found.x, _evaluations(found)
    if polish:
        options = {"xatol": 1e-12 * size, "fatol": 1e-15 * size, "maxiter": 2000}
        local = scipy.optimize.minimize(lambda p: cost(p)[0], point, method="Nelder-Mead", options=options)
        point, evaluations = local.x, evaluations + int(local.nfev)
    depths, normals = _depths(bodies, point)
    active = depths < depths.min() + ACTIVE * size
    rows = numpy.vstack([normals[active].T, numpy.ones(int(active.sum()))])
    _, residual = scipy.optimize.nnls(rows, numpy.array([0.0, 0.0, 0.0, 1.0]))
    return GeneticResult(2.0 * float(depths.min()), point[None], float(residual), evaluations)


def _evolve(cost: object, bounds: list[tuple[float, float]], seed: int) -> scipy.optimize.OptimizeResult:
    return scipy.optimize.differential_evolution(
        cost, bounds, maxiter=GENERATIONS, popsize=POPULATION, tol=SPREAD, seed=seed, polish=False, vectorized=True,
        updating="deferred",
    )  # fmt: skip


def _evaluations(found: scipy.optimize.OptimizeResult) -> int:
    """Of single points: a call of the cost is a whole population."""
    return int(found.nfev * found.population.shape[0])


def _slsqp_distance(bodies: tuple[ConvexBody, ConvexBody], points: Field, size: float) -> scipy.optimize.OptimizeResult:
    """Local search from a pair of points; constraints as they are."""
    start = points.ravel()

    def room(unknowns: Field) -> Field:
        return numpy.concatenate(
            [-constraint_values(body, unknowns[3 * k : 3 * k + 3]) for k, body in enumerate(bodies)]
        )

    return scipy.optimize.minimize(
        lambda z: ((z[:3] - z[3:]) ** 2).sum() / size**2,
        start,
        method="SLSQP",
        constraints={"type": "ineq", "fun": room},
        options={"ftol": 1e-16, "maxiter": 300},
    )


def constraint_values(body: ConvexBody, points: Field) -> Field:
    """g of every constraint, quadrics first, at points [..., 3] [m]: [constraints, ...]."""
    off = points[..., None, :] - body.centres
    curved = numpy.einsum("...ki,kij,...kj->k...", off, body.shapes, off) - 1.0
    flat = numpy.moveaxis(points @ body.normals.T - body.offsets, -1, 0)
    return numpy.concatenate([curved, flat])


def _pulled_in(body: ConvexBody, points: Field) -> Field:
    """Points [3, ...] drawn towards the inside point until they are in the body."""
    start = body.inside.reshape((3,) + (1,) * (points.ndim - 1))
    way = points - start
    reach = numpy.ones(points.shape[1:])
    for centre, shape in zip(body.centres, body.shapes, strict=True):
        off = body.inside - centre
        square = numpy.einsum("i...,ij,j...->...", way, shape, way)
        half = numpy.einsum("i,ij,j...->...", off, shape, way)
        root = numpy.sqrt(numpy.maximum(half**2 - square * (off @ shape @ off - 1.0), 0.0))
        reach = numpy.minimum(reach, (root - half) / numpy.maximum(square, 1e-300))
    for normal, offset in zip(body.normals, body.offsets, strict=True):
        rise = numpy.tensordot(normal, way, axes=1)
        depth = offset - normal @ body.inside
        reach = numpy.minimum(reach, numpy.where(rise > 0.0, depth / numpy.maximum(rise, 1e-300), 1.0))
    return numpy.asarray(start + reach * way)


def _depths(bodies: tuple[ConvexBody, ConvexBody], point: Field) -> tuple[Field, Field]:
    """Depth below each constraint of both bodies, and the outward normal at its foot."""
    depths, normals = [], []
    for body in bodies:
        for centre, axes, rotation in zip(body.centres, body.half_axes, body.rotations, strict=True):
            local, normal = rotation.T @ (point - centre), numpy.empty(3)
            depths.append(supporting_plane(axes, local, normal) - normal @ local)
            normals.append(rotation @ normal)
        depths += list(body.offsets - body.normals @ point)
        normals += list(body.normals)
    return numpy.array(depths), numpy.array(normals)


def _distance_residual(bodies: tuple[ConvexBody, ConvexBody], points: Field, size: float) -> float:
    """Largest part of the gap that no positive multipliers of active constraints balance, and of a
    constraint violated.
    """
    worst = 0.0
    for k, body in enumerate(bodies):
        point, gap = points[k], (points[k] - points[1 - k]) / size
        off = point - body.centres
        slopes = numpy.concatenate([2.0 * numpy.einsum("kij,kj->ki", body.shapes, off), body.normals])
        lengths = numpy.linalg.norm(slopes, axis=1)
        outside = constraint_values(body, point) / (lengths * size)
        active = outside > -ACTIVE
        if active.any():
            _, left = scipy.optimize.nnls((slopes / lengths[:, None])[active].T, -gap)
        else:
            left = float(numpy.linalg.norm(gap))
        worst = max(worst, float(left), float(outside.max()))
    return worst


def _bounds(body: ConvexBody, size: float) -> list[tuple[float, float]]:
    """Where closest points are looked for: about the inside point, within the larger of the body
    and the pair.
    """
    axes = body.half_axes[numpy.isfinite(body.half_axes)]
    half = max([size, *(1.1 * axes)])
    return [(float(middle - half), float(middle + half)) for middle in body.inside]


def _size(body_1: ConvexBody, body_2: ConvexBody) -> float:
    """Of the order of the pair [m]."""
    return float(numpy.linalg.norm(body_1.inside - body_2.inside)) + sum(
        float(min([*body.half_axes.ravel(), *(body.offsets - body.normals @ body.inside)])) for body in (body_1, body_2)
    )
