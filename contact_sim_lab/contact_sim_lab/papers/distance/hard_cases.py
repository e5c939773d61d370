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
from contact_sim_lab.records.hard_case import Finding, HardCase, at_most, close_to, exactly

Field = NDArray[numpy.float64]

ORIGIN = (0.0, 0.0, 0.0)


def concentric() -> Finding:
    """Largest error of d against 2 min(R1, R2), relative to it, for three ratios of the radii."""
    errors = [
        abs(interference(sphere(ORIGIN, 0.3), sphere(ORIGIN, radius)).depth / (2.0 * min(radius, 0.3)) - 1.0)
        for radius in (0.1, 0.3, 0.5)
    ]
    return at_most(max(errors), 1e-12)


def concentric_flag() -> Finding:
    """How many of five nested pairs say that they have no single direction: concentric, eccentric,
    touching inside.
    """
    pairs = [(0.0, 0.1), (0.0, 0.3), (0.0, 0.5), (0.05, 0.1), (0.2, 0.1)]
    found = [interference(sphere(ORIGIN, 0.3), sphere((offset, 0.0, 0.0), radius)) for offset, radius in pairs]
    return exactly(sum(not result.one_foot_each for result in found), 5)


def nested() -> Finding:
    """d of a sphere of 0.1 m that lies eccentrically inside one of 0.3 m."""
    return close_to(interference(sphere(ORIGIN, 0.3), sphere((0.1, 0.05, 0.0), 0.1)).depth, 0.2, 1e-13)


def nested_ellipsoid() -> Finding:
    """d of an ellipsoid inside another: twice its smallest half axis."""
    inner = ellipsoid((0.1, 0.1, 0.05), (0.5, 0.2, 0.4))
    return close_to(interference(ellipsoid(ORIGIN, (3.0, 2.0, 1.0)), inner).depth, 0.4, 1e-12)


def wedge() -> Finding:
    """d over w of a wedge of 60 degrees pushed w into a half-space: 2/3, and less than the
    separating translation w.
    """
    half = math.radians(30.0)
    edge = polyhedron([[math.cos(half), 0, -math.sin(half)], [-math.cos(half), 0, -math.sin(half)]], [0.0, 0.0])
    return close_to(interference(edge, half_space((0, 0, 1), 0.1)).depth / 0.1, 2.0 / 3.0, 1e-12)


def through_touch() -> Finding:
    """Largest error of d [m] for gaps from -1e-3 to 1e-3 m between spheres, zero among them."""
    gaps = (-1e-3, -1e-6, -1e-9, 0.0, 1e-9, 1e-6, 1e-3)
    pairs = [(sphere(ORIGIN, 1.0), sphere((0.0, 0.0, 1.5 + gap), 0.5)) for gap in gaps]
    errors = [abs(interference(*pair).depth + gap) for pair, gap in zip(pairs, gaps, strict=True)]
    return at_most(max(errors), 1e-11)


def parallel_faces() -> Finding:
    """Distance of two boxes with parallel faces, where the closest points are not unique."""
    return close_to(minimum_distance(box(ORIGIN, (1, 1, 1)), box((2.5, 0.4, 0.0), (1, 1, 1))).distance, 0.5, 1e-12)


def slender() -> Finding:
    """Relative error of the distance of two ellipsoids with axes in the ratio 1 to 1000."""
    pair = ellipsoid(ORIGIN, (1.0, 0.03, 0.001)), ellipsoid((0.3, 0.2, 0.4), (0.001, 1.0, 0.05))
    one, other = ((body.centres[0], body.shapes[0]) for body in pair)
    exact = reference.ellipsoid_distance(one, other, starts=10)
    return at_most(abs(minimum_distance(*pair).distance / exact - 1.0), 1e-11)


def genetic_repeats() -> Finding:
    """Difference of two genetic searches with the same seed."""
    one, other = _pair()
    first, second = (genetic_distance(one, other, seed=3, polish=False).value for _ in range(2))
    return exactly(abs(first - second), 0.0)


def genetic_residual() -> Finding:
    """Residual of the optimality conditions after the genetic search and its local search, worst of
    three seeds.
    """
    return at_most(max(genetic_distance(*_pair(), seed=seed).residual for seed in (1, 2, 3)), 1e-5)


def genetic_flat_cost() -> Finding:
    """Distance of faces that lie parallel, a flat cost: the points found differ by seed, the
    distance may not [m].
    """
    boxes = box(ORIGIN, (1, 1, 1)), box((2.5, 0.4, 0.0), (1, 1, 1))
    return at_most(max(abs(genetic_distance(*boxes, seed=seed).value - 0.5) for seed in (1, 2)), 1e-7)


def genetic_depth() -> Finding:
    """Relative difference between the interference of the polished genetic search and that of the
    conditions.
    """
    pair = ellipsoid(ORIGIN, (0.12, 0.2, 0.3)), ellipsoid((-0.16, 0.15, 0.05), (0.08, 0.06, 0.25))
    return at_most(abs(genetic_interference(*pair).value / interference(*pair).depth - 1.0), 1e-8)


def _pair() -> tuple[ConvexBody, ConvexBody]:
    return ellipsoid(ORIGIN, (0.12, 0.2, 0.3)), ellipsoid((-0.27, 0.15, 0.05), (0.08, 0.06, 0.25))


CASES = (
    HardCase("interference", "concentric spheres: error against 2 min(R1, R2)", concentric),
    HardCase("interference", "concentric and nested spheres: no single direction, flagged", concentric_flag),
    HardCase("interference", "sphere inside a sphere: d", nested),
    HardCase("interference", "ellipsoid inside an ellipsoid: d", nested_ellipsoid),
    HardCase("interference", "wedge of 60° in a half-space: d over w", wedge),
    HardCase("interference", "through touch, gaps of ±1e-9 to ±1e-3 m: error", through_touch),
    HardCase("closest", "parallel faces: distance", parallel_faces),
    HardCase("closest", "axes 1 to 1000: relative error of the distance", slender),
    HardCase("GA", "same seed: difference", genetic_repeats),
    HardCase("GA", "polished: KKT residual", genetic_residual),
    HardCase("GA", "flat cost, parallel faces: error of the distance", genetic_flat_cost),
    HardCase("GA", "interference against the conditions", genetic_depth),
)
