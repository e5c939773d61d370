"""The part of a grid that can be in contact: a field at a given approach is solved there, and is
zero elsewhere.

Pressure pushes the surface away, never towards the other body, so a cell in contact has `gap =
approach - u < approach`. The contact therefore lies among the cells whose gap is below the
approach, and the solution on any window that holds all of them *is* the solution on the whole grid.
A tire touches about an eighth of its grid and the window is about a third, so the transforms take a
third of the time. One cell more on each side keeps the contact off the window's edge, except where
that is the grid's edge.

Windows come in sizes of `STEP` cells, so that a handful of influence tables serves a whole run.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.jit import entry
from contact_sim_pkg.pressure.field.halfspace import Field, HalfSpace, part_of
from contact_sim_pkg.pressure.field.solver import (
    FieldResult,
    SolverWorkspace,
    acceptable,
    make_workspace,
    solve_at_approach,
    solve_at_load,
)

__all__ = ["GridWindow", "Part", "WindowedSolver", "copy_window", "make_part", "overlap_window", "write_window"]

STEP = 4
"""Sizes of windows are multiples of it [cells]; chosen by time on the tire's grid."""


class GridWindow(NamedTuple):
    """Rows `first_row ... first_row + rows - 1` and columns alike; no rows where nothing
    overlaps.
    """

    first_row: int
    first_col: int
    rows: int
    cols: int


class Part(NamedTuple):
    """What solves windows of one size."""

    half_space: HalfSpace
    workspace: SolverWorkspace
    gap: Field
    pressure: Field


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


def make_part(whole: HalfSpace, rows: int, cols: int) -> Part:
    """Tables and buffers for windows of one size of a grid."""
    half_space = part_of(whole, rows, cols)
    return Part(half_space, make_workspace(half_space), numpy.zeros((rows, cols)), numpy.zeros((rows, cols)))


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


@entry
def copy_window(field: Field, first_row: int, first_col: int, part: Field) -> None:
    """Copy a window of `field` into `part`.

    field: [rows, cols] of the whole grid; part: [rows, cols] of the window.
    """
    for i in range(part.shape[0]):
        for j in range(part.shape[1]):
            part[i, j] = field[first_row + i, first_col + j]


@entry
def write_window(part: Field, first_row: int, first_col: int, field: Field) -> None:
    """Write `part` into its window of `field`, and zero around it.

    part: [rows, cols] of the window; field: [rows, cols] of the whole grid.
    """
    field[:] = 0.0
    for i in range(part.shape[0]):
        for j in range(part.shape[1]):
            field[first_row + i, first_col + j] = part[i, j]
