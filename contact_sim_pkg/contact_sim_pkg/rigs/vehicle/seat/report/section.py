"""Section of the page on the vibration of a seat: spectra, transmissibility and metrics."""

from __future__ import annotations

import math
from typing import Any

from markupsafe import Markup

from contact_sim_pkg.report.page import Section
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.report.tables import Table
from contact_sim_pkg.rigs.vehicle.seat.report.figures_occupant import occupant_pictures
from contact_sim_pkg.rigs.vehicle.seat.report.figures_ride import seat_spectrum, seat_transmissibility
from contact_sim_pkg.rigs.vehicle.seat.report.occupant import occupant_signals
from contact_sim_pkg.rigs.vehicle.seat.report.ride import ride_signals, vibration_numbers


def ride_sections(recording: Recording) -> list[Section]:
    """Call inside `drawing.style()`; none without a seat."""
    signals = ride_signals(recording.motion)
    if signals is None:
        return []
    pictures = [seat_spectrum(signals), seat_transmissibility(signals)]
    table = vibration_table(vibration_numbers(signals))
    sections = [Section("ride", "Seat vibration", [each for each in pictures if each is not None], [table])]
    occupant = occupant_signals(recording)
    return sections if occupant is None else [*sections, Section("occupant", "Occupant", occupant_pictures(occupant))]


def vibration_table(numbers: dict[str, Any]) -> Table:
    """Metrics of floor and seat, and SEAT, from `vibration_numbers`."""
    header = ("", "rms, m/s²", "weighted rms, m/s²", Markup("VDV, m/s<sup>1.75</sup>"), "crest factor")
    keys = ("rms_m_s2", "weighted_rms_m_s2", "dose_m_s1_75", "crest_factor")
    rows = [(place, *(_text(numbers[f"{place}_{key}"]) for key in keys)) for place in ("floor", "seat")]
    factors = (_text(numbers[f"seat_factor_{key}"], ".1f") for key in ("percent", "dose_percent"))
    caption = (
        "Vertical acceleration over the whole run, mean removed. Weighted with Wk of ISO 2631-1 in the frequency domain. "
        "SEAT is the seat's value over the floor's; a crest factor above 9 makes the rms doubtful."
    )
    if caution := numbers.get("seat_factor_caution"):
        caption += f" SEAT is {caution}."
    return Table(caption, header, [*rows, ("SEAT, %", "", *factors, "")])


def _text(value: float, digits: str = ".3g") -> str:
    """A dash where the number is not defined."""
    return f"{value:{digits}}" if math.isfinite(value) else "–"
