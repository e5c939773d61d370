"""Lemke's method for the linear complementarity problem ``0 <= z _|_ w = M z + q >= 0``,
lexicographic against cycling.

Tableau ``w - M z - d z0 = q``, d > 0 the covering vector, ones unless set: columns w, z, z0, q. The
columns of w hold the inverse of the basis: with them ties are broken lexicographically, and the end
result is refined against the problem as it was given. Source: Cottle, Pang, Stone, The Linear
Complementarity Problem, 4.4 and 4.9.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy
import numpy.typing

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import kernel
from contact_sim_pkg.rigid.results import CONTACT_NOT_FINITE, NOT_CONVERGED, RAY, SOLVED

# entries are of order 1: contact rows are scaled by their own inverse mass
PIVOT_TOLERANCE = 1.0e-10
TIE_TOLERANCE = 1.0e-11
BASIS_TOLERANCE = 1.0e-15
REFINEMENTS = 3
PIVOTS_PER_ROW = 40


class LemkeWorkspace(NamedTuple):
    """Arrays for problems of up to ``make_lemke_workspace(size)`` unknowns."""

    M: Vector  # [size, size]
    q: Vector  # [size]
    cover: Vector  # [size], d: greater than 0
    z: Vector  # [size]
    tableau: Vector  # [size, 2 size + 2]
    basis: numpy.typing.NDArray[numpy.int64]  # [size]; w_i: i, z_i: size + i, z0: 2 size
    correction: Vector  # [size]


def make_lemke_workspace(size: int) -> LemkeWorkspace:
    """Work space for problems of up to ``size`` unknowns."""
    zeros = numpy.zeros
    return LemkeWorkspace(
        zeros((size, size)), zeros(size), numpy.ones(size), zeros(size), zeros((size, 2 * size + 2)),
        zeros(size, numpy.int64), zeros(size),
    )  # fmt: skip


@kernel
def _set_up(work, n):
    M, q, tableau, basis = work.M, work.q, work.tableau, work.basis
    for i in range(n):
        basis[i] = i
        for j in range(n):
            tableau[i, j] = 0.0
            tableau[i, n + j] = -M[i, j]
        tableau[i, i] = 1.0
        tableau[i, 2 * n] = -work.cover[i]
        tableau[i, 2 * n + 1] = q[i]


@kernel
def _pivot(tableau, row, column, n):
    columns = 2 * n + 2
    factor = 1.0 / tableau[row, column]
    for j in range(columns):
        tableau[row, j] *= factor
    tableau[row, column] = 1.0
    for i in range(n):
        factor = tableau[i, column]
        if i == row or factor == 0.0:
            continue
        for j in range(columns):
            tableau[i, j] -= factor * tableau[row, j]
        tableau[i, column] = 0.0


@kernel
def _comes_first(tableau, row, other, column, n):
    """Whether ``row`` leaves before ``other``: lexicographic order of (q, inverse basis) over the
    entering column.
    """
    for k in range(n + 1):
        j = 2 * n + 1 if k == 0 else k - 1
        mine, theirs = tableau[row, j] / tableau[row, column], tableau[other, j] / tableau[other, column]
        difference = mine - theirs
        if abs(difference) > TIE_TOLERANCE * max(1.0e-3, abs(mine), abs(theirs)):
            return difference < 0.0
    return False


@kernel
def _leaving_row(work, column, n):
    """Row of the variable that leaves, -1 on a ray; z0 is let go wherever it ties."""
    tableau, basis = work.tableau, work.basis
    best, row_of_z0 = -1, -1
    for i in range(n):
        if tableau[i, column] <= PIVOT_TOLERANCE:
            continue
        if basis[i] == 2 * n:
            row_of_z0 = i
        if best < 0 or _comes_first(tableau, i, best, column, n):
            best = i
    if row_of_z0 >= 0 and best != row_of_z0:
        mine = tableau[row_of_z0, 2 * n + 1] / tableau[row_of_z0, column]
        if mine - tableau[best, 2 * n + 1] / tableau[best, column] <= TIE_TOLERANCE * max(1.0e-3, abs(mine)):
            return row_of_z0
    return best


@kernel
def _basic_part(M, basis, row, x, n):
    """Contribution of the basic variables ``x`` to row ``row`` of ``w - M z``."""
    total = 0.0
    for k in range(n):
        variable = basis[k]
        if variable < n:
            total += x[k] if variable == row else 0.0
        elif variable < 2 * n:
            total -= M[row, variable - n] * x[k]
    return total


@kernel
def _read_solution(work, n):
    """Basic values refined against M and q, then into ``work.z``; rounding below zero is cut
    off.
    """
    tableau, basis, z, correction, last = work.tableau, work.basis, work.z, work.correction, 2 * n + 1
    M, q = work.M, work.q
    for i in range(n):
        z[i] = tableau[i, last]
    # the columns of w hold the inverse of the basis: refine against M and q as they were given
    for _ in range(REFINEMENTS):
        for i in range(n):
            correction[i] = q[i] - _basic_part(M, basis, i, z, n)
        for i in range(n):
            total = 0.0
            for j in range(n):
                total += tableau[i, j] * correction[j]
            z[i] += total
    for i in range(n):
        # values of the basic variables, refined
        tableau[i, last] = z[i]
    for i in range(n):
        z[i] = 0.0
    for i in range(n):
        # of these the z; the w and z0 do not count
        if n <= basis[i] < 2 * n:
            z[basis[i] - n] = max(0.0, tableau[i, last])


@kernel
def complementarity_residual(work, n):
    """Greatest ``|min(z_i, w_i)|`` of ``work.z`` in the problem that ``work`` holds, over 1 or the
    greatest unknown.
    """
    M, q, z, worst, greatest = work.M, work.q, work.z, 0.0, 1.0
    for i in range(n):
        w = q[i]
        for j in range(n):
            w += M[i, j] * z[j]
        broken = abs(min(z[i], w))
        if not broken <= worst:  # also true for NaN
            worst = broken
        greatest = max(greatest, z[i])
    return worst / greatest


@kernel
def solve_in_basis(work, n):
    """Solve for another ``work.q`` in the basis of the last call of `lemke`; False where that is no
    longer the solution's.
    """
    tableau, q, last = work.tableau, work.q, 2 * n + 1
    for i in range(n):
        total = 0.0
        for j in range(n):
            total += tableau[i, j] * q[j]
        tableau[i, last] = total
    _read_solution(work, n)
    holds = True
    for i in range(n):
        holds = holds and tableau[i, last] >= -BASIS_TOLERANCE
    return holds


@kernel
def lemke(work: LemkeWorkspace, n: int) -> int:
    """Solve the first ``n`` rows of ``work.M``, ``work.q`` (entries of order 1) into ``work.z``;
    returns a status.

    SOLVED; RAY where no variable can leave; NOT_CONVERGED after 40 pivots a row;
    CONTACT_NOT_FINITE.
    """
    _set_up(work, n)
    q, z, tableau, basis = work.q, work.z, work.tableau, work.basis
    # z0 enters at the row that needs most of it: all w are then at least 0
    row = 0
    for i in range(n):
        z[i] = 0.0
        if not abs(q[i]) < numpy.inf:
            return CONTACT_NOT_FINITE
        if q[i] * work.cover[row] <= q[row] * work.cover[i]:
            row = i
    if q[row] >= 0.0:
        return SOLVED
    # the complement of what left enters next, until z0 leaves
    entering = 2 * n
    for _ in range(PIVOTS_PER_ROW * n):
        leaving = basis[row]
        _pivot(tableau, row, entering, n)
        basis[row] = entering
        if leaving == 2 * n:
            _read_solution(work, n)
            return SOLVED
        entering = leaving + n if leaving < n else leaving - n
        row = _leaving_row(work, entering, n)
        if row < 0:
            return RAY
    return NOT_CONVERGED
