"""Resultants of a pressure field on a grid: load, peak, mean, area and centre of pressure."""

from __future__ import annotations

from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.core.jit import entry

__all__ = ["PatchSummary", "summarise"]


Field = NDArray[numpy.float64]


class PatchSummary(NamedTuple):
    load: float  # [N] sum of the pressure times the cell area
    peak: float  # [Pa] largest pressure
    mean: float  # [Pa] load / area, 0 without contact
    area: float  # [m^2] cells under pressure; too large on coarse grids by about half a cell along the boundary
    centre_x: float  # [m] centre of pressure; the centre of the grid without contact
    centre_y: float  # [m]


@entry
def summarise(pressure: Field, cell_x: float, cell_y: float, origin_x: float, origin_y: float) -> PatchSummary:
    """Resultants of a pressure field.

    pressure: [Pa], float64 [rows, cols], rows along x; cell_x, cell_y: size of a cell [m]; origin_x, origin_y: centre
    of cell (0, 0) [m]. The sums run over the rows in order, so the same field gives the same bits.
    """
    rows, cols = pressure.shape
    total, moment_x, moment_y, peak, cells = 0.0, 0.0, 0.0, 0.0, 0
    for i in range(rows):
        row_total, row_moment = 0.0, 0.0
        for j in range(cols):
            p = pressure[i, j]
            row_total += p
            row_moment += p * j
            peak = max(peak, p)
            cells += 1 if p > 0.0 else 0
        total += row_total
        moment_x += row_total * i
        moment_y += row_moment
    if total <= 0.0:
        return PatchSummary(
            0.0, 0.0, 0.0, 0.0, origin_x + 0.5 * (rows - 1) * cell_x, origin_y + 0.5 * (cols - 1) * cell_y
        )
    centre_x = origin_x + moment_x / total * cell_x
    centre_y = origin_y + moment_y / total * cell_y
    return PatchSummary(total * cell_x * cell_y, peak, total / cells, cells * cell_x * cell_y, centre_x, centre_y)
