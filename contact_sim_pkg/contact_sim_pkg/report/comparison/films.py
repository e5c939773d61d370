"""The films of several runs on one scale, and those of what each presses more than the first, at the slider's time."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib import colormaps
from numpy.typing import NDArray

from contact_sim_pkg.report.comparison.aligned import Alignment
from contact_sim_pkg.report.comparison.instants import SAME, common_instants
from contact_sim_pkg.report.comparison.maps import DIFFERENCE_COLOURS
from contact_sim_pkg.report.film import Film, png_of
from contact_sim_pkg.report.rows import number
from contact_sim_pkg.report.series import FloatArray, Recording
from contact_sim_pkg.report.timeline import (
    MapView,
    Series,
    as_floats,
    as_text,
    data_of,
    film_data,
    films_of,
    groups_of,
    map_view,
)

__all__ = ["RunFilms", "data_of_runs", "films_of_runs"]

UNMOVED = Alignment(0.0, 0.0, 0.0, 1.0, None)
MIDDLE = 128
"""byte of no difference; 1: that of `Difference.largest` less, 255: so much more, 0: nothing presses"""
LEAST_SCALE = 16.0
"""bytes of the films at the end of the colours of a difference: one of them is rounding"""

ROUNDING = 1e-6
"""cells"""

PlaceArray = NDArray[np.uint32]


class Difference(NamedTuple):
    """Where the cells of two films lie on common cells."""

    rows: int
    cols: int
    places: tuple[PlaceArray, PlaceArray]
    """[rows * cols] number of the cell in each film, from 1 on; 0 beside it"""
    largest: float
    """at the ends of the colours, in bytes of the films"""
    cell_x: float
    cell_y: float
    """[m]"""
    instants: FloatArray
    """[s] of both films; none where they have none in common"""

    def frame(self, films: tuple[Film, Film], time: float) -> FloatArray:
        """Second less first film at a time [s], [rows * cols], in bytes of the films; nan where neither presses."""
        first, second = (np.append(0.0, film.at(time))[place] for film, place in zip(films, self.places, strict=True))
        return np.where((first > 0.0) | (second > 0.0), second - first, np.nan)

    def as_bytes(self, frame: FloatArray) -> NDArray[np.uint8]:
        """A frame [rows, cols] as bytes of its colours."""
        scaled = np.clip(np.rint(MIDDLE + 127.0 * frame / self.largest), 1.0, 255.0)
        return np.where(np.isnan(frame), 0.0, scaled).astype(np.uint8).reshape(self.rows, self.cols)


class RunFilms(NamedTuple):
    """Films of all runs and their differences, as the page shows them."""

    views: list[MapView]
    data: list[dict[str, Any]]
    """for the script, in the same order; a difference names its two films by their place"""
    notes: list[str]
    """sentences on grids and times that differ"""


def films_of_runs(
    letters: Sequence[str], recordings: Sequence[Recording], moved: int = 1, by: Alignment = UNMOVED
) -> RunFilms:
    """Films of all contacts, on one scale a contact, and after them those of each run less the first that has one.

    Args:
        letters: of the runs.
        recordings: the runs; which lack a contact's film, a note says.
        moved: which of two is laid over the other.
        by: how it is.
    """
    by_run = [dict(films_of(each)) for each in recordings]
    found = RunFilms([], [], [])
    for contact in dict.fromkeys(contact for each in by_run for contact in each):
        having = [(letter, each[contact]) for letter, each in zip(letters, by_run, strict=True) if contact in each]
        own_letters, films = zip(*having, strict=True)
        _add(found, contact, own_letters, films, moved, by)
        if without := [each for each in letters if each not in own_letters]:
            found.notes.append(f"No map of the {contact} in {', '.join(without)}.")
    return found


def _add(
    found: RunFilms, contact: str, letters: Sequence[str], films: Sequence[Film], moved: int, by: Alignment
) -> None:
    top = max(each.largest for each in films)
    scaled = [each.on_scale(top) for each in films]
    begin = len(found.data)
    for letter, film in zip(letters, scaled, strict=True):
        found.views.append(map_view(f"{letter}: {contact}", film))
        found.data.append(film_data(contact, film))
    for place in range(1, len(films)):
        pair = scaled[0], scaled[place]
        difference = _difference(pair, moved, by)
        found.views.append(_view(f"{letters[place]} − {letters[0]}: {contact}", difference, pair))
        found.data.append({
            "of": [begin, begin + place], "rows": difference.rows, "cols": difference.cols, "largest": difference.largest,
            "instants": as_floats(difference.instants), "unit": 1e-3 * top / 255.0,
            "places": [as_text(each.astype("<u4").tobytes()) for each in difference.places],
        })  # fmt: skip
        found.notes.extend(_notes(contact, letters[0], letters[place], pair, aligned=by is not UNMOVED))


def data_of_runs(letters: Sequence[str], recordings: Sequence[Recording], films: RunFilms) -> str:
    """What the script of the page draws: the series of all runs by their axis, and their films."""
    groups: dict[str, list[Series]] = {}
    for letter, recording in zip(letters, recordings, strict=True):
        for label, series in groups_of(recording):
            groups.setdefault(label, []).extend((f"{letter} {name}", time, values) for name, time, values in series)
    return data_of([*groups.items()], films.data, differences=as_text(_colours().tobytes()))


def _difference(films: tuple[Film, Film], moved: int, by: Alignment) -> Difference:
    """On the cells of the film that is not moved, as many as hold both."""
    fixed, other = films[1 - moved], films[moved]
    rows, cols = other.frames.shape[1:]
    corners = np.array([[x, y] for x in (0, rows - 1) for y in (0, cols - 1)]) * (other.cell_x, other.cell_y)
    corners += other.origin_x, other.origin_y
    cos, sin = math.cos(by.turn), math.sin(by.turn)
    reached = corners @ np.array([[cos, sin], [-sin, cos]]) + (by.shift_x, by.shift_y)
    axes = []
    for axis, (cell, origin) in enumerate(((fixed.cell_x, fixed.origin_x), (fixed.cell_y, fixed.origin_y))):
        ends = (reached[:, axis] - origin) / cell
        low, high = (
            min(0, math.floor(ends.min() + ROUNDING)),
            max(fixed.frames.shape[1 + axis] - 1, math.ceil(ends.max() - ROUNDING)),
        )
        axes.append(origin + cell * np.arange(low, high + 1))
    x, y = np.meshgrid(*axes, indexing="ij")
    across, along = x - by.shift_x, y - by.shift_y
    own, laid = _places(fixed, x, y), _places(other, cos * across + sin * along, cos * along - sin * across)
    places = (own, laid) if moved == 1 else (laid, own)
    common = common_instants(films[0].time, films[1].time)
    found = Difference(x.shape[0], x.shape[1], places, LEAST_SCALE, fixed.cell_x, fixed.cell_y, common)
    shown = common if common.size else films[0].time
    largest = max(float(np.nanmax(np.abs(np.append(found.frame(films, time), 0.0)))) for time in shown)
    return found._replace(largest=max(largest, LEAST_SCALE))


def _places(film: Film, x: FloatArray, y: FloatArray) -> PlaceArray:
    """Numbers from 1 on of the nearest cells of a film at places x, y [m]; 0 beside it."""
    rows, cols = film.frames.shape[1:]
    row, col = np.rint((x - film.origin_x) / film.cell_x), np.rint((y - film.origin_y) / film.cell_y)
    inside = (row >= 0) & (row < rows) & (col >= 0) & (col < cols)
    return np.where(inside, row * cols + col + 1.0, 0.0).astype(np.uint32).ravel()


def _view(name: str, difference: Difference, films: tuple[Film, Film]) -> MapView:
    """The difference at the largest pressure of the first film, or at their last common instant before it."""
    time = float(films[0].time[films[0].highest])
    if difference.instants.size:
        time = float(difference.instants[max(int(np.searchsorted(difference.instants, time + SAME)) - 1, 0)])
    frame, kilo = difference.frame(films, time), 1e-3 * films[0].largest / 255.0
    picture = as_text(png_of(difference.as_bytes(frame), _colours()))
    end = number(kilo * difference.largest)
    least, most = (kilo * float(choose(np.append(frame, 0.0))) for choose in (np.nanmin, np.nanmax))
    length, width = 1e3 * difference.rows * difference.cell_x, 1e3 * difference.cols * difference.cell_y
    return MapView(
        name, picture, difference.rows, difference.cols, width / length, f"{time:.3f} s · {least:.3g} to {most:.3g} kPa", end,
        f"{length:.0f} × {width:.0f} mm", f"-{end}",
    )  # fmt: skip


def _notes(contact: str, first: str, other: str, films: tuple[Film, Film], *, aligned: bool) -> list[str]:
    """What the difference of two films takes that neither recorded."""
    one, two = films
    found = []
    offsets = [(two.origin_x - one.origin_x) / one.cell_x, (two.origin_y - one.origin_y) / one.cell_y]
    alike = math.isclose(one.cell_x, two.cell_x) and math.isclose(one.cell_y, two.cell_y)
    if not alike:
        cells = " and ".join(f"{1e3 * each.cell_x:.3g} × {1e3 * each.cell_y:.3g} mm" for each in films)
        found.append(
            f"The grids of the {contact} differ, cells of {cells} in {first} and {other}: nearest cells are compared."
        )
    elif not aligned and any(abs(each - round(each)) > 0.01 for each in offsets):
        found.append(
            f"The grids of the {contact} in {first} and {other} are part of a cell apart: nearest cells are compared."
        )
    if common_instants(one.time, two.time).size == 0:
        found.append(
            f"The fields of the {contact} in {first} and {other} are of different instants: linear between two."
        )
    return found


def _colours() -> NDArray[np.uint8]:
    """[256, 4] of the bytes of a difference; 0 is blank."""
    found: NDArray[np.uint8] = np.array(colormaps[DIFFERENCE_COLOURS](np.linspace(0.0, 1.0, 256), bytes=True))
    found[0] = 0
    return found
