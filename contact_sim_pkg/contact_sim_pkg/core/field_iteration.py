"""One iteration of the pressure-field solver (`core/field_solver.py`): evaluate, choose a direction, step, correct."""

from __future__ import annotations

from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.core.halfspace import Buffers, Field, HalfSpace, convolve, make_buffers, precondition
from contact_sim_pkg.core.jit import kernel

__all__ = ["SolverWorkspace", "evaluate", "fresh_surface", "make_workspace", "rescale", "search", "step"]

ONE_BY_ONE = 12
"""Clipped cells up to which their influence is summed directly: about the cost of one convolution at 64 x 48."""


class SolverWorkspace(NamedTuple):
    """Buffers of one solve at a time; a second solve in another thread needs its own. All fields are [rows, cols]."""

    buffers: Buffers
    height: Field  # [m] gap above its lowest cell: differences keep their digits whatever the datum is
    surface: Field  # [m] height + displacement
    residual: Field  # [m] clearance on the free cells, else 0
    residual_before: Field  # [m] the same one iteration earlier
    filtered: Field  # [Pa] preconditioned residual
    direction: Field  # [Pa] search direction
    response: Field  # [m] displacement of the search direction
    clipped: Field  # [Pa] pressure that the bound p >= 0 added in the last step
    clipped_cells: NDArray[numpy.int64]  # row-major indices of these cells


class State(NamedTuple):
    """Sums over the field, from one pass."""

    approach: float  # [m]
    residual: float  # [-]


def make_workspace(half_space: HalfSpace) -> SolverWorkspace:
    """Buffers that fit a half-space; solving itself allocates nothing."""
    shape = (half_space.rows, half_space.cols)
    return SolverWorkspace(
        buffers=make_buffers(half_space),
        height=numpy.zeros(shape),
        surface=numpy.zeros(shape),
        residual=numpy.zeros(shape),
        residual_before=numpy.zeros(shape),
        filtered=numpy.zeros(shape),
        direction=numpy.zeros(shape),
        response=numpy.zeros(shape),
        clipped=numpy.zeros(shape),
        clipped_cells=numpy.zeros(half_space.rows * half_space.cols, dtype=numpy.int64),
    )


@kernel
def fresh_surface(half_space: HalfSpace, workspace: SolverWorkspace, pressure: Field) -> None:
    """Deformed surface [m] from the pressure, by a convolution of its own."""
    convolve(half_space, workspace.buffers, pressure, workspace.surface)
    surface = workspace.surface
    rows, cols = pressure.shape
    for i in range(rows):
        for j in range(cols):
            surface[i, j] += workspace.height[i, j]


@kernel
def mean_height(surface: Field, pressure: Field) -> float:
    """Mean of the surface [m] over the cells in contact: the approach of a field whose load is given."""
    rows, cols = pressure.shape
    total, cells = 0.0, 0.0
    for i in range(rows):
        for j in range(cols):
            touching = 1.0 if pressure[i, j] > 0.0 else 0.0
            total += touching * surface[i, j]
            cells += touching
    return total / max(cells, 1.0)


@kernel
def evaluate(workspace: SolverWorkspace, pressure: Field, approach: float, holds_load: bool) -> State:
    """Residual of a field (and its approach, if the load is given); stores the clearance of the free cells."""
    surface, height = workspace.surface, workspace.height
    residual, before = workspace.residual, workspace.residual_before
    rows, cols = pressure.shape
    if holds_load:
        approach = mean_height(surface, pressure)
    complementarity, energy, total, penetration = 0.0, 0.0, 0.0, 0.0
    for i in range(rows):
        for j in range(cols):
            p = pressure[i, j]
            clearance = surface[i, j] - approach
            before[i, j] = residual[i, j]
            residual[i, j] = clearance if p > 0.0 or clearance < 0.0 else 0.0
            complementarity += p * abs(clearance)
            energy += p * (surface[i, j] - height[i, j])
            total += p
            penetration = max(penetration, -clearance if p == 0.0 else 0.0)
    if penetration == 0.0 and complementarity == 0.0:
        return State(approach, 0.0)
    if energy <= 0.0:
        return State(approach, numpy.inf)
    return State(approach, (complementarity + penetration * total) / energy)


@kernel
def search(
    half_space: HalfSpace, workspace: SolverWorkspace, pressure: Field, slope_before: float, holds_load: bool
) -> float:
    """New search direction from the preconditioned clearance z; returns `sum z r`, for the next call.

    `slope_before` is that of the direction before, 0 to start again. Polak-Ribiere: `beta = sum z (r - r_before) /
    slope_before`, at least 0. A direction that does not descend is replaced by -z.
    """
    residual, before, filtered = workspace.residual, workspace.residual_before, workspace.filtered
    precondition(half_space, workspace.buffers, residual, filtered)
    rows, cols = pressure.shape
    slope, change, total, cells = 0.0, 0.0, 0.0, 0.0
    for i in range(rows):
        for j in range(cols):
            free = 1.0 if pressure[i, j] > 0.0 or residual[i, j] != 0.0 else 0.0
            value = free * filtered[i, j]
            filtered[i, j] = value
            slope += value * residual[i, j]
            change += value * (residual[i, j] - before[i, j])
            total += value
            cells += free
    mean = total / max(cells, 1.0) if holds_load else 0.0
    momentum = max(change / slope_before, 0.0) if slope_before > 0.0 else 0.0
    if advance_direction(workspace, pressure, momentum, mean, cells, holds_load) >= 0.0:
        advance_direction(workspace, pressure, 0.0, mean, cells, holds_load)
    return slope


@kernel
def advance_direction(
    workspace: SolverWorkspace,
    pressure: Field,
    momentum: float,
    mean: float,
    cells: float,
    holds_load: bool,
) -> float:
    """`t = -(z - mean) + momentum t` on the free cells, 0 elsewhere; returns `sum t r`.

    If the load is held the mean of t is removed as well: cells that left the free set had taken a part of it.
    """
    residual, filtered, direction = workspace.residual, workspace.filtered, workspace.direction
    rows, cols = pressure.shape
    total, descent, clearance = 0.0, 0.0, 0.0
    for i in range(rows):
        for j in range(cols):
            free = 1.0 if pressure[i, j] > 0.0 or residual[i, j] != 0.0 else 0.0
            kept = momentum * direction[i, j] if momentum > 0.0 else 0.0
            value = free * (mean - filtered[i, j] + kept)
            direction[i, j] = value
            total += value
            descent += value * residual[i, j]
            clearance += residual[i, j]
    if not holds_load:
        return descent
    surplus = total / max(cells, 1.0)
    for i in range(rows):
        for j in range(cols):
            free = 1.0 if pressure[i, j] > 0.0 or residual[i, j] != 0.0 else 0.0
            direction[i, j] -= free * surplus
    return descent - surplus * clearance


@kernel
def step(half_space: HalfSpace, workspace: SolverWorkspace, pressure: Field) -> bool:
    """Move to the minimum along the direction, clip p at zero, update the surface; False if no step is possible."""
    direction, response, surface = workspace.direction, workspace.response, workspace.surface
    residual, clipped = workspace.residual, workspace.clipped
    convolve(half_space, workspace.buffers, direction, response)
    rows, cols = pressure.shape
    descent, curvature = 0.0, 0.0
    for i in range(rows):
        for j in range(cols):
            descent += direction[i, j] * residual[i, j]
            curvature += direction[i, j] * response[i, j]
    if not (curvature > 0.0 and descent < 0.0):
        return False
    length, count = -descent / curvature, 0
    for i in range(rows):
        for j in range(cols):
            p = pressure[i, j] + length * direction[i, j]
            surface[i, j] += length * response[i, j]
            clipped[i, j] = 0.0
            if p < 0.0:
                clipped[i, j] = -p
                workspace.clipped_cells[count] = i * cols + j
                count += 1
                p = 0.0
            pressure[i, j] = p
    correct_for_clipping(half_space, workspace, count)
    return True


@kernel
def correct_for_clipping(half_space: HalfSpace, workspace: SolverWorkspace, count: int) -> None:
    """Add the displacement of the pressure that clipping added."""
    surface, clipped, influence = workspace.surface, workspace.clipped, half_space.influence
    rows, cols = surface.shape
    if count > ONE_BY_ONE:
        convolve(half_space, workspace.buffers, clipped, workspace.response)
        for i in range(rows):
            for j in range(cols):
                surface[i, j] += workspace.response[i, j]
        return
    for k in range(count):
        row, col = divmod(workspace.clipped_cells[k], cols)
        value = clipped[row, col]
        for i in range(rows):
            table = influence[abs(i - row)]
            for j in range(col):
                surface[i, j] += value * table[col - j]
            for j in range(col, cols):
                surface[i, j] += value * table[j - col]


@kernel
def rescale(workspace: SolverWorkspace, pressure: Field, total: float) -> None:
    """Scale pressure and displacement so that the pressures add up to `total` again."""
    surface, height = workspace.surface, workspace.height
    rows, cols = pressure.shape
    present = 0.0
    for i in range(rows):
        for j in range(cols):
            present += pressure[i, j]
    if present <= 0.0:
        return
    factor = total / present
    for i in range(rows):
        for j in range(cols):
            pressure[i, j] *= factor
            surface[i, j] = height[i, j] + factor * (surface[i, j] - height[i, j])
