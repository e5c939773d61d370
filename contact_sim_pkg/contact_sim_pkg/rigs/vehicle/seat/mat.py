"""The pressure mat under an occupant whose contact is a point contact."""

from __future__ import annotations

from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.rigs.vehicle.seat.schema import Body, PressureMat
from contact_sim_pkg.rigs.vehicle.seat.shape import seat_gap, shape_of
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

AHEAD = 0.7  # part of the length that lies forward of the tuberosities


class PanMat(NamedTuple):
    """Cells of the pressure map of a seat pan: x forward from the tuberosities, y left."""

    cell_x: float  # [m]
    cell_y: float  # [m]
    origin_x: float  # [m] centre of the first cell
    origin_y: float  # [m]
    gap: NDArray[numpy.float64]  # [rows, cols] [m] of the occupant's lower surface over its lowest point
    fields: int  # maps a block


def build_pan_mat(scene: ResolvedScene, body: Body) -> PanMat | None:
    """The mat of a resolved scene under a body; None where it does not call for one."""
    effect = scene.effect("seat", PressureMat)
    if effect is None:
        return None
    rows, cols, length, width = effect.rows, effect.cols, effect.length, effect.width
    cell_x, cell_y = length / rows, width / cols
    x: Vector = (numpy.arange(rows, dtype=numpy.float64) + 0.5) * cell_x - (1.0 - AHEAD) * length
    y: Vector = (numpy.arange(cols, dtype=numpy.float64) - 0.5 * (cols - 1)) * cell_y
    fields = round(scene.block_length * scene.outputs.field_rate)
    return PanMat(cell_x, cell_y, float(x[0]), float(y[0]), seat_gap(shape_of(body), x, y), fields)
