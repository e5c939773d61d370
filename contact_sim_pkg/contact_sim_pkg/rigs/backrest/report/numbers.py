"""Numbers behind the pictures of the backrest: loops, area ratio, shares of stick and slip,
duration of slaps, where a cushion carries.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from contact_sim_pkg.pressure.cushion.sitter import LumbarSupport
from contact_sim_pkg.report.point_series import PointSeries
from contact_sim_pkg.report.ranges import cushion_warnings
from contact_sim_pkg.report.series import EpisodeSeries, FloatArray, PressureMap, Recording
from contact_sim_pkg.report.signal.loops import period_of, vibration_period

BACKREST = "backrest"
"""Name of the contact that these numbers belong to."""
SHARE_ROWS = 200
"""Most intervals over which shares are taken where nothing drives in cycles."""
LUMBAR_REACH = LumbarSupport().length
"""[m] of the back above and below the middle of the lumbar support that counts as lumbar."""


class Shares(NamedTuple):
    """Parts of the time, taken over all candidate points, of each interval."""

    edges: FloatArray
    """[s] [intervals + 1]"""
    apart: FloatArray
    touching: FloatArray
    """carries, no friction in the scene"""
    sticking: FloatArray
    slipping: FloatArray


def drive_period(scene: dict[str, Any]) -> float | None:
    """Period [s] of a sinusoidal vibration, or of the sliding where there is no vibration; None for
    any other drive.
    """
    if isinstance(scene.get("vibration"), dict):
        return vibration_period(scene)
    backrest = scene.get("backrest")
    sliding = backrest.get("sliding") if isinstance(backrest, dict) else None
    return period_of(sliding) if isinstance(sliding, dict) and sliding.get("amplitude") else None


def state_shares(points: PointSeries, period: float | None) -> Shares:
    """Shares of the states over each cycle of the drive, the last one possibly incomplete.

    period: of the drive [s]; None: at most `SHARE_ROWS` intervals over the run.
    """
    begin, step = float(points.time[0]), _interval(points.time)
    end = float(points.time[-1]) + step
    if period is None:
        edges: FloatArray = np.linspace(begin, end, min(SHARE_ROWS, points.time.size) + 1, dtype=np.float64)
    else:
        edges = np.append(np.arange(begin, end - 0.5 * step, max(period, step)), end)
    row = np.clip(np.searchsorted(edges, points.time + 1e-9 * step, side="right") - 1, 0, edges.size - 2)
    total = np.maximum(np.bincount(row, minlength=edges.size - 1), 1) * points.points
    states = (points.apart, points.touching, points.sticking, points.slipping)
    return Shares(edges, *(np.bincount(row, weights=each, minlength=edges.size - 1) / total for each in states))


def _interval(time: FloatArray) -> float:
    return float(time[-1] - time[0]) / (time.size - 1) if time.size > 1 else 1e-3


def heaviest_slap(slaps: EpisodeSeries) -> int | None:
    """Number of the slap with the largest force; None without slaps."""
    return int(slaps.peak_force.argmax()) if slaps.peak_force.size else None


class BackLoad(NamedTuple):
    """Where the mean map of a cushion carries."""

    centre_height: float
    """[m] of the centre of pressure over the lower edge of the seat back"""
    lumbar_share: float
    """part of the load (0 .. 1) within 60 mm of the height of the lumbar support"""


def back_load(recording: Recording) -> BackLoad | None:
    """Load, area and largest pressure change little with a lumbar support, these do. None without a
    cushion, or where it carries nothing.
    """
    keys = ((recording.scene.get("effects") or {}).get(BACKREST) or {}).get("cushion")
    field = recording.fields.get(BACKREST)
    if not keys or field is None:
        return None
    average = field.average
    line = average.pressure.sum(axis=1)
    height = average.origin_x + average.cell_x * np.arange(line.size)
    total = float(line.sum())
    lumbar = np.abs(height - float(keys["lumbar_height"])) < LUMBAR_REACH
    return BackLoad(float(line @ height) / total, float(line[lumbar].sum()) / total) if total > 0.0 else None


def backrest_warnings(recording: Recording) -> list[str]:
    """Ranges of the foam that the run has left, and a back that ends within its footprint."""
    field = recording.fields.get(BACKREST)
    cut = "" if field is None else ends_of_back(field.heaviest.field)
    said = [f"At the largest force {cut} (backrest.back); a fitted curve runs on."] if cut else []
    return [*cushion_warnings("backrest", recording), *said]


def ends_of_back(field: PressureMap) -> str:
    """`the footprint is cut at -250 and 250 mm (up, x), where the back ends`: where cells at the edge of the grid, which is
    that of the back, carry pressure; empty where none does.
    """
    loaded = field.pressure > 0.0
    found = []
    for name, axis, cell, origin in (
        ("up, x", 0, field.cell_x, field.origin_x),
        ("left, y", 1, field.cell_y, field.origin_y),
    ):
        count = loaded.shape[axis]
        ends = ((0, origin - 0.5 * cell), (-1, origin + (count - 0.5) * cell))
        if at := [f"{1e3 * place:.0f}" for number, place in ends if loaded.take(number, axis).any()]:
            found.append(f"{' and '.join(at)} mm ({name})")
    return f"the footprint is cut at {', '.join(found)}, where the back ends" if found else ""
