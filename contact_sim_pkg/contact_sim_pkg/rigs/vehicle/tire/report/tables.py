"""Numbers of a rolling tire: against its state at rest, and its peaks raw and filtered."""

from __future__ import annotations

import math

from contact_sim_pkg.report.rows import number
from contact_sim_pkg.report.series import FieldSeries, FloatArray
from contact_sim_pkg.report.signal.peaks import PeakRow
from contact_sim_pkg.report.tables import Table
from contact_sim_pkg.rigs.vehicle.tire.report.closed_form import TireReference


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
