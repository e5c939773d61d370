"""The series of runs for the page's interactive view, on one axis of time, and the films that its cursor moves."""

from __future__ import annotations

import base64
import json
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib import colormaps
from numpy.typing import ArrayLike, NDArray

from contact_sim_pkg.report.drawing import PRESSURE_COLOURS
from contact_sim_pkg.report.film import Film, png_of
from contact_sim_pkg.report.rows import number
from contact_sim_pkg.report.series import FloatArray, Recording

__all__ = [
    "MapView", "Series", "as_floats", "as_text", "colours_as_text", "data_of", "film_data", "films_of", "groups_of", "map_view",
    "map_views", "page_data",
]  # fmt: skip

INTERVALS = 1000
"""Intervals of the view; each shows the smallest and the largest value in it."""


class MapView(NamedTuple):
    """A film as the page shows it before its script runs: the frame with the largest pressure."""

    name: str
    picture: str
    """PNG as base64"""
    rows: int
    cols: int
    aspect: float
    """width over height"""
    text: str
    largest: str
    """[kPa] at the upper end of the colours"""
    size: str
    """[mm] length and width of what is shown"""
    least: str = "0"
    """[kPa] at the lower end of the colours"""


def map_views(recording: Recording) -> list[MapView]:
    """A view a contact with a pressure field that carries a load."""
    return [map_view(name, film) for name, film in films_of(recording)]


def map_view(name: str, film: Film) -> MapView:
    """A film at its largest pressure."""
    place = film.highest
    _, rows, cols = film.frames.shape
    length, width = 1e3 * rows * film.cell_x, 1e3 * cols * film.cell_y
    said = frame_text(film.time[place], film.load[place], film.peak[place])
    picture = as_text(png_of(film.frames[place], _colours()))
    return MapView(
        name, picture, rows, cols, width / length, said, number(1e-3 * film.largest), f"{length:.0f} × {width:.0f} mm"
    )


def frame_text(time: float, load: float, peak: float) -> str:
    """`0.570 s · 4200 N · peak 450 kPa`, as the script writes it too."""
    return f"{time:.3f} s · {load:.0f} N · peak {1e-3 * peak:.0f} kPa"


def page_data(recording: Recording) -> str:
    """What the script of the page of a run draws: `data_of`, over distance too where the run travels."""
    road = recording.series.get("road")
    travel = None if road is None or np.ptp(road.travel.distance) <= 0.01 else road.travel.at
    films = [film_data(name, film) for name, film in films_of(recording)]
    return data_of(groups_of(recording), films, travel)


def data_of(
    groups: Sequence[tuple[str, list[Series]]],
    films: Sequence[dict[str, Any]],
    distance: Callable[[FloatArray], FloatArray] | None = None,
    **more: Any,
) -> str:
    """What the script of a page draws, as JSON that is safe inside an element of a page.

    Numbers are base64 of little-endian 32-bit floats, frames of bytes.
    """
    start, end = _span(groups)
    edges = np.linspace(start, end, INTERVALS + 1)
    times = np.repeat(edges[:-1], 2)
    times[1::2] += 0.5 * (edges[1] - edges[0])
    data: dict[str, Any] = {
        "time": as_floats(times),
        "distance": None if distance is None else as_floats(distance(times)),
        "groups": [
            {"label": label, "series": [{"name": name, "values": as_floats(_on(edges, times, time, values))}
                                        for name, time, values in series]}
            for label, series in groups
        ],
        "films": films,
        "colours": colours_as_text(),
        **more,
    }  # fmt: skip
    # inside <script> only "<" could end the element
    return json.dumps(data, separators=(",", ":")).replace("<", "\\u003c")


Series = tuple[str, FloatArray, FloatArray]


def groups_of(recording: Recording) -> list[tuple[str, list[Series]]]:
    """Series that share an axis, by its label."""
    contacts, fields, motion = recording.contacts, recording.fields, recording.motion
    forces: list[Series] = []
    for name, contact in contacts.items():
        forces.append((name, contact.time, contact.normal))
        if np.any(contact.tangential):
            forces.append((f"{name}, along", contact.time, contact.tangential))
    found: list[tuple[str, list[Series]]] = [
        ("force, N", forces),
        (
            "peak pressure, kPa",
            [(name, each.time, 1e-3 * each.peak) for name, each in fields.items() if each.time.size > 1],
        ),
        ("approach, mm", [(name, each.time, 1e3 * each.approach) for name, each in contacts.items()]),
    ]
    if motion is not None:
        bodies = [(name.replace("_", " "), motion.time, values) for name, values in motion.acceleration.items()]
        found.insert(1, ("acceleration, m/s²", [each for each in bodies if np.any(each[2])]))
    return [(label, series) for label, series in found if series]


def films_of(recording: Recording) -> list[tuple[str, Film]]:
    """Contacts whose field carries a load, with its film."""
    return [(name, field.film) for name, field in recording.fields.items() if field.film.largest > 0.0]


def film_data(name: str, film: Film) -> dict[str, Any]:
    """A film as the script takes it."""
    return {
        "name": name, "rows": film.frames.shape[1], "cols": film.frames.shape[2], "time": as_floats(film.time),
        "load": as_floats(film.load), "peak": as_floats(1e-3 * film.peak),
        "frames": as_text(film.frames.tobytes()),
    }  # fmt: skip


def _span(groups: Sequence[tuple[str, list[Series]]]) -> tuple[float, float]:
    """[s] from the first to the last sample."""
    times = [time for _, series in groups for _, time, _ in series if time.size]
    if not times:
        return 0.0, 1.0
    start, end = min(float(time[0]) for time in times), max(float(time[-1]) for time in times)
    return start, max(end, start + 1e-6)


def _on(edges: FloatArray, times: FloatArray, time: FloatArray, values: FloatArray) -> FloatArray:
    """Two values an interval, the smallest and the largest in the order in which they came, so that no peak is lost;
    a series with fewer samples is interpolated at ``times``, and nan beyond its ends.
    """
    values = np.nan_to_num(values)
    starts = np.clip(np.searchsorted(time, edges[:-1]), 0, time.size - 1)
    if time.size <= 2 * edges.size or np.any(np.diff(starts) == 0):
        beyond = float(edges[1] - edges[0]) + (float(np.diff(time).max()) if time.size > 1 else np.inf)
        inside = (times >= time[0] - beyond) & (times <= time[-1] + beyond)
        return np.where(inside, np.interp(times, time, values), np.nan)
    low, high = np.minimum.reduceat(values, starts), np.maximum.reduceat(values, starts)
    rising = values[starts] <= values[np.append(starts[1:], time.size) - 1]
    found = np.empty(2 * low.size)
    found[0::2], found[1::2] = np.where(rising, low, high), np.where(rising, high, low)
    return found


def as_floats(values: ArrayLike) -> str:
    """Numbers as base64 of little-endian 32-bit floats."""
    return as_text(np.asarray(values, dtype="<f4").tobytes())


def as_text(values: bytes) -> str:
    """Bytes as base64."""
    return base64.b64encode(values).decode()


def colours_as_text() -> str:
    """Four bytes a byte of a frame, as base64."""
    return as_text(_colours().tobytes())


def _colours() -> NDArray[np.uint8]:
    """[256, 4] of the bytes of a frame; 0 is blank."""
    found: NDArray[np.uint8] = colormaps[PRESSURE_COLOURS](np.linspace(0.0, 1.0, 256), bytes=True)
    found = np.array(found)
    found[0] = 0
    return found
