"""Start without a field before: the field on a grid of half as many cells each way as a start.

Source: Tire/Road Contact eqs 1 to 4; nested iteration: Hackbusch, Multi-Grid Methods and
Applications, 5.
"""

from __future__ import annotations

from contact_sim_pkg.compiled.jit import entry
from contact_sim_pkg.pressure.field.halfspace import Field
from contact_sim_pkg.pressure.field.outside import widened

__all__ = ["double", "halve"]


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
def double(pressure: Field, out: Field) -> tuple[int, int, int, int]:
    """Bilinear interpolation to two by two cells each, zero where `pressure` is; returns the
    window, or no rows.

    pressure: [rows, cols] [Pa]; out: [2 rows, 2 cols] [Pa].
    """
    rows, cols = pressure.shape
    top, bottom, left, right = rows, -1, cols, -1
    for i in range(2 * rows):
        row = i // 2
        beside = min(max(row + 2 * (i % 2) - 1, 0), rows - 1)
        for j in range(2 * cols):
            col = j // 2
            next_to = min(max(col + 2 * (j % 2) - 1, 0), cols - 1)
            out[i, j] = 0.0
            if pressure[row, col] > 0.0:
                # Bilinear weights of a cell of half the size
                near = 0.75 * pressure[row, col] + 0.25 * pressure[row, next_to]
                far = 0.75 * pressure[beside, col] + 0.25 * pressure[beside, next_to]
                out[i, j] = 0.75 * near + 0.25 * far
                top, bottom = min(top, row), max(bottom, row)
                left, right = min(left, col), max(right, col)
    # No contact: an empty window
    if bottom < 0:
        return 0, 0, 0, 0
    return widened(2 * rows, 2 * cols, 2 * top, 2 * bottom + 1, 2 * left, 2 * right + 1)
