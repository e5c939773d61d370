"""Solution of a small dense linear system inside compiled code."""

from __future__ import annotations

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.jit import kernel

__all__ = ["solve_linear"]

Field = NDArray[numpy.float64]


@kernel
def solve_linear(matrix: Field, right: Field) -> Field:
    """x of `matrix x = right` [n], by elimination with row pivoting; both arguments are
    overwritten.

    A pivot that is exactly zero gives infinities or NaN in the result.
    """
    size = right.size
    for column in range(size):
        # Largest pivot of the column, its row moved up
        pivot = column
        for row in range(column + 1, size):
            if abs(matrix[row, column]) > abs(matrix[pivot, column]):
                pivot = row
        for k in range(column, size):
            matrix[column, k], matrix[pivot, k] = matrix[pivot, k], matrix[column, k]
        right[column], right[pivot] = right[pivot], right[column]
        for row in range(column + 1, size):
            factor = matrix[row, column] / matrix[column, column]
            for k in range(column, size):
                matrix[row, k] -= factor * matrix[column, k]
            right[row] -= factor * right[column]
    # Back substitution
    for row in range(size - 1, -1, -1):
        for k in range(row + 1, size):
            right[row] -= matrix[row, k] * right[k]
        right[row] /= matrix[row, row]
    return right
