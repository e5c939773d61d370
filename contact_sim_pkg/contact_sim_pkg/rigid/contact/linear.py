"""Linear systems that may be singular but have a solution: elimination with complete pivoting.

Source: Golub and Van Loan, Matrix Computations, 3.4.
"""

from __future__ import annotations

from contact_sim_pkg.compiled.jit import kernel

RANK_TOLERANCE = 1.0e-11  # a pivot below this part of the greatest counts as zero


@kernel
def _swap(matrix, right, order, step, row, column):
    n = matrix.shape[1]
    if row != step:
        right[step], right[row] = right[row], right[step]
        for j in range(n):
            matrix[step, j], matrix[row, j] = matrix[row, j], matrix[step, j]
    if column != step:
        order[step], order[column] = order[column], order[step]
        for i in range(matrix.shape[0]):
            matrix[i, step], matrix[i, column] = matrix[i, column], matrix[i, step]


@kernel
def _greatest(matrix, step, n):
    greatest, row, column = -1.0, step, step
    for i in range(step, n):
        for j in range(step, n):
            if abs(matrix[i, j]) > greatest:
                greatest, row, column = abs(matrix[i, j]), i, j
    return greatest, row, column


@kernel
def solve_consistent(matrix, right, x, order, n):
    """Solve ``matrix x = right`` (first ``n`` rows and columns), both overwritten; returns the
    rank.

    Where the rank is short the unknowns that are left over are 0. ``order`` [n] integers is work
    space.
    """
    for i in range(n):
        order[i] = i
    first, rank = 0.0, n
    for step in range(n):
        # complete pivoting: a pivot that is rounding ends the elimination
        greatest, row, column = _greatest(matrix, step, n)
        if step == 0:
            first = greatest
        if not greatest > RANK_TOLERANCE * first:
            rank = step
            break
        _swap(matrix, right, order, step, row, column)
        for i in range(step + 1, n):
            factor = matrix[i, step] / matrix[step, step]
            if factor != 0.0:
                right[i] -= factor * right[step]
                for j in range(step, n):
                    matrix[i, j] -= factor * matrix[step, j]
    # unknowns beyond the rank are 0; the others by back substitution
    for i in range(rank, n):
        x[order[i]] = 0.0
    for i in range(rank - 1, -1, -1):
        total = right[i]
        for j in range(i + 1, rank):
            total -= matrix[i, j] * x[order[j]]
        x[order[i]] = total / matrix[i, i]
    return rank
