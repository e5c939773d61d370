"""A belt that yields in series with a half-space: what it adds to the preconditioner, and to a step
that clips.

The belt is rigid across, so its displacement w [rows] follows from the line sums of the pressure
alone, `w = G l`, `l_i = sum_j p_ij`. Against long waves it is far softer than the half-space: a
clearance that is the same across a row is mostly to be taken by the belt. With M the preconditioner
of the half-space and U the sum across the free cells of each row, the inverse of the sum of both is

    M - M U W U^T M,    W = (G^-1 + A)^-1,    A = U^T M U        (Woodbury).

A is taken from a strip of one width and scaled to the free cells n_i of each row, `sqrt(n_i n_j)`; the
lines `A W U^T M r` that the belt takes are spread evenly over the free cells of their row, in
place of a second filter. Of a contact that is scattered over the tops of a rough road M makes larger
lines than A says, and the belt would be sent too far: what it leaves of them, `G^-1 W`, is divided by a
root of how much larger.

Clipping at p >= 0 adds line sums e that the direction did not have. The belt would yield under
them: the rows are scaled down by their part `A W e`, else most of the next step would be spent on
it.

Source: Pacejka, Tire and Vehicle Dynamics, 9; Tire/Road Contact eqs 3 and 4.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.guards import require_positive, require_values
from contact_sim_pkg.compiled.jit import borrowing_kernel

__all__ = [
    "BeltWorkspace",
    "factor_belt",
    "keep_lines",
    "make_belt_workspace",
    "relieve",
    "stiffness_of_belt",
    "weigh_scatter",
]

Field = NDArray[numpy.float64]
Values = NDArray[numpy.float64]
Cells = NDArray[numpy.int64]

SOFTEST = 1e-6
"""Of the belt's influence under the load, added there: short waves of a thick belt have none."""

FEWEST = 3
"""Free cells of a row that lines are spread over: a cell of its own at the border would be held by them."""

SCATTERED = 0.25
"""Power of that factor: with 1 contacts of many tops take twice the corrections, with 0 one in five fails."""

LINE_FACTORS = (0.3, 1.5)
"""Least and largest factor of the pressure of a row after clipping."""


class BeltWorkspace(NamedTuple):
    """Scratch of one solve; of no size where there is no belt."""

    # [rows, rows] U of `U^T U = G^-1 + A`, upper triangle
    factor: Field
    root: Values  # [rows] sqrt(free cells over those of the strip)
    lines: Values  # [rows] [Pa] sums across
    taken: Values  # [rows] [Pa] of them by the belt
    scattered: Values  # [1] of what M makes of a clearance of the cells in contact over what A does


def stiffness_of_belt(along: Values) -> Field:
    """Inverse [Pa/m] of the influence `along` [rows] [m/Pa] of a line of cells on lines so many rows
    away, above 0 under the load. Raises ValueError where one is not finite or they have no inverse.
    """
    along = require_values("influence of the belt", along, "m/Pa", shape=(None,))
    require_positive("influence of the belt under the load", float(along[0]) if len(along) else 0.0, "m/Pa")
    rows = numpy.arange(len(along))
    influence = along[abs(rows[:, None] - rows)] + SOFTEST * along[0] * numpy.eye(len(along))
    return numpy.ascontiguousarray(numpy.linalg.inv(influence))


def make_belt_workspace(rows: int) -> BeltWorkspace:
    """Scratch for a belt under `rows` rows."""
    return BeltWorkspace(
        numpy.zeros((rows, rows)), numpy.zeros(rows), numpy.zeros(rows), numpy.zeros(rows), numpy.ones(1)
    )


@borrowing_kernel
def factor_belt(belt: Field, strip: Field, pressure: Field, scratch: BeltWorkspace) -> None:
    """Factor `G^-1 + A` for the cells in contact; nothing without a belt.

    belt: G^-1 [rows, rows] [Pa/m]; strip: A of a strip as wide as the grid [rows, rows] [Pa/m];
    pressure: [rows, cols] [Pa].
    """
    factor, root = scratch.factor, scratch.root
    count = len(belt)
    cols = pressure.shape[1]
    for i in range(count):
        pressing = 0
        for j in range(cols):
            pressing += 1 if pressure[i, j] > 0.0 else 0
        root[i] = numpy.sqrt(pressing / cols)
    for i in range(count):
        for j in range(i, count):
            factor[i, j] = belt[i, j] + root[i] * strip[i, j] * root[j]
    # Cholesky by rows: the inner loop runs along memory, past which each row goes once for four.
    for first in range(0, count, 4):
        end = min(first + 4, count)
        for k in range(first, end):
            scale = 1.0 / numpy.sqrt(factor[k, k])
            for j in range(k, count):
                factor[k, j] *= scale
            for i in range(k + 1, end):
                take_row_off(factor, k, i)
        for i in range(end, count):
            take_rows_off(factor, first, i)


@borrowing_kernel
def weigh_scatter(strip: Field, pressure: Field, filtered: Field, scratch: BeltWorkspace) -> None:
    """How much larger lines M makes of a clearance of the cells in contact than A does, once the rows are factored.

    strip, pressure: as there; filtered: what M makes of 1 m on the cells in contact [rows, cols] [Pa].
    """
    rows, cols = pressure.shape
    root, of_cells, of_strip = scratch.root, 0.0, 0.0
    for i in range(rows):
        for j in range(cols):
            of_cells += filtered[i, j] if pressure[i, j] > 0.0 else 0.0
        for j in range(rows):
            of_strip += root[i] * strip[i, j] * root[j]
    scratch.scattered[0] = max(of_cells / of_strip, 1.0) ** SCATTERED if of_strip > 0.0 else 1.0


@borrowing_kernel
def take_row_off(factor: Field, k: int, i: int) -> None:
    """Take row `k` off row `i` of a triangle [rows, rows] that is factored."""
    above, row = factor[k, i:], factor[i, i:]
    part = above[0]
    for j in range(len(row)):
        row[j] -= part * above[j]


@borrowing_kernel
def take_rows_off(factor: Field, k: int, i: int) -> None:
    """The same of the four rows from `k` on, one after the other."""
    first, second, third, fourth = factor[k, i:], factor[k + 1, i:], factor[k + 2, i:], factor[k + 3, i:]
    a, b, c, d, row = first[0], second[0], third[0], fourth[0], factor[i, i:]
    for j in range(len(row)):
        row[j] = (((row[j] - a * first[j]) - b * second[j]) - c * third[j]) - d * fourth[j]


@borrowing_kernel
def taken_by_belt(belt: Field, scratch: BeltWorkspace, scattered: float) -> None:
    """`A W l` of the lines l, as `l - G^-1 W l / s`, into `taken`; s: `scattered`.

    belt: [rows, rows] [Pa/m].
    """
    factor, lines, taken = scratch.factor, scratch.lines, scratch.taken
    count = len(belt)
    for i in range(count):
        taken[i] = lines[i]
    # W l by the two triangles.
    for k in range(count):
        taken[k] /= factor[k, k]
        part = taken[k]
        for j in range(k + 1, count):
            taken[j] -= factor[k, j] * part
    for i in range(count - 1, -1, -1):
        total = taken[i]
        for j in range(i + 1, count):
            total -= factor[i, j] * taken[j]
        taken[i] = total / factor[i, i]
    # The part of the half-space off.
    for k in range(count):
        part = taken[k] / scattered
        for i in range(count):
            lines[i] -= belt[k, i] * part
    for i in range(count):
        taken[i] = lines[i]


@borrowing_kernel
def relieve(belt: Field, residual: Field, filtered: Field, scratch: BeltWorkspace) -> None:
    """Take the lines of the belt off the preconditioned clearance; nothing without a belt.

    belt: [rows, rows] [Pa/m]; residual: [rows, cols] [m], 0 on cells that are not free; filtered:
    [rows, cols] [Pa].
    """
    lines, taken = scratch.lines, scratch.taken
    cols = residual.shape[1]
    for i in range(len(belt)):
        total = 0.0
        for j in range(cols):
            total += filtered[i, j] if residual[i, j] != 0.0 else 0.0
        lines[i] = total
    taken_by_belt(belt, scratch, scratch.scattered[0])
    for i in range(len(belt)):
        free = 0
        for j in range(cols):
            free += 1 if residual[i, j] != 0.0 else 0
        each = taken[i] / free if free >= FEWEST else 0.0
        for j in range(cols):
            filtered[i, j] -= each


@borrowing_kernel
def keep_lines(
    belt: Field, pressure: Field, clipped: Values, leaving: Cells, left: int, scratch: BeltWorkspace
) -> None:
    """Scale the rows of a pressure that was clipped, by what the belt would yield under; nothing
    without a belt.

    belt: [rows, rows] [Pa/m]; pressure: [rows, cols] [Pa]; clipped: [cells] [Pa] added to the first
    `left` cells of `leaving`.
    """
    lines, taken = scratch.lines, scratch.taken
    cols = pressure.shape[1]
    for i in range(len(belt)):
        lines[i] = 0.0
    for m in range(left if len(belt) > 0 else 0):
        lines[leaving[m] // cols] += clipped[m]
    taken_by_belt(belt, scratch, 1.0)
    for i in range(len(belt)):
        total = 0.0
        for j in range(cols):
            total += pressure[i, j]
        if total > 0.0:
            factor = min(max(1.0 - taken[i] / total, LINE_FACTORS[0]), LINE_FACTORS[1])
            for j in range(cols):
                pressure[i, j] *= factor
