"""A ball that touches given constraints at given normals: Newton steps on the conditions, and how
far they are from met.

Unknowns: centre p, radius r, and for each foot k its point x_k and multiplier lambda_k. Equations,
n_k the outward normal:

    sum lambda_k n_k = 0,   sum lambda_k = 1,   x_k = p + r n_k(x_k),   g_k(x_k) = 0

They stay regular through r = 0, and where the nearest boundary point jumps, since every foot has a
point of its own.

Source: Driver and Seat eq 2.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_lab.papers.distance.ball_constraints import Constraints, Cuts, depth_below, least_depth
from contact_sim_pkg.compiled.jit import kernel
from contact_sim_pkg.compiled.linear_solve import solve_linear

__all__ = ["Ball", "ball_residual", "cluster", "touch"]

Field = NDArray[numpy.float64]
Indices = NDArray[numpy.int64]

NEWTON_STEPS = 10
MOST_FEET = 10
SMALLEST_MULTIPLIER = 1e-5
"""Of a cutting plane that counts as holding the ball."""

SAME_FOOT = 0.97
"""Cosine between the normals of planes of one constraint that count as one foot."""

DAMPING = 1e-15
"""Relative, of the normal equations: without it they are singular where a foot may move along the
surface.
"""


class Ball(NamedTuple):
    centre: Field  # [3]
    constraints: Indices  # [feet]
    normals: Field  # [feet, 3] outward
    points: Field  # [feet, 3]
    multipliers: Field  # [feet]
    radius: float


@kernel
def cluster(cuts: Cuts, multipliers: Field, centre: Field, radius: float) -> Ball:
    """The planes that support a ball, those of one constraint and nearly one direction merged.

    multipliers: [cuts]; centre: [3]; lengths over the size [1].
    """
    constraints, normals = numpy.empty(MOST_FEET, dtype=numpy.int64), numpy.zeros((MOST_FEET, 3))
    weights, feet = numpy.zeros(MOST_FEET), 0
    for row in range(cuts.used[0]):
        if multipliers[row] > SMALLEST_MULTIPLIER:
            # Sum of the normals of a foot, weighted by the multipliers
            foot = 0
            while foot < feet and not same_foot(cuts, row, constraints[foot], normals[foot], weights[foot]):
                foot += 1
            if foot < MOST_FEET:
                feet = max(feet, foot + 1)
                constraints[foot] = cuts.constraints[row]
                weights[foot] += multipliers[row]
                for j in range(3):
                    normals[foot, j] += multipliers[row] * cuts.normals[row, j]
    points = numpy.empty((MOST_FEET, 3))
    for foot in range(feet):
        # Unit normals, and the feet on the ball
        length = math.sqrt(normals[foot, 0] ** 2 + normals[foot, 1] ** 2 + normals[foot, 2] ** 2)
        for j in range(3):
            normals[foot, j] /= length
            points[foot, j] = centre[j] + radius * normals[foot, j]
    return Ball(centre, constraints[:feet], normals[:feet], points[:feet], weights[:feet], radius)


@kernel
def same_foot(cuts: Cuts, row: int, constraint: int, normal: Field, weight: float) -> bool:
    """Whether a cut belongs to a foot that is there: the same constraint, nearly the same normal
    [3].

    normal: sum of unit normals weighted by multipliers, weight: sum of these [1].
    """
    cosine = 0.0
    for j in range(3):
        cosine += cuts.normals[row, j] * normal[j]
    return bool(cuts.constraints[row] == constraint and cosine > SAME_FOOT * weight)


@kernel
def touch(constraints: Constraints, ball: Ball) -> Ball:
    """The ball after Newton steps on the equations, as long as they come closer."""
    error, right, matrix = equations(constraints, ball)
    for _ in range(NEWTON_STEPS):
        moved = newton_move(ball, right, matrix)
        moved_error, right, matrix = equations(constraints, moved)
        if not moved_error < error:
            break
        ball, error = moved, moved_error
    return ball


@kernel
def equations(constraints: Constraints, ball: Ball) -> tuple[float, Field, Field]:
    """Norm [1] of the equations, the equations and their Jacobian; sets the ball's normals. Four
    rows and columns a foot.

    The equations: [4 + 4 feet], the Jacobian: [4 + 4 feet, 4 + 4 feet].
    """
    feet = ball.multipliers.size
    size, planes = 4 + 4 * feet, constraints.offsets.size
    right, matrix, turn = numpy.zeros(size), numpy.zeros((size, size)), numpy.zeros((3, 3))
    # Multipliers add up to 1.
    right[3] = -1.0
    for k in range(feet):
        row, constraint = 4 + 4 * k, ball.constraints[k]
        # Value, normal and derivative of the normal at the foot on this constraint.
        if constraint < planes:
            value = plane_foot(constraints, constraint, ball.points[k], ball.normals[k], turn)
        else:
            value = quadric_foot(constraints, constraint - planes, ball.points[k], ball.normals[k], turn)
        # Balance of the normals, foot on the ball, foot on the constraint.
        right[3] += ball.multipliers[k]
        matrix[3, row + 3] = 1.0
        right[row + 3] = value
        for j in range(3):
            normal = ball.normals[k, j]
            right[j] += ball.multipliers[k] * normal
            matrix[j, row + 3] = normal
            right[row + j] = ball.points[k, j] - ball.centre[j] - ball.radius * normal
            matrix[row + j, j] = -1.0
            matrix[row + j, 3] = -normal
            matrix[row + 3, row + j] = normal
            for m in range(3):
                matrix[j, row + m] = ball.multipliers[k] * turn[j, m]
                matrix[row + j, row + m] = (1.0 if j == m else 0.0) - ball.radius * turn[j, m]
    # Norm of all equations.
    total = 0.0
    for part in right:
        total += part * part
    return math.sqrt(total), right, matrix


@kernel
def plane_foot(constraints: Constraints, i: int, point: Field, normal: Field, turn: Field) -> float:
    """Distance of a point from plane i, over the size [1]; its normal and the normal's derivative.

    point, normal: [3]; turn: [3, 3], the derivative.
    """
    value = -constraints.offsets[i]
    for j in range(3):
        normal[j] = constraints.normals[i, j]
        value += normal[j] * point[j]
        for m in range(3):
            turn[j, m] = 0.0
    return float(value)


@kernel
def quadric_foot(constraints: Constraints, k: int, point: Field, normal: Field, turn: Field) -> float:
    """`g / |grad g|` [1] of quadric k at a point; its normal and the normal's derivative `(I - n
    n^T) Q / |Q y|`.

    point, normal: [3]; turn: [3, 3], the derivative.
    """
    value, length = -1.0, 0.0
    for j in range(3):
        normal[j] = 0.0
        for m in range(3):
            normal[j] += constraints.shapes[k, j, m] * (point[m] - constraints.centres[k, m])
        value += normal[j] * (point[j] - constraints.centres[k, j])
        length += normal[j] ** 2
    # Unit normal, then its derivative
    length = math.sqrt(length)
    for j in range(3):
        normal[j] /= length
    for m in range(3):
        along = 0.0
        for j in range(3):
            along += normal[j] * constraints.shapes[k, j, m]
        for j in range(3):
            turn[j, m] = (constraints.shapes[k, j, m] - normal[j] * along) / length
    return float(value / (2.0 * length))


@kernel
def newton_move(ball: Ball, right: Field, matrix: Field) -> Ball:
    """The ball moved by the least-squares solution of `matrix step = -right`.

    right: [n]; matrix: [n, n].
    """
    size = right.size
    # Normal equations of the Newton step, damped: the matrix may be singular.
    normal_matrix, normal_right = numpy.zeros((size, size)), numpy.zeros(size)
    for i in range(size):
        for j in range(size):
            if matrix[i, j] != 0.0:
                normal_right[j] -= matrix[i, j] * right[i]
                for m in range(size):
                    normal_matrix[j, m] += matrix[i, j] * matrix[i, m]
    largest = 0.0
    for j in range(size):
        largest = max(largest, normal_matrix[j, j])
    for j in range(size):
        normal_matrix[j, j] += DAMPING * largest
    step = solve_linear(normal_matrix, normal_right)
    # Step of centre, feet, multipliers and radius.
    centre, points, multipliers = ball.centre.copy(), ball.points.copy(), ball.multipliers.copy()
    for j in range(3):
        centre[j] += step[j]
    for k in range(multipliers.size):
        multipliers[k] += step[7 + 4 * k]
        for j in range(3):
            points[k, j] += step[4 + 4 * k + j]
    return Ball(centre, ball.constraints, ball.normals.copy(), points, multipliers, ball.radius + step[3])


@kernel
def ball_residual(constraints: Constraints, ball: Ball) -> float:
    """Largest violation [1] of the conditions: balance and signs of the multipliers, and depths
    unlike the least one.

    Depths are over the size.
    """
    least = least_depth(constraints, ball.centre)
    worst, total = 0.0, -1.0
    for j in range(3):
        balance = 0.0
        for k in range(ball.multipliers.size):
            balance += ball.multipliers[k] * ball.normals[k, j]
        worst = max(worst, abs(balance))
    for k in range(ball.multipliers.size):
        total += ball.multipliers[k]
        depth = depth_below(constraints, ball.constraints[k], ball.centre)
        worst = max(worst, -ball.multipliers[k], abs(ball.multipliers[k]) * abs(depth - least))
    return max(worst, abs(total), abs(ball.radius - least))
