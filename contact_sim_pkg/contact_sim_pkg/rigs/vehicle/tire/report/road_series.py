"""The road under the wheel's track from `road/patch`, read block by block; neighbouring blocks
overlap.
"""

from __future__ import annotations

from functools import cache
from typing import Any, NamedTuple

import numpy as np

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.report.series import FloatArray, Recording
from contact_sim_pkg.report.signal.thinning import ThinnedRows

TRACK = 0.1
"""[m] width of the strip in the middle whose lowest and highest points are kept"""
ROWS = 200_000
"""Most rows kept: 1.2 km at cells of 6 mm, beyond that the mean of two, four, …"""


class WheelTravel(NamedTuple):
    """Way of the wheel centre over time, straight between its points."""

    time: FloatArray
    """[s] ascending"""
    distance: FloatArray
    """[m]"""

    def at(self, time: FloatArray) -> FloatArray:
        """[m] at the times [s]; its ends beyond them."""
        return np.interp(time, self.time, self.distance)


class RoadSeries(NamedTuple):
    """What the wheel rolled over."""

    travel: WheelTravel
    distance: FloatArray
    """[m] of the heights"""
    middle: FloatArray
    """[m] height in the middle of the track"""
    low: FloatArray
    high: FloatArray
    """[m] lowest and highest point of the strip around the middle"""


def road_of(recording: Recording) -> RoadSeries | None:
    """Road of a recording; None where the bag holds none."""
    return recording.series.get("road")


class RoadReader:
    """Travel over time, and the road's profile over distance in the middle of the track."""

    def __init__(self) -> None:
        """Nothing read yet."""
        self._travel: list[tuple[float, float]] = []
        self._end = (0.0, 0.0)
        self._next_row: int | None = None
        self._profile = ThinnedRows(ROWS, _mean_low_high)

    def add(self, time: float, _type: str, message: Any) -> None:
        """Read the block that starts at `time` [s]. BagError for one that does not fill its
        grid.
        """
        if len(message.height) != message.rows * message.cols:
            raise BagError(
                f"the road at {time:.6f} s has {len(message.height)} heights for {message.rows} x {message.cols} nodes"
            )
        self._travel.append((time, message.travel_start))
        length = time - self._travel[-2][0] if len(self._travel) > 1 else 0.0
        self._end = (time + length, message.travel_end)
        self._append(message)

    def _append(self, message: Any) -> None:
        """Rows that no earlier block had."""
        height = np.reshape(message.height, (message.rows, message.cols))
        skipped = 0 if self._next_row is None else max(self._next_row - message.first_row, 0)
        if skipped >= message.rows:
            return
        track, middle = _columns(message.cols, message.cell_y)
        strip = height[skipped:, track]
        x = (message.first_row + skipped + np.arange(len(strip))) * message.cell_x
        rows = x, height[skipped:, middle].mean(axis=1), strip.min(axis=1), strip.max(axis=1)
        self._profile.add(np.stack(rows, axis=1))
        self._next_row = message.first_row + message.rows

    def finish(self) -> RoadSeries:
        """The series of all blocks read; at least one."""
        if self._next_row is None:
            raise BagError("no road was read")
        time, travel = np.array([*self._travel, self._end]).T
        return RoadSeries(WheelTravel(time, travel), *self._profile.finish().T)


@cache
def _columns(cols: int, cell_y: float) -> tuple[slice, slice]:
    """Columns of a patch in the strip, and the one or two in the middle of it."""
    distance = np.abs((np.arange(cols) - 0.5 * (cols - 1)) * cell_y)
    strip, middle = (np.flatnonzero(distance <= reach) for reach in (max(0.5 * TRACK, cell_y), 0.51 * cell_y))
    return slice(strip[0], strip[-1] + 1), slice(middle[0], middle[-1] + 1)


def _mean_low_high(rows: FloatArray, axis: int) -> FloatArray:
    """Groups of rows of distance, middle, low and high [..., 4]."""
    x_middle, low, high = rows[..., :2].mean(axis=axis), rows[..., 2:3].min(axis=axis), rows[..., 3:].max(axis=axis)
    return np.concatenate([x_middle, low, high], axis=-1)
