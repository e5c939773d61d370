"""Two pressure maps laid over each other by the shift and turn that correlate them most: a mat and a run."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from scipy.ndimage import map_coordinates
from scipy.optimize import minimize
from scipy.signal import fftconvolve

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.records.metric import Metric
from contact_sim_pkg.report.metrics.listing import of_field
from contact_sim_pkg.report.metrics.mat import centre
from contact_sim_pkg.report.series import FloatArray, PressureMap, Recording

__all__ = ["Alignment", "MapPair", "align", "compare_maps", "is_mat", "laid_over"]

TURNS = np.radians(np.arange(-180.0, 180.0, 7.5))
"""[rad] that are tried; the best one is refined"""
MOST_CELLS = 160
"""along a side of the grid that they are tried on"""
AS_GOOD = 0.005
"""of the correlation: of turns that fit so much alike the smaller one is taken"""
OTHER = math.radians(30.0)
"""from the turn that was taken, beyond which one that fits as well is another answer"""

TURNED_ROUND = math.radians(45.0)
ALIKE = 0.7
"""correlation of two maps of one contact"""


class Alignment(NamedTuple):
    """Where a map lies on another one: p = R(turn) q + shift takes its places q to places p there."""

    turn: float
    """[rad] from forward to the left, about the origin of the map"""
    shift_x: float
    shift_y: float
    """[m] forward and left"""
    correlation: float
    """integral of the product over the root of those of the squares, 0 to 1"""
    as_good: float | None
    """[rad] another turn that fits as well; None without one"""


def align(fixed: PressureMap, moved: PressureMap) -> Alignment:
    """Lay a map over a fixed one, both with a load, by the largest correlation; of turns that fit alike the smallest.

    The centres of pressure lie over each other first; 48 turns are tried with every shift (by Fourier transform) on a
    common grid, and the best place is refined between the cells (Nelder and Mead).
    """
    own, other = np.array(centre(fixed)), np.array(centre(moved))
    reach = max(_reach(fixed, own), _reach(moved, other))
    cell = max(min(fixed.cell_x, fixed.cell_y, moved.cell_x, moved.cell_y), 2.0 * reach / MOST_CELLS)
    count = math.ceil(reach / cell)
    side = cell * np.arange(-count, count + 1, dtype=np.float64)
    here = _pressures(fixed, 0.0, -own, side, side)
    tried = []
    for turn in TURNS:
        there = _pressures(moved, turn, -_turned(turn, other), side, side)
        products = fftconvolve(here, there[::-1, ::-1], mode="same")
        place = np.unravel_index(int(products.argmax()), products.shape)
        shift = cell * (np.array(place) - (side.size - 1) // 2)
        norm = math.sqrt(float((here**2).sum() * (there**2).sum()))
        tried.append((float(products[place]) / norm, float(turn), shift))
    best = max(tried, key=lambda each: each[0])[0]
    fitting = [each for each in tried if each[0] >= (1.0 - AS_GOOD) * best]
    _, turn, shift = min(fitting, key=lambda each: abs(each[1]))
    # The place between the cells, about the centre of pressure: turn times reach is a length as the shift is
    scale = np.array([1.0 / reach, 1.0, 1.0])

    def missed(place: FloatArray) -> float:
        angle, *by = place * scale
        there = _pressures(moved, angle, -_turned(angle, other) + by, side, side)
        return -float((here * there).sum()) / math.sqrt(float((here**2).sum() * (there**2).sum()) or 1.0)

    start = np.array([turn * reach, *shift])
    simplex = start + cell * np.vstack([np.zeros(3), np.eye(3)])
    options = {"initial_simplex": simplex, "xatol": 1e-4 * cell, "fatol": 1e-10, "maxiter": 400}
    found = minimize(missed, start, method="Nelder-Mead", options=options)
    angle, *by = found.x * scale
    shift = own + by - _turned(angle, other)
    others = [each for each in fitting if abs(_around(each[1] - angle)) > OTHER]
    as_good = max(others, key=lambda each: each[0])[1] if others else None
    return Alignment(_around(float(angle)), float(shift[0]), float(shift[1]), -float(found.fun), as_good)


class MapPair(NamedTuple):
    """Two mean maps of one contact on each other."""

    names: list[str]
    metrics: list[list[Metric]]
    """of each map on its own cells"""
    maps: list[PressureMap]
    """on common cells, one of them moved"""
    moved: int
    """which one, 0 or 1"""
    alignment: Alignment

    @property
    def difference(self) -> FloatArray:
        """Pressure of the second less that of the first [Pa], on the common cells."""
        return self.maps[1].pressure - self.maps[0].pressure

    @property
    def sentences(self) -> list[str]:
        """How they lie on each other, and what is doubtful about it."""
        by, kilo = self.alignment, 1e-3 * self.difference
        rms, largest = math.sqrt(float((kilo**2).mean())), float(np.abs(kilo).max())
        turn = round(math.degrees(by.turn), 1) + 0.0  # no minus before nought
        text = (
            f"{self.names[self.moved]} lies on {self.names[1 - self.moved]} turned by {turn:.1f}° to the left, "
            f"shifted by {1e3 * by.shift_x:.1f} mm forward and {1e3 * by.shift_y:.1f} mm to the left: correlation "
            f"{by.correlation:.3f}; difference: rms {rms:.3g} kPa, at most {largest:.3g} kPa"
        )
        found = [text]
        if by.as_good is not None:
            found.append(f"turned by {math.degrees(by.as_good):.0f}° it fits as well: the maps do not show the turn")
        if abs(by.turn) > TURNED_ROUND:
            found.append("zones and centre are those of the map as it was imported; `bench import --front` turns it")
        if by.correlation < ALIKE:
            found.append(f"a correlation below {ALIKE:g}: the maps are hardly of one contact")
        return found


def is_mat(recording: Recording) -> bool:
    """Whether a recording is of a mat: fields without any force or motion."""
    return bool(recording.fields) and not recording.contacts and recording.motion is None


def compare_maps(names: Sequence[str], recordings: Sequence[Recording], loaded: float) -> MapPair:
    """Lay the mean map of a mat over that of a run or of another mat.

    Args:
        names: of the two.
        recordings: two, one of them a mat.
        loaded: [Pa] above which a cell counts for the metrics.

    Raises:
        BagError: there are not two, or one has no field of the contact, or none with a load.
    """
    if len(recordings) != 2:
        raise BagError(f"a mat is compared with one run or one mat; {len(recordings)} bags are given")
    moved = 0 if is_mat(recordings[0]) and not is_mat(recordings[1]) else 1
    contact = next(iter(recordings[moved].fields))
    fields = [each.fields.get(contact) for each in recordings]
    for name, recording, field in zip(names, recordings, fields, strict=True):
        if field is None or not (field.average.pressure > loaded).any():
            what = "no pressure field" if field is None else f"no pressure above {loaded:g} Pa"
            raise BagError(
                f"{name} has {what} of the contact {contact}; its fields are of {', '.join(recording.fields) or 'none'}; record "
                "one, or say what the mat lies on by `bench import --contact`"
            )
    whole = [field for field in fields if field is not None]
    metrics = [of_field(each, contact, loaded) for each in recordings]
    fixed, other = whole[1 - moved].average, whole[moved].average
    alignment = align(fixed, other)
    maps = [fixed, fixed]
    maps[moved] = laid_over(other, alignment, fixed)
    return MapPair(list(names), metrics, maps, moved, alignment)


def laid_over(moved: PressureMap, by: Alignment, fixed: PressureMap) -> PressureMap:
    """The moved map on the cells of the fixed one, between its own by straight lines; 0 beside it."""
    x = fixed.origin_x + fixed.cell_x * np.arange(fixed.pressure.shape[0], dtype=np.float64)
    y = fixed.origin_y + fixed.cell_y * np.arange(fixed.pressure.shape[1], dtype=np.float64)
    return fixed._replace(pressure=_pressures(moved, by.turn, np.array([by.shift_x, by.shift_y]), x, y))


def _pressures(grid: PressureMap, turn: float, shift: FloatArray, x: FloatArray, y: FloatArray) -> FloatArray:
    """Pressure [Pa] of a map that is turned about its origin and shifted, at places x, y [m]."""
    across, along = x[:, None] - shift[0], y[None, :] - shift[1]
    cos, sin = math.cos(turn), math.sin(turn)
    rows = (cos * across + sin * along - grid.origin_x) / grid.cell_x
    cols = (cos * along - sin * across - grid.origin_y) / grid.cell_y
    found: FloatArray = map_coordinates(grid.pressure, [rows, cols], order=1, mode="grid-constant")
    return found


def _turned(turn: float, place: FloatArray) -> FloatArray:
    cos, sin = math.cos(turn), math.sin(turn)
    return np.array([cos * place[0] - sin * place[1], sin * place[0] + cos * place[1]])


def _reach(grid: PressureMap, middle: FloatArray) -> float:
    """Distance [m] from the centre of pressure to the farthest loaded cell, and a cell more."""
    rows, cols = np.nonzero(grid.pressure)
    x, y = grid.origin_x + grid.cell_x * rows - middle[0], grid.origin_y + grid.cell_y * cols - middle[1]
    return float(np.hypot(x, y).max() + 2.0 * max(grid.cell_x, grid.cell_y))


def _around(angle: float) -> float:
    """The same angle from -pi to pi."""
    return math.remainder(angle, 2.0 * math.pi)
