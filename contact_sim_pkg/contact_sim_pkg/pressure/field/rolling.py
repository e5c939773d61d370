"""The pressure field of a contact that rolls: each field starts from a prediction, on the cells
that it needs.

Prediction and its displacement come from the two fields before (`pressure/field/prediction.py`);
corrections follow, each certified by its own convolution (`pressure/field/follow.py`). Where that
does not converge the solver of `pressure/field/solver.py` goes on. After much travel the road that
was under the wheel has left: the start is the field on a grid of half as many cells each way, which
rolls along and is itself started like that; on the coarsest grid it is the last field where the wheel
took it. So it is without a field before, with nothing to start from on the coarsest.

Window: the solver works on the box of the contact before and a margin. A window is enough if no
cell outside it penetrates, which is checked after each solve (`pressure/field/outside.py`). Where
one penetrates the window grows and the solve goes on.
"""

from __future__ import annotations

from functools import cache
from math import isfinite

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.held import Held, hold
from contact_sim_pkg.pressure.closed_form.lame import fit_patch
from contact_sim_pkg.pressure.field.follow import FIRST_LENGTH, MOST_CORRECTIONS
from contact_sim_pkg.pressure.field.halfspace import Field, HalfSpace, coarsened, make_half_space
from contact_sim_pkg.pressure.field.instant import (
    FROM_HALF,
    FROM_PRESSURE,
    Start,
    all_finite,
    grown_window,
    solve_instant,
    store_window,
)
from contact_sim_pkg.pressure.field.nested import halve, window_of_half
from contact_sim_pkg.pressure.field.outside import widened
from contact_sim_pkg.pressure.field.patch import summarise
from contact_sim_pkg.pressure.field.prediction import EXTRAPOLATION, make_previous_field
from contact_sim_pkg.pressure.field.solver import (
    BAD_INPUT,
    CONVERGED,
    EDGE,
    FieldRequest,
    FieldResult,
    solve_at_approach,
    solve_at_load,
)
from contact_sim_pkg.pressure.field.window import GridWindow, Part, copy_window, make_part, write_window
from contact_sim_pkg.records.state import State

__all__ = ["RollingField"]

LEAST_OF_HALF = 24
"""Rows and columns below which a coarser grid costs more than it saves."""

TOLERANCE_OF_HALF = 5e-2
"""Of the field on the coarser grid; the grids differ by more."""

MOST_TRAVEL = 0.1
"""Of a window's rows: after more travel the last field is no start where the road took it."""

CLOSER, CLOSEST = 0.1, 1e-10
"""Of the tolerance, and no closer than, where the solver goes on: its residual alone hardly sees the
pressure of a cell.
"""

NOWHERE = (0, -1, 0, -1)

NEW, REPEAT, START = 0, 1, 2
"""Lengths of corrections are learned apart for a new instant, another solve at the same, and a
start from nothing.
"""

NESTED_COSTS, NEWEST, AGAIN = 2.0, 0.125, 16
"""Corrections that the coarser fields of a nested start cost; weight of the newest count of corrections in its mean; instants
after which the start that was worse is tried again.
"""

Values = NDArray[numpy.float64]
Box = tuple[int, int, int, int]


class RollingField:
    """One pressure field, and the fields of the two instants before. Rows lie along the travel.

    `roll` begins an instant and sets how far the road moved, `solve_at_load` or `solve_at_approach`
    solves there; `pressure` [Pa] is the field. A solve without `roll` repeats the instant: it
    starts from the last field, which it replaces.
    """

    STATE = State(
        ("pressure",),
        (
            "_last.value", "_before.value", "_instants", "_cells", "_box", "_lengths", "_taken", "_same", "_half",
            "_cells_of_half",
        ),
        ("_last.value", "_before.value"),
    )  # fmt: skip

    def __init__(self, half_space: HalfSpace) -> None:
        """Take the whole grid; tables of a window's size are made when it first comes (about 1 ms)
        and kept.
        """
        self.half_space = half_space
        self.pressure: Field = numpy.zeros((half_space.rows, half_space.cols))
        self._last, self._before = hold(make_previous_field(half_space)), hold(make_previous_field(half_space))
        self._instants = 0  # stored, at most 2
        self._cells: int | None = None  # of travel since the last field, if a new instant began
        self._box: Box = NOWHERE  # of the last field's contact
        self._lengths: Values = numpy.full((3, MOST_CORRECTIONS), FIRST_LENGTH)
        self._taken = [0.0, 0.0, 0.0]  # mean corrections of each
        self._same = 0  # instants since the other start was tried
        self._parts: dict[tuple[int, int], Held[Part]] = {}
        self.whole = self._part(half_space.rows, half_space.cols)
        self._half = _half_of(half_space)
        self._cells_of_half = 0  # of travel since its last field, in cells of this grid
        self._gap_of_half: Field = numpy.zeros((half_space.rows // 2, half_space.cols // 2))
        compile_now()

    @property
    def convolutions(self) -> int:
        """Of the solves so far on this grid; coarser ones, and looks outside a window, not counted."""
        return sum(int(part.value.workspace.buffers.convolutions[0]) for part in self._parts.values())

    def roll(self, cells: int) -> None:
        """A new instant: the road moved by `cells` rows towards row 0 since the last field;
        negative: the other way.
        """
        self._cells = int(cells) + (self._cells or 0)
        self._cells_of_half += int(cells)

    def reset(self) -> None:
        """Drop the fields before: the next one starts from nothing."""
        self._instants, self._cells, self._box = 0, None, NOWHERE
        self._lengths.fill(FIRST_LENGTH)
        self._taken, self._same = [0.0, 0.0, 0.0], 0
        self.pressure.fill(0.0)

    def solve_at_load(self, gap: Field, load: float, tolerance: float, max_iterations: int) -> FieldResult:
        """As `pressure/field/solver.py:solve_at_load`, into `pressure`. BAD_INPUT leaves the fields
        before as they were.

        gap: [rows, cols] [m]; load: [N]; tolerance: [1].
        """
        return self._checked(gap, FieldRequest(float(load), True, float(tolerance), int(max_iterations)))

    def solve_at_approach(self, gap: Field, approach: float, tolerance: float, max_iterations: int) -> FieldResult:
        """As `pressure/field/solver.py:solve_at_approach`, into `pressure`. BAD_INPUT leaves the
        fields before as they were.

        gap: [rows, cols] [m]; approach: [m]; tolerance: [1].
        """
        return self._checked(gap, FieldRequest(float(approach), False, float(tolerance), int(max_iterations)))

    def _checked(self, gap: Field, request: FieldRequest) -> FieldResult:
        whole, prescribed = self.half_space, request.prescribed
        if gap.shape != (whole.rows, whole.cols):
            raise ValueError(f"pressure field: gap is {gap.shape}, it must be {(whole.rows, whole.cols)}")
        if not (isfinite(prescribed) and (prescribed >= 0.0 or not request.holds_load) and all_finite(gap)):
            return FieldResult(BAD_INPUT, 0, 0.0, numpy.nan, numpy.inf)
        return self._solve(gap, request)

    def _solve(self, gap: Field, request: FieldRequest) -> FieldResult:
        """Solve where the gap and what is requested are known to be finite."""
        # Predict from the fields before, or start from a coarser grid.
        repeats, has_left = self._begin()
        window, spent = self._expected(has_left or (not repeats and self._prefers_nested())), 0
        share, lengths = (0.0, REPEAT) if repeats else (EXTRAPOLATION if self._instants > 1 else 0.0, NEW)
        if window is None:
            (window, share), lengths = self._start(gap, request), START
        # Correct on a window that grows until no cell outside penetrates; the solver goes on where
        # that fails.
        while True:
            start = Start(window.first_row, window.first_col, repeats, share)
            left = request._replace(max_iterations=request.max_iterations - spent) if spent else request
            found = solve_instant(
                self.whole, self._part(window.rows, window.cols), self._last, self._before, gap,
                self._half._last if self._half else self._last, left, start, self._lengths[lengths], self.pressure,
            )  # fmt: skip
            spent += found.corrections
            if share != FROM_PRESSURE:
                self._learn(lengths, found.corrections if found.certified else MOST_CORRECTIONS)
            if not found.certified:
                return self._settle(window, gap, request, spent, repeats)
            if found.window == window:
                self._end(repeats, found.box)
                return FieldResult(self._status(), spent, found.load, found.approach, found.residual)
            window, share, lengths = GridWindow(*found.window), FROM_PRESSURE, START

    def _begin(self) -> tuple[bool, bool]:
        """Carry the fields before to where the road is now; whether this is another solve at the
        same instant, and whether the road of the last field has left.
        """
        repeats = self._cells is None and self._instants > 0
        last, before = self._last.value.place, self._before.value.place
        if self._cells:
            last[4] += self._cells
            before[4] += self._cells
        self._cells = None
        top, _left, bottom, _right, moved = last.tolist()
        has_left = abs(moved) > MOST_TRAVEL * (bottom - top)
        if has_left:
            last[4], self._instants = 0, min(self._instants, 1)
        return repeats, has_left

    def _end(self, repeats: bool, box: Box) -> None:
        """The new field was stored: in place of the last one if that was of the same instant."""
        self._box = box
        if not repeats:
            self._last, self._before = self._before, self._last
            self._instants = min(self._instants + 1, 2)

    def _learn(self, start: int, corrections: int) -> None:
        """Take up how many ``corrections`` a ``start`` needed."""
        self._taken[start] += (NEWEST if self._taken[start] else 1.0) * (corrections - self._taken[start])

    def _prefers_nested(self) -> bool:
        """Whether a nested start needs fewer corrections than a prediction; on a road whose tops pass quickly
        under a stiff tread it does. The other one is tried again now and then.
        """
        if self._half is None or self._instants < 2:
            return False
        self._same = (self._same + 1) % AGAIN
        nested = self._taken[NEW] > self._taken[START] + NESTED_COSTS
        return nested if self._same else not nested

    def _expected(self, starts_nested: bool) -> GridWindow | None:
        """Where the contact will be: around the place of the last; None where no field before is of
        use, or a coarser grid, where there is one, has a better start.
        """
        if self._instants == 0 or self._box == NOWHERE or (starts_nested and self._half is not None):
            return None
        top, bottom, left, right = self._box
        return GridWindow(*widened(self.half_space.rows, self.half_space.cols, top, bottom, left, right))

    def _start(self, gap: Field, request: FieldRequest) -> tuple[GridWindow, float]:
        """Start from the field on a grid of half as many cells each way, itself started like that,
        or from nothing.
        """
        half, whole = self._half, GridWindow(0, 0, self.half_space.rows, self.half_space.cols)
        if half is None:
            self.pressure.fill(0.0)
            return whole, FROM_PRESSURE
        if self._instants == 0:
            half.reset()
        half.roll(self._cells_of_half // 2)
        self._cells_of_half = 0
        halve(gap, self._gap_of_half)
        half._solve(self._gap_of_half, request._replace(tolerance=TOLERANCE_OF_HALF))
        if half._box == NOWHERE:
            self.pressure.fill(0.0)
            return whole, FROM_PRESSURE
        return GridWindow(*window_of_half(whole.rows, whole.cols, half._box)), FROM_HALF

    def _settle(self, window: GridWindow, gap: Field, request: FieldRequest, spent: int, repeats: bool) -> FieldResult:
        """Solve from the start in `pressure`, on windows that grow until no cell outside
        penetrates.
        """
        result = self._solve_in(window, gap, request, spent)
        while result.status in (CONVERGED, EDGE):
            grown = self._grown(window, gap, result.approach)
            if grown == window:
                break
            window, spent = grown, spent + result.iterations
            result = self._solve_in(window, gap, request, spent)
        result = result._replace(iterations=result.iterations + spent)
        if result.load > 0.0:
            part, target = self._part(window.rows, window.cols), self._last if repeats else self._before
            self._end(repeats, store_window(part, window.first_row, window.first_col, target, self.pressure))
            return result._replace(status=self._status()) if result.status in (CONVERGED, EDGE) else result
        self._instants, self._box = 0, NOWHERE
        return result

    def _solve_in(self, window: GridWindow, gap: Field, request: FieldRequest, spent: int) -> FieldResult:
        part = self._part(window.rows, window.cols).value
        copy_window(gap, window.first_row, window.first_col, part.gap)
        copy_window(self.pressure, window.first_row, window.first_col, part.pressure)
        closer = min(request.tolerance, max(CLOSER * request.tolerance, CLOSEST))
        solve, iterations = solve_at_load if request.holds_load else solve_at_approach, request.max_iterations - spent
        result = solve(part.half_space, part.workspace, part.gap, request.prescribed, closer, iterations, part.pressure)
        write_window(part.pressure, window.first_row, window.first_col, self.pressure)
        return result

    def _grown(self, window: GridWindow, gap: Field, approach: float) -> GridWindow:
        """The window, or a larger one that holds the cells outside it that penetrate."""
        whole = self.half_space
        if (window.rows, window.cols) == (whole.rows, whole.cols):
            return window
        return GridWindow(*grown_window(self.whole, gap, approach, self.pressure, window[:]))

    def _status(self) -> int:
        """EDGE is about the whole grid's edge: the window's edge was checked."""
        top, bottom, left, right = self._box
        at_edge = top == 0 or left == 0 or bottom == self.half_space.rows - 1 or right == self.half_space.cols - 1
        return EDGE if at_edge else CONVERGED

    def _part(self, rows: int, cols: int) -> Held[Part]:
        part = self._parts.get((rows, cols))
        if part is None:
            part = self._parts[rows, cols] = hold(make_part(self.half_space, rows, cols))
        return part


def _half_of(whole: HalfSpace) -> RollingField | None:
    """A grid with cells of twice the size; None where it would be too coarse to help."""
    rows, cols = whole.rows, whole.cols
    if min(rows, cols) < 2 * LEAST_OF_HALF or rows % 2 or cols % 2:
        return None
    return RollingField(coarsened(whole))


@cache
def compile_now() -> None:
    """Compile all of it on a grid of four cells: a path that was never taken may be needed in the
    middle of a run.
    """
    half_space, field, wide = make_half_space(2, 2, 1.0, 1.0, 1.0), numpy.zeros((2, 2)), numpy.zeros((4, 4))
    part, previous = make_part(half_space, 2, 2), hold(make_previous_field(half_space))
    held, lengths = hold(part), numpy.full(MOST_CORRECTIONS, FIRST_LENGTH)
    all_finite(field)
    # The arguments have the types of a run; their values do not matter
    request, start = FieldRequest(1.0, True, 1.0, 1), Start(0, 0, False, FROM_PRESSURE)
    solve_instant(held, held, previous, previous, field, previous, request, start, lengths, field)
    solve_at_load(half_space, part.workspace, field, 1.0, 1.0, 1, field)
    store_window(held, 0, 0, previous, field)
    grown_window(held, field, 1.0, field, (0, 0, 2, 2))
    copy_window(field, 0, 0, part.gap)
    write_window(part.gap, 0, 0, field)
    halve(wide, field)
    window_of_half(4, 4, (0, 1, 0, 1))
    widened(2, 2, 0, 1, 0, 1)
    # What is published of a field
    grid = (1.0, 1.0, 0.0, 0.0)
    summarise(field, *grid)
    fit_patch(field, *grid)
