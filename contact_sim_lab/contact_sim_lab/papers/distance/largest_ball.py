"""The largest ball inside the constraints of two bodies, by cutting planes and steps on its
conditions (see `papers/distance/interference.py`).

A round solves a linear program for the largest ball under all supporting planes so far, its centre
within a box about the best centre. The box shrinks where the planes promise more than the
constraints hold and grows where they hold. Each round ends with Newton steps on

    sum lambda_k n_k = 0,   sum lambda_k = 1,   x_k = p + r n_k(x_k),   depth_k(x_k) = 0

from the planes that hold that ball: centre p, radius r, and for each foot k its point x_k, outward
normal n_k and multiplier lambda_k. These equations stay regular through r = 0, and where the
nearest boundary point jumps, since every foot has a point of its own. The search ends where the
conditions are met.

Source: Driver and Seat eq 2; Boyd and Vandenberghe, Convex Optimization, 8.5.1.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
import scipy.optimize
from numpy.typing import NDArray

from contact_sim_lab.papers.distance.convex_body import ConvexBody, depths, joined, moved, newton, surface
from contact_sim_lab.papers.distance.ellipsoid import supporting_plane

__all__ = ["BallResult", "largest_ball"]

Field = NDArray[numpy.float64]

MOST_ROUNDS = 40
CONVERGED = 1e-12
"""Residual of the conditions at which the search ends."""

FARTHEST = 1e5
"""Radius, in units of the pair's size, that counts as unbounded."""

HOLDS = 1e-7
"""Multiplier of a foot that counts."""

SAME_FOOT, ONE_FOOT = 0.97, 1.0 - 1e-9
"""Cosine between the normals of one constraint that count as one foot, before and after the steps."""

REFLECTIONS = numpy.array([[x, y, z] for x in (1.0, -1.0) for y in (1.0, -1.0) for z in (1.0, -1.0)])
"""In the planes of symmetry of a quadric."""


class BallResult(NamedTuple):
    radius: float  # [m] inf where nothing bounds it
    centre: Field  # [3] [m]
    # [3] outward of body 1 at its foot with the largest multiplier; zero where it has none
    normal: Field
    feet_1: int  # on body 1
    feet_2: int
    residual: float  # [1] of the conditions
    rounds: int


class Ball(NamedTuple):
    centre: Field  # [3]
    radius: float
    constraints: list[int]  # [feet] quadrics first
    normals: Field  # [feet, 3] outward
    multipliers: Field  # [feet]


def largest_ball(body_1: ConvexBody, body_2: ConvexBody, origin: Field, size: float) -> BallResult:
    """Largest ball inside both bodies, searched from a point `origin` [3] [m] near both; size: of
    the pair [m].
    """
    both = moved(joined((body_1, body_2)), origin, size)
    middle: Field = numpy.zeros(3)
    half_width = 1.0
    radius = float(depths(both, middle)[0].min())
    # Rows: normal [3], offset and constraint of each plane
    flat = numpy.arange(len(both.offsets)) + len(both.centres)
    cuts = numpy.vstack([numpy.column_stack([both.normals, both.offsets, flat]), new_cuts(both, middle)])
    best, best_error, rounds = Ball(middle, radius, [], numpy.zeros((0, 3)), numpy.zeros(0)), math.inf, 0
    while rounds < MOST_ROUNDS and best_error > CONVERGED and radius < FARTHEST:
        # Ball under the cuts, with the centre in a trust region
        rounds += 1
        planned = ball_under_planes(cuts, middle, half_width)
        centre, promised = planned.centre, planned.radius - radius
        ball = merged(touching(both, merged(planned, SAME_FOOT)), ONE_FOOT)
        # Kept where it fulfils the conditions better
        error = ball_residual(both, ball)
        if error < best_error:
            best, best_error = ball, error
        cuts = numpy.vstack([cuts, new_cuts(both, centre)])
        # Trust region by the ratio of the gain to the predicted one
        held = float(depths(both, centre)[0].min()) - radius
        half_width *= 2.0 if held > 0.5 * promised else (1.0 if held > 0.1 * promised else 0.5)
        if held > 0.0:
            middle, radius = centre, radius + held
    # Back to the scale of the bodies
    curved, curved_1, planes_1 = len(both.centres), len(body_1.centres), len(body_1.offsets)
    holding = [k for k in range(len(best.constraints)) if best.multipliers[k] > HOLDS]
    of_1 = [k for k in holding if best.constraints[k] < curved_1 or curved <= best.constraints[k] < curved + planes_1]
    normal = best.normals[max(of_1, key=lambda k: best.multipliers[k])] if of_1 else numpy.zeros(3)
    result = size * float(depths(both, best.centre)[0].min()) if radius < FARTHEST else math.inf
    feet_2 = len(holding) - len(of_1)
    return BallResult(result, origin + size * best.centre, normal, len(of_1), feet_2, best_error, rounds)


def new_cuts(body: ConvexBody, point: Field) -> Field:
    """Supporting planes at the feet of a point [3] on every quadric, and their reflections:
    [cuts, 5] normal, offset, constraint."""
    rows = [numpy.zeros((0, 5))]
    for k, (centre, half_axes, rotation) in enumerate(zip(body.centres, body.half_axes, body.rotations, strict=True)):
        normal = numpy.empty(3)
        distance = supporting_plane(half_axes, (point - centre) @ rotation, normal)
        normals = numpy.unique(REFLECTIONS * normal, axis=0) @ rotation.T
        rows.append(numpy.column_stack([normals, normals @ centre + distance, numpy.full(len(normals), k)]))
    return numpy.vstack(rows)


def ball_under_planes(cuts: Field, middle: Field, half_width: float) -> Ball:
    """Largest ball below all planes [cuts, 5], its centre within a box about `middle` [3], with the
    planes that hold it; lengths over the size."""
    bounds = [(place - half_width, place + half_width) for place in middle]
    found = scipy.optimize.linprog(
        [0.0, 0.0, 0.0, -1.0], A_ub=numpy.column_stack([cuts[:, :3], numpy.ones(len(cuts))]), b_ub=cuts[:, 3],
        bounds=[*bounds, (None, None)],
    )  # fmt: skip
    multipliers = -found.ineqlin.marginals
    holding = cuts[multipliers > HOLDS]
    constraints = [int(constraint) for constraint in holding[:, 4]]
    return Ball(found.x[:3], float(found.x[3]), constraints, holding[:, :3], multipliers[multipliers > HOLDS])


def merged(ball: Ball, cosine: float) -> Ball:
    """The ball with feet on one constraint merged whose normals have more than this cosine."""
    kept: list[int] = []
    multipliers = numpy.zeros(len(ball.constraints))
    for k, constraint in enumerate(ball.constraints):
        same = (m for m in kept if ball.constraints[m] == constraint and ball.normals[m] @ ball.normals[k] > cosine)
        foot = next(same, k)
        if foot == k:
            kept.append(k)
        multipliers[foot] += ball.multipliers[k]
    return ball._replace(
        constraints=[ball.constraints[k] for k in kept], normals=ball.normals[kept], multipliers=multipliers[kept]
    )


def touching(body: ConvexBody, ball: Ball) -> Ball:
    """The ball after Newton steps on the equations."""
    feet = len(ball.constraints)

    def equations(unknowns: Field) -> tuple[Field, Field]:
        """Unknowns: centre, radius, and four a foot: its point and multiplier."""
        values, jacobian = numpy.zeros(unknowns.size), numpy.zeros((unknowns.size, unknowns.size))
        values[3] = -1.0
        for k, constraint in enumerate(ball.constraints):
            row = 4 + 4 * k
            point, multiplier, place = unknowns[row : row + 3], unknowns[row + 3], slice(row, row + 3)
            values[row + 3], normal, turn = surface(body, constraint, point)
            # Balance of the normals, sum of the multipliers, foot on the ball and on the constraint
            values[:3] += multiplier * normal
            values[3] += multiplier
            values[place] = point - unknowns[:3] - unknowns[3] * normal
            jacobian[:3, place], jacobian[:3, row + 3], jacobian[3, row + 3] = multiplier * turn, normal, 1.0
            jacobian[place, :3], jacobian[place, 3] = -numpy.eye(3), -normal
            jacobian[place, place], jacobian[row + 3, place] = numpy.eye(3) - unknowns[3] * turn, normal
        return values, jacobian

    points = ball.centre + ball.radius * ball.normals
    start = numpy.column_stack([points, ball.multipliers]).ravel()
    found = newton(equations, numpy.concatenate([ball.centre, [ball.radius], start]))
    places = found[4:].reshape(feet, 4)
    normals = numpy.array([surface(body, k, place[:3])[1] for k, place in zip(ball.constraints, places, strict=True)])
    return Ball(found[:3], float(found[3]), ball.constraints, normals, places[:, 3])


def ball_residual(body: ConvexBody, ball: Ball) -> float:
    """Largest violation [1] of the conditions: balance and signs of the multipliers, and depths
    unlike the least one, over the size."""
    depth = depths(body, ball.centre)[0]
    least, weights = float(depth.min()), ball.multipliers
    unlike = abs(weights) * abs(depth[ball.constraints] - least)
    return float(
        max(*abs(weights @ ball.normals), abs(weights.sum() - 1.0), abs(ball.radius - least), *-weights, *unlike)
    )
