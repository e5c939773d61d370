"""Work of the tire in the plane of the road from `tire/work`, part by part."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from contact_sim_pkg.report.series import FloatArray, Recording

SUPPLIED = ("axle", "drift", "rim", "slopes")
KEPT = ("moving", "springs", "strained")
LOST = ("brake", "dampers", "rolling", "bristles")


class WorkSeries(NamedTuple):
    """Works since the start."""

    time: FloatArray
    """[s]"""
    parts: dict[str, FloatArray]
    """[J] by the names of the message"""

    @property
    def lost(self) -> float:
        """All that was lost at the end [J]."""
        return float(sum(self.parts[name][-1] for name in LOST))


def work_of(recording: Recording) -> WorkSeries | None:
    """Work of a recording; None where the bag holds none."""
    return recording.series.get("work")


class WorkReader:
    """All blocks."""

    def __init__(self) -> None:
        """Nothing read yet."""
        self._times: list[float] = []
        self._blocks: list[Any] = []

    def add(self, time: float, _type: str, message: Any) -> None:
        """Read the block that begins at `time` [s]."""
        self._times.append(time)
        self._blocks.append(message)

    def finish(self) -> WorkSeries:
        """The series of all blocks read."""
        names = (*SUPPLIED, *KEPT, *LOST, "sampling")
        return WorkSeries(
            np.array(self._times),
            {name: np.array([float(getattr(each, name)) for each in self._blocks]) for name in names},
        )
