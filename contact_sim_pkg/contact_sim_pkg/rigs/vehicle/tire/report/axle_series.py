"""Force of the tire on its axle from `tire/axle`, block by block."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from contact_sim_pkg.report.series import FloatArray, Recording


class AxleSeries(NamedTuple):
    """Force on the axle at the full rate."""

    time: FloatArray
    """[s]"""
    sample_period: float
    """[s]"""
    longitudinal: FloatArray
    """[N] forward positive"""
    vertical: FloatArray
    """[N] up positive"""


def axle_of(recording: Recording) -> AxleSeries | None:
    """Force on the axle of a recording; None where the bag holds none."""
    return recording.series.get("axle")


class AxleReader:
    """All samples."""

    def __init__(self) -> None:
        """Nothing read yet."""
        self._blocks: list[tuple[float, Any]] = []

    def add(self, time: float, _type: str, message: Any) -> None:
        """Read the block that begins at `time` [s]."""
        self._blocks.append((time, message))

    def finish(self) -> AxleSeries:
        """The series of all blocks read."""
        period = float(self._blocks[0][1].sample_period)
        times = [time + period * np.arange(len(block.longitudinal)) for time, block in self._blocks]
        along, up = (
            np.concatenate([np.asarray(getattr(block, name), dtype=np.float64) for _time, block in self._blocks])
            for name in ("longitudinal", "vertical")
        )
        return AxleSeries(np.concatenate(times), period, along, up)
