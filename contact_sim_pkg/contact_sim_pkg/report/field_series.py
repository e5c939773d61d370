"""The pressure fields of one topic, read one by one: a minute of them would not fit into a small
memory.
"""

from __future__ import annotations

import math
from collections import deque
from operator import attrgetter
from typing import Any

import numpy as np

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.pressure.field.extent import extent
from contact_sim_pkg.report.film import FilmReader
from contact_sim_pkg.report.series import FieldSeries, FloatArray, PressureMap, Snapshot
from contact_sim_pkg.report.signal.thinning import ThinnedRows

SCALARS = ("load", "peak", "mean", "area", "lame_a", "lame_b", "lame_n", "centre_x", "centre_y")
_scalars_of = attrgetter(*SCALARS)
AROUND_LARGEST_LOAD = 20
"""Fields kept before and after the one with the largest load."""
BLOCK = 0.02
"""[m] side of the square over which a peak is averaged: a tread block, more than a cell"""
HISTORY_ROWS = 4000
"""Most rows of the history of the line load."""


class FieldReader:
    """Scalars of all fields, a few whole fields, and the line load along x over time.

    A contact that outgrows its grid is solved on a wider one of the same cells, so fields of two
    sizes may come. Mean and history are taken over the widest, cells laid over each other by their
    place in the contact's frame.
    """

    def __init__(self) -> None:
        """Nothing read yet."""
        self._scalars: list[tuple[float, ...]] = []
        self._total: FloatArray = np.zeros((0, 0))
        self._widest: Any = None
        self._highest: Any = None
        self._highest_time = 0.0
        self._history_time, self._history = ThinnedRows(HISTORY_ROWS), ThinnedRows(HISTORY_ROWS)
        self._event = _LargestLoad()
        self._film = FilmReader()
        self._first: tuple[float, Any] | None = None
        self._touch: tuple[float, Any] | None = None

    def add(self, time: float, message: Any) -> None:
        """Read the field at `time` [s]. BagError for a field that does not fill its grid, or on
        cells of another size.
        """
        if len(message.pressure) != message.rows * message.cols:
            raise BagError(
                f"the field at {time:.6f} s has {len(message.pressure)} values for {message.rows} x {message.cols} cells"
            )
        self._widen(time, message)
        row, col = place_of(message, self._widest)
        pressure = np.reshape(message.pressure, (message.rows, message.cols))
        # Sum over time, at the place of this grid in the widest one
        self._total[row : row + message.rows, col : col + message.cols] += pressure
        size = extent(pressure) * message.cell_x, extent(pressure.T) * message.cell_y
        self._first = self._first or (time, message)
        if self._touch is None and message.load > 0.0 and self._scalars and self._scalars[-1][1] <= 0.0:
            self._touch = time, message
        over_block = peak_over(pressure, message.cell_x, message.cell_y, BLOCK)
        self._scalars.append((time, *_scalars_of(message), *size, over_block))
        # Line load along x for the space-time picture
        line = np.zeros((1, self._widest.rows))
        line[0, row : row + message.rows] = pressure.sum(axis=1, dtype=np.float64) * message.cell_y
        self._history_time.add(np.array([[time]]))
        self._history.add(line)
        self._event.add(time, message)
        self._film.add(time, message)
        if self._highest is None or message.peak > self._highest.peak:
            self._highest, self._highest_time = message, time

    def _widen(self, time: float, message: Any) -> None:
        """Make room for a grid that is wider than all before."""
        before, shape = self._widest, (message.rows, message.cols)
        if before is None:
            self._widest, self._total = message, np.zeros(shape)
            return
        same_cells = math.isclose(message.cell_x, before.cell_x) and math.isclose(message.cell_y, before.cell_y)
        wider = message.rows >= before.rows and message.cols >= before.cols
        if not same_cells or not (wider or (message.rows <= before.rows and message.cols <= before.cols)):
            raise BagError(
                f"the field at {time:.6f} s lies on {message.rows} x {message.cols} cells of {message.cell_x} x "
                f"{message.cell_y} m, another one on {before.rows} x {before.cols} of {before.cell_x} x {before.cell_y} m; "
                "one grid must hold the other, with the same cells"
            )
        # What was summed so far moves into the wider grid
        if wider and shape != (before.rows, before.cols):
            row, col = place_of(before, message)
            total = np.zeros(shape)
            total[row : row + before.rows, col : col + before.cols] = self._total
            self._history.widen(row, message.rows - before.rows - row)
            self._widest, self._total = message, total

    def finish(self) -> FieldSeries:
        """The series of all fields read; at least one."""
        if self._first is None:
            raise BagError("no field was read")
        time, *columns = np.array(self._scalars).T
        return FieldSeries(
            time=time,
            **dict(zip((*SCALARS, "length", "width", "block_peak"), columns, strict=True)),
            highest=pressure_map(self._highest, self._highest.pressure),
            highest_time=self._highest_time,
            average=pressure_map(self._widest, self._total / time.size),
            event=self._event.finish(),
            film=self._film.finish(self._widest, place_of),
            history_time=self._history_time.finish()[:, 0],
            history=self._history.finish(),
            history_group=self._history.group,
            first=_snapshot(*self._first),
            touch=None if self._touch is None else _snapshot(*self._touch),
        )


class _LargestLoad:
    """The field with the largest load and those just before and after it."""

    def __init__(self) -> None:
        self._recent: deque[tuple[float, Any]] = deque(maxlen=2 * AROUND_LARGEST_LOAD + 1)
        self._kept: list[tuple[float, Any]] = []
        self._load = -math.inf
        self._wanted = 0

    def add(self, time: float, message: Any) -> None:
        """Read the next field; the first of several equal loads counts."""
        self._recent.append((time, message))
        if message.load > self._load:
            self._load, self._wanted = message.load, AROUND_LARGEST_LOAD + 1
        if self._wanted > 0:
            self._wanted -= 1
            if self._wanted == 0:
                self._kept = list(self._recent)

    def finish(self) -> list[Snapshot]:
        """In the order of time; fewer after the largest load where the recording ends."""
        kept = self._kept
        if self._wanted > 0:  # the recording ends less than that many fields after the largest load
            kept = list(self._recent)[self._wanted - 2 * AROUND_LARGEST_LOAD - 1 :]
        return [_snapshot(time, each) for time, each in kept]


def _snapshot(time: float, message: Any) -> Snapshot:
    return Snapshot(time, float(message.load), pressure_map(message, message.pressure))


def peak_over(pressure: Any, cell_x: float, cell_y: float, side: float) -> float:
    """Largest mean pressure [Pa] over squares of ``side`` [m], parts of cells included; of ``pressure`` [rows, cols]
    [Pa], even in each cell of ``cell_x`` by ``cell_y`` [m].

    The integral over a square is bilinear in its place as long as no edge passes one of a cell, so the largest lies
    where one edge along x and one along y does: the near or the far ones.
    """
    rows, cols = (
        min(side / cell, float(size)) for cell, size in zip((cell_x, cell_y), np.shape(pressure), strict=True)
    )
    integral = np.pad(np.asarray(pressure, dtype=np.float64), ((1, 0), (1, 0))).cumsum(axis=0).cumsum(axis=1)
    return float(_strips(_strips(integral, rows).T, cols).max()) / (rows * cols)


def _strips(integral: FloatArray, cells: float) -> FloatArray:
    """Integrals over the strips of so many ``cells`` that begin or end at an edge of a cell, along the first axis of
    an ``integral`` [edges, ...].
    """
    whole, part = divmod(cells, 1.0)
    count = int(whole)
    if part < 1e-9:
        return integral[count:] - integral[: integral.shape[0] - count]
    begun, ended = integral[: -count - 1], integral[count + 1 :]
    from_begin = (1.0 - part) * integral[count:-1] + part * ended - begun
    to_end = ended - (1.0 - part) * integral[1 : integral.shape[0] - count] - part * begun
    return np.concatenate((from_begin, to_end))


def place_of(inner: Any, outer: Any) -> tuple[int, int]:
    """Row and column of `outer` on which cell (0, 0) of `inner` lies, the nearest ones."""
    row = round((inner.origin_x - outer.origin_x) / outer.cell_x)
    col = round((inner.origin_y - outer.origin_y) / outer.cell_y)
    return min(max(row, 0), outer.rows - inner.rows), min(max(col, 0), outer.cols - inner.cols)


def pressure_map(message: Any, pressure: Any) -> PressureMap:
    """The field of a message with other pressures on its grid, or its own."""
    grid = np.array(pressure, dtype=np.float64).reshape(message.rows, message.cols)
    return PressureMap(grid, message.cell_x, message.cell_y, message.origin_x, message.origin_y)
