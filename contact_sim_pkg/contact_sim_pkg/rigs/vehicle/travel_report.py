"""Travel between two stops in a report: how much of it a run uses, and how often a stop is hit."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact_sim_pkg.records.metric import EVENT, Metric
from contact_sim_pkg.report.drawing import ACCENT, MUTED, Picture, draw_series, new_figure, picture
from contact_sim_pkg.report.metrics.maker import Maker
from contact_sim_pkg.report.series import FloatArray, Recording

__all__ = ["Travel", "heights_of", "keys_of", "travel_metrics", "travel_of", "travel_picture"]


class Travel(NamedTuple):
    """Height of a mass over another, and where the stops begin."""

    contact: str
    what: str
    time: FloatArray
    """[s]"""
    sample_period: float
    """[s]"""
    height: FloatArray
    """[m]"""
    low: float
    high: float
    """[m]"""

    @property
    def used(self) -> float:
        """Way from the lowest to the highest place over that between the stops [1]."""
        return float(np.ptp(self.height)) / (self.high - self.low)

    @property
    def on_stop(self) -> NDArray[np.bool_]:
        """Whether it is beyond where a stop begins [samples]."""
        found: NDArray[np.bool_] = (self.height < self.low) | (self.height > self.high)
        return found

    @property
    def hits(self) -> int:
        """How often a stop is reached; once where the run begins on it."""
        return int(self.on_stop[0]) + int(np.count_nonzero(~self.on_stop[:-1] & self.on_stop[1:]))


def travel_metrics(travel: Travel | None) -> list[Metric]:
    """Share of the travel that is used, and hits of its stops; none without a travel."""
    if travel is None:
        return []
    window = float(travel.time[0]), float(travel.time[-1]) + travel.sample_period
    make = Maker(travel.contact, "bench/motion", window, basis=EVENT).make
    low, high = 1e3 * float(travel.height.min()), 1e3 * float(travel.height.max())
    free = f"{low:.3g} to {high:.3g} mm, free {1e3 * travel.low:.3g} to {1e3 * travel.high:.3g} mm"
    if travel.on_stop.any():
        free += f"; on a stop for {100.0 * travel.on_stop.mean():.3g} % of the run"
    count = travel.height.size
    return [
        make("travel_used", f"{travel.what}, share used", 100.0 * travel.used, "%", count=count, remark=free),
        make("stop_hits", f"{travel.what}, stops hit", float(travel.hits), "", count=count),
    ]


def travel_picture(travel: Travel | None) -> list[Picture]:
    """The travel over time between its stops; none without one. Call inside `drawing.style()`."""
    if travel is None:
        return []
    figure, (axes,) = new_figure(2.4)
    band = draw_series(axes, travel.time, 1e3 * travel.height, color=ACCENT)
    for stop in (travel.low, travel.high):
        axes.axhline(1e3 * stop, color=MUTED, linewidth=0.9, linestyle=(0, (4, 3)))
    axes.set_xlabel("time, s")
    axes.set_ylabel("height, mm")
    caption = (
        f"Travel: {100.0 * travel.used:.3g} % of the way between the stops (dashed) is used; they are hit {travel.hits} times."
        f"{band}"
    )
    return [picture(f"{travel.contact}-travel", figure, f"Travel of the {travel.what} between its stops", caption)]


def heights_of(recording: Recording) -> Mapping[str, FloatArray]:
    """Heights [m] by body; none without a motion."""
    return {} if recording.motion is None else recording.motion.position


def keys_of(recording: Recording, contact: str, effect: str) -> Mapping[str, Any] | None:
    """Keys of an effect of the recorded scene; None without it."""
    named = (recording.scene.get("effects") or {}).get(contact) or {}
    found: Mapping[str, Any] | None = named.get(effect)
    return found


def travel_of(
    recording: Recording, contact: str, what: str, height: FloatArray, stops: tuple[float, float]
) -> Travel | None:
    """A height [m] over time between two ``stops`` [m]; None of fewer than two samples."""
    motion = recording.motion
    if motion is None or motion.time.size < 2:
        return None
    return Travel(contact, what, motion.time, motion.sample_period, height, *stops)
