"""Peaks raw and filtered, side by side."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from contact_sim_pkg.report.drawing import ACCENT, MUTED, Picture, new_figure, picture
from contact_sim_pkg.report.signal.low_pass import Peak, highest, lowest
from contact_sim_pkg.report.signal.peaks import FilteredSignal

BEFORE, AFTER = 0.05, 0.08
"""[s] shown before and after a peak"""


def peak_curves(key: str, name: str, signals: list[FilteredSignal]) -> Picture:
    """Each signal around its largest magnitude, as sampled and through the 100 Hz filter."""
    figure, axes = new_figure(2.8, 1, max(2, len(signals)))
    for place, signal in zip(axes, signals, strict=False):
        _draw(place, signal)
    for place in axes[len(signals) :]:
        place.set_axis_off()
    # Numbers of the caption: each peak raw and filtered
    parts = []
    for signal in signals:
        soft = _filtered_peak(signal)
        parts.append(
            f"{signal.name} {signal.peak.value:.5g} {signal.unit} raw at {signal.peak.time:.4f} s, {soft.value:.5g} "
            f"{signal.unit} filtered at {soft.time:.4f} s"
        )
    caption = (
        f"Around the largest peaks of the {name}: {'; '.join(parts)}. Grey as sampled, blue through the filter; crosses are "
        "the peaks. The filter is a Butterworth low-pass of order 2 run forward and backward: no phase, −3 dB at 100 Hz. "
        "Peaks of one or two milliseconds belong to edges and to the solver as much as to the tire: compare the filtered ones."
    )
    return picture(f"{key}-peaks", figure, f"Peaks of the {name} raw and filtered at 100 Hz", caption)


def _draw(axes: Axes, signal: FilteredSignal) -> None:
    scale, unit = (1e-3, "kN") if signal.unit == "N" and abs(signal.peak.value) >= 2000.0 else (1.0, signal.unit)
    shown = (signal.time >= signal.peak.time - BEFORE) & (signal.time <= signal.peak.time + AFTER)
    time = signal.time[shown]
    axes.plot(time, signal.raw[shown] * scale, color=MUTED, linewidth=0.8, marker=".", markersize=3.0, label="raw")
    axes.plot(time, signal.filtered[shown] * scale, color=ACCENT, linewidth=1.3, label="100 Hz")
    soft = _filtered_peak(signal)
    axes.plot([signal.peak.time], [signal.peak.value * scale], marker="x", color=MUTED, markersize=7, linestyle="")
    if time[0] <= soft.time <= time[-1]:
        axes.plot([soft.time], [soft.value * scale], marker="x", color=ACCENT, markersize=7, linestyle="")
    axes.locator_params(axis="x", nbins=4)  # instants of a long run have many digits
    axes.set_xlabel("simulated time, s")
    axes.set_ylabel(f"{signal.name}, {unit}")
    axes.legend(loc="best")


def _filtered_peak(signal: FilteredSignal) -> Peak:
    find = highest if signal.peak.value >= 0.0 else lowest
    return find(signal.time, np.asarray(signal.filtered))
