"""One instant of a rolling pressure field in one compiled piece: predict, correct, certify, look outside the window, keep."""

from __future__ import annotations

from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.jit import entry, kernel
from contact_sim_pkg.pressure.field.follow import follow
from contact_sim_pkg.pressure.field.halfspace import Field, HalfSpace
from contact_sim_pkg.pressure.field.iteration import SolverWorkspace
from contact_sim_pkg.pressure.field.outside import enclose
from contact_sim_pkg.pressure.field.prediction import Known, predict, remember, scale_to, start_from
from contact_sim_pkg.pressure.field.solver import total_of

__all__ = ["Instant", "all_finite", "grown_window", "keep_window", "solve_instant"]

LEAST_FROM_START = 2
"""Corrections of a start that is no prediction: on a window that has grown the first moves the new cells by its length only."""

Values = NDArray[numpy.float64]


class Instant(NamedTuple):
    """What a solve from a prediction came to."""

    certified: bool  # otherwise the field on the whole grid is a start, and nothing else means anything
    corrections: int
    load: float  # [N]
    approach: float  # [m]
    residual: float  # [-]
    window: tuple[int, int, int, int]  # first row, first column, rows, columns of the window that is needed
    box: tuple[int, int, int, int]  # first and last row, first and last column of the contact


@entry
def all_finite(gap: Field) -> bool:
    """Whether every height is a finite number."""
    faults = 0
    for i in range(gap.shape[0]):
        for j in range(gap.shape[1]):
            faults += 0 if abs(gap[i, j]) < numpy.inf else 1
    return faults == 0


@entry
def solve_instant(
    whole: HalfSpace,
    part: HalfSpace,
    workspace: SolverWorkspace,
    gap: Field,
    given: float,
    holds_load: bool,
    tolerance: float,
    max_corrections: int,
    first_row: int,
    first_col: int,
    last: Known,
    before: Known,
    repeats: bool,
    share: float,
    lengths: Values,
    pressure: Field,
) -> Instant:
    """Solve on the window of the size of `part` at (first_row, first_col); `pressure` of the whole grid is overwritten.

    share: of extrapolation; negative: start from `pressure` instead of what is known. The new field is kept in
    `last` if this repeats an instant, else in `before`. What is not certified is put into `pressure` as a start.
    """
    rows, cols = part.rows, part.cols
    window, cell = (first_row, first_col, rows, cols), whole.cell_x * whole.cell_y
    datum = load_heights(gap, first_row, first_col, workspace.height, workspace.clipped)
    if share >= 0.0:
        predict(workspace, first_row, first_col, last, before, share)
    else:
        start_from(part, workspace, first_row, first_col, pressure)
    total, approach = (given / cell, 0.0) if holds_load else (-1.0, given - datum)
    if (holds_load or approach > 0.0) and scale_to(workspace, approach, total):
        keep = last if repeats else before
        least = 1 if share >= 0.0 else LEAST_FROM_START
        found = follow(part, workspace, approach, total, tolerance, least, max_corrections, lengths)
        if found.certified:
            box = remember(workspace, first_row, first_col, keep, pressure)
            approach = found.approach + datum if holds_load else given
            window = enclose(whole, gap, approach, pressure, *window)
            load = total_of(workspace.pressure) * cell
            return Instant(True, found.corrections, load, approach, found.residual, window, box)
    put_start(workspace, first_row, first_col, pressure)
    return Instant(False, 0, 0.0, given, numpy.inf, window, (0, 0, 0, 0))


@entry
def keep_window(
    workspace: SolverWorkspace, first_row: int, first_col: int, keep: Known, pressure: Field
) -> tuple[int, int, int, int]:
    """Keep what another solver left in the workspace; as `remember`."""
    return remember(workspace, first_row, first_col, keep, pressure)


@entry
def grown_window(
    whole: HalfSpace, gap: Field, approach: float, pressure: Field,
    first_row: int, first_col: int, rows: int, cols: int,
) -> tuple[int, int, int, int]:  # fmt: skip
    """See `enclose`."""
    return enclose(whole, gap, approach, pressure, first_row, first_col, rows, cols)


@kernel
def load_heights(gap: Field, first_row: int, first_col: int, height: Field, line: Values) -> float:
    """Gap of a window above its lowest cell, which is returned; `line` [cols] is scratch."""
    rows, cols = height.shape
    for j in range(cols):
        line[j] = numpy.inf
    for i in range(rows):
        for j in range(cols):
            here = gap[first_row + i, first_col + j]
            line[j] = here if here < line[j] else line[j]  # `min` minds NaN, which takes four times as long
    least = numpy.inf
    for j in range(cols):
        least = min(least, line[j])
    for i in range(rows):
        for j in range(cols):
            height[i, j] = gap[first_row + i, first_col + j] - least
    return least


@kernel
def put_start(workspace: SolverWorkspace, first_row: int, first_col: int, pressure: Field) -> None:
    """What the corrections came to, as a start on the whole grid: positive and finite, zero elsewhere."""
    rows, cols = workspace.pressure.shape
    pressure[:] = 0.0
    for i in range(rows):
        for j in range(cols):
            p = workspace.pressure[i, j]
            if 0.0 < p < numpy.inf:
                pressure[first_row + i, first_col + j] = p
