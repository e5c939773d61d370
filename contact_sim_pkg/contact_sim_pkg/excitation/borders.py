"""How the road of a file goes on: beyond its ends and sides by a border mode, before its beginning with its slope."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar, Literal, Protocol, TypeAlias

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.kinds import RoadKind, Wave

__all__ = [
    "BEYOND_THE_ENDS", "BORDERS", "BORDER_NAMES", "Border", "FileRoad", "FileRoadKind", "TurnedBeginning", "bring_inside",
]  # fmt: skip

BORDERS = ("none", "zero", "constant", "repeat", "reflect")  # in the order of BORDER_MODE 0 to 4 of OpenCRG

Border: TypeAlias = Literal["refuse", "zero", "keep", "repeat", "reflect"]
BORDER_NAMES = {"refuse": "none", "zero": "zero", "keep": "constant", "repeat": "repeat", "reflect": "reflect"}
"""Words of a scene, by which a road goes on, as `BORDERS` names them."""
BEYOND_THE_ENDS = "after the end of the road, and before its beginning where start is negative"

Array = NDArray[numpy.float64]


class FileRoadKind(RoadKind):
    """The road of a file: measured, with waves of any length."""

    largest_file: ClassVar[int] = 512 << 20

    def shortest_wave(self, limit: float) -> Wave:
        """See RoadKind."""
        return Wave(0.0, float("inf"), "a measured road holds waves below")


class FileRoad(Protocol):
    """The road of a file, of a length, along which a run starts somewhere."""

    start: float  # [m] from the beginning of the road to x = 0

    def heights(self, x: Array, y: Array) -> Array:
        """See blocks.Surface."""

    def describe(self) -> dict[str, Any]:
        """See blocks.Surface."""

    def refuse_steep_track(self, y: Array) -> None:
        """Raise ExcitationError where the road rises across the track's lines `y`, [m], by more
        than a wheel can stand on.
        """


class TurnedBeginning:
    """The road of a file on which a tire starts, half of it over what lies before the beginning.

    There the road is turned by half a turn about its first points: z(-s) = 2 z(0) - z(s), so that height
    and slope go on (decision 0034). Where the start itself lies before the road, the border mode decides.
    """

    def __init__(self, road: FileRoad) -> None:
        """Of a `road`."""
        self.road, self.start = road, road.start

    def heights(self, x: Array, y: Array) -> Array:
        """See blocks.Surface."""
        before = x < -self.start - 1e-9
        if self.start < 0.0 or not before.any():
            return self.road.heights(x, y)
        height = self.road.heights(numpy.where(before, -2.0 * self.start - x, x), y)
        height[before] = 2.0 * self.road.heights(numpy.array([-self.start]), y) - height[before]
        return height

    def describe(self) -> dict[str, Any]:
        """See blocks.Surface."""
        return self.road.describe()

    def refuse_steep_track(self, y: Array) -> None:
        """See FileRoad."""
        self.road.refuse_steep_track(y)


def bring_inside(
    file: str, value: Array, low: float, high: float, border: str, name: str, requested: Array
) -> tuple[Array, Any]:
    """Positions `value` along (`name` x) or across (y) a road, [m] or cells, brought into [low, high] by the
    `border` mode, and where the height is 0 instead, None for nowhere.

    Raises ExcitationError, with the place as `requested` [m], outside of a road whose border is 'none'.
    """
    outside = (value < low - 1e-9) | (value > high + 1e-9)
    if not outside.any():
        return numpy.clip(value, low, high), None
    if border == "none":
        worst = float(requested[outside][0])
        raise ExcitationError(
            f"{file}: {name} = {worst:g} m lies outside of the road; shorten the run or say how the road "
            f"goes on (road.border_{'u' if name == 'x' else 'v'}: zero, keep, repeat or reflect)"
        )
    return numpy.clip(_BRING_INSIDE[border](value, low, high), low, high), outside if border == "zero" else None


def _repeat(value: Array, low: float, high: float) -> Array:
    return low + numpy.mod(value - low, high - low) if high > low else numpy.full_like(value, low)


def _reflect(value: Array, low: float, high: float) -> Array:
    return high - numpy.abs(_repeat(value, low, low + 2.0 * (high - low)) - high)


def _keep(value: Array, low: float, high: float) -> Array:
    return numpy.clip(value, low, high)


_BRING_INSIDE: dict[str, Callable[[Array, float, float], Array]] = {
    "zero": _keep, "constant": _keep, "repeat": _repeat, "reflect": _reflect
}  # fmt: skip
