"""Hard cases of the contact search: interference of nested, concentric and edged bodies, and the
genetic search.
"""

from __future__ import annotations

import math

import numpy
from numpy.typing import NDArray

from contact_sim_lab.papers.distance import reference
from contact_sim_lab.papers.distance.closest import minimum_distance
from contact_sim_lab.papers.distance.convex_body import ConvexBody, box, ellipsoid, half_space, sphere
from contact_sim_lab.papers.distance.convex_intersection import polyhedron
from contact_sim_lab.papers.distance.genetic_search import genetic_distance, genetic_interference
from contact_sim_lab.papers.distance.interference import interference
from contact_sim_lab.records import guard
from contact_sim_lab.records.hard_case import Finding, HardCase, at_most, close_to, exactly

Field = NDArray[numpy.float64]

ORIGIN = (0.0, 0.0, 0.0)


def concentric() -> Finding:
    """Largest error of d against 2 min(R1, R2), relative to it, for three ratios of the radii."""
    outer, inner = sphere(ORIGIN, 0.3), {radius: sphere(ORIGIN, radius) for radius in (0.1, 0.3, 0.5)}
    errors = [abs(interference(outer, ball).depth / (2.0 * min(radius, 0.3)) - 1.0) for radius, ball in inner.items()]
    apart = max(numpy.linalg.norm(ball.centres - outer.centres) for ball in inner.values())
    return at_most(max(errors), 1e-12, hard=float(apart))


def concentric_flag() -> Finding:
    """How many of five nested pairs say that they have no single direction: concentric, eccentric,
    touching inside.
    """
    pairs = [(0.0, 0.1), (0.0, 0.3), (0.0, 0.5), (0.05, 0.1), (0.2, 0.1)]
    found = [interference(sphere(ORIGIN, 0.3), sphere((offset, 0.0, 0.0), radius)) for offset, radius in pairs]
    return exactly(
        sum(not result.one_foot_each for result in found),
        5,
        hard=sum(offset <= abs(0.3 - radius) + 1e-15 for offset, radius in pairs),
    )


def nested() -> Finding:
    """d of a sphere of 0.1 m that lies eccentrically inside one of 0.3 m."""
    inner = sphere((0.1, 0.05, 0.0), 0.1)
    return close_to(
        interference(sphere(ORIGIN, 0.3), inner).depth,
        0.2,
        1e-13,
        hard=0.3 - inner.half_axes.max() - numpy.linalg.norm(inner.centres),
    )


def nested_ellipsoid() -> Finding:
    """d of an ellipsoid inside another: twice its smallest half axis."""
    inner = ellipsoid((0.1, 0.1, 0.05), (0.5, 0.2, 0.4))
    outer = ellipsoid(ORIGIN, (3.0, 2.0, 1.0))
    return close_to(
        interference(outer, inner).depth,
        0.4,
        1e-12,
        hard=float((((inner.centres + inner.half_axes) / outer.half_axes) ** 2).sum()),
    )


def wedge() -> Finding:
    """d over w of a wedge of 60 degrees pushed w into a half-space: 2/3, and less than the
    separating translation w.
    """
    half = math.radians(30.0)
    edge = polyhedron([[math.cos(half), 0, -math.sin(half)], [-math.cos(half), 0, -math.sin(half)]], [0.0, 0.0])
    return close_to(
        interference(edge, half_space((0, 0, 1), 0.1)).depth / 0.1,
        2.0 / 3.0,
        1e-12,
        hard=180.0 - math.degrees(math.acos(edge.normals[0] @ edge.normals[1])),
    )


def through_touch() -> Finding:
    """Largest error of d [m] for gaps from -1e-3 to 1e-3 m between spheres, zero among them."""
    gaps = (-1e-3, -1e-6, -1e-9, 0.0, 1e-9, 1e-6, 1e-3)
    pairs = [(sphere(ORIGIN, 1.0), sphere((0.0, 0.0, 1.5 + gap), 0.5)) for gap in gaps]
    errors = [abs(interference(*pair).depth + gap) for pair, gap in zip(pairs, gaps, strict=True)]
    return at_most(max(errors), 1e-11, hard=min(map(abs, gaps)))


def _common_width(one: ConvexBody, other: ConvexBody) -> float:
    """Smaller width [m] that the faces across x share."""
    high, low = numpy.minimum(one.offsets, other.offsets).reshape(2, 3)
    return float((high + low)[1:].min())


def parallel_faces() -> Finding:
    """Distance of two boxes with parallel faces, where the closest points are not unique."""
    pair = box(ORIGIN, (1, 1, 1)), box((2.5, 0.4, 0.0), (1, 1, 1))
    return close_to(minimum_distance(*pair).distance, 0.5, 1e-12, hard=_common_width(*pair))


def slender() -> Finding:
    """Relative error of the distance of two ellipsoids with axes in the ratio 1 to 1000."""
    pair = ellipsoid(ORIGIN, (1.0, 0.03, 0.001)), ellipsoid((0.3, 0.2, 0.4), (0.001, 1.0, 0.05))
    one, other = ((body.centres[0], body.shapes[0]) for body in pair)
    exact = reference.ellipsoid_distance(one, other, starts=10)
    return at_most(
        abs(minimum_distance(*pair).distance / exact - 1.0),
        1e-11,
        hard=max(body.half_axes.max() / body.half_axes.min() for body in pair),
    )


def genetic_repeats() -> Finding:
    """Difference of two genetic searches with the same seed."""
    one, other = _pair()
    first, second = (genetic_distance(one, other, seed=3, polish=False).value for _ in range(2))
    return exactly(abs(first - second), 0.0, hard=abs(first - genetic_distance(one, other, seed=4, polish=False).value))


def genetic_residual() -> Finding:
    """Residual of the optimality conditions after the genetic search and its local search, worst of
    three seeds.
    """
    return at_most(
        max(genetic_distance(*_pair(), seed=seed).residual for seed in (1, 2, 3)),
        1e-5,
        hard=genetic_distance(*_pair(), seed=1, polish=False).residual,
    )


def genetic_flat_cost() -> Finding:
    """Distance of faces that lie parallel, a flat cost: the points found differ by seed, the
    distance may not [m].
    """
    boxes = box(ORIGIN, (1, 1, 1)), box((2.5, 0.4, 0.0), (1, 1, 1))
    return at_most(
        max(abs(genetic_distance(*boxes, seed=seed).value - 0.5) for seed in (1, 2)), 1e-7, hard=_common_width(*boxes)
    )


def genetic_depth() -> Finding:
    """Relative difference between the interference of the polished genetic search and that of the
    conditions.
    """
    pair = ellipsoid(ORIGIN, (0.12, 0.2, 0.3)), ellipsoid((-0.16, 0.15, 0.05), (0.08, 0.06, 0.25))
    exact = interference(*pair).depth
    return at_most(abs(genetic_interference(*pair).value / exact - 1.0), 1e-8, hard=exact)


def _pair() -> tuple[ConvexBody, ConvexBody]:
    return ellipsoid(ORIGIN, (0.12, 0.2, 0.3)), ellipsoid((-0.27, 0.15, 0.05), (0.08, 0.06, 0.25))


CASES = (
    HardCase("interference", "concentric spheres: error against 2 min(R1, R2)", concentric,
        guard.zero("distance of the centres [m]")),
    HardCase("interference", "concentric and nested spheres: no single direction, flagged", concentric_flag,
        guard.at_least("spheres within the other, touching included", 5)),
    HardCase("interference", "sphere inside a sphere: d", nested, guard.above("room round the inner sphere [m]", 0.0)),
    HardCase("interference", "ellipsoid inside an ellipsoid: d", nested_ellipsoid,
        guard.below("level of the outer body at the corners of the inner one's box", 1.0)),
    HardCase("interference", "wedge of 60° in a half-space: d over w", wedge,
        guard.at_most("angle of the edge [°]", 60.001)),
    HardCase("interference", "through touch, gaps of ±1e-9 to ±1e-3 m: error", through_touch,
        guard.zero("least gap [m]")),
    HardCase("closest", "parallel faces: distance", parallel_faces,
        guard.at_least("common width of the faces [m]", 1.0)),
    HardCase("closest", "axes 1 to 1000: relative error of the distance", slender, guard.scales("axes", 999.0)),
    HardCase("GA", "same seed: difference", genetic_repeats, guard.above("difference to another seed [m]", 0.0)),
    HardCase("GA", "polished: KKT residual", genetic_residual, guard.above("residual before the local search", 1e-5)),
    HardCase("GA", "flat cost, parallel faces: error of the distance", genetic_flat_cost,
        guard.at_least("common width of the faces [m]", 1.0)),
    HardCase("GA", "interference against the conditions", genetic_depth, guard.above("interference [m]", 1e-3)),
)  # fmt: skip
