"""The last seconds of a run as frames for the page: series thinned, the newest pressure field of each contact."""

from __future__ import annotations

import json
import math
import struct
import threading
from collections import deque
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact_sim_pkg.bag.encoding import SECOND
from contact_sim_pkg.bag.errors import MessageError
from contact_sim_pkg.bag.topics import TOPICS

__all__ = ["INTERVAL", "SHOWN", "SPAN", "Scope"]

SPAN = 10.0
"""[s] of simulated time that a page shows"""
INTERVAL = 0.005
"""[s] of which a series keeps the smallest and the largest value"""
MOST_CELLS = 1_000_000
SERIES = ("ContactForce", "BodyMotion")
SHOWN = tuple(
    name for name, topic in TOPICS.items()
    if topic.type.rpartition("/")[2] in (*SERIES, "ContactPatch", "SolverCost", "BenchProgress")
)  # fmt: skip
"""Topics that a page is made from."""

Floats = NDArray[np.float32]
Doubles = NDArray[np.float64]


class _Chunk(NamedTuple):
    """A part of the series of one topic."""

    number: int
    topic: str
    end: float
    """[s]"""
    names: tuple[str, ...]
    values: Floats
    """[1 + names, points] times [s], then a series a row"""


class _Map(NamedTuple):
    number: int
    time: float
    record: Any


class Scope:
    """Takes messages from one thread, and gives frames to others.

    A frame holds all that is newer than the last one of its reader, at most SPAN of series and one field a contact: a
    reader that comes seldom misses frames and no peak of the series.
    """

    def __init__(self, can: tuple[str, ...] = ()) -> None:
        """Empty; ``can``: what the page may ask of the source: `pause`, `step`, `seek`."""
        self._lock = threading.Lock()
        self._number = 0
        self._about: dict[str, Any] = {"can": list(can), "paused": False}
        self._clear()

    def _clear(self) -> None:
        self._chunks: deque[_Chunk] = deque()
        self._maps: dict[str, _Map] = {}
        self._largest: dict[str, float] = {}
        self._latest: dict[str, float] = {}
        self._loads: dict[str, float] = {}
        self._from = self._number

    @property
    def number(self) -> int:
        """Of the last change."""
        return self._number

    def clear(self) -> None:
        """Forget the series and fields: another time or another run follows."""
        with self._lock:
            self._clear()
            self._number += 1

    def say(self, **about: Any) -> None:
        """What the page shows in words: `time` [s], `end` [s], `paused`, `can`, `scene`, `state`."""
        with self._lock:
            if any(self._about.get(key) != value for key, value in about.items()):
                self._about.update(about)
                self._number += 1

    def take(self, topic: str, stamp: int, record: Any) -> None:
        """One message.

        Args:
            topic: one of SHOWN.
            stamp: of the message, [ns].
            record: of the type of the topic (`records/messages.py`).

        Raises:
            MessageError: the values of the message do not fit each other.
        """
        kind, time = TOPICS[topic].type.rpartition("/")[2], stamp / SECOND
        with self._lock:
            # a loop, or the next run of a bench
            if kind in SERIES and time < self._latest.get(topic, -math.inf) - 0.5 * INTERVAL:
                self._clear()
            if kind in SERIES:
                self._add(topic, time, record, kind)
            elif kind == "ContactPatch":
                self._add_map(topic, time, record)
            elif kind == "SolverCost":
                self._about |= {"rtf": _finite(record.real_time_factor)}
            else:
                self._about |= {
                    "rtf": _finite(record.real_time_factor), "scene": str(record.scene),
                    "state": int(record.state), "time": time,
                }  # fmt: skip
            self._number += 1

    def _add(self, topic: str, time: float, record: Any, kind: str) -> None:
        period = float(record.sample_period)
        if not 1e-9 <= period <= 1e3:
            raise MessageError(f"{topic} has samples {period} s apart")
        if kind == "BodyMotion":
            names = tuple(str(name).replace("_", " ") for name in record.bodies)
            rows = np.asarray(record.acceleration, dtype=np.float64)
        else:
            names = ("normal", "along")
            rows = np.array([record.normal, record.tangential], dtype=np.float64)
            self._loads[topic] = _finite(rows[0].max(initial=0.0))
            self._about["load"] = max(self._loads.values())
        if not rows.size:
            raise MessageError(f"{topic} has no samples")
        times, values = _thinned(time, period, rows)
        end = time + (rows.shape[1] - 1) * period
        self._latest[topic] = end
        self._about["time"] = max(end, *self._latest.values())
        self._chunks.append(_Chunk(self._number + 1, topic, end, names, np.vstack([times, values]).astype(np.float32)))
        while self._chunks[0].end < end - SPAN:
            self._chunks.popleft()

    def _add_map(self, topic: str, time: float, record: Any) -> None:
        if record.pressure.ndim != 2 or not 0 < record.pressure.size <= MOST_CELLS:
            raise MessageError(f"{topic} has a field of {record.pressure.shape} cells")
        self._largest[topic] = max(self._largest.get(topic, 0.0), _finite(record.peak))
        self._maps[topic] = _Map(self._number + 1, time, record)

    def frame(self, after: int) -> tuple[int, bytes]:
        """The newest frame for a reader whose last one had the number ``after``, 0 at first, and its own number.

        Four bytes with the length of a JSON text, the text filled up to a multiple of four bytes, then 32-bit floats of
        the series of each entry of `plots`, row by row, and the bytes of each of `maps`: 0 no pressure, 255 `largest`.
        """
        with self._lock:
            number, about = self._number, {**self._about, "anew": after <= self._from}
            chunks = [chunk for chunk in self._chunks if chunk.number > after]
            maps = {topic: each for topic, each in self._maps.items() if each.number > after}
            largest = dict(self._largest)
        joined: dict[tuple[str, tuple[str, ...]], list[Floats]] = {}
        for chunk in chunks:
            joined.setdefault((chunk.topic, chunk.names), []).append(chunk.values)
        plots = {key: np.hstack(parts) for key, parts in joined.items()}
        about |= {
            "number": number, "span": SPAN,
            "plots": [
                {"topic": topic, "label": _label(topic), "names": names, "points": values.shape[1]}
                for (topic, names), values in plots.items()
            ],
            "maps": [_about_map(topic, each, largest[topic]) for topic, each in maps.items()],
        }  # fmt: skip
        text = json.dumps(about, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        bodies = [np.ascontiguousarray(values, dtype="<f4").tobytes() for values in plots.values()]
        bodies += [_bytes_of(each.record, largest[topic]) for topic, each in maps.items()]
        return number, b"".join([struct.pack("<I", len(text)), text, *bodies])


def _about_map(topic: str, each: _Map, largest: float) -> dict[str, Any]:
    record = each.record
    return {
        "topic": topic, "name": topic.partition("/")[0], "rows": record.pressure.shape[0], "cols": record.pressure.shape[1],
        "time": each.time, "load": _finite(record.load), "peak": _finite(record.peak), "largest": largest,
    }  # fmt: skip


def _bytes_of(record: Any, largest: float) -> bytes:
    pressure = np.nan_to_num(np.asarray(record.pressure, dtype=np.float32))
    scaled = np.ceil(pressure * (255.0 / largest if largest > 0.0 else 0.0))
    return bytes(np.clip(scaled, 0.0, 255.0).astype(np.uint8).tobytes())


def _thinned(time: float, period: float, rows: Doubles) -> tuple[Doubles, Doubles]:
    """Times [s] and rows of the samples that begin at ``time`` and are ``period`` [s] apart: as they are, or the
    smallest and the largest of every INTERVAL where they are denser than two in it.
    """
    rows = np.nan_to_num(rows).astype(np.float64)
    group = round(INTERVAL / period)
    if group <= 2:
        return np.asarray(time + period * np.arange(rows.shape[1]), dtype=np.float64), rows
    starts = np.arange(0, rows.shape[1], group)
    found: Doubles = np.empty((len(rows), 2 * starts.size))
    found[:, 0::2], found[:, 1::2] = np.minimum.reduceat(rows, starts, 1), np.maximum.reduceat(rows, starts, 1)
    times = np.repeat(np.asarray(time + period * starts, dtype=np.float64), 2)
    times[1::2] += 0.5 * INTERVAL
    return times, found


def _label(topic: str) -> str:
    contact = topic.partition("/")[0]
    return "acceleration, m/s²" if contact == "bench" else f"{contact} force, N"


def _finite(value: Any) -> float:
    """JSON has no other numbers."""
    return float(value) if math.isfinite(value) else 0.0
