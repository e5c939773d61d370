"""The pressure field of a mat, with what is said of it beside its cells."""

from __future__ import annotations

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.bag.messages import PatchField
from contact_sim_pkg.pressure.closed_form.lame import fit_patch
from contact_sim_pkg.pressure.field.patch import summarise


def mat_field(
    block: int, grid: tuple[float, float, float, float], approach: float, pressure: NDArray[numpy.float64]
) -> PatchField:
    """Load, peak, area, centre and Lame curve of ``pressure`` [rows, cols] [Pa].

    ``grid``: sizes of a cell and centre of the first one, each along rows and columns, in [m]; ``approach`` [m].
    """
    total, shape = summarise(pressure, *grid), fit_patch(pressure, *grid)
    touching = total.load > 0.0
    return PatchField(
        block, *grid, total.load, total.peak, total.mean, total.area, total.centre_x if touching else 0.0,
        total.centre_y if touching else 0.0, approach, shape.a, shape.b, shape.exponent, pressure.astype(numpy.float32),
    )  # fmt: skip
