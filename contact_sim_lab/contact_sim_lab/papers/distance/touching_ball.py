"""The largest ball inside the constraints of two bodies, by cutting planes and Newton steps (see
`papers/distance/interference.py`).

A round solves for the largest ball under all supporting planes so far, its centre within a box
about the best centre. The box shrinks where the planes promise more than the constraints hold and
grows where they hold. Each round ends with Newton steps from the planes that hold that ball; the
search ends where the conditions are met.

Source: Driver and Seat eq 2; Boyd and Vandenberghe, Convex Optimization, 8.5.1.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_lab.papers.distance.ball_constraints import Constraints, Cuts, add_cuts, gather, least_depth, make_cuts
from contact_sim_lab.papers.distance.convex_body import ConvexBody
from contact_sim_lab.papers.distance.convex_program import Program, ProgramSolution, minimise
from contact_sim_lab.papers.distance.touching_newton import Ball, ball_residual, cluster, touch
from contact_sim_pkg.compiled.jit import entry, kernel

__all__ = ["BallResult", "largest_ball"]

Field = NDArray[numpy.float64]

MOST_ROUNDS = 40
CONVERGED = 1e-12
"""Residual of the conditions at which the search ends."""

FARTHEST = 1e5
"""Radius, in units of the pair's size, that counts as unbounded."""

PROGRAM_GAP = 1e-13
HOLDS = 1e-7
"""Multiplier of a foot that counts."""


class BallResult(NamedTuple):
    radius: float  # [m] inf where nothing bounds it
    centre: Field  # [3] [m]
    # [3] outward of body 1 at its foot with the largest multiplier; zero where it has none
    normal: Field
    feet_1: int  # on body 1
    feet_2: int
    residual: float  # [1] of the conditions
    rounds: int


@entry
def largest_ball(body_1: ConvexBody, body_2: ConvexBody, origin: Field, size: float) -> BallResult:
    """Largest ball inside both bodies, searched from a point `origin` [3] [m] near both; size: of
    the pair [m].
    """
    # First cuts at the origin.
    constraints = gather(body_1, body_2, origin, size)
    cuts = make_cuts(constraints, MOST_ROUNDS + 1)
    middle: Field = numpy.zeros(3)
    half_width = 1.0
    radius = least_depth(constraints, middle)
    add_cuts(constraints, cuts, middle)
    best, best_error, rounds = cluster(cuts, numpy.zeros(cuts.offsets.size), middle, radius), math.inf, 0
    while rounds < MOST_ROUNDS and best_error > CONVERGED and radius < FARTHEST:
        # Ball under the cuts, with the centre in a trust region.
        rounds += 1
        program = ball_under_planes(cuts, middle, radius, half_width)
        centre = first_three(program.unknowns)
        ball = touch(constraints, cluster(cuts, program.multipliers, centre, program.unknowns[3]))
        # Kept where it fulfils the conditions better.
        error = ball_residual(constraints, ball)
        if error < best_error:
            best, best_error = ball, error
        add_cuts(constraints, cuts, centre)
        # Trust region by the ratio of the gain to the predicted one.
        held, promised = least_depth(constraints, centre) - radius, program.unknowns[3] - radius
        half_width *= 2.0 if held > 0.5 * promised else (1.0 if held > 0.1 * promised else 0.5)
        if held > 0.0:
            middle, radius = centre, radius + held
    # Back to the scale of the bodies.
    normal, feet_1, feet_2 = holding_feet(constraints, best)
    centre = numpy.empty(3)
    for j in range(3):
        centre[j] = origin[j] + size * best.centre[j]
    result = size * least_depth(constraints, best.centre) if radius < FARTHEST else math.inf
    return BallResult(result, centre, normal, feet_1, feet_2, best_error, rounds)


@kernel
def first_three(values: Field) -> Field:
    """The first three of the values, [3]."""
    found = numpy.empty(3)
    for j in range(3):
        found[j] = values[j]
    return found


@kernel
def holding_feet(constraints: Constraints, ball: Ball) -> tuple[Field, int, int]:
    """Normal of body 1 at its foot with the largest multiplier, and the numbers of feet on each
    body.

    The normal: [3].
    """
    normal, feet, largest = numpy.zeros(3), numpy.zeros(2, numpy.int64), HOLDS
    for k in range(ball.multipliers.size):
        if ball.multipliers[k] > HOLDS:
            owner = constraints.owners[ball.constraints[k]]
            feet[owner - 1] += 1
            if owner == 1 and ball.multipliers[k] > largest:
                largest = ball.multipliers[k]
                for j in range(3):
                    normal[j] = ball.normals[k, j]
    return normal, feet[0], feet[1]


@kernel
def ball_under_planes(cuts: Cuts, middle: Field, radius: float, half_width: float) -> ProgramSolution:
    """Largest ball, unknowns (p, r), under all planes, p within a box about `middle`, where a ball
    of `radius` fits.

    middle: [3]; half_width: of the box; all lengths over the size [1].
    """
    count = cuts.used[0]
    rows, bounds = numpy.zeros((count + 6, 4)), numpy.empty(count + 6)
    # Cuts: the ball lies below each plane.
    for i in range(count):
        bounds[i], rows[i, 3] = cuts.offsets[i], 1.0
        # Trust region about the middle.
        for j in range(3):
            rows[i, j] = cuts.normals[i, j]
    for j in range(3):
        rows[count + j, j], rows[count + 3 + j, j] = 1.0, -1.0
        bounds[count + j], bounds[count + 3 + j] = half_width + middle[j], half_width - middle[j]
    # Largest radius, from a point inside.
    cost, start = numpy.zeros(4), numpy.empty(4)
    cost[3], start[3] = -1.0, radius - half_width
    for j in range(3):
        start[j] = middle[j]
    matrices, vectors = numpy.zeros((0, 4, 4)), numpy.zeros((0, 4))
    program = Program(
        quadratic=numpy.zeros((4, 4)),
        linear=cost,
        flat_rows=rows,
        flat_bounds=bounds,
        curved=matrices,
        curved_centres=vectors,
        curved_rows=vectors,
        curved_bounds=numpy.zeros(0),
    )
    return minimise(program, start, PROGRAM_GAP)
