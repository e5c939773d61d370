"""Numbers of a rolling tire: against its state at rest, and its peaks raw and filtered."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from contact_sim_pkg.report.series import ContactSeries, FieldSeries, FloatArray
from contact_sim_pkg.report.signal.lift_off import lifted_intervals
from contact_sim_pkg.report.signal.peaks import PeakRow
from contact_sim_pkg.report.tables import Table
from contact_sim_pkg.report.tiles import number
from contact_sim_pkg.rigs.vehicle.tire.report.closed_form import TireReference
from contact_sim_pkg.rigs.vehicle.tire.report.numbers import load_numbers
from contact_sim_pkg.rigs.vehicle.tire.report.road_series import WheelTravel

NAMED_LIFT_OFFS = 6
"""Lift-offs that are listed one by one."""


def footprint_table(field: FieldSeries, reference: TireReference | None) -> Table:
    """Load, pressure and size of the footprint: at rest on a flat road, over the run, at the
    largest load.
    """
    touching = field.load > 0.0
    heaviest = int(field.load.argmax())

    def over_run(values: FloatArray) -> float:
        return float(values[touching].mean()) if touching.any() else math.nan

    ratio = 1.0 / reference.peak_pressure if reference is not None else math.nan
    at_rest = _at_rest(reference)
    rows = [
        (label, text(rest), text(over_run(values) * scale), text(float(values[heaviest]) * scale),
         text(float(values.max()) * scale))
        for (label, values, scale), rest in zip(
            [
                ("normal force, N", field.load, 1.0),
                ("peak pressure, kPa", field.peak, 1e-3),
                ("peak pressure over that at rest", field.peak, ratio),
                ("mean pressure, kPa", field.mean, 1e-3),
                ("footprint length, mm", field.length, 1e3),
                ("footprint width, mm", field.width, 1e3),
                ("contact area, cm²", field.area, 1e4),
            ],
            at_rest, strict=True,
        )
    ]  # fmt: skip
    caption = (
        f"At rest: {'elliptic Hertz contact' if reference is None else reference.how} on a flat road with the scene's radii "
        "and modulus. Run: the recorded fields, mean "
        "over those with load; length and width reach over the outermost loaded cells. "
        f"Largest load of a field: {field.load[heaviest]:.4g} N at {field.time[heaviest]:.3f} s."
    )
    return Table(caption, ("footprint", "at rest", "mean of the run", "at the largest load", "largest"), rows)


def _at_rest(reference: TireReference | None) -> list[float]:
    if reference is None:
        return [math.nan] * 7
    return [
        reference.load, reference.peak_pressure * 1e-3, 1.0, reference.load / reference.area * 1e-3, reference.semi_axis_x * 2e3,
        reference.semi_axis_y * 2e3, reference.area * 1e4,
    ]  # fmt: skip


def load_table(contact: ContactSeries, travel: WheelTravel | None, standing: float | None) -> Table:
    """Extremes of the load, dynamic load coefficient, lift-offs and their times; ``standing``: load
    at rest [N].
    """
    numbers = load_numbers(contact, standing)
    intervals = lifted_intervals(contact)
    rows = [
        ("standing load", _with("standing_load_N", numbers, " N")),
        ("largest load over standing load", _with("load_max_over_standing", numbers)),
        ("dynamic load coefficient σ(Fz)/Fz₀", _with("dynamic_load_coefficient", numbers)),
        ("share of the time without load", f"{100.0 * float((contact.normal <= 0.0).mean()):.3g} %"),
        ("lift-offs", str(len(intervals))),
    ]
    # Each lift-off of the first few.
    rows += [
        (f"lift-off {place + 1}", _when(start, end, travel))
        for place, (start, end) in enumerate(intervals[:NAMED_LIFT_OFFS])
    ]
    left = len(intervals) - NAMED_LIFT_OFFS
    caption = f"Samples every {contact.sample_period * 1e3:.3g} ms over the whole run. Lift-off: the normal force is 0."
    if left > 0:
        caption += f" {left} later lift-offs are not listed."
    return Table(caption, ("load", ""), [row for row in rows if row[1]])


def peak_table(peaks: list[PeakRow]) -> Table:
    """Peaks raw and filtered side by side, with their times."""
    rows = [
        (row.label, number(row.raw.value), f"{row.raw.time:.4f}", number(row.filtered.value), f"{row.filtered.time:.4f}",
         f"{row.filtered.value / row.raw.value:.3f}" if row.raw.value else "–")
        for row in peaks
    ]  # fmt: skip
    caption = (
        "Raw: the samples as recorded. Filtered: Butterworth low-pass of order 2 run forward and backward (zero phase, order 4 "
        "in all), a sine of 100 Hz keeps 1/√2, as CFC 60 of SAE J211-1. Largest over the whole run."
    )
    return Table(caption, ("peak", "raw", "at, s", "100 Hz", "at, s", "ratio"), rows)


def text(value: float) -> str:
    """Number with three digits, in the unit of its column ([s], [m], [N]); a dash for NaN or
    infinity.
    """
    return number(value) if math.isfinite(value) else "–"


def _with(key: str, numbers: dict[str, Any], unit: str = "") -> str:
    return f"{numbers[key]:.4g}{unit}" if key in numbers else ""


def _when(start: float, end: float, travel: WheelTravel | None) -> str:
    span = f"{start:.3f} to {end:.3f} s"
    if travel is None:
        return span
    first, last = travel.at(np.array([start, end]))
    return f"{span}, {first:.3f} to {last:.3f} m"
