"""Pressure maps under an occupant whose contact is no field: of a cushion by its table, of a point
contact by a bed of springs.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.laws.parameters import ElasticLaw
from contact_sim_pkg.pressure.mat import spread_force
from contact_sim_pkg.rigs.vehicle.seat.schema import Body, CushionMap, PressureMat
from contact_sim_pkg.rigs.vehicle.seat.shape import seat_gap, shape_of
from contact_sim_pkg.run.contact_laws import Cushion
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

AHEAD = 0.7  # part of the length that lies forward of the tuberosities


class SeatMap(NamedTuple):
    """Pressure map of a seat pan: x forward from the tuberosities, y left."""

    cells: tuple[float, float, float, float]  # [m] sizes of a cell along x and y, centre of cell (0, 0)
    fields: int  # maps a block
    pressure: Callable[[float, float], NDArray[numpy.float64]]  # approach [m], force [N] -> [rows, cols] [Pa]


def build_seat_map(scene: ResolvedScene, body: Body, elastic: ElasticLaw, cushion: Cushion | None) -> SeatMap | None:
    """The map of a resolved scene; None where it does not call for one.

    elastic: force law of a point contact, under which the ``body`` lies.
    """
    fields = round(scene.block_length * scene.outputs.field_rate)
    if cushion is not None and scene.effect("seat", CushionMap) is not None:
        return SeatMap(cushion.cells, fields, cushion.pressure)
    effect = scene.effect("seat", PressureMat)
    if effect is None:
        return None
    rows, cols, length, width = effect.rows, effect.cols, effect.length, effect.width
    cell_x, cell_y = length / rows, width / cols
    x: Vector = (numpy.arange(rows, dtype=numpy.float64) + 0.5) * cell_x - (1.0 - AHEAD) * length
    y: Vector = (numpy.arange(cols, dtype=numpy.float64) - 0.5 * (cols - 1)) * cell_y
    gap = seat_gap(shape_of(body), x, y)

    def pressure(approach: float, force: float) -> NDArray[numpy.float64]:
        return spread_force(force, approach, elastic, gap, cell_x * cell_y)

    return SeatMap((cell_x, cell_y, float(x[0]), float(y[0])), fields, pressure)
