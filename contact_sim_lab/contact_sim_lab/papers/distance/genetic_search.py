"""Distance and interference of convex bodies by a genetic search, as Driver and Seat solves its eqs
1 and 2.

scipy's differential evolution (a population that crosses and mutates, seed fixed) finds the region;
a local search from its best point gives the digits. It needs thousands of evaluations where
`papers/distance/closest.py` needs some tens, and is here to be compared with it.
The residual is that of the optimality conditions at the point found, with the multipliers that fit
best.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy
import scipy.optimize
from numpy.typing import NDArray

from contact_sim_lab.papers.distance.closest import conditions, descended
from contact_sim_lab.papers.distance.convex_body import ConvexBody, depths, joined, moved, pair_size

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
    bodies, size = (body_1, body_2), pair_size(body_1, body_2)

    def gaps(genes: Field) -> Field:
        points = [_pulled_in(body, genes[3 * k : 3 * k + 3]) for k, body in enumerate(bodies)]
        return numpy.asarray(((points[0] - points[1]) ** 2).sum(axis=0))

    bounds = [bound for body in bodies for bound in _bounds(body, size)]
    found = _evolve(gaps, bounds, seed)
    points = numpy.stack([_pulled_in(body, found.x[3 * k : 3 * k + 3]) for k, body in enumerate(bodies)])
    evaluations = _evaluations(found)
    origin = body_1.inside
    scaled, points = (moved(body_1, origin, size), moved(body_2, origin, size)), (points - origin) / size
    if polish:
        local = descended(scaled, points)
        points, evaluations = local.x.reshape(2, 3), evaluations + int(local.nfev)
    distance, residual = size * float(numpy.linalg.norm(points[0] - points[1])), conditions(scaled, points, ACTIVE)[1]
    return GeneticResult(distance, origin + size * points, residual, evaluations)


def genetic_interference(body_1: ConvexBody, body_2: ConvexBody, seed: int = 1, polish: bool = True) -> GeneticResult:
    """Interference d [m]: twice the largest depth below every constraint of both bodies."""
    both, size = joined((body_1, body_2)), pair_size(body_1, body_2)

    def cost(genes: Field) -> Field:
        return numpy.array([-depths(both, point)[0].min() for point in genes.reshape(3, -1).T])

    found = _evolve(cost, _bounds(body_1, size), seed)
    point, evaluations = found.x, _evaluations(found)
    if polish:
        options = {"xatol": 1e-12 * size, "fatol": 1e-15 * size, "maxiter": 2000}
        local = scipy.optimize.minimize(lambda p: cost(p)[0], point, method="Nelder-Mead", options=options)
        point, evaluations = local.x, evaluations + int(local.nfev)
    found_depths, normals = depths(both, point)
    active = found_depths < found_depths.min() + ACTIVE * size
    rows = numpy.vstack([normals[active].T, numpy.ones(int(active.sum()))])
    _, residual = scipy.optimize.nnls(rows, numpy.array([0.0, 0.0, 0.0, 1.0]))
    return GeneticResult(2.0 * float(found_depths.min()), point[None], float(residual), evaluations)


def _evolve(cost: object, bounds: list[tuple[float, float]], seed: int) -> scipy.optimize.OptimizeResult:
    return scipy.optimize.differential_evolution(
        cost, bounds, maxiter=GENERATIONS, popsize=POPULATION, tol=SPREAD, seed=seed, polish=False, vectorized=True,
        updating="deferred",
    )  # fmt: skip


def _evaluations(found: scipy.optimize.OptimizeResult) -> int:
    """Of single points: a call of the cost is a whole population."""
    return int(found.nfev * found.population.shape[0])


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


def _bounds(body: ConvexBody, size: float) -> list[tuple[float, float]]:
    """Where closest points are looked for: about the inside point, within the larger of the body
    and the pair.
    """
    axes = body.half_axes[numpy.isfinite(body.half_axes)]
    half = max([size, *(1.1 * axes)])
    return [(float(middle - half), float(middle + half)) for middle in body.inside]
