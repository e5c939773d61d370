"""Brush friction of a rolling tire: elastic bristles that stick to the road or slide, one a cell of
the pressure field.

Contact frame: x forward, y left, z up, origin in the road below the wheel centre, which travels
with v along x. The belt runs backwards with (1 + kappa) v through the contact, the road with v, and
sideways with -v tan(alpha) (ISO 8855):

* `kappa = (omega R_e - v)/v`: driving positive, -1 is a locked wheel;
* `alpha` is the angle from the wheel's x axis to its velocity, positive to the left: the wheel
  drifts to the left, the road drags the tread to the right, F_y is negative, and M_z is positive,
  turning the wheel into its velocity.

A bristle stands in the belt, its tip on the road. While it sticks, its deflection u grows by the
way of the road relative to the belt, `(kappa, -tan alpha) v dt`; the shear on the tire is `tau_i =
k_i u_i`. It sticks up to `mu_s p`. Then the tip slides along tau with `|tau| = mu p`, until a
trial stress falls below that; mu falls with the slip speed v, `mu(v) = mu_k + (mu_s - mu_k)
exp(-v/v_s)` (Polach). Bristles enter the contact, and leave it, unstrained.

Normal and shear problem are not coupled: for a rigid road and an incompressible tread (nu = 1/2)
Cerruti's normal displacement, with its factor 1 - 2 nu, is zero. The bristles do not influence each
other (Kalker's simplified theory).

Bristles are carried in whole cells of the belt, and the part of a cell that is left is kept as
`phase`: nothing is smeared. A step of many cells is advanced cell by cell; the pressure goes
linearly in time from the field before to the present one, *in the contact frame*, where it stands
still on a smooth road. So the result for a constant pressure does not depend on the step. A cell is
in contact up to its borders; there the bristles begin to grow.

Source: Pacejka, Tire and Vehicle Dynamics, ch. 3; Kalker, A fast algorithm for the simplified
theory of rolling contact (FASTSIM), Vehicle System Dynamics 11 (1982); Polach, Creep forces in
simulations of traction vehicles running on adhesion limit, Wear 258 (2005).
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import entry, kernel
from contact_sim_pkg.rigs.vehicle.tire.brush.lattice import blend, copy_field, loaded_window, place_on
from contact_sim_pkg.rigs.vehicle.tire.brush.steps import (
    PAD,
    Bristles,
    Field,
    LoadedWindow,
    Slide,
    advance_bristles,
    next_segment,
)
from contact_sim_pkg.rigs.vehicle.tire.parameters import Brush

__all__ = [
    "BrushResult",
    "BrushState",
    "PatchGrid",
    "RollingStep",
    "advance_brush",
    "brush_state_on",
    "make_brush_state",
    "rolling_step",
]

LEAST_WAY = 1e-12
"""Shorter ways of the belt [cells] in one step count as none: a locked wheel."""


LEAST_SQUARE = 1e-200
"""[m^2] of a slip that has a direction."""

APART, STICKS, SLIPS = 0, 1, 2
"""What the bristle of a cell does: it carries no pressure, its tip holds to the road, or slides
over it.
"""


class BrushState(NamedTuple):
    """State of the bristles of one contact; written by `advance_brush`."""

    bristles: Bristles
    before: Field  # [Pa] pressure of the last field, [PAD + rows + PAD, cols]
    # [3] phase of the belt's lattice [cells], origin_x of the last field [m], 1 once there was a
    # field
    place: Vector


class PatchGrid(NamedTuple):
    """Where a pressure field lies in the contact frame: centre of cell (0, 0), and the cells
    [m].
    """

    origin_x: float
    origin_y: float
    cell_x: float
    cell_y: float


class RollingStep(NamedTuple):
    """Ways during one step [m]; see `rolling_step`."""

    travel: float  # of the wheel centre, forward: v dt
    belt: float  # of the belt, backward: omega R_e dt
    drift: float  # of the belt over the road, to the left: v tan(alpha) dt
    duration: float = 0.0  # [s]; 0: too short for any friction but the kinetic one
    turn: float = 0.0  # [rad] yaw of the belt, to the left
    bend: float = 0.0  # [1/m] curvature of the belt in the plane of the road: it lies on y = -bend x^2 / 2
    extension: float = 0.0  # [1/m] strain of the belt along, ahead of the wheel: at x it is longer by -extension x


class BrushResult(NamedTuple):
    """Force and moment on the tire, about the origin of the contact frame, and what the step
    cost.
    """

    force_x: float  # [N] sum of tau_x A
    force_y: float  # [N] sum of tau_y A
    moment_z: float  # [N m] sum of (x tau_y - y tau_x) A
    sliding_share: float  # sliding cells among those in contact, 0 without contact
    dissipated: float  # [J] work of friction during the step, tau times sliding way; >= 0
    # [J] elastic energy of the bristles that left the contact during the step, lost as well; >= 0
    released: float


def make_brush_state(rows: int, cols: int) -> BrushState:
    """Unstrained bristles for pressure fields of [rows, cols] cells.

    Raises `ValueError` for an empty grid.
    """
    if rows < 1 or cols < 1:
        raise ValueError(f"brush: grid of {rows} x {cols} cells, it must have at least one row and one column")
    shape = (rows + 2 * PAD, cols)
    bristles = Bristles(
        numpy.zeros(shape), numpy.zeros(shape), numpy.zeros(shape, dtype=numpy.uint8), numpy.zeros(shape)
    )
    return BrushState(bristles, numpy.zeros(shape), numpy.zeros(3))


def brush_state_on(state: BrushState, rows: int, cols: int, cell_x: float) -> BrushState:
    """The same bristles for fields of another size with the same cells and middle column; what does
    not fit is dropped.

    Row 0 of the next field may lie anywhere: `advance_brush` finds it by its `origin_x`. Errors as
    in `make_brush_state`.
    cell_x: [m].
    """
    moved = make_brush_state(rows, cols)
    old_rows, old_cols = state.before.shape[0] - 2 * PAD, state.before.shape[1]
    if (cols - old_cols) % 2:
        raise ValueError(f"brush: from {old_cols} to {cols} columns, the two must differ by an even number")
    more_rows, more_cols = (rows - old_rows) // 2, (cols - old_cols) // 2
    # Copy the common middle of both grids; their middle columns are the same.
    for source, target in zip(_arrays_of(state), _arrays_of(moved), strict=True):
        row, col = max(0, -more_rows) + PAD, max(0, -more_cols)
        part = source[row : row + min(rows, old_rows), col : col + min(cols, old_cols)]
        row, col = max(0, more_rows) + PAD, max(0, more_cols)
        target[row : row + part.shape[0], col : col + part.shape[1]] = part
    moved.place[:] = state.place
    moved.place[1] -= more_rows * cell_x
    return moved


def _arrays_of(state: BrushState) -> tuple[NDArray[Any], ...]:
    bristles = state.bristles
    return bristles.deflection_x, bristles.deflection_y, bristles.sliding, state.before


def rolling_step(travel: float, slip: float, slip_angle: float, duration: float = 0.0) -> RollingStep:
    """Ways for a `travel` v dt [m] at the longitudinal slip kappa [1] and the slip angle alpha
    [rad], over a `duration` dt [s].

    Raises `ValueError` where a number is not finite or the slip angle is not within +-pi/2. A wheel
    that spins at standstill has no slip: give its ways to `RollingStep`.
    """
    for name, value in (("travel", travel), ("slip", slip), ("slip angle", slip_angle)):
        if not math.isfinite(value):
            raise ValueError(f"brush: {name} is {value}, it must be a finite number")
    if not abs(slip_angle) < 0.5 * math.pi:
        raise ValueError(f"brush: slip angle is {slip_angle} rad, it must lie between -pi/2 and pi/2")
    return RollingStep(
        float(travel), float((1.0 + slip) * travel), float(travel * math.tan(slip_angle)), float(duration)
    )


@entry
def advance_brush(
    brush: Brush, state: BrushState, grid: PatchGrid, pressure: Field, step: RollingStep,
    shear_x: NDArray[numpy.float64], shear_y: NDArray[numpy.float64], mode: NDArray[numpy.uint8],
) -> BrushResult:  # fmt: skip
    """Carry the bristles through one step that ends with the field `pressure` [Pa] >= 0, float64
    [rows, cols].

    grid: where that field lies; cells must be those of the state's fields before. The first field
    of a state counts as having stood since before the step. Written, on the cells of `pressure`:
    shear_x, shear_y, the stress on the tire [Pa], and mode: APART, STICKS or SLIPS. Raises
    `ValueError` where a field is not on the cells of the state. Ways that are not finite give
    forces that are not. Cost: about one visit of each loaded cell for each cell of belt travel.
    """
    rows, cols = state.before.shape[0] - 2 * PAD, state.before.shape[1]
    for field_rows, field_cols in (pressure.shape, shear_x.shape, shear_y.shape, mode.shape):
        if field_rows != rows or field_cols != cols:
            raise ValueError("brush: a field is not on the cells of the bristles; move them with brush_state_on")
    for i in range(rows):
        for j in range(cols):
            shear_x[i, j], shear_y[i, j], mode[i, j] = 0.0, 0.0, APART
    phase, window = move_onto(state, grid, pressure)
    sliding = sliding_brush(brush, step)
    phase, dissipated, released = advance_step(sliding, state, grid, pressure, window, phase, step, 0.0, 1.0)
    settle_on(state, grid, pressure, phase)
    force_x, force_y, moment_z, _moment_x, share = write_shear(
        sliding, state.bristles, grid, window, phase, shear_x=shear_x, shear_y=shear_y, mode=mode
    )
    area = grid.cell_x * grid.cell_y
    return BrushResult(force_x, force_y, moment_z, share, dissipated * area, released * area)


@kernel
def move_onto(state: BrushState, grid: PatchGrid, pressure: Field) -> tuple[float, LoadedWindow]:
    """Shift the bristles onto the lattice of a field `pressure` [Pa]; returns the phase of the belt
    on it and the window of what is loaded.
    """
    first_field = state.place[2] == 0.0
    origin_before = grid.origin_x if first_field else state.place[1]
    phase = place_on(state.bristles, state.before, state.place[0], (grid.origin_x - origin_before) / grid.cell_x)
    if first_field:
        copy_field(pressure, state.before)
    return phase, loaded_window(state.before, pressure)


@kernel
def settle_on(state: BrushState, grid: PatchGrid, pressure: Field, phase: float) -> None:
    """Store what the next step starts from: the field `pressure` [Pa], and the phase of the belt."""
    copy_field(pressure, state.before)
    state.place[0], state.place[1], state.place[2] = phase, grid.origin_x, 1.0


@kernel
def sliding_brush(brush: Brush, step: RollingStep) -> Brush:
    """The brush with the sliding coefficient of the slip speed of `step` as its kinetic one, and both as
    the load leaves them in the direction of the slip.
    """
    kinetic = brush.coefficient_kinetic
    if brush.speed > 0.0 and step.duration > 0.0:
        slip_speed = math.sqrt((step.belt - step.travel) ** 2 + step.drift**2) / step.duration
        kinetic += (brush.coefficient_static - kinetic) * math.exp(-slip_speed / brush.speed)
    static = brush.coefficient_static
    if brush.along != 1.0 or brush.across != 1.0:
        along, across = (step.belt - step.travel) ** 2, step.drift**2
        factor = brush.along + (brush.across - brush.along) * across / max(along + across, LEAST_SQUARE)
        static, kinetic = factor * static, factor * kinetic
    return Brush(brush.stiffness_x, brush.stiffness_y, static, kinetic, brush.speed, brush.along, brush.across)


@kernel
def advance_step(
    brush: Brush, state: BrushState, grid: PatchGrid, pressure: Field, window: LoadedWindow, phase: float,
    step: RollingStep, start: float, end: float,
) -> tuple[float, float, float]:  # fmt: skip
    """Advance over a step, segment by segment, while the pressure goes from the part `start` to the
    part `end` [1] of the way to the field `pressure` [Pa].

    Returns the new phase, work of friction and released energy [J/m^2].
    """
    # Belt travel in cells; a standing belt slides over one segment without length.
    cells = abs(step.belt) / grid.cell_x
    if not LEAST_WAY <= cells < math.inf:
        cells = 0.0
    over = cells if cells > 0.0 else 1.0
    turn = step.turn / over  # of the belt for each cell of way: its points move by -turn y, turn x
    # A point of a bent belt that rolls on by a cell moves sideways by bend x cell, of a strained one back by less
    rolled = math.copysign(grid.cell_x, step.belt) if cells > 0.0 else 0.0
    aside, shorter = turn + step.bend * rolled, step.extension * rolled
    along, backward = (step.belt - step.travel) / over + turn * grid.origin_y, step.belt < 0.0
    remaining = cells
    dissipated, released = 0.0, 0.0
    while True:
        # The pressure changes linearly over the step, the slide is that of the middle of each segment.
        segment = next_segment(phase, remaining, backward)
        remaining -= segment.length
        middle = PAD + 0.5 * (segment.start + segment.end)
        x = grid.origin_x - middle * grid.cell_x  # of the label 0
        slide = Slide(
            along - shorter * x,
            -step.drift / over - aside * x,
            turn * grid.cell_y,
            -aside * grid.cell_x,
            -shorter * grid.cell_x,
        )
        blend(state.before, pressure, end - (end - start) * remaining / over, window, state.bristles.pressure)
        work, energy = advance_bristles(brush, state.bristles, window, segment, slide)
        dissipated += work
        released += energy
        phase = segment.end - segment.write
        if remaining <= 0.0:
            return phase, dissipated, released


@kernel
def write_shear(
    brush: Brush, bristles: Bristles, grid: PatchGrid, window: LoadedWindow, phase: float, shear_x: Field,
    shear_y: Field, mode: NDArray[numpy.uint8],
) -> tuple[float, float, float, float, float]:  # fmt: skip
    """Write the shear [Pa] at the centres of the cells, [rows, cols], in the `window` of what is
    loaded.

    Returns its sums along x and y [N], their moment, that of x tau_x [N m] and the share of sliding cells [1]. A
    centre lies between two bristles: deflections are interpolated, a bristle out of contact does
    not count; the nearer one decides whether the cell slides. The limit is that of the cell's own
    pressure.
    """
    # The centre of a cell lies between the bristle near to it and the one beyond.
    near, far = (0, 1) if phase <= 0.5 else (1, 0)
    weight = min(phase, 1.0 - phase)
    pressure, rows = bristles.pressure, shear_x.shape[0]
    sum_x, sum_y, moment, moment_x, loaded, sliding = 0.0, 0.0, 0.0, 0.0, 0, 0
    for m in range(max(window.first, PAD), min(window.last, rows + PAD)):
        i = m - PAD
        x = grid.origin_x + i * grid.cell_x
        beyond = m + far - near
        for j in range(window.left, window.right):
            shear_x[i, j], shear_y[i, j], mode[i, j] = 0.0, 0.0, APART
            if not pressure[m, j] > 0.0:
                continue
            # Shear, and the sums of force and moment.
            counts = weight if window.first - 1 <= beyond < window.last and pressure[beyond, j] > 0.0 else 0.0
            tau_x, tau_y = stress_between(brush, bristles, m + near, m + far, j, counts, pressure[m, j])
            shear_x[i, j], shear_y[i, j] = tau_x, tau_y
            sum_x += tau_x
            sum_y += tau_y
            moment += x * tau_y - (grid.origin_y + j * grid.cell_y) * tau_x
            moment_x += x * tau_x
            loaded += 1
            # The nearer bristle decides between stick and slip.
            slips = bristles.sliding[m + near, j] != 0
            mode[i, j] = SLIPS if slips else STICKS
            sliding += 1 if slips else 0
    area = grid.cell_x * grid.cell_y
    return sum_x * area, sum_y * area, moment * area, moment_x * area, sliding / max(loaded, 1)


@kernel
def stress_between(
    brush: Brush, bristles: Bristles, near: int, far: int, j: int, weight: float, pressure: float
) -> tuple[float, float]:
    """Stress [Pa] between two bristles, the far one with `weight`: `mu p` where the near one
    slides, else up to `mu_s p`.
    """
    x = bristles.deflection_x[near, j] + weight * (bristles.deflection_x[far, j] - bristles.deflection_x[near, j])
    y = bristles.deflection_y[near, j] + weight * (bristles.deflection_y[far, j] - bristles.deflection_y[near, j])
    tau_x, tau_y = brush.stiffness_x * x, brush.stiffness_y * y
    stress = math.sqrt(tau_x * tau_x + tau_y * tau_y)
    if stress <= 0.0:
        return 0.0, 0.0
    slides = bristles.sliding[near, j]
    limit = (brush.coefficient_kinetic if slides else brush.coefficient_static) * pressure
    if not slides and stress <= limit:
        return tau_x, tau_y
    factor = limit / stress
    return tau_x * factor, tau_y * factor
