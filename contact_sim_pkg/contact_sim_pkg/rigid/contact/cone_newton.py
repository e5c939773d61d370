"""Newton's method on the contact problem with the true (second-order) friction cone, from a start
nearby.

Conditions as one equation (Alart and Curnier 1991): ``c_n = max(floor, c_n - u_n)``, ``c_t =
projection of c_t - u_t on the disc of radius mu c_n``, in contacts scaled by sqrt(A_nn,i). Its
derivative is singular where contacts are redundant, but the step exists: elimination with complete
pivoting finds one.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
import numpy.typing

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import kernel
from contact_sim_pkg.rigid.contact.linear import solve_consistent
from contact_sim_pkg.rigid.problem import SPACE, residual
from contact_sim_pkg.rigid.results import NOT_CONVERGED, SOLVED

ITERATIONS = 30
STALLED = 4  # iterations without a better residual after which the method ends
# residual that counts as solved; residual at which no further step is taken
GOOD, ENOUGH = 1.0e-12, 1.0e-15


class NewtonWorkspace(NamedTuple):
    """Arrays of the method."""

    matrix: Vector  # [rows, rows]
    right: Vector  # [rows]
    step: Vector  # [rows]
    velocity: Vector  # [rows]
    best: Vector  # [rows]
    order: numpy.typing.NDArray[numpy.int64]  # [rows]


def make_newton_workspace(rows: int) -> NewtonWorkspace:
    """Work space for problems of ``rows`` rows."""
    zeros = numpy.zeros
    return NewtonWorkspace(
        zeros((rows, rows)), zeros(rows), zeros(rows), zeros(rows), zeros(rows), zeros(rows, numpy.int64)
    )


@kernel
def _velocity_row(problem, work, row, value):
    """Equation ``velocity of the row = 0``."""
    weight = problem.A[row - row % problem.width, row - row % problem.width]
    for j in range(problem.q.shape[0]):
        work.matrix[row, j] = problem.A[row, j] / weight
    work.right[row] = -value / weight


@kernel
def _impulse_row(problem, work, row, value):
    """Equation ``impulse of the row = what it is less value``."""
    for j in range(problem.q.shape[0]):
        work.matrix[row, j] = 0.0
    work.matrix[row, row] = 1.0
    work.right[row] = -value


@kernel
def _slide_rows(problem, work, c, row, friction, x, y, radius):
    """Equations ``c_t = radius (x, y)/|(x, y)|`` with (x, y) = c_t - u_t / A_nn."""
    weight = problem.A[row, row]
    length = math.hypot(x, y)
    s = (x / length, y / length)
    for a in range(problem.width - 1):
        for j in range(problem.q.shape[0]):
            first = (1.0 if j == row + 1 else 0.0) - problem.A[row + 1, j] / weight
            second = 0.0
            if problem.width == SPACE:
                second = (1.0 if j == row + 2 else 0.0) - problem.A[row + 2, j] / weight
            along = s[0] * first + s[1] * second
            turned = (first if a == 0 else second) - s[a] * along
            work.matrix[row + 1 + a, j] = (1.0 if j == row + 1 + a else 0.0) - radius / length * turned
        work.matrix[row + 1 + a, row] -= s[a] * friction
        work.right[row + 1 + a] = radius * s[a] - c[row + 1 + a]


@kernel
def _fill(problem, work, c):
    for i in range(problem.friction.shape[0]):
        row = i * problem.width
        weight, friction, floor = problem.A[row, row], problem.friction[i], problem.floor[i]
        u = work.velocity
        # normal row: the contact presses, or its impulse is at the floor
        if c[row] - u[row] / weight > floor:
            _velocity_row(problem, work, row, u[row])
        else:
            _impulse_row(problem, work, row, c[row] - floor)
        # tangential rows: no friction, stick (velocity 0), or slip on the edge of the disc
        x, y = c[row + 1] - u[row + 1] / weight, 0.0
        if problem.width == SPACE:
            y = c[row + 2] - u[row + 2] / weight
        radius = friction * max(0.0, c[row])
        if radius <= 0.0:
            for a in range(1, problem.width):
                _impulse_row(problem, work, row + a, c[row + a])
        elif math.hypot(x, y) <= radius:
            for a in range(1, problem.width):
                _velocity_row(problem, work, row + a, u[row + a])
        else:
            _slide_rows(problem, work, c, row, friction, x=x, y=y, radius=radius)


@kernel
def solve_by_newton(problem, work, c):
    """Improve ``c`` [rows] in place; returns (status, residual). Never worse than the start."""
    rows = problem.q.shape[0]
    best, waited = numpy.inf, 0
    for _ in range(ITERATIONS):
        # the best iterate is kept: a step of the semismooth equation may lead away
        now = residual(problem, c, work.velocity)
        if now < best:
            best, waited = now, 0
            for i in range(rows):
                work.best[i] = c[i]
        else:
            waited += 1
        if best <= ENOUGH or waited >= STALLED or not now < numpy.inf:
            break
        # singular where contacts are redundant; the system has a solution all the same
        _fill(problem, work, c)
        solve_consistent(work.matrix, work.right, work.step, work.order, rows)
        for i in range(rows):
            c[i] += work.step[i]
    for i in range(rows):
        c[i] = work.best[i]
    return (SOLVED if best <= GOOD else NOT_CONVERGED), best
