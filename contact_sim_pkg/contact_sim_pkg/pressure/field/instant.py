"""One instant of a rolling pressure field in one compiled entry: predict, correct, certify, look
outside the window, store.

Source: Tire/Road Contact eqs 1 to 4.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.held import Held
from contact_sim_pkg.compiled.jit import borrowing_kernel, entry
from contact_sim_pkg.pressure.field.follow import correct
from contact_sim_pkg.pressure.field.halfspace import Field
from contact_sim_pkg.pressure.field.iteration import SolverWorkspace
from contact_sim_pkg.pressure.field.nested import start_from_half
from contact_sim_pkg.pressure.field.outside import enclose
from contact_sim_pkg.pressure.field.prediction import PreviousField, predict, scale_to, start_from, store
from contact_sim_pkg.pressure.field.solver import FieldRequest, total_of
from contact_sim_pkg.pressure.field.window import Part

__all__ = [
    "FROM_HALF",
    "FROM_PRESSURE",
    "InstantResult",
    "Start",
    "all_finite",
    "grown_window",
    "solve_instant",
    "store_window",
]

LEAST_FROM_START = 2
"""Corrections of a start that is no prediction: on a window that has grown the first moves the new
cells by its length only.
"""

FROM_PRESSURE, FROM_HALF = -1.0, -2.0
"""In place of a share of extrapolation: start from the pressure on the whole grid, or from the last
field on the grid of half as many cells each way.
"""

Values = NDArray[numpy.float64]


class Start(NamedTuple):
    """Where a solve starts."""

    first_row: int  # of its window
    first_col: int
    repeats: bool  # another solve at the instant of the last field
    share: float  # of extrapolation; negative: start from the pressure on the whole grid


class InstantResult(NamedTuple):
    """Result of a solve from a prediction."""

    # Otherwise the field on the whole grid is a start, and nothing else means anything
    certified: bool
    corrections: int
    load: float  # [N]
    approach: float  # [m]
    residual: float  # [1]
    # First row, first column, rows, columns of the window that is needed
    window: tuple[int, int, int, int]
    box: tuple[int, int, int, int]  # first and last row, first and last column of the contact


@entry
def all_finite(gap: Field) -> bool:
    """Whether every height is a finite number.

    gap: [rows, cols] [m].
    """
    faults = 0
    for i in range(gap.shape[0]):
        for j in range(gap.shape[1]):
            faults += 0 if abs(gap[i, j]) < numpy.inf else 1
    return faults == 0


@entry
def solve_instant(
    whole: Held[Part], part: Held[Part], last: Held[PreviousField], before: Held[PreviousField], gap: Field,
    half: Held[PreviousField], request: FieldRequest, start: Start, lengths: Values, pressure: Field,
) -> InstantResult:  # fmt: skip
    """Solve on the window of the size of `part` at the place of `start`; `pressure` of the whole
    grid is overwritten.

    gap: [rows, cols] [m] of the whole grid; pressure: [rows, cols] [Pa]; request: its iterations
    are corrections; lengths: of corrections [1], learned. The new field is stored in `last` if this
    repeats an instant, else in `before`. What is not certified is put into `pressure` as a start.
    """
    half_space, workspace = part.value.half_space, part.value.workspace
    rows, cols = half_space.rows, half_space.cols
    first_row, first_col, share = start.first_row, start.first_col, start.share
    prescribed, holds_load = request.prescribed, request.holds_load
    window, cell = (first_row, first_col, rows, cols), half_space.cell_x * half_space.cell_y
    # Prediction from the fields before, or the pressure on the whole grid as a start.
    datum = load_heights(gap, first_row, first_col, workspace.height, workspace.clipped)
    if share >= 0.0:
        predict(workspace, first_row, first_col, last.value, before.value, share)
    elif share == FROM_HALF:
        start_from_half(workspace, first_row, first_col, half.value)
    else:
        start_from(half_space, workspace, first_row, first_col, pressure)
    # Corrections until the field is certified.
    total, approach = (prescribed / cell, 0.0) if holds_load else (-1.0, prescribed - datum)
    if (holds_load or approach > 0.0) and scale_to(workspace, approach, total):
        target = last.value if start.repeats else before.value
        least = 1 if share >= 0.0 else LEAST_FROM_START
        found = correct(half_space, workspace, approach, total, request, least, share != FROM_HALF, lengths)
        if found.certified:
            # Certified: stored, and the window that it needs.
            box = store(workspace, first_row, first_col, target, pressure)
            approach = found.approach + datum if holds_load else prescribed
            window = enclose(whole.value, gap, approach, pressure, window)
            load = total_of(workspace.pressure) * cell
            return InstantResult(True, found.corrections, load, approach, found.residual, window, box)
    # Not certified: a start for the solver.
    put_start(workspace, first_row, first_col, pressure)
    return InstantResult(False, 0, 0.0, prescribed, numpy.inf, window, (0, 0, 0, 0))


@entry
def store_window(
    part: Held[Part], first_row: int, first_col: int, target: Held[PreviousField], pressure: Field
) -> tuple[int, int, int, int]:
    """Store what another solver left in the workspace; as `store`.

    pressure: [rows, cols] [Pa] of the whole grid.
    """
    return store(part.value.workspace, first_row, first_col, target.value, pressure)


@entry
def grown_window(
    whole: Held[Part], gap: Field, approach: float, pressure: Field, window: tuple[int, int, int, int]
) -> tuple[int, int, int, int]:
    """See `enclose`.

    gap: [rows, cols] [m]; approach: [m]; pressure: [rows, cols] [Pa].
    """
    return enclose(whole.value, gap, approach, pressure, window)


@borrowing_kernel
def load_heights(gap: Field, first_row: int, first_col: int, height: Field, line: Values) -> float:
    """Copy the gap [rows, cols] of a window, from its lowest cell up, into `height` [rows, cols];
    returns that lowest gap [m].

    first_row, first_col: of the window in the whole gap; line: [cols], scratch.
    """
    rows, cols = height.shape
    for j in range(cols):
        line[j] = numpy.inf
    for i in range(rows):
        for j in range(cols):
            here = gap[first_row + i, first_col + j]
            # `min` propagates NaN, which takes four times as long
            line[j] = here if here < line[j] else line[j]
    least = numpy.inf
    for j in range(cols):
        least = min(least, line[j])
    for i in range(rows):
        for j in range(cols):
            height[i, j] = gap[first_row + i, first_col + j] - least
    return least


@borrowing_kernel
def put_start(workspace: SolverWorkspace, first_row: int, first_col: int, pressure: Field) -> None:
    """Field after the corrections, as a start on the whole grid: positive and finite, zero
    elsewhere.

    pressure: [rows, cols] [Pa] of the whole grid.
    """
    rows, cols = workspace.pressure.shape
    pressure[:] = 0.0
    for i in range(rows):
        for j in range(cols):
            p = workspace.pressure[i, j]
            if 0.0 < p < numpy.inf:
                pressure[first_row + i, first_col + j] = p
