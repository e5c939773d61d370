"""The pressure field of a one-sided contact on a half-space, for a given approach or a given load.

With p the pressure, u = K p the displacement (`core/halfspace.py`), g0 the gap of the undeformed surfaces and d the
approach, the clearance `c = u + g0 - d` satisfies in each cell `p >= 0, c >= 0, p c = 0`.

Method: preconditioned conjugate gradients (Polak-Ribiere, beta >= 0) on the free cells {p > 0} and {p = 0, c < 0}: a
penetrating cell joins the search direction without a restart. The displacement of the direction updates the clearance,
so an ordinary iteration takes one convolution. Where the step would pull, p is set to zero and the clearance is
corrected: cell by cell from the influence table when few are concerned, by one more convolution when many are. A given
load is held by removing the mean of the direction and rescaling; the approach is then the mean of u + g0 in contact.
Conjugate gradients with active set: Polonsky and Keer (1999), Wear 231, 206. Preconditioner: |q|, the symbol of K^-1.

The residual that is returned is computed from the returned pressure by a convolution of its own:

    residual = (sum p |c| + max(0, -c over p = 0) sum p) / sum p u

a number without unit, 0 for the exact field. `sum p u > 0` is twice the elastic energy, so nothing is divided by the
roughness or the size of the grid, and a flat surface is no special case.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.core.halfspace import HalfSpace, Workspace, convolve, precondition
from contact_sim_pkg.core.jit import entry, kernel

__all__ = [
    "BAD_INPUT",
    "CONVERGED",
    "EDGE",
    "NOT_CONVERGED",
    "NO_CONTACT",
    "SENTENCES",
    "FieldResult",
    "first_bad_cell",
    "refuse_bad_gap",
    "solve_at_approach",
    "solve_at_load",
]

CONVERGED = 0
NO_CONTACT = 1
EDGE = 2
NOT_CONVERGED = 3
BAD_INPUT = 4

SENTENCES = {
    CONVERGED: "the pressure field is certified to the tolerance",
    NO_CONTACT: "the surfaces do not touch: the pressure is zero everywhere",
    EDGE: "the contact reaches the edge of the grid, so load may be missing; enlarge the grid",
    NOT_CONVERGED: "the residual is above the tolerance after the allowed iterations; it is returned with the field",
    BAD_INPUT: "a value of the gap, the start pressure, the approach or the load is not finite, or a pressure or the load is negative",
}
"""What each status means, ready for a message."""

ONE_BY_ONE = 12
"""Clipped cells up to which their influence is summed directly: about the cost of one convolution at 64 x 48."""

PATIENCE = 20
"""Iterations without a lower residual after which the direction starts again from the gradient."""


class FieldResult(NamedTuple):
    status: int  # CONVERGED, NO_CONTACT, EDGE, NOT_CONVERGED or BAD_INPUT
    iterations: int  # conjugate gradient steps
    load: float  # [N] sum of the pressure times the cell area
    approach: float  # [m] rigid approach, against the same datum as the gap
    residual: float  # [-] certified on the returned field, see the module text


class _State(NamedTuple):
    """Sums over the field, from one pass."""

    approach: float
    residual: float


@entry
def solve_at_approach(
    half_space: HalfSpace,
    workspace: Workspace,
    gap: numpy.ndarray,
    approach: float,
    tolerance: float,
    max_iterations: int,
    pressure: numpy.ndarray,
) -> FieldResult:
    """Pressure field at a given approach.

    gap: height of the undeformed gap [m], float64 [rows, cols], any datum; approach: rigid approach [m] against that
    datum; tolerance: on the residual [-]; pressure: float64 [rows, cols] [Pa], in: start (zeros when nothing is known),
    out: the field, exactly zero where there is no contact. Nothing is raised: see `status`; bad input leaves the
    pressure untouched.
    """
    if not (numpy.isfinite(approach) and acceptable(gap, pressure)):
        return FieldResult(BAD_INPUT, 0, 0.0, approach, numpy.inf)
    if gap.min() >= approach:
        pressure[:] = 0.0
        return FieldResult(NO_CONTACT, 0, 0.0, approach, 0.0)
    return iterate(half_space, workspace, gap, approach, -1.0, tolerance, max_iterations, pressure)


@entry
def solve_at_load(
    half_space: HalfSpace,
    workspace: Workspace,
    gap: numpy.ndarray,
    load: float,
    tolerance: float,
    max_iterations: int,
    pressure: numpy.ndarray,
) -> FieldResult:
    """Pressure field that carries a given load [N] >= 0, and its approach; the rest as `solve_at_approach`.

    Zero load gives a zero field and the approach of first touch, the smallest gap.
    """
    if not (numpy.isfinite(load) and load >= 0.0 and acceptable(gap, pressure)):
        return FieldResult(BAD_INPUT, 0, 0.0, numpy.nan, numpy.inf)
    if load == 0.0:
        pressure[:] = 0.0
        return FieldResult(NO_CONTACT, 0, 0.0, gap.min(), 0.0)
    total = load / (half_space.cell_x * half_space.cell_y)
    if pressure.sum() <= 0.0:
        start_from_overlap(half_space, gap, load, pressure)
    pressure *= total / pressure.sum()
    return iterate(half_space, workspace, gap, 0.0, total, tolerance, max_iterations, pressure)


@entry
def first_bad_cell(gap: numpy.ndarray) -> int:
    """Row-major index of the first cell that is not finite, or -1."""
    for cell in range(gap.size):
        if not numpy.isfinite(gap.flat[cell]):
            return cell
    return -1


def refuse_bad_gap(gap: numpy.ndarray, name: str = "gap") -> None:
    """Raise `ValueError` naming the first cell whose height is not finite."""
    cell = first_bad_cell(gap)
    if cell >= 0:
        row, col = divmod(int(cell), gap.shape[1])
        raise ValueError(f"{name}: the height of row {row}, column {col} is {gap[row, col]}, it must be a finite number; fill or mask it")


@kernel
def acceptable(gap: numpy.ndarray, pressure: numpy.ndarray) -> bool:
    """All heights finite, all start pressures finite and not negative."""
    faults = 0
    rows, cols = gap.shape
    for i in range(rows):
        for j in range(cols):
            good = numpy.isfinite(gap[i, j]) and pressure[i, j] >= 0.0 and numpy.isfinite(pressure[i, j])
            faults += 0 if good else 1
    return faults == 0


@kernel
def start_from_overlap(half_space: HalfSpace, gap: numpy.ndarray, load: float, pressure: numpy.ndarray) -> None:
    """A first pressure proportional to the overlap at the approach whose overlap volume V and area A carry the load.

    `P = 0.6 E* V / sqrt(A / pi)`, exact for a sphere (4 sqrt(2) / (3 pi)); found by bisection. Beyond the highest gap
    the whole grid is loaded.
    """
    low, high = gap.min(), gap.max()
    cell = half_space.cell_x * half_space.cell_y
    for _ in range(16):
        middle = 0.5 * (low + high)
        volume, area = 0.0, 0.0
        for height in gap.flat:
            overlap = max(middle - height, 0.0)
            volume += overlap * cell
            area += cell if overlap > 0.0 else 0.0
        if 0.6 * half_space.modulus * volume >= load * numpy.sqrt(area / numpy.pi):
            high = middle
        else:
            low = middle
    pressure[:] = numpy.maximum(high - gap, 0.0)
    if pressure.sum() <= 0.0:
        pressure[:] = 1.0


@kernel
def iterate(
    half_space: HalfSpace,
    workspace: Workspace,
    gap: numpy.ndarray,
    approach: float,
    total: float,
    tolerance: float,
    max_iterations: int,
    pressure: numpy.ndarray,
) -> FieldResult:
    """Conjugate gradients from the given pressure; `total` [Pa] is the sum of p to hold, or -1 for a given approach."""
    holds_load = total > 0.0
    fresh_surface(half_space, workspace, gap, pressure)
    certified, best, stale, slope, iterations = True, numpy.inf, 0, 0.0, 0
    state = evaluate(workspace, gap, pressure, approach, holds_load)
    while True:
        if state.residual <= tolerance and not certified:
            fresh_surface(half_space, workspace, gap, pressure)
            certified = True
            state = evaluate(workspace, gap, pressure, approach, holds_load)
        if state.residual <= tolerance or iterations >= max_iterations:
            break
        stale = 0 if state.residual < best else stale + 1
        best = min(best, state.residual)
        if stale > PATIENCE:
            slope, stale = 0.0, 0
        slope = search(half_space, workspace, pressure, state.approach, slope, holds_load)
        if not step(half_space, workspace, pressure):
            break
        if holds_load:
            rescale(workspace, gap, pressure, total)
        certified = False
        iterations += 1
        state = evaluate(workspace, gap, pressure, approach, holds_load)
    if not certified:
        fresh_surface(half_space, workspace, gap, pressure)
        state = evaluate(workspace, gap, pressure, approach, holds_load)
    load = pressure.sum() * half_space.cell_x * half_space.cell_y
    return FieldResult(verdict(pressure, state.residual, tolerance), iterations, load, state.approach, state.residual)


@kernel
def verdict(pressure: numpy.ndarray, residual: float, tolerance: float) -> int:
    if not residual <= tolerance:
        return NOT_CONVERGED
    if pressure[0].any() or pressure[-1].any() or pressure[:, 0].any() or pressure[:, -1].any():
        return EDGE
    return CONVERGED if pressure.any() else NO_CONTACT


@kernel
def fresh_surface(half_space: HalfSpace, workspace: Workspace, gap: numpy.ndarray, pressure: numpy.ndarray) -> None:
    """Deformed surface `u + g0` [m] from the pressure, by a convolution of its own."""
    convolve(half_space, workspace, pressure, workspace.surface)
    surface = workspace.surface
    surface += gap


@kernel
def evaluate(workspace: Workspace, gap: numpy.ndarray, pressure: numpy.ndarray, approach: float, holds_load: bool) -> _State:
    """Approach (for a given load: mean of u + g0 in contact) and residual; the clearance of free cells is stored."""
    surface, residual, before = workspace.surface, workspace.residual, workspace.residual_before
    rows, cols = pressure.shape
    if holds_load:
        height, cells = 0.0, 0.0
        for i in range(rows):
            for j in range(cols):
                touching = 1.0 if pressure[i, j] > 0.0 else 0.0
                height += touching * surface[i, j]
                cells += touching
        approach = height / max(cells, 1.0)
    complementarity, energy, pressure_sum, penetration = 0.0, 0.0, 0.0, 0.0
    for i in range(rows):
        for j in range(cols):
            p = pressure[i, j]
            clearance = surface[i, j] - approach
            before[i, j] = residual[i, j]
            residual[i, j] = clearance if p > 0.0 or clearance < 0.0 else 0.0
            complementarity += p * abs(clearance)
            energy += p * (surface[i, j] - gap[i, j])
            pressure_sum += p
            penetration = max(penetration, -clearance if p == 0.0 else 0.0)
    if penetration == 0.0 and complementarity == 0.0:
        return _State(approach, 0.0)
    if energy <= 0.0:
        return _State(approach, numpy.inf)
    return _State(approach, (complementarity + penetration * pressure_sum) / energy)


@kernel
def search(
    half_space: HalfSpace, workspace: Workspace, pressure: numpy.ndarray, approach: float, slope_before: float, holds_load: bool
) -> float:
    """New search direction from the preconditioned clearance; returns `sum z r` (0 before the first direction)."""
    residual, before, filtered, direction = workspace.residual, workspace.residual_before, workspace.filtered, workspace.direction
    precondition(half_space, workspace, residual, filtered)
    rows, cols = pressure.shape
    slope, change, mean, free = 0.0, 0.0, 0.0, 0.0
    for i in range(rows):
        for j in range(cols):
            is_free = pressure[i, j] > 0.0 or residual[i, j] != 0.0
            value = filtered[i, j] if is_free else 0.0
            filtered[i, j] = value
            slope += value * residual[i, j]
            change += value * (residual[i, j] - before[i, j])
            mean += value
            free += 1.0 if is_free else 0.0
    mean = mean / max(free, 1.0) if holds_load else 0.0
    momentum = max(change / slope_before, 0.0) if slope_before > 0.0 else 0.0
    descent = advance_direction(workspace, pressure, momentum, mean, holds_load, free)
    if descent >= 0.0:
        descent = advance_direction(workspace, pressure, 0.0, mean, holds_load, free)
    return slope


@kernel
def advance_direction(
    workspace: Workspace, pressure: numpy.ndarray, momentum: float, mean: float, holds_load: bool, free: float
) -> float:
    """`t = -(z - mean) + momentum t` on the free cells, without net load if the load is held; returns `sum t r`."""
    residual, filtered, direction = workspace.residual, workspace.filtered, workspace.direction
    rows, cols = pressure.shape
    net, descent = 0.0, 0.0
    for i in range(rows):
        for j in range(cols):
            is_free = pressure[i, j] > 0.0 or residual[i, j] != 0.0
            value = mean - filtered[i, j] + momentum * direction[i, j] if is_free else 0.0
            direction[i, j] = value
            net += value
            descent += value * residual[i, j]
    if holds_load and net != 0.0:
        net /= max(free, 1.0)
        descent = 0.0
        for i in range(rows):
            for j in range(cols):
                if pressure[i, j] > 0.0 or residual[i, j] != 0.0:
                    direction[i, j] -= net
                    descent += direction[i, j] * residual[i, j]
    return descent


@kernel
def step(half_space: HalfSpace, workspace: Workspace, pressure: numpy.ndarray) -> bool:
    """Move to the minimum along the direction, clip p at zero, update the surface; False if no step is possible."""
    direction, response, surface = workspace.direction, workspace.response, workspace.surface
    residual, clipped = workspace.residual, workspace.clipped
    convolve(half_space, workspace, direction, response)
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
def correct_for_clipping(half_space: HalfSpace, workspace: Workspace, count: int) -> None:
    """Add the displacement of the pressure that clipping added."""
    surface, clipped, influence = workspace.surface, workspace.clipped, half_space.influence
    rows, cols = surface.shape
    if count > ONE_BY_ONE:
        convolve(half_space, workspace, clipped, workspace.response)
        surface += workspace.response
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
def rescale(workspace: Workspace, gap: numpy.ndarray, pressure: numpy.ndarray, total: float) -> None:
    """Scale pressure and displacement so that the pressures add up to `total` again."""
    present = pressure.sum()
    if present <= 0.0:
        return
    factor = total / present
    surface = workspace.surface
    rows, cols = pressure.shape
    for i in range(rows):
        for j in range(cols):
            pressure[i, j] *= factor
            surface[i, j] = gap[i, j] + factor * (surface[i, j] - gap[i, j])
