"""The foam of a scene's seat back under a back."""

from __future__ import annotations

import numpy

from contact_sim_pkg.pressure.cushion.sitter import PERCENTILES, LumbarSupport, back_gap
from contact_sim_pkg.records.fields import given
from contact_sim_pkg.rigs.backrest.schema import BackCushion
from contact_sim_pkg.run.contact_laws import Cushion, PressingBody, build_cushion
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

BELOW, ABOVE, HALF_WIDTH = 0.06, 0.66, 0.26  # [m] of the cells, from the middle of the lower edge of the seat back


def build_back_cushion(scene: ResolvedScene, preload: float) -> Cushion | None:
    """The foam of a resolved scene's seat back under a ``preload`` [N]; None where it does not call
    for a cushion. Errors as ``build_cushion``.
    """
    keys = scene.effect("backrest", BackCushion)
    if keys is None:
        return None
    cell = given(keys.cell)
    rows, cols = round((BELOW + ABOVE) / cell), 2 * round(HALF_WIDTH / cell)
    x = (numpy.arange(rows, dtype=numpy.float64) + 0.5) * cell - BELOW
    y = (numpy.arange(cols, dtype=numpy.float64) - 0.5 * (cols - 1)) * cell
    sitter, support = PERCENTILES[given(keys.percentile)], LumbarSupport(keys.lumbar_support, keys.lumbar_height)
    body = PressingBody(x, y, (sitter, support), lambda x, y: back_gap(sitter, support, x, y))
    return build_cushion("backrest", keys, preload, body)
