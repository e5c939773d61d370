"""Numbers behind the pictures of the backrest: loops, area ratio, shares of stick and slip, duration of slaps."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from scipy.integrate import trapezoid
from scipy.interpolate import CubicSpline

from contact_sim_pkg.report.point_series import PointSeries
from contact_sim_pkg.report.series import ContactSeries, EpisodeSeries, FieldSeries, FloatArray

BACKREST = "backrest"
"""Name of the contact that these numbers belong to."""
LAST_CYCLES = 2
"""Cycles of the drive at the end of a run that stand for its steady state."""
FEW_INSTANTS = 100
"""Fewer of them in the last cycles would make corners of a loop: it is shown as dots, over the second half of the run."""
SHARE_ROWS = 200
"""Most stretches over which shares are taken where nothing drives in cycles."""


class Loop(NamedTuple):
    """A force over the displacement it works on, in the order of time."""

    time: FloatArray
    """[s]"""
    displacement: FloatArray
    """[m]"""
    force: FloatArray
    """[N]"""

    def since(self, time: float) -> Loop:
        """The part from this time [s] on."""
        chosen = self.time >= time
        return Loop(*(column[chosen] for column in self))

    def steady(self, begin: float) -> tuple[Loop, bool]:
        """What stands for the steady state of a run whose last cycles begin at `begin` [s]; whether it is shown as dots."""
        last = self.since(begin)
        if begin <= 0.0 or last.time.size >= FEW_INSTANTS:
            return last, False
        return self.since(min(begin, 0.5 * float(self.time[-1]))), True


class AreaRatio(NamedTuple):
    """Area of the contact domain over the area under the static load."""

    time: FloatArray
    """[s]"""
    ratio: FloatArray
    reference: float
    """[m^2] S_ref"""


class Shares(NamedTuple):
    """Parts of the time, taken over all candidate points, of each stretch."""

    edges: FloatArray
    """[s] [stretches + 1]"""
    apart: FloatArray
    touching: FloatArray
    """carries, no friction in the scene"""
    sticking: FloatArray
    slipping: FloatArray


def drive_period(scene: dict[str, Any]) -> float | None:
    """Period [s] of a sinusoidal vibration, or of the sliding where there is no vibration; None for any other drive."""
    vibration, backrest = scene.get("vibration"), scene.get("backrest")
    if isinstance(vibration, dict):
        return _period(vibration) if vibration.get("kind") == "sine" else None
    sliding = backrest.get("sliding") if isinstance(backrest, dict) else None
    return _period(sliding) if isinstance(sliding, dict) and sliding.get("amplitude") else None


def _period(section: dict[str, Any]) -> float | None:
    frequency = section.get("frequency")
    return 1.0 / frequency if isinstance(frequency, (int, float)) and frequency > 0.0 else None


def steady_start(end: float, period: float | None, cycles: int = LAST_CYCLES) -> float:
    """Time [s] from which the last `cycles` cycles run to `end` [s]; 0 without a period or in a shorter run."""
    return 0.0 if period is None else max(0.0, end - cycles * period)


def normal_loop(contact: ContactSeries) -> Loop:
    """Normal force of the whole contact over the approach of its deepest point, at the full rate."""
    return Loop(contact.time, contact.approach, contact.normal)


def point_loop(points: PointSeries) -> Loop:
    """Normal force over approach of point 1, at the rate of the fields."""
    return Loop(points.time, points.approach, points.normal)


def tangential_loop(contact: ContactSeries, points: PointSeries) -> Loop:
    """Friction of point 1 on the seat back, F_t of the paper's eq 9, over the displacement of the back along it.

    A single point is the whole contact, whose force is recorded at the full rate; its displacement, recorded at the rate of the
    fields, is then taken between by a cubic spline. Of one of many points both are at the rate of the fields. (The bag has
    the force on the back, of the other sign.)
    """
    if points.points > 1 or points.time.size < 4:
        return Loop(points.time, points.displacement, -points.tangential)
    inside = (contact.time >= points.time[0]) & (contact.time <= points.time[-1])
    time = contact.time[inside]
    displacement: FloatArray = CubicSpline(points.time, points.displacement)(time)
    return Loop(time, displacement, -contact.tangential[inside])


def loop_work(loop: Loop) -> float:
    """Work [J] done along the loop, integral of F d(displacement) by trapezia."""
    return float(trapezoid(loop.force, loop.displacement))


def area_ratio(field: FieldSeries) -> AreaRatio | None:
    """S(t)/S_ref; S_ref is the area of the first field, at rest under the static load. None where that is not in the bag."""
    if field.time[0] > 0.0 or field.area[0] <= 0.0:
        return None
    reference = float(field.area[0])
    return AreaRatio(field.time, field.area / reference, reference)


def state_shares(points: PointSeries, period: float | None) -> Shares:
    """Shares over each cycle of the drive, the last one as far as it goes; without one over at most `SHARE_ROWS` stretches."""
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


def durations(slaps: EpisodeSeries) -> FloatArray:
    """From the touch to the loss of force in [s], of each slap."""
    lasted: FloatArray = slaps.end - slaps.start
    return lasted


def heaviest_slap(slaps: EpisodeSeries) -> int | None:
    """Number of the slap with the largest force; None without slaps."""
    return int(slaps.peak_force.argmax()) if slaps.peak_force.size else None


def slaps_of(episodes: EpisodeSeries | None) -> EpisodeSeries:
    """The slaps of the whole contact; none where the bag has no episodes."""
    return EpisodeSeries(*(np.zeros(0) for _ in EpisodeSeries._fields)) if episodes is None else episodes.slaps()
