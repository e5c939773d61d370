"""The part of a grid that can be in contact: a field at a given approach is solved there, and is
zero elsewhere.

Pressure pushes the surface away, never towards the other body, so a cell in contact has `gap =
approach - u < approach`. The contact therefore lies among the cells whose gap is below the
approach, and the solution on any window that holds all of them *is* the solution on the whole grid.
A tire touches about an eighth of its grid and the window is about a third, so the transforms take a
third of the time. One cell more on each side keeps the contact off the window's edge, except where
that is the grid's edge.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.jit import entry
from contact_sim_pkg.pressure.field.halfspace import Field, HalfSpace, part_of
from contact_sim_pkg.pressure.field.solver import (
    SolverWorkspace,
    make_workspace,
)

__all__ = ["GridWindow", "Part", "copy_window", "make_part", "write_window"]


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


def make_part(whole: HalfSpace, rows: int, cols: int) -> Part:
    """Tables and buffers for windows of one size of a grid."""
    half_space = part_of(whole, rows, cols)
    return Part(half_space, make_workspace(half_space), numpy.zeros((rows, cols)), numpy.zeros((rows, cols)))


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
