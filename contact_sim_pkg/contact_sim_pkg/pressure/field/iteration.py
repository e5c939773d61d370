"""One iteration of the pressure-field solver (`pressure/field/solver.py`): evaluate, choose a
direction, step, correct.

Pressure, clearance and direction differ from zero on the free cells only, about a fifth of a tire's
grid. A list of them is kept, cells in contact first, and every sum runs over the list; whole grids
are passed over only for the transforms, to update the surface and to look for cells that penetrate.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.jit import borrowing_kernel, kernel
from contact_sim_pkg.pressure.field.belt import BeltWorkspace, make_belt_workspace
from contact_sim_pkg.pressure.field.halfspace import Buffers, Field, HalfSpace, convolve, make_buffers, precondition

__all__ = [
    "SolverWorkspace",
    "begin",
    "evaluate",
    "fresh_surface",
    "hold_load",
    "make_workspace",
    "move_surface",
    "part",
    "rescale",
    "search",
    "step",
]

ONE_BY_ONE = 64
"""Clipped cells up to which their influence is summed directly: about the cost of one convolution.
"""

Cells = NDArray[numpy.int64]
Values = NDArray[numpy.float64]


class CellLists(NamedTuple):
    """Row-major indices of cells; how many of them are meant is handed around."""

    free: Cells  # cells in contact, then cells that penetrate without pressure
    left: Cells  # cells that were free and carry no pressure now
    # The workspace's fields of these names, the same memory as one row: compiles sooner than
    # `ravel`
    height: Values
    pressure: Values
    surface: Values
    residual: Values
    filtered: Values
    direction: Values
    response: Values


class SolverWorkspace(NamedTuple):
    """Buffers of one solve at a time; a second solve in another thread needs its own. Fields are
    [rows, cols].
    """

    buffers: Buffers
    # [m] gap above its lowest cell: differences keep their digits whatever the datum is
    height: Field
    pressure: Field  # [Pa]
    surface: Field  # [m] height + displacement
    residual: Field  # [m] clearance on the free cells, else 0
    filtered: Field  # [Pa] preconditioned residual
    direction: Field  # [Pa] search direction, 0 on cells that are not free
    response: Field  # [m] displacement of the search direction
    # [m] clearance of the free cells one iteration earlier, in the order of their list
    residual_before: Values
    clipped: Values  # [Pa] pressure that the bound p >= 0 added to the cells of `left`
    cells: CellLists
    belt: BeltWorkspace


class Evaluation(NamedTuple):
    """What one evaluation finds."""

    approach: float  # [m]
    residual: float  # [1]
    free: int  # cells in the list


def make_workspace(half_space: HalfSpace) -> SolverWorkspace:
    """Buffers that fit a half-space; solving itself allocates nothing."""
    shape, cells = (half_space.rows, half_space.cols), half_space.rows * half_space.cols
    height, pressure, surface, residual, filtered, direction, response = (numpy.zeros(shape) for _ in range(7))
    fields = (height, pressure, surface, residual, filtered, direction, response)
    free, left = numpy.zeros(cells, dtype=numpy.int64), numpy.zeros(cells, dtype=numpy.int64)
    lists = CellLists(free, left, *(field.reshape(-1) for field in fields))
    belt = make_belt_workspace(len(half_space.belt))
    return SolverWorkspace(make_buffers(half_space), *fields, numpy.zeros(cells), numpy.zeros(cells), lists, belt)


@borrowing_kernel
def begin(workspace: SolverWorkspace) -> int:
    """Reset from the solve before; lists the cells in contact and returns their number.

    Fields of the workspace: [rows, cols]; its list: row-major indices, [cells].
    """
    pressure, residual, direction = workspace.pressure, workspace.residual, workspace.direction
    free = workspace.cells.free
    rows, cols = pressure.shape
    count = 0
    for i in range(rows):
        found = 0
        for j in range(cols):
            residual[i, j] = 0.0
            direction[i, j] = 0.0
            found += 1 if pressure[i, j] > 0.0 else 0
        # Most rows of a grid have no contact
        if found == 0:
            continue
        for j in range(cols):
            if pressure[i, j] > 0.0:
                free[count] = i * cols + j
                count += 1
    return count


@kernel
def fresh_surface(half_space: HalfSpace, workspace: SolverWorkspace) -> None:
    """Deformed surface [m] from the pressure, by a convolution of its own."""
    surface, height = workspace.surface, workspace.height
    convolve(half_space, workspace.buffers, workspace.pressure, surface)
    rows, cols = surface.shape
    for i in range(rows):
        for j in range(cols):
            surface[i, j] += height[i, j]


@borrowing_kernel
def evaluate(workspace: SolverWorkspace, contact: int, left: int, approach: float, holds_load: bool) -> Evaluation:
    """Residual of a field (and its approach, if the load is given); stores the clearance of the
    free cells.

    The first `contact` cells of the list are in contact, the first `left` of the other have just
    lost their pressure.
    approach: [m], taken where the load is not prescribed.
    """
    pressure, residual = workspace.cells.pressure, workspace.cells.residual
    surface, height = workspace.cells.surface, workspace.cells.height
    free, before = workspace.cells.free, workspace.residual_before
    if holds_load:  # the approach is the mean of the surface in contact
        mean = 0.0
        for m in range(contact):
            mean += surface[free[m]]
        approach = mean / max(float(contact), 1.0)
    release_cells(workspace, left, approach)
    complementarity, energy, total = 0.0, 0.0, 0.0
    for m in range(contact):
        k = free[m]
        p, clearance = pressure[k], surface[k] - approach
        before[m] = residual[k]
        residual[k] = clearance
        complementarity += p * abs(clearance)
        energy += p * (surface[k] - height[k])
        total += p
    count = join(workspace, contact, approach)
    penetration = 0.0
    for m in range(contact, count):
        penetration = max(penetration, -residual[free[m]])
    if penetration == 0.0 and complementarity == 0.0:
        return Evaluation(approach, 0.0, count)
    if not energy > 0.0:
        return Evaluation(approach, numpy.inf, count)
    return Evaluation(approach, (complementarity + penetration * total) / energy, count)


@borrowing_kernel
def release_cells(workspace: SolverWorkspace, left: int, approach: float) -> None:
    """Cells that lost their pressure and do not penetrate are not free any more.

    approach: [m].
    """
    surface = workspace.cells.surface
    residual, direction = workspace.cells.residual, workspace.cells.direction
    for m in range(left):
        k = workspace.cells.left[m]
        if not surface[k] < approach:
            residual[k] = 0.0
            direction[k] = 0.0


@borrowing_kernel
def join(workspace: SolverWorkspace, contact: int, approach: float) -> int:
    """Append the cells that penetrate without pressure to the list; returns its length.

    approach: [m].
    """
    surface, pressure, residual = workspace.surface, workspace.pressure, workspace.residual
    free, before = workspace.cells.free, workspace.residual_before
    rows, cols = surface.shape
    count = contact
    for i in range(rows):
        found = 0
        for j in range(cols):
            found += 1 if surface[i, j] < approach and pressure[i, j] == 0.0 else 0
        # Few rows have a cell that joins
        if found == 0:
            continue
        for j in range(cols):
            if surface[i, j] < approach and pressure[i, j] == 0.0:
                free[count] = i * cols + j
                before[count] = residual[i, j]
                residual[i, j] = surface[i, j] - approach
                count += 1
    return count


@kernel
def search(
    half_space: HalfSpace, workspace: SolverWorkspace, count: int, slope_before: float, holds_load: bool
) -> tuple[float, float]:
    """New search direction from the preconditioned clearance z; returns `sum z r`, for the next
    call, and `sum t r`.

    `slope_before` is that of the direction before, 0 to start again. Polak-Ribiere: `beta = sum z
    (r - r_before) / slope_before`, at least 0. A direction that does not descend is replaced by -z.
    Slopes: [Pa m].
    """
    precondition(half_space.preconditioner, workspace.buffers, workspace.residual, workspace.filtered)
    residual, filtered = workspace.cells.residual, workspace.cells.filtered
    free, before = workspace.cells.free, workspace.residual_before
    slope, change, total = 0.0, 0.0, 0.0
    for m in range(count):
        k = free[m]
        slope += filtered[k] * residual[k]
        change += filtered[k] * (residual[k] - before[m])
        total += filtered[k]
    # A prescribed load: directions keep the sum of the pressures
    mean = total / max(float(count), 1.0) if holds_load else 0.0
    momentum = max(change / slope_before, 0.0) if slope_before > 0.0 else 0.0
    descent = advance_direction(workspace, count, momentum, mean, holds_load)
    # Restart along the preconditioned clearance
    if descent >= 0.0:
        descent = advance_direction(workspace, count, 0.0, mean, holds_load)
    return slope, descent


@borrowing_kernel
def advance_direction(workspace: SolverWorkspace, count: int, momentum: float, mean: float, holds_load: bool) -> float:
    """`t = -(z - mean) + momentum t` on the free cells; returns `sum t r`.

    If the load is held the mean of t is removed as well: cells that left the free set had taken a
    part of it.
    momentum: [1]; mean: [Pa]; the result: [Pa m].
    """
    residual, filtered = workspace.cells.residual, workspace.cells.filtered
    direction, free = workspace.cells.direction, workspace.cells.free
    total, descent, clearance = 0.0, 0.0, 0.0
    for m in range(count):
        k = free[m]
        value = mean - filtered[k] + momentum * direction[k]
        direction[k] = value
        total += value
        descent += value * residual[k]
        clearance += residual[k]
    if not holds_load:
        return descent
    # Mean of the direction off, so that the load stays
    surplus = total / max(float(count), 1.0)
    for m in range(count):
        direction[free[m]] -= surplus
    return descent - surplus * clearance


@kernel
def step(half_space: HalfSpace, workspace: SolverWorkspace, count: int, descent: float) -> float:
    """Length of the step to the minimum along the direction, the surface moved by it; 0 if no step
    is possible.

    descent: [Pa m]; the result: [1].
    """
    direction, response = workspace.cells.direction, workspace.cells.response
    convolve(half_space, workspace.buffers, workspace.direction, workspace.response)
    free = workspace.cells.free
    curvature = 0.0
    for m in range(count):
        curvature += direction[free[m]] * response[free[m]]
    if not (curvature > 0.0 and descent < 0.0):
        return 0.0
    return -descent / curvature


@borrowing_kernel
def part(workspace: SolverWorkspace, count: int, length: float) -> tuple[int, int]:
    """Move the pressure by `length` [1] along the direction and clip it at zero; splits the list of
    free cells.

    Returns the numbers of cells in contact and of cells that left; the clipped pressures [Pa] of
    the latter are stored.
    """
    pressure, direction = workspace.cells.pressure, workspace.cells.direction
    free, leaving, clipped = workspace.cells.free, workspace.cells.left, workspace.clipped
    contact, left = 0, 0
    for m in range(count):
        k = free[m]
        p = pressure[k] + length * direction[k]
        # Cells in contact stay at the head of the list
        if p > 0.0:
            pressure[k] = p
            free[contact] = k
            contact += 1
        else:
            pressure[k] = 0.0
            leaving[left] = k
            clipped[left] = -p
            left += 1
    return contact, left


@borrowing_kernel
def move_surface(half_space: HalfSpace, workspace: SolverWorkspace, length: float, left: int) -> None:
    """Add the displacement of a step and of the pressure that clipping added, cell by cell.

    length: [1] of the response [m].
    """
    surface, response, mirrored = workspace.surface, workspace.response, half_space.mirrored
    rows, cols = surface.shape
    for i in range(rows):
        for j in range(cols):
            surface[i, j] += length * response[i, j]
    for m in range(left):
        row, col = divmod(workspace.cells.left[m], cols)
        value = workspace.clipped[m]
        for i in range(rows):
            table = mirrored[abs(i - row), cols - 1 - col :]
            for j in range(cols):
                surface[i, j] += value * table[j]


@borrowing_kernel
def hold_load(workspace: SolverWorkspace, contact: int, total: float) -> float:
    """Scale the pressures so that they add up to `total` again; returns the factor, 1 where nothing
    is in contact.

    total: [Pa], the sum over the cells.
    """
    pressure, free = workspace.cells.pressure, workspace.cells.free
    present = 0.0
    for m in range(contact):
        present += pressure[free[m]]
    if present <= 0.0:
        return 1.0
    factor = total / present
    for m in range(contact):
        pressure[free[m]] *= factor
    return factor


@borrowing_kernel
def rescale(workspace: SolverWorkspace, factor: float) -> None:
    """Scale the displacement by what the pressures were scaled by.

    factor: [1]; the surface: [rows, cols] [m].
    """
    surface, height = workspace.surface, workspace.height
    rows, cols = surface.shape
    for i in range(rows):
        for j in range(cols):
            surface[i, j] = height[i, j] + factor * (surface[i, j] - height[i, j])
