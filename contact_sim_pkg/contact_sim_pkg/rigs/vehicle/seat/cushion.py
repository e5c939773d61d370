"""The foam cushion of a scene under buttocks and thighs."""

from __future__ import annotations

import numpy

from contact_sim_pkg.pressure.cushion.foam_layer import FoamLayer
from contact_sim_pkg.pressure.cushion.sitter import PERCENTILES, pan_gap
from contact_sim_pkg.rigs.vehicle.seat.schema import SeatCushion
from contact_sim_pkg.run.contact_laws import Cushion, PressingBody, build_cushion, layer_under
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.schema.fields import given

BEHIND, AHEAD, HALF_WIDTH = 0.24, 0.48, 0.32  # [m] of the cells, from the tuberosities


def build_pan_cushion(scene: ResolvedScene, load: float) -> Cushion | None:
    """The cushion of a resolved scene under a ``load`` [N] at rest; None where it does not call for
    one. Errors as ``build_cushion``.
    """
    keys = scene.effect("seat", SeatCushion)
    return None if keys is None else build_cushion("seat", keys, load, _body(keys))


def pan_layer(keys: SeatCushion) -> FoamLayer:
    """The foam layer of a cushion under its body."""
    return layer_under(keys, _body(keys))


def _body(keys: SeatCushion) -> PressingBody:
    # A row of cells lies under the tuberosities, the middle between two columns.
    rows, cols = round((BEHIND + AHEAD) / keys.cell), 2 * round(HALF_WIDTH / keys.cell)
    x = (numpy.arange(rows, dtype=numpy.float64) - round(BEHIND / keys.cell)) * keys.cell
    y = (numpy.arange(cols, dtype=numpy.float64) - 0.5 * (cols - 1)) * keys.cell
    sitter, tilt = PERCENTILES[given(keys.percentile)], keys.thigh_tilt
    return PressingBody(x, y, (sitter, tilt), lambda x, y: pan_gap(sitter, x, y, tilt))
