"""The foam cushion of a scene under buttocks and thighs, and its map."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.pressure.cushion.foam_layer import FoamGrid, FoamLayer
from contact_sim_pkg.pressure.cushion.force_table import at_load
from contact_sim_pkg.pressure.cushion.sitter import PERCENTILES, pan_gap
from contact_sim_pkg.pressure.cushion.tissue import PlateUnderTissue, Tissue, form_without_load
from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.rigs.vehicle.seat.occupants import SEATED_MASS
from contact_sim_pkg.rigs.vehicle.seat.schema import CushionMap, SeatCushion
from contact_sim_pkg.run.contact_laws import Cushion, PressingBody, build_cushion, foam_of, layer_under
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.schema.fields import given

BEHIND, AHEAD, HALF_WIDTH = 0.24, 0.48, 0.32  # [m] of the cells, from the tuberosities


class SeatMap(NamedTuple):
    """Pressure map of a seat pan: x forward from the tuberosities, y left."""

    cells: tuple[float, float, float, float]  # [m] sizes of a cell along x and y, centre of cell (0, 0)
    fields: int  # maps a block
    pressure: Callable[[float, float], NDArray[numpy.float64]]  # approach [m], force [N] -> [rows, cols] [Pa]


def build_pan_cushion(scene: ResolvedScene, load: float) -> Cushion | None:
    """The cushion of a resolved scene under a ``load`` [N] at rest; None where it does not call for
    one. Errors as ``build_cushion``.
    """
    keys = scene.effect("seat", SeatCushion)
    return None if keys is None else build_cushion("seat", keys, load, _body(keys))


def build_seat_map(scene: ResolvedScene, cushion: Cushion | None) -> SeatMap | None:
    """The map of a scene's ``cushion``; None where the scene does not call for one."""
    if cushion is None or scene.effect("seat", CushionMap) is None:
        return None
    return SeatMap(cushion.cells, round(scene.block_length * scene.outputs.field_rate), cushion.pressure)


def pan_layer(keys: SeatCushion) -> FoamLayer | PlateUnderTissue:
    """The foam layer of a cushion, or the plate in its place, under its body."""
    return layer_under(keys, _body(keys))


def _body(keys: SeatCushion) -> PressingBody:
    # A row of cells lies under the tuberosities, the middle between two columns.
    cell = given(keys.cell)
    rows, cols = round((BEHIND + AHEAD) / cell), 2 * round(HALF_WIDTH / cell)
    x = (numpy.arange(rows, dtype=numpy.float64) - round(BEHIND / cell)) * cell
    y = (numpy.arange(cols, dtype=numpy.float64) - 0.5 * (cols - 1)) * cell
    percentile, tilt = given(keys.percentile), keys.thigh_tilt
    sitter = PERCENTILES[percentile]
    if keys.tissue is None:
        return PressingBody(x, y, (sitter, tilt), lambda x, y: pan_gap(sitter, x, y, tilt))
    # The form of a percentile is that on the default foam under the weight that it has there.
    tissue, weight = Tissue(keys.tissue, given(keys.tissue_depth)), SEATED_MASS[percentile] * GRAVITY
    default = SeatCushion()
    sizes = (sitter, tilt, weight, foam_of(default), default.shear_share)

    def free_form(x: Vector, y: Vector) -> NDArray[numpy.float64]:
        grid = FoamGrid(len(x), len(y), cell, cell)
        reference = at_load(FoamLayer(grid, foam_of(default), pan_gap(sitter, x, y), default.shear_share), weight)
        return form_without_load(pan_gap(sitter, x, y, tilt), tissue, reference.pressure)

    return PressingBody(x, y, sizes, free_form, tissue, keys.carrier == "plate")
