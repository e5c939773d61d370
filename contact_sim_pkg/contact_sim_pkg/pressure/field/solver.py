"""The pressure field of a one-sided contact on a half-space, for a given approach or a given load.

With p the pressure, u = K p the displacement (`pressure/field/halfspace.py`), g0 the gap of the
undeformed surfaces and d the approach, the clearance `c = u + g0 - d` satisfies in each cell `p >=
0, c >= 0, p c = 0`.

Method: preconditioned conjugate gradients (Polak-Ribiere, beta >= 0) on the free cells {p > 0} and
{p = 0, c < 0}: a penetrating cell joins the search direction without a restart. The displacement of
the direction updates the clearance, so an ordinary iteration takes one convolution. Where the step
would pull, p is set to zero and the clearance is corrected: cell by cell from the influence table
when few are concerned, by one more convolution when many are. A given load is held by removing the
mean of the direction and rescaling; the approach is then the mean of u + g0 in contact. Conjugate
gradients with active set: Polonsky and Keer (1999), Wear 231, 206. Preconditioner: |q|, the symbol
of K^-1.

The residual that is returned is computed from the returned pressure by a convolution of its own:

    residual = (sum p |c| + max(0, -c over p = 0) sum p) / sum p u

a number without unit, 0 for the exact field. `sum p u > 0` is twice the elastic energy, so nothing
is divided by the roughness or the size of the grid, and a flat surface is no special case.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.guards import require_count, require_not_negative
from contact_sim_pkg.compiled.jit import borrowing_kernel, entry, kernel
from contact_sim_pkg.pressure.field.halfspace import Field, HalfSpace
from contact_sim_pkg.pressure.field.iteration import (
    ONE_BY_ONE,
    SolverWorkspace,
    begin,
    evaluate,
    fresh_surface,
    hold_load,
    make_workspace,
    move_surface,
    part,
    rescale,
    search,
    step,
)

__all__ = [
    "BAD_INPUT",
    "CONVERGED",
    "EDGE",
    "NOT_CONVERGED",
    "SENTENCES",
    "FieldRequest",
    "FieldResult",
    "SolverWorkspace",
    "first_bad_cell",
    "make_workspace",
    "refuse_bad_gap",
    "solve",
    "solve_at_approach",
    "solve_at_load",
]

CONVERGED = 0
EDGE = 1
NOT_CONVERGED = 2
BAD_INPUT = 3

SENTENCES = {
    CONVERGED: "the pressure field is certified to the tolerance",
    EDGE: "the contact reaches the edge of the grid, so load may be missing; enlarge the grid",
    NOT_CONVERGED: "the residual is above the tolerance after the allowed iterations; allow more or request less",
    BAD_INPUT: "gap, approach or load is not a finite number, or the load or a pressure of the start is negative",
}
"""What each status means, ready for a message."""

PATIENCE = 20
"""Iterations without a lower residual after which the direction starts again from the gradient."""


class FieldRequest(NamedTuple):
    """What is prescribed, and how accurately the field is needed."""

    prescribed: float  # load [N] where `holds_load`, else approach [m] against the datum of the gap
    holds_load: bool
    tolerance: float  # [1] on the residual
    max_iterations: int


class FieldResult(NamedTuple):
    """What a solve found, beside the field."""

    status: int  # CONVERGED (also without contact: load 0), EDGE, NOT_CONVERGED or BAD_INPUT
    iterations: int  # conjugate gradient steps
    load: float  # [N] sum of the pressure times the cell area
    approach: float  # [m] rigid approach, against the same datum as the gap
    residual: float  # [1] certified on the returned field, see the module text


def solve_at_approach(
    half_space: HalfSpace,
    workspace: SolverWorkspace,
    gap: Field,
    approach: float,
    tolerance: float,
    max_iterations: int,
    pressure: Field,
) -> FieldResult:
    """Pressure field at a given approach.

    gap: height of the undeformed gap [m], float64 [rows, cols], any datum; approach: rigid approach
    [m] against that datum; tolerance: on the residual [1]; pressure: float64 [rows, cols] [Pa], in:
    start (zeros when nothing is known), out: the field, exactly zero where there is no contact.
    Without contact the field and the load are zero and the status is CONVERGED. With EDGE and
    NOT_CONVERGED the field is returned as it is; BAD_INPUT leaves it untouched. Raises `ValueError`
    for arrays of the wrong shape or type, a tolerance below 0, iterations that are no whole number
    >= 0.
    """
    _refuse(half_space, gap, pressure, tolerance, max_iterations)
    # Floats and whole numbers: other types would compile another version
    request = FieldRequest(float(approach), False, float(tolerance), int(max_iterations))
    return solve(half_space, workspace, gap, request, pressure)


def solve_at_load(
    half_space: HalfSpace,
    workspace: SolverWorkspace,
    gap: Field,
    load: float,
    tolerance: float,
    max_iterations: int,
    pressure: Field,
) -> FieldResult:
    """Pressure field that carries a given load [N] >= 0, and its approach; the rest as
    `solve_at_approach`.

    Zero load gives a zero field and the approach of first contact, the smallest gap.
    """
    _refuse(half_space, gap, pressure, tolerance, max_iterations)
    request = FieldRequest(float(load), True, float(tolerance), int(max_iterations))
    return solve(half_space, workspace, gap, request, pressure)


def refuse_bad_gap(gap: Field, name: str = "gap") -> None:
    """Raise `ValueError` naming the first cell whose height is not finite.

    gap: [rows, cols] [m].
    """
    cell = int(first_bad_cell(gap))
    if cell >= 0:
        row, col = divmod(cell, gap.shape[1])
        raise ValueError(
            f"{name}: the height of row {row}, column {col} is {gap[row, col]}, it must be finite; fill the cell"
        )


def _refuse(half_space: HalfSpace, gap: Field, pressure: Field, tolerance: float, max_iterations: int) -> None:
    """Compiled code does not check bounds, so shapes are checked before it."""
    require_not_negative("pressure field: tolerance", tolerance)
    require_count("pressure field: iterations", max_iterations, least=0)
    shape = (half_space.rows, half_space.cols)
    if gap.shape != shape or pressure.shape != shape:
        raise ValueError(f"pressure field: gap is {gap.shape} and pressure {pressure.shape}, both must be {shape}")
    for name, field in (("gap", gap), ("pressure", pressure)):
        if field.dtype != numpy.float64 or not (field.flags.c_contiguous and field.flags.writeable):
            raise ValueError(
                f"pressure field: {name} is of {field.dtype}, contiguous {field.flags.c_contiguous}, writable "
                f"{field.flags.writeable}; it must be float64, contiguous by rows and writable: "
                f"pass numpy.array({name}, float, order='C')"
            )


@entry
def first_bad_cell(gap: Field) -> int:
    """Row-major index of the first cell that is not finite, or -1. The array has two axes, which is
    not checked.

    gap: [rows, cols] [m].
    """
    rows, cols = gap.shape
    for i in range(rows):
        for j in range(cols):
            if not numpy.isfinite(gap[i, j]):
                return i * cols + j
    return -1


@entry
def solve(
    half_space: HalfSpace, workspace: SolverWorkspace, gap: Field, request: FieldRequest, pressure: Field
) -> FieldResult:
    """`solve_at_load` or `solve_at_approach`, as `request` says.

    gap: [rows, cols] [m]; pressure: [rows, cols] [Pa], start and result. Shapes are not checked.
    """
    prescribed, holds_load = request.prescribed, request.holds_load
    if not (numpy.isfinite(prescribed) and (prescribed >= 0.0 or not holds_load) and acceptable(gap, pressure)):
        return FieldResult(BAD_INPUT, 0, 0.0, numpy.nan, numpy.inf)
    # Nothing to carry, or above the surface: no contact
    touch = lowest(gap)
    if prescribed == 0.0 if holds_load else prescribed <= touch:
        pressure[:] = 0.0
        return FieldResult(CONVERGED, 0, 0.0, touch if holds_load else prescribed, 0.0)
    total = prescribed / (half_space.cell_x * half_space.cell_y) if holds_load else -1.0
    # Heights above the lowest cell: no digits lost to the datum
    heights_above(gap, touch, workspace.height)
    heights_above(pressure, 0.0, workspace.pressure)
    if holds_load:
        start_at_load(half_space, workspace.height, prescribed, total, workspace.pressure)
    result = iterate(half_space, workspace, prescribed - touch, total, request.tolerance, request.max_iterations)
    heights_above(workspace.pressure, 0.0, pressure)
    approach = touch + result.approach if holds_load else prescribed
    return FieldResult(result.status, result.iterations, result.load, approach, result.residual)


@borrowing_kernel
def acceptable(gap: Field, pressure: Field) -> bool:
    """All heights finite, all start pressures finite and not negative.

    gap: [rows, cols] [m]; pressure: [rows, cols] [Pa].
    """
    faults = 0
    rows, cols = gap.shape
    for i in range(rows):
        for j in range(cols):
            good = numpy.isfinite(gap[i, j]) and pressure[i, j] >= 0.0 and numpy.isfinite(pressure[i, j])
            faults += 0 if good else 1
    return faults == 0


@borrowing_kernel
def lowest(gap: Field) -> float:
    """Lowest height [m] of a gap [rows, cols]."""
    rows, cols = gap.shape
    least = numpy.inf
    for i in range(rows):
        for j in range(cols):
            least = min(least, gap[i, j])
    return least


@borrowing_kernel
def heights_above(gap: Field, datum: float, height: Field) -> None:
    """Write `gap - datum` [m] into `height`, both [rows, cols]."""
    rows, cols = gap.shape
    for i in range(rows):
        for j in range(cols):
            height[i, j] = gap[i, j] - datum


@borrowing_kernel
def total_of(pressure: Field) -> float:
    """Sum over the cells, row by row.

    pressure: [rows, cols] [Pa].
    """
    rows, cols = pressure.shape
    total = 0.0
    for i in range(rows):
        row_total = 0.0
        for j in range(cols):
            row_total += pressure[i, j]
        total += row_total
    return total


@kernel
def start_at_load(half_space: HalfSpace, height: Field, load: float, total: float, pressure: Field) -> None:
    """Scale the start pressure to the load; without one, take a pressure proportional to an overlap
    that carries it.

    The overlap's volume V and area A carry `0.6 E* V / sqrt(A / pi)`, exact for a sphere (4 sqrt(2)
    / (3 pi)); its approach is found by bisection. Beyond the highest cell the whole grid is loaded.
    height, pressure: [rows, cols]; load: [N]; total: [Pa].
    """
    rows, cols = height.shape
    present = total_of(pressure)
    if present <= 0.0:
        approach = overlap_approach(half_space, height, load)
        for i in range(rows):
            for j in range(cols):
                pressure[i, j] = max(approach - height[i, j], 0.0)
        present = total_of(pressure)
    for i in range(rows):
        for j in range(cols):
            pressure[i, j] = pressure[i, j] * (total / present) if present > 0.0 else total / (rows * cols)


@borrowing_kernel
def overlap_approach(half_space: HalfSpace, height: Field, load: float) -> float:
    """Approach [m] above the lowest cell at which the overlap carries the load [N]; height: [rows,
    cols] [m].
    """
    rows, cols = height.shape
    low, high = 0.0, 0.0
    for i in range(rows):
        for j in range(cols):
            high = max(high, height[i, j])
    cell = half_space.cell_x * half_space.cell_y
    for _ in range(12):
        # Bisection: the overlap as a punch of its own area
        middle = 0.5 * (low + high)
        volume, cells = 0.0, 0.0
        for i in range(rows):
            for j in range(cols):
                overlap = max(middle - height[i, j], 0.0)
                volume += overlap
                cells += 1.0 if overlap > 0.0 else 0.0
        if 0.6 * half_space.modulus * volume * cell >= load * numpy.sqrt(cells * cell / numpy.pi):
            high = middle
        else:
            low = middle
    return high


@kernel
def iterate(
    half_space: HalfSpace,
    workspace: SolverWorkspace,
    approach: float,
    total: float,
    tolerance: float,
    max_iterations: int,
) -> FieldResult:
    """Conjugate gradients from the given pressure; `total` [Pa] is the sum of p to hold, or -1 for
    a given approach.
    """
    holds_load = total > 0.0
    refresh, fresh, blocked = True, False, False
    best, stale, slope, iterations = numpy.inf, 0, 0.0, 0
    contact = begin(workspace)
    left = min(contact, 0)  # of a literal 0 another version would be compiled
    while True:
        if refresh:
            if holds_load:
                hold_load(workspace, contact, total)
            fresh_surface(half_space, workspace)
            refresh, fresh = False, True
        state = evaluate(workspace, contact, left, approach, holds_load)
        if state.residual <= tolerance or iterations >= max_iterations or blocked:
            if fresh:
                break
            refresh = True  # certify: evaluate once more, from the pressure alone
            contact, left = part(workspace, state.free, 0.0)
            continue
        stale = 0 if state.residual < best else stale + 1
        best = min(best, state.residual)
        slope, descent = search(half_space, workspace, state.free, slope if stale < PATIENCE else 0.0, holds_load)
        stale = stale if stale < PATIENCE else 0
        length = step(half_space, workspace, state.free, descent)
        blocked = length == 0.0
        contact, left = part(workspace, state.free, length)
        iterations += 1
        # As expensive as summing the clipped pressure, and what certifies as well
        refresh = left > ONE_BY_ONE
        fresh = False
        if not refresh:
            move_surface(half_space, workspace, length, left)
            if holds_load and left > 0:
                rescale(workspace, hold_load(workspace, contact, total))
    pressure = workspace.pressure
    load = total_of(pressure) * half_space.cell_x * half_space.cell_y
    return FieldResult(verdict(pressure, state.residual, tolerance), iterations, load, state.approach, state.residual)


@borrowing_kernel
def verdict(pressure: Field, residual: float, tolerance: float) -> int:
    """Status of a pressure field [rows, cols] [Pa] with this residual [1]; tolerance: [1]."""
    if not residual <= tolerance:
        return NOT_CONVERGED
    rows, cols = pressure.shape
    at_edge = 0
    for i in range(rows):
        at_edge += 1 if pressure[i, 0] > 0.0 or pressure[i, cols - 1] > 0.0 else 0
    for j in range(cols):
        at_edge += 1 if pressure[0, j] > 0.0 or pressure[rows - 1, j] > 0.0 else 0
    return EDGE if at_edge > 0 else CONVERGED
