"""The road under the wheel's track from `road/patch`, read block by block; neighbouring blocks
overlap.
"""

from __future__ import annotations

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
        self._middle, self._low, self._high = (ThinnedRows(ROWS, reduce) for reduce in (np.mean, np.min, np.max))

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
        y = (np.arange(message.cols) - 0.5 * (message.cols - 1)) * message.cell_y
        strip = height[skipped:, np.abs(y) <= max(0.5 * TRACK, message.cell_y)]
        middle = height[skipped:, np.abs(y) <= 0.51 * message.cell_y].mean(axis=1)
        x = (message.first_row + skipped + np.arange(len(strip))) * message.cell_x
        for row in np.column_stack([x, middle, strip.min(axis=1), strip.max(axis=1)]):
            self._middle.add(row[:2])
            self._low.add(row[2:3])
            self._high.add(row[3:4])
        self._next_row = message.first_row + message.rows

    def finish(self) -> RoadSeries:
        """The series of all blocks read; at least one."""
        if self._next_row is None:
            raise BagError("no road was read")
        time, travel = np.array([*self._travel, self._end]).T
        x, middle = self._middle.finish().T
        low: FloatArray = self._low.finish()[:, 0]
        high: FloatArray = self._high.finish()[:, 0]
        return RoadSeries(WheelTravel(time, travel), x, middle, low, high)
