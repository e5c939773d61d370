"""A field on the window of a grid that can be in contact, alone; see `pressure/field/window.py`.

Windows come in sizes of `STEP` cells, so that a handful of influence tables serves a whole run.
"""

from __future__ import annotations

import numpy

from contact_sim_pkg.compiled.jit import entry
from contact_sim_pkg.pressure.field.halfspace import Field, HalfSpace
from contact_sim_pkg.pressure.field.solver import (
    FieldResult,
    acceptable,
    make_workspace,
    solve_at_approach,
    solve_at_load,
)
from contact_sim_pkg.pressure.field.window import GridWindow, Part, copy_window, make_part, write_window

__all__ = ["STEP", "WindowedSolver", "overlap_window"]

STEP = 4
"""Sizes of windows are multiples of it [cells]; chosen by time on the tire's grid."""


class WindowedSolver:
    """Fields on one grid. Tables of a window's size are made when it first comes (about 1 ms) and
    kept.
    """

    def __init__(self, half_space: HalfSpace) -> None:
        """Take the whole grid."""
        self.half_space = half_space
        self._whole = make_workspace(half_space)
        self._parts: dict[tuple[int, int], Part] = {}
        cell = numpy.zeros((1, 1))
        # Compiled now: the first window that is not the whole grid may come in the middle of a run.
        copy_window(cell, 0, 0, cell)
        write_window(cell, 0, 0, numpy.zeros((1, 1)))

    def solve_at_approach(
        self, gap: Field, approach: float, tolerance: float, max_iterations: int, pressure: Field
    ) -> FieldResult:
        """As `field_solver.solve_at_approach` on the whole grid; the same field, sooner.

        gap: [rows, cols] [m]; approach: [m]; pressure: [rows, cols] [Pa].
        """
        rows, cols = self.half_space.rows, self.half_space.cols
        window = GridWindow(0, 0, rows, cols)
        if gap.shape == pressure.shape == (rows, cols):  # other shapes are refused below
            window = GridWindow(*overlap_window(gap, float(approach), pressure))
        if window.rows == 0 or (window.rows, window.cols) == (rows, cols):
            return solve_at_approach(self.half_space, self._whole, gap, approach, tolerance, max_iterations, pressure)
        part = self._part(window.rows, window.cols)
        copy_window(gap, window.first_row, window.first_col, part.gap)
        copy_window(pressure, window.first_row, window.first_col, part.pressure)
        result = solve_at_approach(
            part.half_space, part.workspace, part.gap, approach, tolerance, max_iterations, part.pressure
        )
        write_window(part.pressure, window.first_row, window.first_col, pressure)
        return result

    def solve_at_load(
        self, gap: Field, load: float, tolerance: float, max_iterations: int, pressure: Field
    ) -> FieldResult:
        """As `field_solver.solve_at_load`, on the whole grid: without the approach no window is
        known to hold the contact.

        gap: [rows, cols] [m]; load: [N]; pressure: [rows, cols] [Pa].
        """
        return solve_at_load(self.half_space, self._whole, gap, load, tolerance, max_iterations, pressure)

    def _part(self, rows: int, cols: int) -> Part:
        part = self._parts.get((rows, cols))
        if part is None:
            part = self._parts[rows, cols] = make_part(self.half_space, rows, cols)
        return part


@entry
def overlap_window(gap: Field, approach: float, pressure: Field) -> tuple[int, int, int, int]:
    """Smallest window of an allowed size that holds every cell with `gap < approach` [m] and its
    neighbours.

    No rows where no cell overlaps; the whole grid where a number is not finite, which the solver
    refuses.
    """
    rows, cols = gap.shape
    if not acceptable(gap, pressure):
        return 0, 0, rows, cols
    top, bottom, left, right = rows, -1, cols, -1
    for i in range(rows):
        first, last = cols, -1
        for j in range(cols):
            if gap[i, j] < approach:
                first = min(first, j)
                last = j
        if last >= 0:
            top, bottom = min(top, i), i
            left, right = min(left, first), max(right, last)
    if bottom < 0:
        return 0, 0, 0, 0
    # Sizes in steps, so that few transforms are prepared; moved inside the grid
    height = min(rows, -(-(bottom - top + 3) // STEP) * STEP)
    width = min(cols, -(-(right - left + 3) // STEP) * STEP)
    return max(0, min(top - 1, rows - height)), max(0, min(left - 1, cols - width)), height, width
