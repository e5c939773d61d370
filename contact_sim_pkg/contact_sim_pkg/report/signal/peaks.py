"""Peaks of a tire's force and of its wheel's acceleration, raw and filtered."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from contact_sim_pkg.report.series import ContactSeries, MotionSeries
from contact_sim_pkg.report.signal.low_pass import FloatArray, Peak, highest, low_pass, lowest

WHEEL = "wheel_z"


class FilteredSignal(NamedTuple):
    """A signal as recorded and through the filter."""

    name: str
    unit: str
    time: FloatArray
    """[s]"""
    raw: FloatArray
    filtered: FloatArray
    peak: Peak
    """of the raw samples: the one that is looked at"""


class PeakRow(NamedTuple):
    """One extreme of one signal."""

    label: str
    raw: Peak
    filtered: Peak


def filtered_signals(contact: ContactSeries, motion: MotionSeries | None) -> list[FilteredSignal]:
    """Normal force, and the wheel's acceleration where it is recorded; empty where sampling is too
    slow for the filter.
    """
    found = [_signal("normal force", "N", contact.time, contact.normal, contact.sample_period)]
    if motion is not None and WHEEL in motion.acceleration:
        wheel = motion.acceleration[WHEEL]
        found.append(_signal("wheel acceleration", "m/s²", motion.time, wheel, motion.sample_period))
    return [signal for signal in found if signal is not None]


def peak_rows(signals: list[FilteredSignal]) -> list[PeakRow]:
    """The largest value of each signal, and the smallest of those that change their sign."""
    rows: list[PeakRow] = []
    for signal in signals:
        label = f"{signal.name}, {signal.unit}"
        if signal.raw.min() >= 0.0:
            rows.append(_row(label, signal, highest))
        else:
            rows += [_row(f"{label}, up", signal, highest), _row(f"{label}, down", signal, lowest)]
    return rows


def _row(label: str, signal: FilteredSignal, find: Callable[[FloatArray, FloatArray], Peak]) -> PeakRow:
    return PeakRow(label, find(signal.time, signal.raw), find(signal.time, signal.filtered))


def _signal(name: str, unit: str, time: FloatArray, raw: FloatArray, period: float) -> FilteredSignal | None:
    filtered = low_pass(raw, 1.0 / period)
    if filtered is None:
        return None
    up, down = highest(time, raw), lowest(time, raw)
    return FilteredSignal(name, unit, time, raw, filtered, up if up.value >= -down.value else down)
