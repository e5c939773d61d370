"""Winkler bed: independent springs, `p = k max(approach - gap, 0)`, the least expensive pressure
field of a rough contact.

A cell knows nothing of its neighbours. With k from Hertz, load and approach on a smooth road are
right; on a sphere the contact is sqrt(2) times too wide and the peak pressure 2/3 of Hertz's. Use
the pressure field (`pressure/field/solver.py`) where the shape of the pressure matters.

At a given load the approach is exact: the load is a convex, piecewise linear function of it, on
which Newton steps from the right end after finitely many, at most one for each cell (about ten in
practice).

Source: Johnson (1985), Contact Mechanics, section 4.3.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.jit import entry, kernel
from contact_sim_pkg.pressure.closed_form.hertz import hertz_contact
from contact_sim_pkg.pressure.field.solver import refuse_bad_gap

__all__ = ["WinklerResult", "bed_stiffness", "winkler_at_approach", "winkler_at_load"]

Field = NDArray[numpy.float64]


class WinklerResult(NamedTuple):
    load: float  # [N] sum of the pressure times the cell area
    approach: float  # [m] against the datum of the gap
    cells: int  # cells under pressure


def bed_stiffness(curvature_a: float, curvature_b: float, modulus: float, load: float) -> float:
    """`k = 2 P sqrt(A B) / (pi approach^2)` [Pa/m]: the bed that has Hertz's approach at this load
    on a smooth gap.

    curvature_a, curvature_b: of the gap A x^2 + B y^2 [1/m]; modulus: E* [Pa]; load: P [N] > 0.
    Raises `ValueError` for P <= 0 and a stiffness that is no number, else as `hertz_contact`.
    """
    contact = hertz_contact(curvature_a, curvature_b, modulus, load)
    if contact.load <= 0.0:
        raise ValueError(f"Winkler bed: the load is {load} N, it must be above 0 to give a stiffness")
    squared = contact.approach**2 if contact.approach < 1e150 else math.inf
    stiffness = 2.0 * load * math.sqrt(curvature_a * curvature_b) / (math.pi * squared) if squared > 0.0 else math.inf
    if not 0.0 < stiffness < math.inf:
        raise ValueError(
            f"Winkler bed: an approach of {contact.approach} m under {load} N gives no stiffness that is a number"
        )
    return stiffness


def winkler_at_approach(
    gap: Field, stiffness: float, cell_x: float, cell_y: float, approach: float, pressure: Field
) -> WinklerResult:
    """Pressure field at a given approach.

    gap: height of the undeformed gap [m], float64 [rows, cols], any datum; stiffness: k [Pa/m];
    cell_x, cell_y [m]; approach: [m] against the datum; pressure: float64 [rows, cols] [Pa],
    overwritten. Raises `ValueError` for wrong shapes and values that are not finite or not
    positive.
    """
    _refuse(gap, stiffness, cell_x, cell_y, approach, "approach [m]", pressure)
    return press(gap, float(stiffness), float(cell_x * cell_y), float(approach), pressure)


def winkler_at_load(
    gap: Field, stiffness: float, cell_x: float, cell_y: float, load: float, pressure: Field
) -> WinklerResult:
    """Pressure field that carries a load [N]; for load <= 0 zeros and the approach of first
    contact. Rest as before.
    """
    _refuse(gap, stiffness, cell_x, cell_y, load, "load [N]", pressure)
    cell = float(cell_x * cell_y)
    approach = approach_at_load(gap, float(stiffness) * cell, float(load))
    return press(gap, float(stiffness), cell, approach, pressure)


@entry
def press(gap: Field, stiffness: float, cell: float, approach: float, pressure: Field) -> WinklerResult:
    """`winkler_at_approach` without its checks, for compiled callers; cell: area of a cell
    [m^2].
    """
    rows, cols = gap.shape
    total, cells = 0.0, 0
    for i in range(rows):
        row_total = 0.0
        for j in range(cols):
            overlap = max(approach - gap[i, j], 0.0)
            pressure[i, j] = stiffness * overlap
            row_total += overlap
            cells += 1 if overlap > 0.0 else 0
        total += row_total
    return WinklerResult(stiffness * total * cell, approach, cells)


@entry
def approach_at_load(gap: Field, cell_stiffness: float, load: float) -> float:
    """Approach [m] at which the bed carries a load [N]; cell_stiffness: k times the area of a cell
    [N/m].

    Newton from the highest cell down: `approach = (P / (k cell) + sum of the gaps below it) /
    (their number)`.
    """
    low, high = limits(gap)
    if not load > 0.0:
        return low
    approach = high - low
    wanted = load / cell_stiffness
    previous = -1
    # Fewer springs touch at each iteration; the number no longer changing is the solution
    for _ in range(gap.size + 1):
        cells, total = below(gap, low, approach)
        if cells == 0 or cells == previous:
            break
        previous = cells
        approach = (wanted + total) / cells
    return low + approach


@kernel
def limits(gap: Field) -> tuple[float, float]:
    """Smallest and largest gap.

    gap: [rows, cols] [m].
    """
    rows, cols = gap.shape
    low, high = numpy.inf, -numpy.inf
    for i in range(rows):
        for j in range(cols):
            low, high = min(low, gap[i, j]), max(high, gap[i, j])
    return low, high


@kernel
def below(gap: Field, datum: float, approach: float) -> tuple[int, float]:
    """Number of cells with `gap - datum <= approach` and the sum of their `gap - datum`, row by
    row.

    gap: [rows, cols] [m]; datum, approach: [m].
    """
    rows, cols = gap.shape
    cells, total = 0, 0.0
    for i in range(rows):
        row_total = 0.0
        for j in range(cols):
            height = gap[i, j] - datum
            if height <= approach:
                cells += 1
                row_total += height
        total += row_total
    return cells, total


def _refuse(
    gap: Field, stiffness: float, cell_x: float, cell_y: float, value: float, name: str, pressure: Field
) -> None:
    if gap.ndim != 2 or gap.size == 0 or gap.shape != pressure.shape:
        raise ValueError(
            f"Winkler bed: gap is {gap.shape} and pressure {pressure.shape}, both must be one [rows, cols]"
        )
    for label, number in (("stiffness [Pa/m]", stiffness), ("cell_x [m]", cell_x), ("cell_y [m]", cell_y)):
        if not 0.0 < number < math.inf:
            raise ValueError(f"Winkler bed: {label} is {number}, it must be a finite number above 0")
    if not math.isfinite(value):
        raise ValueError(f"Winkler bed: {name} is {value}, it must be a finite number")
    refuse_bad_gap(gap)
