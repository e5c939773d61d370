"""The contact points of one topic, read instant by instant: only one of them and counts are kept of
every instant.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.report.point_series import APART, SLIPS, PointSeries, PointSnapshot

OF_POINT_1 = ("approach", "normal", "tangential", "displacement")
STATES = range(APART, SLIPS + 1)
COUNTS = ("apart", "touching", "sticking", "slipping")


class PointReader:
    """Counts of the states, the course of point 1, and all points at first contact and at the
    largest force.
    """

    def __init__(self) -> None:
        """Nothing read yet."""
        self._rows: list[tuple[float, ...]] = []
        self._points = 0
        self._first: int | None = None
        self._before: float | None = None
        self._touch: tuple[float, Any] | None = None
        self._touched = False
        self._heaviest: tuple[float, Any] | None = None
        self._load = -1.0

    def add(self, time: float, message: Any) -> None:
        """Read the points at `time` [s]. BagError for arrays of different length or another number
        of points.
        """
        count = len(message.x)
        if any(len(getattr(message, name)) != count for name in ("y", "state", *OF_POINT_1)) or not count:
            raise BagError(f"the contact points at {time:.6f} s have arrays of different length, or none at all")
        if self._points not in (0, count):
            raise BagError(f"the contact points at {time:.6f} s are {count}, before they were {self._points}")
        self._points = count
        load = float(np.sum(message.normal))
        if self._first is None and load > 0.0:
            self._first = int(np.argmax(message.normal))
        number = self._first or 0
        counts = (float(np.count_nonzero(np.asarray(message.state) == state)) for state in STATES)
        self._rows.append((time, *counts, *(float(getattr(message, name)[number]) for name in OF_POINT_1)))
        self._keep(time, load, message)

    def _keep(self, time: float, load: float, message: Any) -> None:
        if self._touch is None or (not self._touched and load > 0.0 and self._before == 0.0):
            self._touched = self._touch is not None
            self._touch = time, message
        if load > self._load:
            self._load, self._heaviest = load, (time, message)
        self._before = load

    def finish(self) -> PointSeries:
        """The series of all instants read; at least one."""
        if self._touch is None or self._heaviest is None:
            raise BagError("no contact points were read")
        columns = dict(zip(("time", *COUNTS, *OF_POINT_1), np.array(self._rows).T, strict=True))
        number = self._first or 0
        return PointSeries(
            points=self._points, first_x=float(self._touch[1].x[number]), first_y=float(self._touch[1].y[number]),
            touch=_snapshot(*self._touch), heaviest=_snapshot(*self._heaviest), **columns,
        )  # fmt: skip


def _snapshot(time: float, message: Any) -> PointSnapshot:
    x, y, approach, normal = (
        np.array(getattr(message, name), dtype=np.float64) for name in ("x", "y", "approach", "normal")
    )
    return PointSnapshot(time, x, y, approach, normal, np.array(message.state, dtype=np.uint8))
