"""Advance of the bristles of `rigs/vehicle/tire/brush/rolling_brush.py` through the contact: one segment of at
most one cell at a time.

A bristle with the label m stands `phase` cells behind the centre of row m, 0 <= phase <= 1: in the
cell m as long as phase <= 1/2, then in the cell m - 1. Labels shift by whole cells, values are
never mixed, so nothing is smeared on the way.

Source: Pacejka, Tire and Vehicle Dynamics, 3.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.jit import kernel
from contact_sim_pkg.rigs.vehicle.tire.parameters import Brush

__all__ = [
    "PAD",
    "BeltSegment",
    "Bristles",
    "Field",
    "Flags",
    "LoadedWindow",
    "Slide",
    "advance_bristles",
    "next_segment",
    "slide_onto",
    "unit_slide",
]

PAD = 2
"""Rows before the first and after the last that are never loaded: an advance reads and writes
beyond the grid.
"""

ROUNDING = 1e-12
"""A trial stress within this part of the limit is at the limit."""

NEWTON_STEPS = 20
"""Most steps of `unit_slide`; one for equal stiffnesses, 2 to 5 else."""

LAST_EXCESS = 1e-4
"""Relative excess of the stress at which one more Newton step suffices: its error is about the
square of this.
"""

LEAST_LIMIT = 1e-100
"""Limits [Pa] below it are zero: the squares of smaller stresses are not numbers to divide by."""

Field = NDArray[numpy.float64]
Flags = NDArray[numpy.uint8]


class Bristles(NamedTuple):
    """Deflections of the bristles and the pressure on them, [PAD + rows + PAD, cols]."""

    deflection_x: Field  # [m] tip on the road ahead of its root in the belt
    deflection_y: Field  # [m] to the left
    sliding: Flags  # 1 where the tip slides
    pressure: Field  # [Pa] at the end of the present segment


class LoadedWindow(NamedTuple):
    """Labels `first ... last - 1` (counted from the first padding row) and columns `left ... right
    - 1`.
    """

    first: int
    last: int
    left: int
    right: int


class BeltSegment(NamedTuple):
    """A way of the belt within one cell, and what the road slides along it."""

    length: float  # [cells]
    start: float  # phase at its start
    end: float  # phase at its end
    read: int  # a bristle m is found in row m - read
    write: int  # and left in row m - write
    share_here: float  # [cells] the part of the way in the cell m, 1 or 0 for a belt at rest
    share_next: float  # [cells] the part in the cell m - 1


class Slide(NamedTuple):
    """Way of the road over the belt [m] for each cell of belt travel: of a bristle of label m in
    column j ``x + j x_by_col + m x_by_label`` and ``y + m y_by_label``, for a belt that yaws, bends and extends.
    """

    x: float
    y: float
    x_by_col: float
    y_by_label: float
    x_by_label: float


@kernel
def next_segment(phase: float, remaining: float, backward: bool) -> BeltSegment:
    """Belt travel to the next centre of a cell, or `remaining` [1] cells where that is less;
    `phase` in cells [1].
    """
    if remaining <= 0.0:
        here = 1.0 if phase <= 0.5 else 0.0
        return BeltSegment(0.0, phase, phase, 0, 0, here, 1.0 - here)
    if backward:
        start = phase if phase > 0.0 else 1.0  # phase 0 of one label is phase 1 of the next
        length = min(start, remaining)
        end = start - length if remaining < start else 0.0
        read, write = 0 if phase > 0.0 else 1, 0
    else:
        start = phase
        length = min(1.0 - start, remaining)
        end = start + length if remaining < 1.0 - start else 1.0
        read, write = 0, 1 if end >= 1.0 else 0
    here = min(abs(min(end, 0.5) - min(start, 0.5)), length)
    return BeltSegment(length, start, end, read, write, here, length - here)


@kernel
def advance_bristles(
    brush: Brush, bristles: Bristles, window: LoadedWindow, segment: BeltSegment, slide: Slide
) -> tuple[float, float]:
    """Carry every bristle of the window along one segment, under a road that slides.

    Returns the work [J/m^2] of friction and the elastic energy [J/m^2] of the bristles that left
    the contact.
    """
    pressure, sliding = bristles.pressure, bristles.sliding
    deflection_x, deflection_y = bristles.deflection_x, bristles.deflection_y
    dissipated, released = 0.0, 0.0
    for n in range(window.last - window.first):
        # Never read what was just written
        m = window.first + n if segment.read == 0 else window.last - 1 - n
        source, target, slide_y = m - segment.read, m - segment.write, slide.y + m * slide.y_by_label
        for j in range(window.left, window.right):
            x, y, slid = deflection_x[source, j], deflection_y[source, j], sliding[source, j]
            here, following = pressure[m, j], pressure[m - 1, j]
            if not (following if segment.end > 0.5 else here) > 0.0:
                released += 0.5 * (brush.stiffness_x * x * x + brush.stiffness_y * y * y)
                deflection_x[target, j], deflection_y[target, j], sliding[target, j] = 0.0, 0.0, numpy.uint8(0)
                continue
            # It grows in the loaded cells; up to its limit it sticks, and at the very limit its flag stays as it is
            share = (segment.share_here if here > 0.0 else 0.0) + (segment.share_next if following > 0.0 else 0.0)
            grown_x = x + share * (slide.x + j * slide.x_by_col + m * slide.x_by_label)
            grown_y = y + share * slide_y
            at_end = here + segment.end * (following - here)
            holds = (brush.coefficient_kinetic if slid else brush.coefficient_static) * at_end
            trial = shear_of(brush, grown_x, grown_y)
            if trial <= holds * (1.0 + ROUNDING):
                deflection_x[target, j], deflection_y[target, j] = grown_x, grown_y
                sliding[target, j] = numpy.uint8(slid and trial >= holds * (1.0 - ROUNDING))
                continue
            # Else it slides; the mean of the stress at which it began to, in this segment or before, and that at its end
            limit, before = brush.coefficient_kinetic * at_end, shear_of(brush, x, y)
            if not slid:
                held = brush.coefficient_static * max(here + segment.start * (following - here), at_end)
                before = max(before, min(trial, held), limit)
            new_x, new_y, way = slide_onto(brush, grown_x, grown_y, trial, limit)
            dissipated += way * limit * 0.5 * (limit + before) if way > 0.0 else 0.0
            deflection_x[target, j], deflection_y[target, j], sliding[target, j] = new_x, new_y, numpy.uint8(1)
    return dissipated, released


@kernel
def slide_onto(brush: Brush, x: float, y: float, trial: float, limit: float) -> tuple[float, float, float]:
    """Deflection [m] and `unit_slide` [m/Pa] of a bristle with the trial deflection `x`, `y` [m] of the stress
    `trial` [Pa], once it has slid on to a `limit` [Pa] below that.
    """
    if limit < LEAST_LIMIT:
        return 0.0, 0.0, 0.0
    if brush.stiffness_x == brush.stiffness_y:  # straight back
        part = limit / trial
        return part * x, part * y, (trial / limit - 1.0) / brush.stiffness_x
    way = unit_slide(brush, brush.stiffness_x * x, brush.stiffness_y * y, limit)
    x /= 1.0 + way * brush.stiffness_x
    y /= 1.0 + way * brush.stiffness_y
    factor = limit / shear_of(brush, x, y)
    return x * factor, y * factor, way


@kernel
def shear_of(brush: Brush, x: float, y: float) -> float:
    """Size of the shear stress [Pa] of a deflection `x`, `y` [m]."""
    tau_x, tau_y = brush.stiffness_x * x, brush.stiffness_y * y
    return math.sqrt(tau_x * tau_x + tau_y * tau_y)


@kernel
def unit_slide(brush: Brush, trial_x: float, trial_y: float, limit: float) -> float:
    """Sliding distance over stress [m/Pa]: the w >= 0 with `|tau(w)| = limit`, `tau_i(w) = trial_i
    / (1 + w k_i)`.

    The tip slides along the stress, `w tau`, as Coulomb's law requires. Newton's method on
    1/|tau(w)| = 1/limit, which is linear in w for equal stiffnesses and nearly so else (Moré and
    Sorensen 1983). limit > 0 in [Pa].
    """
    if brush.stiffness_x == brush.stiffness_y:
        return (math.sqrt(trial_x * trial_x + trial_y * trial_y) / limit - 1.0) / brush.stiffness_x
    # Equal stiffnesses have a closed form; else Newton's method from no slide.
    way = 0.0
    for _ in range(NEWTON_STEPS):
        flat_x, flat_y = 1.0 + way * brush.stiffness_x, 1.0 + way * brush.stiffness_y
        x, y = trial_x / flat_x, trial_y / flat_y
        square = x * x + y * y
        excess = math.sqrt(square) / limit - 1.0
        way += square * excess / (brush.stiffness_x * x * x / flat_x + brush.stiffness_y * y * y / flat_y)
        if excess < LAST_EXCESS:
            break
    return way
