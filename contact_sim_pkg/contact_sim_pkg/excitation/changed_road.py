"""A road that becomes another one ahead of the wheel: what was handed out of it stays as it was."""

from __future__ import annotations

from typing import Any

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.blocks import AHEAD, RoadBlocks, Surface

__all__ = ["CHANGE_LENGTH", "ChangedSurface", "changed_road"]

CHANGE_LENGTH = 2.0
"""[m] of road on which the one goes over into the other."""


class ChangedSurface:
    """One surface between two places of the road, another one beyond them.

    With d the distance [m] beyond the nearer place, 0 between them, and s = min(d / CHANGE_LENGTH, 1):
    z = before + (3 s^2 - 2 s^3) (after - before), so that height and slope are continuous.
    """

    def __init__(self, before: Surface, after: Surface, low: float, high: float) -> None:
        """``before`` from ``low`` to ``high`` [m] along the road, ``after`` far from there."""
        self._before, self._after, self._low, self._high = before, after, low, high

    def heights(self, x: NDArray[numpy.float64], y: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """See blocks.Surface."""
        beyond = numpy.maximum(0.0, numpy.maximum(self._low - x, x - self._high))
        part = numpy.minimum(beyond / CHANGE_LENGTH, 1.0)
        weight = (part * part * (3.0 - 2.0 * part))[:, None]
        if not weight.any():
            return self._before.heights(x, y)
        if (weight == 1.0).all():
            return self._after.heights(x, y)
        before = self._before.heights(x, y)
        return before + weight * (self._after.heights(x, y) - before)

    def describe(self) -> dict[str, Any]:
        """That of the surface beyond, and where it begins."""
        described = self._after.describe()
        sentence = f"The road is another one up to {self._high:g} m; over {CHANGE_LENGTH:g} m it becomes this one."
        return {**described, "notes": [*described.get("notes", []), sentence]}


def changed_road(before: RoadBlocks, after: RoadBlocks, block: int, *, same_surface: bool) -> RoadBlocks:
    """Strips of the road ``after`` a change before ``block``: its travel, and what of its surface has not been
    handed out ``before``.

    Raises ExcitationError as `RoadBlocks`.
    """
    surface = before.surface
    if not same_surface:
        first, last = before.rows(0.0, max(block * before.block_length, AHEAD))
        surface = ChangedSurface(surface, after.surface, first * before.cell_x, last * before.cell_x)
    return RoadBlocks(
        surface, after.travel, after.block_length, after.cell_x, after.cell_y, after.half_length, after.cols
    )
