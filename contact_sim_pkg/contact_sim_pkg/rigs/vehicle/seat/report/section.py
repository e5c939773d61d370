"""Section of the page on the vibration of a seat: spectra and transmissibility."""

from __future__ import annotations

from contact_sim_pkg.report.page import FREQUENCY, Section
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.rigs.vehicle.seat.report.figures_occupant import occupant_pictures
from contact_sim_pkg.rigs.vehicle.seat.report.figures_ride import seat_spectrum, seat_transmissibility
from contact_sim_pkg.rigs.vehicle.seat.report.occupant import occupant_signals
from contact_sim_pkg.rigs.vehicle.seat.report.ride import ride_signals
from contact_sim_pkg.rigs.vehicle.seat.report.travel import seat_travel
from contact_sim_pkg.rigs.vehicle.travel_report import travel_picture


def ride_sections(recording: Recording) -> list[Section]:
    """Call inside `drawing.style()`; none without a seat."""
    signals = ride_signals(recording.motion)
    if signals is None:
        return []
    # A seat on a suspension, and a hard one, has its peak elsewhere
    acting = (recording.scene.get("effects") or {}).get("seat") or {}
    plain = acting.get("suspension") is None and (acting.get("cushion") or {}).get("tissue") is None
    pictures = [seat_spectrum(signals), seat_transmissibility(signals, published=plain)]
    sections = [Section("ride", "Seat vibration", [each for each in pictures if each is not None], part=FREQUENCY)]
    if travel := travel_picture(seat_travel(recording)):
        sections.append(Section("suspension", "Seat suspension", travel))
    occupant = occupant_signals(recording)
    return (
        sections
        if occupant is None
        else [*sections, Section("occupant", "Occupant", occupant_pictures(occupant), part=FREQUENCY)]
    )
