"""Prediction of a field from the two before it: pressure and displacement, carried along with the
road.

The roughness of the road is carried through the contact, so the field changes slowly in the
*road's* frame. Pressure p and displacement u = K p of the two fields before, shifted by the cells
travelled, are extrapolated by the same amount,

    p = p1 + t (p1 - p2),    u = u1 + t (u1 - u2),    t = EXTRAPOLATION,

so that u = K p still holds, without a convolution: as long as negative pressures are left as they
are. Both are scaled by one number, to the load where that is given and to the least energy, `sum p
(d - g) / sum p u`, where the approach d is.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.jit import borrowing_kernel, kernel
from contact_sim_pkg.pressure.field.halfspace import Field, HalfSpace, convolve
from contact_sim_pkg.pressure.field.iteration import SolverWorkspace

__all__ = ["EXTRAPOLATION", "PreviousField", "make_previous_field", "predict", "scale_to", "start_from", "store"]

EXTRAPOLATION = 0.75
"""Full extrapolation, 1, carries more of the errors of the fields before into the next; chosen by
error and convolutions.
"""

SCALES = (0.5, 2.0)
"""Least and largest factor of a prediction at a given approach."""

Place = NDArray[numpy.int64]


class PreviousField(NamedTuple):
    """A field that was solved on a window of the whole grid; outside it the pressure is zero and u
    is not known.
    """

    pressure: Field  # [Pa] [rows, cols] of the whole grid, meant within the window only
    displacement: Field  # [m] the same
    # First row, first column, end row, end column of the window; cells travelled since
    place: Place


def make_previous_field(half_space: HalfSpace) -> PreviousField:
    """Nothing stored yet."""
    shape = (half_space.rows, half_space.cols)
    return PreviousField(numpy.zeros(shape), numpy.zeros(shape), numpy.zeros(5, dtype=numpy.int64))


@borrowing_kernel
def predict(
    workspace: SolverWorkspace, first_row: int, first_col: int, last: PreviousField, before: PreviousField, share: float
) -> None:
    """Prediction on the window at (first_row, first_col): pressure, and u in `surface`, infinite
    where it is not known.

    Pressure: [rows, cols] [Pa], surface: [rows, cols] [m] of the window; share: [1] of
    extrapolation.
    """
    pressure, surface = workspace.pressure, workspace.surface
    rows, cols = pressure.shape
    for i in range(rows):
        # Last field where its window holds this row; zero, and unknown, elsewhere
        row, start, end = stored_part(last, first_row + i, first_col, cols)
        for j in range(cols):
            pressure[i, j], surface[i, j] = 0.0, numpy.inf
        for j in range(start, end):
            pressure[i, j] = last.pressure[row, first_col + j]
            surface[i, j] = last.displacement[row, first_col + j]
        if share == 0.0:
            continue
        # Linear extrapolation where both fields are known
        row, start_before, end_before = stored_part(before, first_row + i, first_col, cols)
        for j in range(max(start, start_before), min(end, end_before)):
            p, u = pressure[i, j], surface[i, j]
            surface[i, j] = u + share * (u - before.displacement[row, first_col + j])
            pressure[i, j] = p + share * (p - before.pressure[row, first_col + j]) if p > 0.0 else 0.0


@kernel
def start_from(
    half_space: HalfSpace, workspace: SolverWorkspace, first_row: int, first_col: int, pressure: Field
) -> None:
    """In place of a prediction: the pressure of the whole grid, and u by a convolution.

    pressure: [rows, cols] [Pa] of the whole grid.
    """
    rows, cols = workspace.pressure.shape
    for i in range(rows):
        for j in range(cols):
            workspace.pressure[i, j] = pressure[first_row + i, first_col + j]
    convolve(half_space, workspace.buffers, workspace.pressure, workspace.surface)


@borrowing_kernel
def stored_part(field: PreviousField, row: int, first_col: int, cols: int) -> tuple[int, int, int]:
    """Row of a stored field that lies at `row` now, and the first and end column of a window's row
    that it holds.
    """
    top, start, bottom, end, moved = field.place
    row += moved
    if not top <= row < bottom:
        return 0, 0, 0
    return row, max(start - first_col, 0), min(end - first_col, cols)


@borrowing_kernel
def scale_to(workspace: SolverWorkspace, approach: float, total: float) -> bool:
    """Scale the prediction to the sum `total` [Pa], or where that is negative to the approach; u
    becomes the surface.

    False where it is of no use.
    """
    pressure, surface, height = workspace.pressure, workspace.surface, workspace.height
    rows, cols = pressure.shape
    present, work, energy = 0.0, 0.0, 0.0
    for i in range(rows):
        for j in range(cols):
            p = pressure[i, j]
            if p != 0.0:
                present += p
                work += p * (approach - height[i, j])
                energy += p * surface[i, j]
    if not (present > 0.0 and energy > 0.0):
        return False
    # At an approach: the scale of least energy, within bounds
    factor = total / present if total >= 0.0 else min(max(work / energy, SCALES[0]), SCALES[1])
    if not 0.0 < factor < numpy.inf:
        return False
    for i in range(rows):
        for j in range(cols):
            pressure[i, j] *= factor
            surface[i, j] = height[i, j] + factor * surface[i, j]
    return True


@borrowing_kernel
def store(
    workspace: SolverWorkspace, first_row: int, first_col: int, field: PreviousField, pressure: Field
) -> tuple[int, int, int, int]:
    """Store a solved window, and write its pressure into the whole grid, zero around it.

    Returns first and last row, first and last column of the contact; where there is none the last
    are negative.
    pressure: [rows, cols] [Pa] of the whole grid.
    """
    rows, cols = workspace.pressure.shape
    # Place of the window, and no travel since
    field.place[0], field.place[1] = first_row, first_col
    field.place[2], field.place[3], field.place[4] = first_row + rows, first_col + cols, 0
    pressure[:] = 0.0
    top, bottom, left, right = rows, -1, cols, -1
    for i in range(rows):
        first, end = cols, -1
        for j in range(cols):
            p = workspace.pressure[i, j]
            field.pressure[first_row + i, first_col + j] = p
            field.displacement[first_row + i, first_col + j] = workspace.surface[i, j] - workspace.height[i, j]
            pressure[first_row + i, first_col + j] = p
            if p > 0.0:
                first, end = min(first, j), j
        # Box of the contact
        if end >= 0:
            top, bottom = min(top, i), i
            left, right = min(left, first), max(right, end)
    if bottom < 0:
        return 0, -1, 0, -1
    return first_row + top, first_row + bottom, first_col + left, first_col + right
