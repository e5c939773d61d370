"""Small convex programs: a linear or quadratic cost under linear and convex quadratic constraints,
by interior points.

    minimise z^T P z / 2 + q^T z   where   A z <= b   and   (z - c_k)^T Q_k (z - c_k) + a_k^T z <=
    b_k

P and Q_k symmetric, positive semidefinite. Newton steps on the perturbed Karush-Kuhn-Tucker
conditions `grad cost + G^T lambda = 0`, `-lambda_i g_i = 1/t`, t growing, from a strictly feasible
start: for a convex program they lead to the minimum from any such start. Meant for up to ten
unknowns; the work is linear in the number of constraints. Source: Boyd and Vandenberghe (2004),
Convex Optimization, section 11.7.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.jit import entry, kernel
from contact_sim_pkg.compiled.linear_solve import solve_linear

__all__ = ["Point", "Program", "ProgramSolution", "evaluate", "minimise"]

Field = NDArray[numpy.float64]

MOST_STEPS = 100
MOST_CENTRING_STEPS = 30
MOST_HALVINGS = 40
GROWTH, FASTER_GROWTH = 10.0, 300.0
"""Of t in a step; the larger after a full step."""

REGULARISATION = 1e-13
"""Added to the diagonal of the Newton matrix, relative to its largest: directions that change
nothing stay put.
"""

FIRST_GAP = 0.1
"""Of the first point on the central path; costs are of the order of 1."""

STATIONARY = 1e-9
"""Norm of the stationarity that does not hold the gap back; cost gradients are of the order of 1.
"""

CENTRED = 1e-2
"""Newton decrement at which a point counts as on the path."""

SHORT = 0.3
"""Step after which the point is brought back to the path: far from it curved constraints would
block one step after the other.
"""

EXHAUSTED = 1e-14
"""Gap below which a short step means that the digits are used up."""

CLOSEST_SHARE = 0.01
"""Share of its distance from a constraint that a step must leave."""

FINISHED = 1e-14
"""Residual below which a step need not lower it."""


class Program(NamedTuple):
    quadratic: Field  # [n, n] P
    linear: Field  # [n] q
    flat_rows: Field  # [flat, n] A
    flat_bounds: Field  # [flat] b
    curved: Field  # [curved, n, n] Q_k
    curved_centres: Field  # [curved, n] c_k
    curved_rows: Field  # [curved, n] a_k
    curved_bounds: Field  # [curved] b_k


class Point(NamedTuple):
    unknowns: Field  # [n]
    multipliers: Field  # [constraints] flat ones first
    values: Field  # [constraints] g
    gradients: Field  # [constraints, n]


class ProgramSolution(NamedTuple):
    unknowns: Field  # [n]
    multipliers: Field  # [constraints] lambda >= 0, flat ones first
    # Sum of -lambda_i g_i: the cost is at most this above the minimum, once the residual is zero
    gap: float
    steps: int


@entry
def minimise(program: Program, start: Field, tolerance: float) -> ProgramSolution:
    """Minimum from a start inside every constraint, until the gap is below `tolerance` or the
    digits are used up.

    start: [n]; tolerance: in the unit of the cost [1]. A start on or outside a constraint is
    returned unchanged with an infinite gap.
    """
    count = program.flat_bounds.size + program.curved_bounds.size
    point = evaluate(program, start.copy(), numpy.zeros(count))
    if not is_inside(point):
        return ProgramSolution(point.unknowns, point.multipliers, math.inf, 0)
    point = centred(program, point, FIRST_GAP / count)
    gap, taken, length = gap_of(point), 0, 1.0
    behind = False
    while taken < MOST_STEPS and (gap > tolerance or behind):
        # 1/t
        target = gap / count if behind else gap / (count * (FASTER_GROWTH if length > 0.9 else GROWTH))
        step, multiplier_step = newton_step(program, point, target)
        length, point = line_search(program, point, step, multiplier_step, target)
        if length < SHORT and gap < EXHAUSTED:
            break
        if length < SHORT:
            point = centred(program, point, target)
        gap = gap_of(point)
        behind = norm_of(stationarity(program, point)) > max(10.0 * gap, STATIONARY)
        taken += 1
    return ProgramSolution(point.unknowns, point.multipliers, gap, taken)


@kernel
def evaluate(program: Program, unknowns: Field, multipliers: Field) -> Point:
    """Values and gradients of all constraints.

    unknowns: [n]; multipliers: [constraints].
    """
    flat, curved, size = program.flat_bounds.size, program.curved_bounds.size, unknowns.size
    values, gradients = numpy.empty(flat + curved), numpy.empty((flat + curved, size))
    for i in range(flat):
        value = -program.flat_bounds[i]
        for j in range(size):
            value += program.flat_rows[i, j] * unknowns[j]
            gradients[i, j] = program.flat_rows[i, j]
        values[i] = value
    # Quadrics: value and gradient share the product with the matrix
    for k in range(curved):
        value = -program.curved_bounds[k]
        for j in range(size):
            half = 0.0
            for m in range(size):
                half += program.curved[k, j, m] * (unknowns[m] - program.curved_centres[k, m])
            value += half * (unknowns[j] - program.curved_centres[k, j]) + program.curved_rows[k, j] * unknowns[j]
            gradients[flat + k, j] = 2.0 * half + program.curved_rows[k, j]
        values[flat + k] = value
    return Point(unknowns, multipliers, values, gradients)


@kernel
def moved_by(start: Field, length: float, step: Field) -> Field:
    """`start + length step`, as a loop: an array expression takes much longer to compile.

    start, step: [n]; length: [1].
    """
    moved = numpy.empty(start.size)
    for j in range(start.size):
        moved[j] = start[j] + length * step[j]
    return moved


@kernel
def centred(program: Program, point: Point, target: float) -> Point:
    """The point where `cost / target - sum ln(-g)` is least, by damped Newton steps, which get
    there from anywhere inside.

    With `lambda_i = -target / g_i` the step is `newton_step`'s. The slope along a step decides on
    its length, since the cost over a small target has no digits left for a difference. target: 1/t
    in the unit of the cost [1].
    """
    put_on_path(point, target)
    for _ in range(MOST_CENTRING_STEPS):
        step = newton_step(program, point, target)[0]
        slope, moved_slope, length = -slope_along(program, point, step), math.inf, 1.0
        if slope < CENTRED * CENTRED * target:
            break
        moved = point
        # Halved until inside, with most of the slope gone
        for _ in range(MOST_HALVINGS):
            moved = evaluate(program, moved_by(point.unknowns, length, step), point.multipliers.copy())
            if is_inside(moved):
                put_on_path(moved, target)
                moved_slope = slope_along(program, moved, step)
                if moved_slope <= 0.1 * slope:
                    break
            length *= 0.5
        if not moved_slope <= 0.1 * slope:
            break
        point = moved
    return point


@kernel
def put_on_path(point: Point, target: float) -> None:
    """Set `lambda_i = -target / g_i`; target: 1/t in the unit of the cost [1]."""
    for i in range(point.values.size):
        point.multipliers[i] = -target / point.values[i]


@kernel
def slope_along(program: Program, point: Point, step: Field) -> float:
    """Slope of the Lagrangian along a step [n], in the unit of the cost [1]."""
    total, slope = 0.0, stationarity(program, point)
    for j in range(step.size):
        total += slope[j] * step[j]
    return total


@kernel
def is_inside(point: Point) -> bool:
    """Whether all constraint values [constraints] are negative."""
    inside = True
    for i in range(point.values.size):
        inside = inside and point.values[i] < 0.0
    return inside


@kernel
def norm_of(vector: Field) -> float:
    """Euclidean norm of a vector [n], in its unit [1]."""
    total = 0.0
    for j in range(vector.size):
        total += vector[j] * vector[j]
    return math.sqrt(total)


@kernel
def gap_of(point: Point) -> float:
    """`-sum lambda_i g_i` over the constraints [constraints], in the unit of the cost [1]."""
    total = 0.0
    for i in range(point.values.size):
        total -= point.multipliers[i] * point.values[i]
    return total


@kernel
def stationarity(program: Program, point: Point) -> Field:
    """`P z + q + G^T lambda` [n]."""
    size = point.unknowns.size
    found = program.linear.copy()
    for j in range(size):
        for m in range(size):
            found[j] += program.quadratic[j, m] * point.unknowns[m]
        for i in range(point.values.size):
            found[j] += point.multipliers[i] * point.gradients[i, j]
    return found


@kernel
def residual(program: Program, point: Point, target: float) -> float:
    """Norm [1] of the stationarity and of `-lambda g - 1/t`, lengths over the size; target: 1/t
    [1]."""
    total = 0.0
    for part in stationarity(program, point):
        total += part * part
    for i in range(point.values.size):
        total += (point.multipliers[i] * point.values[i] + target) ** 2
    return math.sqrt(total)


@kernel
def hessian(program: Program, multipliers: Field) -> Field:
    """`P + 2 sum lambda_k Q_k` [n, n] of the Lagrangian."""
    found = program.quadratic.copy()
    flat, size = program.flat_bounds.size, found.shape[0]
    for k in range(program.curved_bounds.size):
        for j in range(size):
            for m in range(size):
                found[j, m] += 2.0 * multipliers[flat + k] * program.curved[k, j, m]
    return found


@kernel
def newton_step(program: Program, point: Point, target: float) -> tuple[Field, Field]:
    """Step of the unknowns [n] and of the multipliers [constraints], the latter eliminated; target:
    1/t in the unit of the cost [1]."""
    size, count = point.unknowns.size, point.values.size
    # Newton's system with the multipliers eliminated.
    matrix = hessian(program, point.multipliers)
    right = moved_by(numpy.zeros(size), -1.0, stationarity(program, point))
    for i in range(count):
        weight = -point.multipliers[i] / point.values[i]
        push = point.multipliers[i] + target / point.values[i]
        for j in range(size):
            right[j] += push * point.gradients[i, j]
            for m in range(size):
                matrix[j, m] += weight * point.gradients[i, j] * point.gradients[i, m]
    # Regularised relative to its diagonal.
    largest = 0.0
    for j in range(size):
        largest = max(largest, matrix[j, j])
    for j in range(size):
        matrix[j, j] += REGULARISATION * largest
    # Step of the unknowns, then of the multipliers.
    step = solve_linear(matrix, right)
    multiplier_step = numpy.empty(count)
    for i in range(count):
        slope = 0.0
        for j in range(size):
            slope += point.gradients[i, j] * step[j]
        multiplier_step[i] = -(point.multipliers[i] * slope + target) / point.values[i] - point.multipliers[i]
    return step, multiplier_step


@kernel
def line_search(
    program: Program, point: Point, step: Field, multiplier_step: Field, target: float
) -> tuple[float, Point]:
    """Longest halved step [1] that stays inside, keeps the multipliers positive and lowers the
    residual; 0 if there is none.

    step: [n]; multiplier_step: [constraints]; target: 1/t in the unit of the cost [1].
    """
    length = 1.0
    for i in range(point.values.size):
        if multiplier_step[i] < 0.0:
            length = min(length, -0.99 * point.multipliers[i] / multiplier_step[i])
    # Halved from the longest step that keeps the multipliers positive
    before = residual(program, point, target)
    for _ in range(MOST_HALVINGS):
        multipliers = moved_by(point.multipliers, length, multiplier_step)
        moved = evaluate(program, moved_by(point.unknowns, length, step), multipliers)
        keeps_off = True
        for i in range(point.values.size):
            keeps_off = keeps_off and moved.values[i] < CLOSEST_SHARE * point.values[i]
        if keeps_off and residual(program, moved, target) <= max((1.0 - 0.01 * length) * before, FINISHED):
            return length, moved
        length *= 0.5
    return 0.0, point
