"""Half-space contact without shortcuts: log-form influence, dense matrix, non-negative least
squares.

For small grids only (24 x 24): the work grows with the cube of the number of cells.
"""

from __future__ import annotations

import mpmath
import numpy
import scipy.linalg
import scipy.optimize
from numpy.typing import NDArray

__all__ = ["cell_displacement", "dense_influence", "direct_sum", "displacement", "pressure_at_approach"]

Field = NDArray[numpy.float64]


def cell_displacement(x: float, y: float, half_x: float, half_y: float, modulus: float) -> float:
    """Displacement [m/Pa] at (x, y) of a cell of half-sizes half_x, half_y under unit pressure, to
    30 digits.

    Love's four logarithms, `(x+hx) ln[(y+hy+R1)/(y-hy+R2)] + ...`, in multiple precision, where
    they lose nothing.
    """
    with mpmath.workdps(50):
        east, west = mpmath.mpf(x) + mpmath.mpf(half_x), mpmath.mpf(x) - mpmath.mpf(half_x)
        north, south = mpmath.mpf(y) + mpmath.mpf(half_y), mpmath.mpf(y) - mpmath.mpf(half_y)
        r1, r2 = mpmath.hypot(east, north), mpmath.hypot(east, south)
        r3, r4 = mpmath.hypot(west, north), mpmath.hypot(west, south)
        total = east * mpmath.log((north + r1) / (south + r2)) + north * mpmath.log((east + r1) / (west + r3))
        total += west * mpmath.log((south + r4) / (north + r3)) + south * mpmath.log((west + r4) / (east + r2))
        return float(total / (mpmath.pi * modulus))


def dense_influence(rows: int, cols: int, cell_x: float, cell_y: float, modulus: float) -> Field:
    """Matrix K [m/Pa], [rows*cols, rows*cols]: displacement of each cell centre under unit pressure
    on each cell.
    """
    table = numpy.array(
        [
            [cell_displacement(i * cell_x, j * cell_y, cell_x / 2, cell_y / 2, modulus) for j in range(cols)]
            for i in range(rows)
        ]
    )
    row, col = numpy.divmod(numpy.arange(rows * cols), cols)
    return numpy.asarray(table[abs(row[:, None] - row), abs(col[:, None] - col)])


def direct_sum(
    places: NDArray[numpy.int64], pressure: Field, cell_x: float, cell_y: float, modulus: float
) -> NDArray[numpy.float64]:
    """Displacement [places] [m] of the cells ``places`` [places, 2] (row, column) under ``pressure``
    [rows, cols] [Pa]: Love's four logarithms, summed over the loaded cells one by one.
    """
    rows, cols = numpy.nonzero(pressure)
    found = []
    for row, col in places:
        east, north = (row - rows + 0.5) * cell_x, (col - cols + 0.5) * cell_y
        west, south = east - cell_x, north - cell_y
        r1, r2 = numpy.hypot(east, north), numpy.hypot(east, south)
        r3, r4 = numpy.hypot(west, north), numpy.hypot(west, south)
        total = east * numpy.log((north + r1) / (south + r2)) + north * numpy.log((east + r1) / (west + r3))
        total += west * numpy.log((south + r4) / (north + r3)) + south * numpy.log((west + r4) / (east + r2))
        found.append(float(numpy.sum(total * pressure[rows, cols])))
    return numpy.array(found) / (numpy.pi * modulus)


def displacement(influence: Field, pressure: Field) -> Field:
    """Surface displacement [m] by the matrix product."""
    return numpy.asarray((influence @ pressure.ravel()).reshape(pressure.shape))


def pressure_at_approach(influence: Field, gap: Field, approach: float) -> Field:
    """Pressure [Pa] at a given approach [m]: non-negative least squares of `|L'p - L^-1 (approach -
    gap)|`, K = L L'.

    Its optimality conditions are exactly p >= 0, clearance >= 0, p * clearance = 0.
    """
    lower = scipy.linalg.cholesky(influence, lower=True)
    scale = float(numpy.sqrt(influence[0, 0]))
    right = scipy.linalg.solve_triangular(lower, approach - gap.ravel(), lower=True)
    pressure, _ = scipy.optimize.nnls(lower.T / scale, right, maxiter=100 * gap.size)
    return numpy.asarray(pressure.reshape(gap.shape) / scale)
