"""Start without a field before: the field on a grid of half as many cells each way as a start.

Source: Tire/Road Contact eqs 1 to 4; nested iteration: Hackbusch, Multi-Grid Methods and
Applications, 5.
"""

from __future__ import annotations

import numpy

from contact_sim_pkg.compiled.jit import borrowing_kernel, entry
from contact_sim_pkg.pressure.field.halfspace import Field
from contact_sim_pkg.pressure.field.iteration import SolverWorkspace
from contact_sim_pkg.pressure.field.outside import widened
from contact_sim_pkg.pressure.field.prediction import PreviousField

__all__ = ["double", "halve", "start_from_half", "window_of_half"]


@entry
def halve(gap: Field, out: Field) -> None:
    """Means of two by two cells.

    gap: [2 rows, 2 cols] [m]; out: [rows, cols] [m].
    """
    for i in range(out.shape[0]):
        for j in range(out.shape[1]):
            out[i, j] = 0.25 * (
                (gap[2 * i, 2 * j] + gap[2 * i, 2 * j + 1]) + (gap[2 * i + 1, 2 * j] + gap[2 * i + 1, 2 * j + 1])
            )


@entry
def double(pressure: Field, out: Field) -> None:
    """Bilinear interpolation to two by two cells each, zero where `pressure` is.

    pressure: [rows, cols] [Pa]; out: [2 rows, 2 cols] [Pa].
    """
    rows, cols = pressure.shape
    for i in range(2 * rows):
        row = i // 2
        beside = min(max(row + 2 * (i % 2) - 1, 0), rows - 1)
        for j in range(2 * cols):
            col = j // 2
            next_to = min(max(col + 2 * (j % 2) - 1, 0), cols - 1)
            near = 0.75 * pressure[row, col] + 0.25 * pressure[row, next_to]
            far = 0.75 * pressure[beside, col] + 0.25 * pressure[beside, next_to]
            out[i, j] = 0.75 * near + 0.25 * far if pressure[row, col] > 0.0 else 0.0


@entry
def window_of_half(rows: int, cols: int, box: tuple[int, int, int, int]) -> tuple[int, int, int, int]:
    """Window of a grid of `rows` x `cols` cells around what is the `box` of the contact on the grid
    of half as many: its first and last row, first and last column.
    """
    top, bottom, left, right = box
    return widened(rows, cols, 2 * top, 2 * bottom + 1, 2 * left, 2 * right + 1)


@borrowing_kernel
def start_from_half(workspace: SolverWorkspace, first_row: int, first_col: int, half: PreviousField) -> None:
    """Pressure and displacement of the last field on the grid of half as many cells each way, each
    continued linearly within its cells: so their means stay, and with the sums of the pressure what a
    belt yields. u goes into `surface`, infinite where it is not known.

    The pressure keeps a tenth of its cell's at least. Pressure: [rows, cols] [Pa], surface: [rows,
    cols] [m] of the window at (first_row, first_col).
    """
    pressure, surface, p, u = workspace.pressure, workspace.surface, half.pressure, half.displacement
    rows, cols = pressure.shape
    top, start, bottom, end, _moved = half.place
    for i in range(rows):
        for j in range(cols):
            pressure[i, j], surface[i, j] = 0.0, numpy.inf
        row, lower = (first_row + i) // 2, (first_row + i) % 2
        if not top <= row < bottom:
            continue
        # An eighth of the difference of its neighbours, to each side of a cell's middle.
        above, below, down = max(row - 1, top), min(row + 1, bottom - 1), 0.25 * lower - 0.125
        for col in range(max(start, (first_col + 1) // 2), min(end, (first_col + cols) // 2)):
            j, left, right = 2 * col - first_col, max(col - 1, start), min(col + 1, end - 1)
            middle = u[row, col] + down * (u[below, col] - u[above, col])
            aside = 0.125 * (u[row, right] - u[row, left])
            surface[i, j], surface[i, j + 1] = middle - aside, middle + aside
            middle, aside = down * (p[below, col] - p[above, col]), 0.125 * (p[row, right] - p[row, left])
            steep, most = abs(middle) + abs(aside), 0.9 * p[row, col]
            part = most / steep if steep > most else 1.0
            pressure[i, j] = p[row, col] + part * (middle - aside)
            pressure[i, j + 1] = p[row, col] + part * (middle + aside)
