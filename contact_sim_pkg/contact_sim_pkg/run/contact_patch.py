"""Record of a pressure field: its cells, and load, area, centre and boundary computed from them."""

from __future__ import annotations

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.pressure.closed_form.lame import fit_patch
from contact_sim_pkg.pressure.field.patch import summarise
from contact_sim_pkg.records.messages import ContactPatch


def contact_patch(
    block: int, grid: tuple[float, float, float, float], approach: float, pressure: NDArray[numpy.float64]
) -> ContactPatch:
    """Load, peak, area, centre and Lamé curve of ``pressure`` [rows, cols] [Pa].

    ``grid``: sizes of a cell and centre of the first one, each along rows and columns, in [m];
    ``approach`` [m].
    """
    total, shape = summarise(pressure, *grid), fit_patch(pressure, *grid)
    cell_x, cell_y, origin_x, origin_y = grid
    touching = total.load > 0.0
    return ContactPatch(
        block=block, cell_x=cell_x, cell_y=cell_y, origin_x=origin_x, origin_y=origin_y, load=total.load,
        peak=total.peak, mean=total.mean, area=total.area, centre_x=total.centre_x if touching else 0.0,
        centre_y=total.centre_y if touching else 0.0, approach=approach, lame_a=shape.a, lame_b=shape.b,
        lame_n=shape.exponent, pressure=pressure.astype(numpy.float32),
    )  # fmt: skip
