"""Pressure fields on the lattice of the bristles: padded copies, the lattice that moves, the field
between two instants.
"""

from __future__ import annotations

import math

from contact_sim_pkg.compiled.jit import kernel
from contact_sim_pkg.rigs.vehicle.tire.brush.steps import PAD, Bristles, Field, Flags, LoadedWindow

__all__ = ["blend", "copy_field", "loaded_window", "place_on"]


@kernel
def place_on(bristles: Bristles, before: Field, phase: float, offset: float) -> float:
    """Move bristles and last pressure `before` [Pa] to a lattice that lies `offset` cells further
    ahead.

    phase: of the belt against the lattice [1]. Returns the new one. Arrays are [rows, cols].
    """
    phase += offset
    cells = math.floor(phase)
    shift_rows(bristles.deflection_x, cells)
    shift_rows(bristles.deflection_y, cells)
    shift_rows(bristles.sliding, cells)
    if offset != 0.0:
        resample(before, offset, bristles.pressure)
    return phase - cells


@kernel
def shift_rows(values: Field | Flags, cells: int) -> None:
    """Move row i to row i - cells, zero where nothing comes from; padding rows are cleared.

    values: [rows, cols].
    """
    rows, cols = values.shape
    if cells == 0:
        return
    for n in range(rows):
        i = n if cells > 0 else rows - 1 - n
        inside = PAD <= i < rows - PAD and 0 <= i + cells < rows
        for j in range(cols):
            values[i, j] = values[i + cells, j] if inside else 0


@kernel
def resample(before: Field, offset: float, scratch: Field) -> None:
    """Write `before` [Pa], [rows, cols], at points `offset` cells ahead of its rows, linear.

    Zero where the nearest cell is not loaded.
    """
    rows, cols = before.shape
    base = math.floor(offset)
    weight = offset - base
    copy_rows(before, scratch)
    for i in range(rows):
        low, high = i + base, i + base + 1
        for j in range(cols):
            first = scratch[low, j] if 0 <= low < rows else 0.0
            second = scratch[high, j] if 0 <= high < rows else 0.0
            nearest = first if weight <= 0.5 else second
            loaded = nearest > 0.0 and PAD <= i < rows - PAD
            before[i, j] = (1.0 - weight) * first + weight * second if loaded else 0.0


@kernel
def copy_rows(source: Field, target: Field) -> None:
    """Copy all of one field into another of the same shape; quicker to compile than an assignment
    of slices.

    source, target: [rows, cols].
    """
    for i in range(source.shape[0]):
        for j in range(source.shape[1]):
            target[i, j] = source[i, j]


@kernel
def copy_field(pressure: Field, padded: Field) -> None:
    """Copy a field into the padded one.

    pressure: [rows, cols] [Pa]; padded: [PAD + rows + PAD, cols] [Pa].
    """
    for i in range(pressure.shape[0]):
        for j in range(pressure.shape[1]):
            padded[PAD + i, j] = pressure[i, j]


@kernel
def loaded_window(before: Field, pressure: Field) -> LoadedWindow:
    """Labels of all bristles that can be under load before, at or between two fields; none without
    load.

    before: [PAD + rows + PAD, cols] [Pa]; pressure: [rows, cols] [Pa].
    """
    rows, cols = pressure.shape
    top, bottom, left, right = rows, -1, cols, -1
    for i in range(rows):
        for j in range(cols):
            if pressure[i, j] > 0.0 or before[PAD + i, j] > 0.0:
                top, bottom = min(top, i), i
                left, right = min(left, j), max(right, j)
    if bottom < 0:
        return LoadedWindow(0, 0, 0, 0)
    return LoadedWindow(PAD + top - 1, PAD + bottom + 3, left, right + 1)


@kernel
def blend(before: Field, pressure: Field, part: float, window: LoadedWindow, out: Field) -> None:
    """Write the pressure [Pa] when `part` [1] of the step is done, linear in time.

    Fields: [rows, cols], `before` and `out` with margins; only inside `window`.
    """
    for m in range(window.first - 1, window.last):
        i = m - PAD
        inside = 0 <= i < pressure.shape[0]
        for j in range(window.left, window.right):
            now = pressure[i, j] if inside else 0.0
            out[m, j] = (1.0 - part) * before[m, j] + part * now  # exact at both ends
