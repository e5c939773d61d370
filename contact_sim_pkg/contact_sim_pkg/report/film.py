"""The pressure maps of a run as frames of bytes, few enough for a page."""

from __future__ import annotations

import io
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["Film", "FilmReader", "png_of"]

MOST_FRAMES, LEAST_FRAMES, MOST_CELLS = 300, 40, 300_000
"""Frames of a film, and values of all of them."""

ByteArray = NDArray[np.uint8]


class Film(NamedTuple):
    """Frames of a contact, cut to the cells that are ever loaded."""

    time: NDArray[np.float64]
    """[s] [frames], ascending: never taken from their numbers"""
    load: NDArray[np.float64]
    """[N] [frames]"""
    peak: NDArray[np.float64]
    """[Pa] [frames]"""
    frames: ByteArray
    """[frames, rows, cols] 0: no pressure; 1 .. 255: linear up to `largest`"""
    largest: float
    """[Pa]"""
    cell_x: float
    cell_y: float
    """[m]"""
    origin_x: float = 0.0
    origin_y: float = 0.0
    """[m] centre of cell (0, 0), forward and left"""

    def on_scale(self, largest: float) -> Film:
        """The film with 255 at ``largest`` [Pa], which is not below its own."""
        scaled = np.ceil(self.frames * (self.largest / largest if largest > 0.0 else 0.0))
        return self._replace(frames=scaled.astype(np.uint8), largest=largest)

    def at(self, time: float) -> NDArray[np.float64]:
        """Values [rows, cols] at a time [s], between two frames along a straight line."""
        after = int(np.clip(np.searchsorted(self.time, time), 1, max(self.time.size - 1, 1)))
        first, last = after - 1, min(after, self.time.size - 1)
        between = self.time[last] - self.time[first]
        share = float(np.clip((time - self.time[first]) / between, 0.0, 1.0)) if between > 0.0 else 0.0
        found: NDArray[np.float64] = (1.0 - share) * self.frames[first] + share * self.frames[last]
        return found

    @property
    def highest(self) -> int:
        """The frame with the largest pressure."""
        return int(self.peak.argmax())


class FilmReader:
    """Keeps every n-th field, n doubling as they become many, and those of the largest load and the largest peak."""

    def __init__(self, most: int | None = None) -> None:
        """Nothing read yet; ``most``: fields that are kept, as many as a page has room for where it is None."""
        self._most = most
        self._kept: list[tuple[float, Any]] = []
        self._largest: dict[str, tuple[float, Any]] = {}
        self._stride = self._read = 0

    def add(self, time: float, message: Any) -> None:
        """Read the field at `time` [s]."""
        self._stride = self._stride or 1
        if self._read % self._stride == 0:
            self._kept.append((time, message))
        self._read += 1
        if len(self._kept) > (self._most or _most(message)):
            self._kept, self._stride = self._kept[::2], 2 * self._stride
        for name in ("load", "peak"):
            before = self._largest.get(name)
            if before is None or getattr(message, name) > getattr(before[1], name):
                self._largest[name] = time, message

    def finish(self, widest: Any, place: Callable[[Any, Any], tuple[int, int]]) -> Film:
        """The frames on the ``widest`` grid; ``place``: row and column of a grid in another."""
        chosen = dict([*self._kept, *self._largest.values()])  # by time: none twice
        times = sorted(chosen)
        pressure = np.zeros((len(times), widest.rows, widest.cols), dtype=np.float32)
        for number, time in enumerate(times):
            message = chosen[time]
            row, col = place(message, widest)
            field = np.reshape(message.pressure, (message.rows, message.cols))
            pressure[number, row : row + message.rows, col : col + message.cols] = np.nan_to_num(field)
        rows, cols = (np.flatnonzero(pressure.any(axis=axes)) for axes in ((0, 2), (0, 1)))
        row, col = (max(int(each[0]) - 1, 0) if each.size else 0 for each in (rows, cols))
        if rows.size:
            pressure = pressure[:, row : rows[-1] + 2, col : cols[-1] + 2]
        largest = float(pressure.max(initial=0.0))
        scaled = np.ceil(pressure * (255.0 / largest if largest > 0.0 else 0.0))
        loads, peaks = (np.array([float(getattr(chosen[time], name)) for time in times]) for name in ("load", "peak"))
        frames = np.clip(scaled, 0.0, 255.0).astype(np.uint8)
        origin = widest.origin_x + row * widest.cell_x, widest.origin_y + col * widest.cell_y
        return Film(np.array(times), loads, peaks, frames, largest, widest.cell_x, widest.cell_y, *origin)


def png_of(frame: ByteArray, colours: ByteArray) -> bytes:
    """A frame [rows, cols] as PNG, forward up and left on the left, by ``colours`` [256, 4]."""
    from matplotlib.image import imsave

    file = io.BytesIO()
    imsave(file, colours[frame[::-1, ::-1]], format="png")
    return file.getvalue()


def _most(message: Any) -> int:
    """Frames of a grid whose number of values is bounded."""
    return int(np.clip(MOST_CELLS // max(message.rows * message.cols, 1), LEAST_FRAMES, MOST_FRAMES))
