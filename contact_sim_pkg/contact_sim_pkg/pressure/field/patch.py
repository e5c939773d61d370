"""Resultants of a pressure field on a grid: load, peak, mean, area and centre of pressure.

Source: Tire/Road Contact eq 2.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.jit import entry, kernel

__all__ = ["PatchSummary", "contact_area", "summarise"]


Field = NDArray[numpy.float64]


class PatchSummary(NamedTuple):
    load: float  # [N] sum of the pressure times the cell area
    peak: float  # [Pa] largest pressure
    mean: float  # [Pa] load / area, 0 without contact
    area: float  # [m^2] `contact_area`: the edge lies between cells
    centre_x: float  # [m] centre of pressure; the centre of the grid without contact
    centre_y: float  # [m]


@entry
def summarise(pressure: Field, cell_x: float, cell_y: float, origin_x: float, origin_y: float) -> PatchSummary:
    """Resultants of a pressure field.

    pressure: [Pa], float64 [rows, cols], rows along x; cell_x, cell_y: size of a cell [m];
    origin_x, origin_y: centre of cell (0, 0) [m]. The sums run over the rows in order, so the same
    field gives the same bits. Pressures >= 0, cells > 0. Not checked.
    """
    rows, cols = pressure.shape
    total, moment_x, moment_y, peak = 0.0, 0.0, 0.0, 0.0
    for i in range(rows):
        # Sums by row first: their order is part of the result
        row_total, row_moment = 0.0, 0.0
        for j in range(cols):
            p = pressure[i, j]
            row_total += p
            row_moment += p * j
            peak = max(peak, p)
        total += row_total
        moment_x += row_total * i
        moment_y += row_moment
    # No contact: zero force in the centre of the grid
    if total <= 0.0:
        return PatchSummary(
            0.0, 0.0, 0.0, 0.0, origin_x + 0.5 * (rows - 1) * cell_x, origin_y + 0.5 * (cols - 1) * cell_y
        )
    centre_x = origin_x + moment_x / total * cell_x
    centre_y = origin_y + moment_y / total * cell_y
    load, area = total * cell_x * cell_y, contact_area(pressure, cell_x, cell_y)
    return PatchSummary(load, peak, load / area, area, centre_x, centre_y)


@entry
def contact_area(pressure: Field, cell_x: float, cell_y: float) -> float:
    """Contact area [m^2] with the edge placed between cells; arguments as `summarise`.

    Near the edge of an elastic contact p^2 grows like the distance from it (Johnson 1985, section
    5.1). So along each line the edge lies `d = p1^2 / (p2^2 - p1^2)` cells beyond the centre of the
    last cell in contact, p1 its pressure and p2 that of the cell before, d at most 1; half a cell
    where the pressure does not fall outwards (a sharp-edged punch) and at the grid's edge. A run of
    one cell counts as one cell. The mean of the areas by rows and by columns is returned. Not
    checked.
    """
    rows, cols = pressure.shape
    length = 0.0
    for i in range(rows):
        for j in range(cols):
            own = pressure[i, j]
            if own > 0.0:
                length += 2.0  # the cell along rows and along columns
                if 0 < j < cols - 1:
                    if pressure[i, j - 1] == 0.0:
                        length += beyond(own, pressure[i, j + 1])
                    if pressure[i, j + 1] == 0.0:
                        length += beyond(own, pressure[i, j - 1])
                if 0 < i < rows - 1:
                    if pressure[i - 1, j] == 0.0:
                        length += beyond(own, pressure[i + 1, j])
                    if pressure[i + 1, j] == 0.0:
                        length += beyond(own, pressure[i - 1, j])
    return 0.5 * length * cell_x * cell_y


@kernel
def beyond(own: float, inner: float) -> float:
    """Reach of the contact beyond the far side of its outermost cell, -1/2 to 1/2 of a cell [1].

    own, inner: pressures of that cell and of the one before [Pa]. The square of the pressure is
    continued as a line (exact for a Hertz edge). 0 where it does not fall outwards.
    """
    if inner <= own:
        return 0.0
    return float(min(own * own / (inner * inner - own * own), 1.0)) - 0.5
