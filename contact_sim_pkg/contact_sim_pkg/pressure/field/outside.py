"""Does a field that was solved on a window hold outside it? Bounds first, direct sums where they
do not decide, and where these are many one convolution.

A window is enough if no cell outside it penetrates. The gap of a block of cells outside is not less
than its lowest gap plus the displacement that the pressure of each block inside causes at the
largest distance between the two. Only cells of blocks where that bound fails are evaluated, from
the influence table. A belt, which may lift the surface far from its load, displaces a row as a whole:
that is evaluated for each row, and the bound is of the half-space alone.

Source: Tire/Road Contact eqs 1 and 4.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.jit import borrowing_kernel, kernel
from contact_sim_pkg.pressure.field.halfspace import Field, HalfSpace, convolve
from contact_sim_pkg.pressure.field.window import Part

__all__ = ["enclose", "widened"]

BLOCK = 4
"""Cells along a side of a block."""

MIDDLE, COARSE = 8, 16
"""Cells along a side of larger blocks, which are tried first; each a multiple of the size before.
"""

MARGIN = 2
"""Cells around a contact that belong to its window."""
MOST_BLOCKS = 96
"""Blocks that the bound does not clear: of more a convolution on the whole grid takes less time."""

Values = NDArray[numpy.float64]
Box = tuple[int, int, int, int]
Places = NDArray[numpy.int64]


class Blocks(NamedTuple):
    """Pressures added up over square blocks of cells; scratch."""

    side: int  # [cells]
    sums: Field  # [Pa] [rows/side, cols/side]
    pressures: Values  # [Pa] those that are not zero
    loaded: Places  # first row and column of these
    number: Places  # [1] how many they are
    line: Values  # [Pa] [cols]


@kernel
def make_blocks(half_space: HalfSpace, side: int) -> Blocks:
    """Scratch for blocks of `side` x `side` cells."""
    rows, cols = -(-half_space.rows // side), -(-half_space.cols // side)
    places = numpy.zeros((rows * cols, 2), dtype=numpy.int64)
    number = numpy.zeros(1, dtype=numpy.int64)
    return Blocks(
        side, numpy.zeros((rows, cols)), numpy.zeros(rows * cols), places, number, numpy.zeros(half_space.cols)
    )


class BlockSums(NamedTuple):
    """Blocks of three sizes."""

    fine: Blocks
    middle: Blocks
    coarse: Blocks
    belt: Values  # [m] [rows] displacement of the belt


@kernel
def make_block_sums(half_space: HalfSpace) -> BlockSums:
    """Scratch for a grid; to hand it in from Python would take longer than to make it."""
    return BlockSums(
        make_blocks(half_space, BLOCK),
        make_blocks(half_space, MIDDLE),
        make_blocks(half_space, COARSE),
        numpy.zeros(half_space.rows),
    )


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
    [rows, cols] [Pa].
    """
    rows, cols = gap.shape
    blocks, places = make_block_sums(whole.half_space), numpy.empty((MOST_BLOCKS, 4), dtype=numpy.int64)
    number = uncertain_blocks(whole.half_space, gap, approach, pressure, window, blocks, places)
    if number > MOST_BLOCKS:
        return around(penetrating_anywhere(whole, gap, approach, pressure, window), window, rows, cols)
    box, loaded = (rows, -1, cols, -1), (window[0], window[0] + window[2])
    for k in range(number):
        found = penetrating(whole.half_space, gap, approach, pressure, blocks, loaded, places[k])
        box = min(box[0], found[0]), max(box[1], found[1]), min(box[2], found[2]), max(box[3], found[3])
    return around(box, window, rows, cols)


@kernel
def uncertain_blocks(
    half_space: HalfSpace, gap: Field, approach: float, pressure: Field, window: tuple[int, int, int, int],
    blocks: BlockSums, places: Places,
) -> int:  # fmt: skip
    """How many blocks of cells outside the window the bound does not clear, and where the first of them
    lie: first and end row, first and end column, into `places` [blocks, 4].

    The sums of `blocks` are made where they are needed.
    """
    rows, cols = gap.shape
    first_row, first_col, end_row, end_col = window[0], window[1], window[0] + window[2], window[1] + window[3]
    line, laid, added, number = numpy.empty(cols), False, False, 0
    behind, ahead = (0, first_row, 0, cols), (end_row, rows, 0, cols)
    beside = (first_row, end_row, 0, first_col), (first_row, end_row, end_col, cols)
    for start, end, first, last in (behind, ahead, *beside):
        for i in range(start, end, BLOCK):
            if not lowest_of_columns(gap, (i, min(i + BLOCK, end)), (first, last), approach, line):
                continue
            for j in range(first, last, BLOCK):
                # Blocks whose lowest gap is below the approach.
                depth = approach - least_of(line, j - first, min(BLOCK, last - j))
                if depth <= 0.0:
                    continue
                # Most of them lie above the belt alone.
                if not laid:
                    lay_belt(half_space, pressure, window, blocks.belt)
                    laid = True
                depth -= least_of(blocks.belt, i, BLOCK)
                if depth <= 0.0:
                    continue
                if not added:
                    add_up(pressure, window, blocks)
                    added = True
                # Those that the bound does not clear.
                if bound(half_space, blocks.coarse, i, j, BLOCK, depth) < depth:
                    if number < len(places):
                        places[number, 0], places[number, 1] = i, min(i + BLOCK, end)
                        places[number, 2], places[number, 3] = j, min(j + BLOCK, last)
                    number += 1
    return number


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


@kernel
def penetrating_anywhere(
    whole: Part, gap: Field, approach: float, pressure: Field, window: tuple[int, int, int, int]
) -> Box:
    """Box of all cells outside the window that penetrate, by the displacement of the whole grid."""
    rows, cols = gap.shape
    moved = whole.workspace.filtered
    convolve(whole.half_space, whole.workspace.buffers, pressure, moved)
    top, bottom, left, right = rows, -1, cols, -1
    for i in range(rows):
        inside = window[0] <= i < window[0] + window[2]
        for j in range(cols):
            is_outside = not (inside and window[1] <= j < window[1] + window[3])
            if is_outside and gap[i, j] + moved[i, j] < approach:
                top, bottom = min(top, i), max(bottom, i)
                left, right = min(left, j), max(right, j)
    return top, bottom, left, right


@borrowing_kernel
def penetrating(
    half_space: HalfSpace,
    gap: Field,
    approach: float,
    pressure: Field,
    blocks: BlockSums,
    loaded: tuple[int, int],
    block: Places,
) -> Box:
    """Box of the cells of a block that penetrate.

    loaded: first and end row with pressure; block: first and end row, first and end column.
    """
    top, bottom, left, right = gap.shape[0], -1, gap.shape[1], -1
    for row in range(block[0], block[1]):
        for col in range(block[2], block[3]):
            depth = approach - gap[row, col]
            # Above the lower bound: decided
            if least_displacement(half_space, blocks, row, col, depth) >= depth:
                continue
            # Direct sum of the pressure over this one cell
            if displacement_at(half_space, pressure, blocks.fine.line, row, col, loaded[0], loaded[1]) < depth:
                top, bottom = min(top, row), max(bottom, row)
                left, right = min(left, col), max(right, col)
    return top, bottom, left, right


@borrowing_kernel
def least_displacement(half_space: HalfSpace, blocks: BlockSums, row: int, col: int, depth: float) -> float:
    """Displacement [m] that a cell has at least, computed until it reaches `depth`."""
    least, belt = 0.0, float(blocks.belt[row])
    for sums in (blocks.coarse, blocks.middle, blocks.fine):
        if belt + least < depth:
            least = max(least, bound(half_space, sums, row, col, 1, depth - belt))
    return belt + least


@borrowing_kernel
def least_of(values: Values, first: int, number: int) -> float:
    """Least of so many values, or as many as there are, from `first` on."""
    least = float(values[first])
    for k in range(first + 1, min(first + number, len(values))):
        least = min(least, values[k])
    return least


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
def add_up(pressure: Field, window: tuple[int, int, int, int], blocks: BlockSums) -> None:
    """Sums of the pressure over blocks of all sizes.

    pressure: [rows, cols] [Pa], zero outside the window.
    """
    add_up_cells(pressure, window[0], window[0] + window[2], blocks.fine)
    add_up_blocks(blocks.fine, blocks.middle)
    add_up_blocks(blocks.middle, blocks.coarse)


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


@borrowing_kernel
def add_up_cells(pressure: Field, first: int, end: int, blocks: Blocks) -> None:
    """Sums of the pressure over blocks of cells.

    pressure: [rows, cols] [Pa], zero but in the rows from `first` to before `end`.
    """
    rows, cols = pressure.shape
    side, sums, line = blocks.side, blocks.sums, blocks.line
    for a in range(first // side, -(-end // side)):
        for j in range(cols):
            line[j] = pressure[a * side, j]
        for i in range(a * side + 1, min((a + 1) * side, rows)):
            for j in range(cols):
                line[j] += pressure[i, j]
        for b in range(sums.shape[1]):
            total = 0.0
            for j in range(b * side, min((b + 1) * side, cols)):
                total += line[j]
            sums[a, b] = total
    list_loaded(blocks)


@borrowing_kernel
def add_up_blocks(fine: Blocks, coarse: Blocks) -> None:
    """Sums over larger blocks from those over smaller ones."""
    ratio = coarse.side // fine.side
    for a in range(coarse.sums.shape[0]):
        for b in range(coarse.sums.shape[1]):
            coarse.sums[a, b] = 0.0
    for a in range(fine.sums.shape[0]):
        for b in range(fine.sums.shape[1]):
            coarse.sums[a // ratio, b // ratio] += fine.sums[a, b]
    list_loaded(coarse)


@borrowing_kernel
def list_loaded(blocks: Blocks) -> None:
    """List the blocks with pressure in them."""
    count = 0
    for a in range(blocks.sums.shape[0]):
        for b in range(blocks.sums.shape[1]):
            if blocks.sums[a, b] > 0.0:
                blocks.loaded[count, 0], blocks.loaded[count, 1] = a * blocks.side, b * blocks.side
                blocks.pressures[count] = blocks.sums[a, b]
                count += 1
    blocks.number[0] = count


@borrowing_kernel
def lowest_of_columns(gap: Field, rows: tuple[int, int], cols: tuple[int, int], most: float, line: Values) -> bool:
    """Lowest gap [m] of each column between two rows and columns, or `most` where none is lower, into
    `line` from 0 on; whether any is lower.
    """
    number, lower = cols[1] - cols[0], 0
    for j in range(number):
        line[j] = most
    for i in range(rows[0], rows[1]):
        row = gap[i, cols[0] : cols[1]]
        for j in range(number):
            line[j] = row[j] if row[j] < line[j] else line[j]
    for j in range(number):
        lower += 1 if line[j] < most else 0
    return lower > 0


@borrowing_kernel
def bound(half_space: HalfSpace, blocks: Blocks, i: int, j: int, side: int, depth: float) -> float:
    """As `least_displacement` of the half-space alone: the pressure of each block at the largest
    distance between two cells of the two blocks.

    depth: [m]; the result: [m].
    """
    influence, along, loaded, far = half_space.influence, half_space.along, blocks.loaded, blocks.side - 1
    last_row, last_col = influence.shape[0] - 1, influence.shape[1] - 1
    total = 0.0
    for k in range(blocks.number[0]):
        away_x = max(i + side - 1 - loaded[k, 0], loaded[k, 0] + far - i)
        away_y = max(j + side - 1 - loaded[k, 1], loaded[k, 1] + far - j)
        away_x = min(away_x, last_row)
        total += blocks.pressures[k] * (influence[away_x, min(away_y, last_col)] - along[away_x])
        if total >= depth:
            break
    return total


@borrowing_kernel
def displacement_at(
    half_space: HalfSpace, pressure: Field, line: Values, row: int, col: int, first_row: int, end_row: int
) -> float:
    """Displacement [m] of one cell by a direct sum over the loaded rows; `line` [cols] is
    scratch.
    """
    cols, mirrored = pressure.shape[1], half_space.mirrored
    for j in range(cols):
        line[j] = 0.0
    for i in range(first_row, end_row):
        loads, table = pressure[i], mirrored[abs(i - row), cols - 1 - col :]
        for j in range(cols):
            line[j] += loads[j] * table[j]
    total = 0.0
    for j in range(cols):
        total += line[j]
    return total
