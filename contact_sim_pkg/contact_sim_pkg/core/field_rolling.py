"""The pressure field of a contact that rolls: each field starts from a prediction, on the cells that it needs.

Prediction: the roughness of the road is carried through the contact, so the field changes slowly in the *road's* frame. The two
fields before, shifted by the cells travelled, are extrapolated linearly, `2 p1 - p2`, set to zero where that is negative or where
p1 was zero, and scaled to the load where a load is given. The prediction is a start only: the answer is certified as ever.

Where nothing is known the start is the field on a grid of half as many cells each way, itself started like that.

Window: the solver works on the box of the predicted contact and a margin. A window is enough if no cell outside it
penetrates. That is checked after each solve by bounds: the gap of a block of cells outside is not less than its lowest gap plus
the displacement that the pressure of each block inside causes at the largest distance between the two. Only cells of blocks
where that bound fails are evaluated, from the influence table. Where one penetrates the window grows and the solve goes on.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.core.field_solver import BAD_INPUT, CONVERGED, EDGE, FieldResult, solve_at_approach, solve_at_load
from contact_sim_pkg.core.field_window import Part, Window, make_part, put_back, take
from contact_sim_pkg.core.halfspace import Field, HalfSpace, coarsened
from contact_sim_pkg.core.jit import entry, kernel

__all__ = ["RollingField"]

BLOCK = 4
"""Cells along a side of a block; windows begin and end at blocks."""

COARSE = 16
"""Cells along a side of the larger blocks, which are tried first; a multiple of `BLOCK`."""

LEAST_OF_HALF = 24
"""Rows and columns below which a coarser grid costs more than it saves."""

TOLERANCE_OF_HALF = 1e-2
"""Of the field on the coarser grid; the grids differ by more."""

Values = NDArray[numpy.float64]
Places = NDArray[numpy.int64]

MARGIN = 2
"""Cells around the predicted contact that belong to the window."""


class Blocks(NamedTuple):
    """Pressures added up over square blocks of cells; scratch."""

    side: int  # [cells]
    sums: Field  # [Pa] [rows/side, cols/side]
    pressures: Values  # [Pa] those that are not zero
    loaded: Places  # first row and column of these
    number: Places  # [1] how many they are
    line: Values  # [Pa] [cols]


def make_blocks(half_space: HalfSpace, side: int) -> Blocks:
    """Scratch for blocks of `side` x `side` cells."""
    rows, cols = -(-half_space.rows // side), -(-half_space.cols // side)
    places = numpy.zeros((rows * cols, 2), dtype=numpy.int64)
    number = numpy.zeros(1, dtype=numpy.int64)
    return Blocks(
        side, numpy.zeros((rows, cols)), numpy.zeros(rows * cols), places, number, numpy.zeros(half_space.cols)
    )


class RollingField:
    """One pressure field and what is known of it from the steps before. Rows lie along the travel.

    `roll` says how far the road moved, `solve_at_load` or `solve_at_approach` solves there; `pressure` [Pa] is the field.
    """

    def __init__(self, half_space: HalfSpace) -> None:
        """Take the whole grid; tables of a window's size are made when it first comes (about 1 ms) and kept."""
        self.half_space = half_space
        self.pressure: Field = numpy.zeros((half_space.rows, half_space.cols))
        self._before: Field = numpy.zeros((half_space.rows, half_space.cols))
        self._coarse, self._fine = make_blocks(half_space, COARSE), make_blocks(half_space, BLOCK)
        self._fields = 0  # known from before, at most 2
        self._cells = 0
        self._parts: dict[tuple[int, int], Part] = {}
        self._half = _half_of(half_space)
        self._gap_of_half: Field = numpy.zeros((half_space.rows // 2, half_space.cols // 2))

    @property
    def convolutions(self) -> int:
        """Done so far on this grid, coarser ones not counted."""
        return sum(int(part.workspace.buffers.convolutions[0]) for part in self._parts.values())

    def roll(self, cells: int) -> None:
        """The road moved by `cells` rows towards row 0 since the last field; negative: the other way."""
        self._cells += int(cells)

    def forget(self) -> None:
        """The next field starts from nothing."""
        self._fields, self._cells = 0, 0
        self.pressure.fill(0.0)
        self._before.fill(0.0)

    def solve_at_load(self, gap: Field, load: float, tolerance: float, max_iterations: int) -> FieldResult:
        """As `field_solver.solve_at_load`, into `pressure`. BAD_INPUT leaves what is known as it was."""
        return self._solve(gap, float(load), True, float(tolerance), int(max_iterations))

    def solve_at_approach(self, gap: Field, approach: float, tolerance: float, max_iterations: int) -> FieldResult:
        """As `field_solver.solve_at_approach`, into `pressure`. BAD_INPUT leaves what is known as it was."""
        return self._solve(gap, float(approach), False, float(tolerance), int(max_iterations))

    def _solve(self, gap: Field, given: float, holds_load: bool, tolerance: float, max_iterations: int) -> FieldResult:
        whole = self.half_space
        if gap.shape != (whole.rows, whole.cols):
            raise ValueError(f"pressure field: gap is {gap.shape}, it must be {(whole.rows, whole.cols)}")
        if not (numpy.isfinite(given) and (given >= 0.0 or not holds_load) and all_finite(gap)):
            return FieldResult(BAD_INPUT, 0, 0.0, numpy.nan, numpy.inf)
        window = Window(*predict(self.pressure, self._before, self._cells, self._fields))
        self._cells = 0
        if window.rows == 0 and self._half is not None:
            window = self._start(self._half, gap, given, holds_load, max_iterations)
        if window.rows == 0:
            window = Window(0, 0, whole.rows, whole.cols)
        result, iterations = self._solve_in(window, gap, given, holds_load, tolerance, max_iterations), 0
        while result.status in (CONVERGED, EDGE):
            grown = self._grown(window, gap, result.approach)
            if grown == window:
                break
            window, iterations = grown, iterations + result.iterations
            result = self._solve_in(window, gap, given, holds_load, tolerance, max_iterations - iterations)
        self._fields = min(self._fields + 1, 2) if result.load > 0.0 else 0
        return self._judged(result._replace(iterations=result.iterations + iterations))

    def _start(self, half: RollingField, gap: Field, given: float, holds_load: bool, max_iterations: int) -> Window:
        """Start from the field on a grid of half as many cells each way, itself started like that."""
        half.forget()
        halve(gap, self._gap_of_half)
        solve = half.solve_at_load if holds_load else half.solve_at_approach
        solve(self._gap_of_half, given, TOLERANCE_OF_HALF, max_iterations)
        return Window(*double(half.pressure, self.pressure))

    def _solve_in(
        self, window: Window, gap: Field, given: float, holds_load: bool, tolerance: float, max_iterations: int
    ) -> FieldResult:
        part = self._part(window.rows, window.cols)
        take(gap, window.first_row, window.first_col, part.gap)
        take(self.pressure, window.first_row, window.first_col, part.pressure)
        solve = solve_at_load if holds_load else solve_at_approach
        result = solve(part.half_space, part.workspace, part.gap, given, tolerance, max_iterations, part.pressure)
        put_back(part.pressure, window.first_row, window.first_col, self.pressure)
        return result

    def _grown(self, window: Window, gap: Field, approach: float) -> Window:
        """The window, or a larger one that holds the cells outside it that penetrate."""
        whole = self.half_space
        if (window.rows, window.cols) == (whole.rows, whole.cols):
            return window
        return Window(*enclose(whole, gap, approach, self.pressure, self._coarse, self._fine, *window))

    def _judged(self, result: FieldResult) -> FieldResult:
        """EDGE is about the whole grid's edge: the window's edge was checked."""
        if result.status not in (CONVERGED, EDGE):
            return result
        p = self.pressure
        at_edge = p[0].any() or p[-1].any() or p[:, 0].any() or p[:, -1].any()
        return result._replace(status=EDGE if at_edge else CONVERGED)

    def _part(self, rows: int, cols: int) -> Part:
        part = self._parts.get((rows, cols))
        if part is None:
            part = self._parts[rows, cols] = make_part(self.half_space, rows, cols)
        return part


def _half_of(whole: HalfSpace) -> RollingField | None:
    """A grid with cells of twice the size; None where it would be too coarse to help."""
    rows, cols = whole.rows, whole.cols
    if min(rows, cols) < 2 * LEAST_OF_HALF or rows % 2 or cols % 2:
        return None
    return RollingField(coarsened(whole))


@entry
def halve(gap: Field, out: Field) -> None:
    """Means of two by two cells."""
    for i in range(out.shape[0]):
        for j in range(out.shape[1]):
            out[i, j] = 0.25 * (
                (gap[2 * i, 2 * j] + gap[2 * i, 2 * j + 1]) + (gap[2 * i + 1, 2 * j] + gap[2 * i + 1, 2 * j + 1])
            )


@entry
def double(pressure: Field, out: Field) -> tuple[int, int, int, int]:
    """Bilinear interpolation to two by two cells each, zero where `pressure` is; returns the window, or no rows."""
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
                near = 0.75 * pressure[row, col] + 0.25 * pressure[row, next_to]
                far = 0.75 * pressure[beside, col] + 0.25 * pressure[beside, next_to]
                out[i, j] = 0.75 * near + 0.25 * far
                top, bottom = min(top, row), max(bottom, row)
                left, right = min(left, col), max(right, col)
    if bottom < 0:
        return 0, 0, 0, 0
    return widened(2 * rows, 2 * cols, 2 * top, 2 * bottom + 1, 2 * left, 2 * right + 1)


@entry
def all_finite(gap: Field) -> bool:
    """Whether every height is a finite number."""
    faults = 0
    for i in range(gap.shape[0]):
        for j in range(gap.shape[1]):
            faults += 0 if abs(gap[i, j]) < numpy.inf else 1
    return faults == 0


@entry
def predict(pressure: Field, before: Field, cells: int, fields: int) -> tuple[int, int, int, int]:
    """Shift and extrapolate; `pressure` becomes the prediction, `before` the last field. Returns the window, or no rows.

    `fields`: how many fields are known, 0 to 2; `cells`: rows that the road moved towards row 0.
    """
    rows, cols = pressure.shape
    top, bottom, left, right = rows, -1, cols, -1
    for k in range(rows):
        i = k if cells >= 0 else rows - 1 - k  # a row is read before it is written
        source = i + cells
        known = fields > 0 and 0 <= source < rows
        first, last = cols, -1
        for j in range(cols):
            p = pressure[source, j] if known else 0.0
            q = before[source, j] if known and fields > 1 else p
            start = max(2.0 * p - q, 0.0) if p > 0.0 else 0.0
            before[i, j] = p
            pressure[i, j] = start
            if p > 0.0:
                first = min(first, j)
                last = j
        if last >= 0:
            top, bottom = min(top, i), max(bottom, i)
            left, right = min(left, first), max(right, last)
    if bottom < 0:
        return 0, 0, 0, 0
    return widened(rows, cols, top, bottom, left, right)


@kernel
def widened(rows: int, cols: int, top: int, bottom: int, left: int, right: int) -> tuple[int, int, int, int]:
    """Window of whole blocks that holds a box of cells and the margin."""
    first_row = max(top - MARGIN, 0) // BLOCK * BLOCK
    first_col = max(left - MARGIN, 0) // BLOCK * BLOCK
    end_row = min(rows, -(-(bottom + 1 + MARGIN) // BLOCK) * BLOCK)
    end_col = min(cols, -(-(right + 1 + MARGIN) // BLOCK) * BLOCK)
    return first_row, first_col, end_row - first_row, end_col - first_col


@entry
def enclose(
    half_space: HalfSpace,
    gap: Field,
    approach: float,
    pressure: Field,
    coarse: Blocks,
    fine: Blocks,
    first_row: int,
    first_col: int,
    window_rows: int,
    window_cols: int,
) -> tuple[int, int, int, int]:
    """Smallest window that holds the given one and every cell outside it that penetrates; the blocks are scratch."""
    rows, cols = gap.shape
    end_row, end_col = first_row + window_rows, first_col + window_cols
    top, bottom, left, right = rows, -1, cols, -1
    added = False
    for i in range(0, rows, BLOCK):
        for j in range(0, cols, BLOCK):
            if first_row <= i < end_row and first_col <= j < end_col:
                continue
            depth = approach - lowest_of_block(gap, i, j, approach)
            if depth <= 0.0:
                continue
            if not added:
                add_up_cells(pressure, fine)
                add_up_blocks(fine, coarse)
                added = True
            if displaced_by(half_space, coarse, i, j, BLOCK, depth) or displaced_by(
                half_space, fine, i, j, BLOCK, depth
            ):
                continue
            for row in range(i, min(i + BLOCK, rows)):
                for col in range(j, min(j + BLOCK, cols)):
                    depth = approach - gap[row, col]
                    if depth <= 0.0 or displaced_by(half_space, fine, row, col, 1, depth):
                        continue
                    if displacement_at(half_space, pressure, row, col, first_row, end_row) < depth:
                        top, bottom = min(top, row), max(bottom, row)
                        left, right = min(left, col), max(right, col)
    if bottom < 0:
        return first_row, first_col, window_rows, window_cols
    first, start, height, width = widened(rows, cols, top, bottom, left, right)
    last_row, last_col = max(end_row, first + height), max(end_col, start + width)
    first, start = min(first, first_row), min(start, first_col)
    return first, start, last_row - first, last_col - start


@kernel
def add_up_cells(pressure: Field, blocks: Blocks) -> None:
    """Sums of the pressure over blocks of cells."""
    rows, cols = pressure.shape
    side, sums, line = blocks.side, blocks.sums, blocks.line
    for a in range(sums.shape[0]):
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


@kernel
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


@kernel
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


@kernel
def lowest_of_block(gap: Field, i: int, j: int, most: float) -> float:
    """Lowest gap [m] of a block, or `most` where none is lower."""
    end_row, end_col = min(i + BLOCK, gap.shape[0]), min(j + BLOCK, gap.shape[1])
    least = most
    for row in range(i, end_row):
        for col in range(j, end_col):
            if gap[row, col] < least:
                least = gap[row, col]
    return least


@kernel
def displaced_by(half_space: HalfSpace, blocks: Blocks, i: int, j: int, side: int, depth: float) -> bool:
    """Whether all of the `side` x `side` cells that begin at (i, j) are surely displaced by `depth` [m] at least.

    The pressure of each block is taken at the largest distance between two cells of the two blocks.
    """
    influence, loaded, far = half_space.influence, blocks.loaded, blocks.side - 1
    last_row, last_col = influence.shape[0] - 1, influence.shape[1] - 1
    total = 0.0
    for k in range(blocks.number[0]):
        away_x = max(i + side - 1 - loaded[k, 0], loaded[k, 0] + far - i)
        away_y = max(j + side - 1 - loaded[k, 1], loaded[k, 1] + far - j)
        total += blocks.pressures[k] * influence[min(away_x, last_row), min(away_y, last_col)]
        if total >= depth:
            return True
    return False


@kernel
def displacement_at(half_space: HalfSpace, pressure: Field, row: int, col: int, first_row: int, end_row: int) -> float:
    """Displacement [m] of one cell by a direct sum over the loaded rows."""
    influence = half_space.influence
    total = 0.0
    for i in range(first_row, end_row):
        table = influence[abs(i - row)]
        for j in range(pressure.shape[1]):
            total += pressure[i, j] * table[abs(j - col)]
    return total
