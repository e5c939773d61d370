"""Does a field that was solved on a window hold outside it?

A window is enough if no cell outside it penetrates: if its gap and its displacement come to the
approach at least. The half-space is displaced downwards everywhere, and a belt, which may lift the
surface far from its load, displaces a row as a whole. Where belt and gap alone clear every cell
nothing is left to do; otherwise the pressure displaces the whole grid, by one convolution.

Source: Tire/Road Contact eqs 1 and 4.
"""

from __future__ import annotations

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.jit import borrowing_kernel, kernel
from contact_sim_pkg.pressure.field.filtering import apply_filter
from contact_sim_pkg.pressure.field.halfspace import Field, HalfSpace
from contact_sim_pkg.pressure.field.window import Part

__all__ = ["enclose", "total_of_row", "widened"]

MARGIN = 2
"""Cells around a contact that belong to its window."""

Values = NDArray[numpy.float64]
Box = tuple[int, int, int, int]


@kernel
def widened(rows: int, cols: int, top: int, bottom: int, left: int, right: int) -> tuple[int, int, int, int]:
    """Window that holds a box of cells and the margin, with sides that the transforms are fast
    for.

    All in [cells]; the result: first row, first column, rows, columns.
    """
    height = good_side(bottom - top + 1 + 2 * MARGIN, rows)
    width = good_side(right - left + 1 + 2 * MARGIN, cols)
    first_row = min(max((top + bottom + 1 - height) // 2, 0), rows - height)
    first_col = min(max((left + right + 1 - width) // 2, 0), cols - width)
    return first_row, first_col, height, width


@kernel
def good_side(least: int, most: int) -> int:
    """The next side of a window [cells], or `most`: even and a product of 2, 3 and 5."""
    side = least + least % 2
    while side < most:
        rest = side
        for prime in (2, 3, 5):
            while rest % prime == 0:
                rest //= prime
        if rest == 1:
            return side
        side += 2
    return most


@kernel
def enclose(
    whole: Part, gap: Field, approach: float, pressure: Field, window: tuple[int, int, int, int]
) -> tuple[int, int, int, int]:
    """Smallest window that holds `window` and every cell outside it that penetrates.

    Windows: first row, first column, rows, columns. gap: [rows, cols] [m]; approach: [m]; pressure:
    [rows, cols] [Pa], zero outside the window.
    """
    moved, belt = whole.workspace.filtered, numpy.zeros(gap.shape[0])
    lay_belt(whole.half_space, pressure, window, belt)
    for i in range(len(belt)):
        if below(gap[i], approach - belt[i], window, i) > 0:
            apply_filter(whole.half_space.transfer, whole.workspace.buffers.filtering, pressure, moved)
            return around(penetrating(gap, approach, moved, window), window, gap.shape[0], gap.shape[1])
    return window


@borrowing_kernel
def below(heights: Values, height: float, window: tuple[int, int, int, int], row: int) -> int:
    """How many cells of a row [cols] lie below a height, all in [m], outside the window."""
    count, first, end = 0, len(heights), len(heights)
    if window[0] <= row < window[0] + window[2]:
        first, end = window[1], window[1] + window[3]
    for j in range(first):
        count += 1 if heights[j] < height else 0
    for j in range(end, len(heights)):
        count += 1 if heights[j] < height else 0
    return count


@borrowing_kernel
def penetrating(gap: Field, approach: float, moved: Field, window: tuple[int, int, int, int]) -> Box:
    """First and last row, first and last column of the cells outside the window that penetrate, the
    last negative where none does; `moved` [rows, cols] [m] becomes the gap of the surface as it is.
    """
    rows, cols = gap.shape
    top, bottom, left, right = rows, -1, cols, -1
    for i in range(rows):
        for j in range(cols):
            moved[i, j] += gap[i, j]
        if below(moved[i], approach, window, i) == 0:
            continue
        top, bottom = min(top, i), i
        inside = window[0] <= i < window[0] + window[2]
        for j in range(cols):
            if moved[i, j] < approach and not (inside and window[1] <= j < window[1] + window[3]):
                left, right = min(left, j), max(right, j)
    return top, bottom, left, right


@kernel
def around(box: Box, window: tuple[int, int, int, int], rows: int, cols: int) -> tuple[int, int, int, int]:
    """Window that holds the old one's contact and what penetrates beside it: first and last row, first
    and last column of a `box`, the last negative where nothing does. All in [cells].
    """
    first_row, first_col, window_rows, window_cols = window
    if box[1] < 0:
        return first_row, first_col, window_rows, window_cols
    top, bottom = min(box[0], first_row + MARGIN), max(box[1], first_row + window_rows - 1 - MARGIN)
    left, right = min(box[2], first_col + MARGIN), max(box[3], first_col + window_cols - 1 - MARGIN)
    return widened(rows, cols, top, bottom, left, right)


@borrowing_kernel
def lay_belt(half_space: HalfSpace, pressure: Field, window: tuple[int, int, int, int], belt: Values) -> None:
    """Displacement [m] [rows] of the belt, zeros before.

    pressure: [rows, cols] [Pa], zero outside the window.
    """
    rows, along = len(belt), half_space.along
    first, left, right = window[0], window[1], window[1] + window[3]
    for k in range(first, first + window[2] if len(half_space.belt) > 0 else first):
        total = total_of_row(pressure[k, left:right])
        if total > 0.0:
            for i in range(k):
                belt[i] += total * along[k - i]
            for i in range(k, rows):
                belt[i] += total * along[i - k]


@borrowing_kernel
def total_of_row(row: Values) -> float:
    """Sum over a row, in four parts: a single one would wait for each addition."""
    first, second, third, fourth = 0.0, 0.0, 0.0, 0.0
    whole = len(row) - len(row) % 4
    for j in range(0, whole, 4):
        first += row[j]
        second += row[j + 1]
        third += row[j + 2]
        fourth += row[j + 3]
    for j in range(whole, len(row)):
        first += row[j]
    return (first + second) + (third + fourth)
