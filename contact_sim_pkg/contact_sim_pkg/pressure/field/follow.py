"""Corrections of a predicted pressure field, one convolution each, each certified by it.

The prediction comes with its displacement (`pressure/field/prediction.py`), so the clearance c is
known before the first convolution. A correction is a step along the preconditioned clearance z = M
c of the free cells, made conjugate to the step before, s, by the response K s that is known from
it:

    d = -(z - mean z) + b s,    b = max(0, sum z K s / sum s K s),    p_new = max(0, p + a d),
    scaled to the load.

Conjugate gradients would take one convolution for the length a and another to certify. Here a is
taken from experience, one length for each correction by its number, and u = K p_new is evaluated
afresh: that certifies the field and gives K s, clipping and all. Where more is needed the step is
rescaled afterwards, with the factor `g = -sum c s / sum s K s`, before the next search direction;
g^(1/4) enters the experience.

Where a belt yields in series with the half-space its lines are taken off z and off what clipping
adds (`pressure/field/belt.py`). A correction then leaves a third of the error on most roads, and no
step is rescaled.

After a correction larger than one before, steps are not conjugate any more: the next takes nothing
from it.

It ends when the residual is at most the tolerance, the last correction changed the field by at most
`CHANGE` times the tolerance in L2, and no cell stands out: what its clearance alone calls for, over
its own influence, is at most `LARGEST_OF_CELL` times the tolerance. The change is the better measure
of the error: the error was 0.4 to 0.9 of it where it was measured (tire on rough roads), while the
residual weighs a clearance by its depth and hardly sees the short waves of the pressure. A single
cell that lets go over several corrections changes by a part of its error each time: there the change
is no measure, the clearance is (0.9 to 1.1 of the largest errors of `tire_texture`).

Source: Tire/Road Contact eqs 1 to 4; Polonsky and Keer, Wear 231 (1999) 206.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.jit import borrowing_kernel, kernel
from contact_sim_pkg.pressure.field.belt import factor_belt, keep_lines, relieve, weigh_scatter
from contact_sim_pkg.pressure.field.halfspace import HalfSpace, convolve, precondition
from contact_sim_pkg.pressure.field.iteration import SolverWorkspace, evaluate, hold_load
from contact_sim_pkg.pressure.field.solver import FieldRequest

__all__ = ["FIRST_LENGTH", "MOST_CORRECTIONS", "correct"]

CHANGE = 6.0
"""Largest last change of the field, over the tolerance."""

LARGEST_OF_CELL = 40.0
"""Largest error of one cell by its clearance, over the largest pressure and the tolerance."""

MOST_CORRECTIONS = 14
"""After so many the prediction was of no use, or the tolerance needs lengths without guessing.
"""

FIRST_LENGTH = 0.4
"""Length of a correction before there is experience."""

LENGTHS = (0.1, 1.5)
"""Shortest and longest correction."""

FACTORS = (0.3, 3.0)
"""Least and largest factor that rescales a step."""

Values = NDArray[numpy.float64]


class Corrected(NamedTuple):
    """Result of the corrections."""

    certified: bool  # otherwise the rest means nothing
    corrections: int
    approach: float  # [m]
    residual: float  # [1]


class Correction(NamedTuple):
    """What the last correction did."""

    factor: float  # [1] by which it should have been longer
    size: float  # [1] L2 norm over that of the field


@kernel
def correct(
    half_space: HalfSpace,
    workspace: SolverWorkspace,
    approach: float,
    total: float,
    request: FieldRequest,
    least_corrections: int,
    is_exact: bool,
    lengths: Values,
) -> Corrected:
    """Correct the prediction in `pressure` and `surface` until it is certified.

    approach: [m], taken where `total` is negative; total: [Pa] as in
    `pressure/field/solver.py:iterate`; request: its tolerance, and the most corrections; lengths:
    [corrections] [1], learned, changed in place; is_exact: whether the surface is that of the pressure,
    so that its change is the response to the first step.
    """
    holds_load = total >= 0.0
    belted = len(half_space.belt) > 0
    contact, pulling = list_cells(workspace)
    press_belt(half_space, workspace)
    none = min(contact, 0)  # left; of a literal 0 another version would be compiled
    state = evaluate(workspace, contact, none, approach, holds_load)
    smallest, stalled = numpy.inf, False
    for correction in range(min(request.max_iterations, MOST_CORRECTIONS)):
        if contact == 0 or not abs(state.approach) < numpy.inf:
            break
        # A step of the learned length, scaled to the load.
        response_known = correction > (0 if is_exact else 1) and not stalled
        search_direction(half_space, workspace, state.free, holds_load, response_known)
        contact, left = move(workspace, state.free, pulling, lengths[correction])
        keep_lines(half_space.belt, workspace.pressure, workspace.clipped, workspace.cells.left, left, workspace.belt)
        factor = hold_load(workspace, contact, total) if holds_load else 1.0
        if contact == 0 or not 0.0 < factor < numpy.inf:
            break
        # Its field, certified by the convolution.
        apply_operator(half_space, workspace)
        change = accept_step(workspace, contact, left, state.approach)
        state = evaluate(workspace, contact, left, approach, holds_load)
        stalled = change.size > smallest
        smallest = min(smallest, change.size)
        # Length learned for next time.
        longer = lengths[correction] * math.sqrt(math.sqrt(change.factor))
        lengths[correction] = min(max(longer, LENGTHS[0]), LENGTHS[1])
        enough = correction + 1 >= least_corrections and change.size <= CHANGE * request.tolerance
        if enough and state.residual <= request.tolerance and no_cell_stands_out(
            half_space, workspace, contact, state.free, LARGEST_OF_CELL * request.tolerance
        ):  # fmt: skip
            return Corrected(True, correction + 1, state.approach, state.residual)
        # Not enough: another, without a belt after the step with its best length.
        pulling = none
        if not belted:
            contact, pulling = rescale_step(workspace, contact, state.free, left, change.factor)
            state = evaluate(workspace, contact, none, approach, holds_load)
    return Corrected(False, 0, approach, numpy.inf)


@borrowing_kernel
def list_cells(workspace: SolverWorkspace) -> tuple[int, int]:
    """List the cells that press as free and those that pull as left; returns how many of each.

    Fields: [rows, cols]; lists: row-major indices, [cells].
    """
    pressure, residual, direction = workspace.pressure, workspace.residual, workspace.direction
    free, left = workspace.cells.free, workspace.cells.left
    rows, cols = pressure.shape
    contact, pulling = 0, 0
    for i in range(rows):
        for j in range(cols):
            # Zero outside the lists, which the transforms rely on
            residual[i, j] = 0.0
            direction[i, j] = 0.0
            if pressure[i, j] > 0.0:
                free[contact] = i * cols + j
                contact += 1
            elif pressure[i, j] < 0.0:
                left[pulling] = i * cols + j
                pulling += 1
    return contact, pulling


@kernel
def press_belt(half_space: HalfSpace, workspace: SolverWorkspace) -> None:
    """What the belt needs for the cells that press; nothing without one."""
    if len(half_space.belt) > 0:
        pressure, clearance = workspace.pressure, workspace.residual
        rows, cols = pressure.shape
        for i in range(rows):
            for j in range(cols):
                clearance[i, j] = 1.0 if pressure[i, j] > 0.0 else 0.0
        precondition(half_space.without_belt, workspace.buffers, clearance, workspace.filtered)
        factor_belt(half_space.belt, half_space.strip, pressure, workspace.belt)
        weigh_scatter(half_space.strip, pressure, workspace.filtered, workspace.belt)


@kernel
def search_direction(
    half_space: HalfSpace, workspace: SolverWorkspace, count: int, holds_load: bool, response_known: bool
) -> None:
    """New direction on the free cells; `direction` holds the step before, `response` what it
    displaced.

    Direction and preconditioned clearance: [Pa], response: [m].
    """
    precondition(half_space.without_belt, workspace.buffers, workspace.residual, workspace.filtered)
    relieve(half_space.belt, workspace.residual, workspace.filtered, workspace.belt)
    filtered, residual = workspace.cells.filtered, workspace.cells.residual
    direction, response = workspace.cells.direction, workspace.cells.response
    free = workspace.cells.free
    # Mean of z, and its product with the response to the step before.
    total, across, along = 0.0, 0.0, 0.0
    for m in range(count):
        k = free[m]
        total += filtered[k]
        if response_known:
            across += filtered[k] * response[k]
            along += direction[k] * response[k]
    mean = total / max(float(count), 1.0) if holds_load else 0.0
    momentum = max(across / along, 0.0) if along > 0.0 else 0.0
    # Direction conjugate to that step.
    surplus, descent = 0.0, 0.0
    for m in range(count):
        k = free[m]
        value = mean - filtered[k] + momentum * direction[k]
        direction[k] = value
        surplus += value
        descent += value * residual[k]
    # Steepest descent where it does not descend; under a load without mean.
    if descent >= 0.0:
        for m in range(count):
            direction[free[m]] = mean - filtered[free[m]]
    elif holds_load:
        surplus /= max(float(count), 1.0)
        for m in range(count):
            direction[free[m]] -= surplus


@borrowing_kernel
def move(workspace: SolverWorkspace, count: int, pulling: int, length: float) -> tuple[int, int]:
    """Step along the direction and clip at zero; `direction` becomes minus the pressure before.

    The first `pulling` cells of `left` pulled: they let go. Returns the numbers of cells in contact
    and of cells that left.
    length: [1] of the direction [Pa].
    """
    pressure, direction = workspace.cells.pressure, workspace.cells.direction
    free, leaving, clipped = workspace.cells.free, workspace.cells.left, workspace.clipped
    # Cells that pulled: without pressure.
    for m in range(pulling):
        k = leaving[m]
        direction[k] = -pressure[k]
        clipped[m] = -pressure[k]
        pressure[k] = 0.0
    # The step, clipped at zero.
    contact, left = 0, pulling
    for m in range(count):
        k = free[m]
        before = pressure[k]
        after = before + length * direction[k]
        direction[k] = -before
        if after > 0.0:
            pressure[k] = after
            free[contact] = k
            contact += 1
        else:
            pressure[k] = 0.0
            leaving[left] = k
            clipped[left] = -after
            left += 1
    return contact, left


@kernel
def apply_operator(half_space: HalfSpace, workspace: SolverWorkspace) -> None:
    """Deformed surface from the pressure alone, and what it moved by in `response`; 0 where it was
    not known before.
    """
    surface, height, response = workspace.surface, workspace.height, workspace.response
    convolve(half_space, workspace.buffers, workspace.pressure, response)
    rows, cols = surface.shape
    for i in range(rows):
        for j in range(cols):
            now = response[i, j] + height[i, j]
            response[i, j] = now - surface[i, j] if surface[i, j] < numpy.inf else 0.0
            surface[i, j] = now


@borrowing_kernel
def accept_step(workspace: SolverWorkspace, contact: int, left: int, approach: float) -> Correction:
    """Complete the step in `direction`, and judge it; `approach` is that before the step.

    approach: [m].
    """
    pressure, direction = workspace.cells.pressure, workspace.cells.direction
    surface, response = workspace.cells.surface, workspace.cells.response
    free, leaving = workspace.cells.free, workspace.cells.left
    work, curvature, size, norm = 0.0, 0.0, 0.0, 0.0
    # Sums over the cells in contact.
    for m in range(contact):
        k = free[m]
        p = pressure[k]
        step = direction[k] + p
        direction[k] = step
        work += (surface[k] - response[k] - approach) * step
        curvature += step * response[k]
        size += step * step
        norm += p * p
    # Sums over the cells that lost their pressure.
    for m in range(left):
        k = leaving[m]
        step = direction[k]
        work += (surface[k] - response[k] - approach) * step
        curvature += step * response[k]
        size += step * step
    # Length with the least energy along the step.
    factor = min(max(-work / curvature, FACTORS[0]), FACTORS[1]) if curvature > 0.0 else 1.0
    return Correction(factor, math.sqrt(size / norm))


@borrowing_kernel
def no_cell_stands_out(
    half_space: HalfSpace, workspace: SolverWorkspace, contact: int, count: int, most: float
) -> bool:
    """Whether no cell errs by more than ``most`` [1] of the largest pressure, as its clearance over its own influence
    says: one that presses by no more than its pressure.
    """
    pressure, residual, free = workspace.cells.pressure, workspace.cells.residual, workspace.cells.free
    peak = 0.0
    for m in range(contact):
        peak = max(peak, pressure[free[m]])
    bound, clearance = most * peak, most * peak * half_space.influence[0, 0]
    beyond = 0
    for m in range(contact):
        k = free[m]
        beyond += 1 if (pressure[k] > bound and residual[k] > clearance) or residual[k] < -clearance else 0
    for m in range(contact, count):
        beyond += 1 if residual[free[m]] < -clearance else 0
    return beyond == 0


@borrowing_kernel
def rescale_step(workspace: SolverWorkspace, contact: int, count: int, left: int, factor: float) -> tuple[int, int]:
    """Make the last step `factor` times as long, surface and all; returns the numbers of cells that
    press and that pull.

    factor: [1].
    """
    surface, response = workspace.surface, workspace.response
    pressure, direction, residual = workspace.cells.pressure, workspace.cells.direction, workspace.cells.residual
    free, leaving = workspace.cells.free, workspace.cells.left
    further = factor - 1.0
    rows, cols = surface.shape
    # Surface of the longer step.
    for i in range(rows):
        for j in range(cols):
            surface[i, j] += further * response[i, j]
    for m in range(left):
        direction[leaving[m]] = 0.0
    for m in range(count):
        residual[free[m]] = 0.0
    # Pressures of the longer step, split by their sign.
    pressing, pulling = 0, 0
    for m in range(contact):
        k = free[m]
        p = pressure[k] + further * direction[k]
        pressure[k] = p
        if p > 0.0:
            free[pressing] = k
            pressing += 1
        elif p < 0.0:
            leaving[pulling] = k
            pulling += 1
    return pressing, pulling
