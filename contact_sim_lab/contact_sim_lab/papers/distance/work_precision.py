"""Work-precision study of the contact search: bounding spheres, support points, the paper's genetic
search, Newton on the conditions.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_lab.papers.distance import reference
from contact_sim_lab.papers.distance.closest import minimum_distance
from contact_sim_lab.papers.distance.convex_body import ConvexBody, ellipsoid
from contact_sim_lab.papers.distance.genetic_search import genetic_distance, genetic_interference
from contact_sim_lab.papers.distance.interference import interference
from contact_sim_lab.records.work_precision import FidelityLevel, Row, WorkPrecision, milliseconds, relative, row

__all__ = ["PART", "WORK_PRECISION", "bodies", "rows"]

Field = NDArray[numpy.float64]

PART = "contact search"
DISTANCE, DEPTH = "distance", "interference"


class DistanceCase(NamedTuple):
    """Two ellipsoids, the question, and how it is answered without shared code."""

    name: str
    pair: tuple[ConvexBody, ConvexBody]
    quantity: str
    expected: float
    reference: str


def bodies(separated: float) -> tuple[ConvexBody, ConvexBody]:
    """The back as an ellipsoid, and a bolster of the seat whose centre is `separated` [m] further
    back.
    """
    lean = math.radians(20.0)
    turn = numpy.array([[math.cos(lean), 0, math.sin(lean)], [0, 1, 0], [-math.sin(lean), 0, math.cos(lean)]])
    return (
        ellipsoid([0.0, 0.0, 0.0], [0.12, 0.20, 0.30], turn),
        ellipsoid([-0.12 - separated, 0.15, 0.05], [0.08, 0.06, 0.25]),
    )


def rows() -> list[Row]:
    """Separated and overlapping; value and error of each fidelity level."""
    found: list[Row] = []
    for case in _cases():
        for name, call in _levels(case).items():
            level, value = FidelityLevel(name, milliseconds(call)), call()
            error = relative(value, case.expected)
            found.append(
                row(PART, case.name, case.quantity, level, case.reference, error, value=value, expected=case.expected)
            )
    return found


def _cases() -> tuple[DistanceCase, ...]:
    separated, close = bodies(0.15), bodies(0.04)
    distance, depth = (
        exact(*((body.centres[0], body.shapes[0]) for body in pair))
        for exact, pair in ((reference.ellipsoid_distance, separated), (reference.separating_translation, close))
    )
    return (
        DistanceCase("separated", separated, DISTANCE, distance, "SLSQP, then 40 digits"),
        DistanceCase("overlapping", close, DEPTH, depth, "support functions, Nelder-Mead"),
    )


def _levels(case: DistanceCase) -> dict[str, Callable[[], float]]:
    one, other = case.pair
    sign = 1.0 if case.quantity == DISTANCE else -1.0

    def newton() -> float:
        return minimum_distance(one, other).distance if case.quantity == DISTANCE else interference(one, other).depth

    def genetic(polish: bool) -> float:
        search = genetic_distance if case.quantity == DISTANCE else genetic_interference
        return search(one, other, polish=polish).value

    return {
        "bounding spheres": lambda: sign * bounding_spheres(one, other),
        "support points along the centres": lambda: sign * support_points(one, other),
        "genetic search": lambda: genetic(False),
        "genetic search, polished": lambda: genetic(True),
        "KKT Newton, multi-start": newton,
    }


def bounding_spheres(one: ConvexBody, other: ConvexBody) -> float:
    """Distance [m] of the spheres about two ellipsoids, never more than theirs; negative:
    overlap.
    """
    separated = numpy.linalg.norm(one.centres[0] - other.centres[0])
    return float(separated - one.half_axes[0].max() - other.half_axes[0].max())


def support_points(one: ConvexBody, other: ConvexBody) -> float:
    """Gap [m] between the tangent planes across the line of centres, never more than the distance;
    negative: overlap.
    """
    between = other.centres[0] - one.centres[0]
    normal = between / numpy.linalg.norm(between)
    reach = sum(numpy.linalg.norm(body.half_axes[0] * (body.rotations[0].T @ normal)) for body in (one, other))
    return float(between @ normal - reach)


WORK_PRECISION = (WorkPrecision(PART, rows),)
