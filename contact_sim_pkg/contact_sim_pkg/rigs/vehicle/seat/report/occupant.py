"""Responses of the occupant of a recording: apparent mass, seat-to-head transmissibility."""

from __future__ import annotations

from typing import NamedTuple

from contact_sim_pkg.report.series import FloatArray, Recording
from contact_sim_pkg.report.signal.spectrum import Transmissibility, transmissibility
from contact_sim_pkg.rigs.vehicle.seat.occupants import OccupantModel
from contact_sim_pkg.rigs.vehicle.seat.report.ride import ride_signals

SEAT = "seat"


class OccupantSignals(NamedTuple):
    """What the seat does to the occupant."""

    name: str
    """of the model"""
    model: OccupantModel
    sample_rate: float
    """[Hz]"""
    seat: FloatArray
    """[m/s^2] of the seat surface, upwards"""
    force: FloatArray
    """[N] of the cushion"""
    head: FloatArray | None
    """[m/s^2]; None without a head"""
    approach: FloatArray
    """[m] into the cushion"""
    alone: bool
    """whether the cushion alone carries the occupant"""


def occupant_signals(recording: Recording) -> OccupantSignals | None:
    """Signals of the occupant; None without a seat or its occupant in the scene."""
    from contact_sim_pkg.rigs.vehicle.seat.schema import OccupantSection

    ride, contact = ride_signals(recording.motion), recording.contacts.get(SEAT)
    given = (recording.scene.get(SEAT) or {}).get("occupant")
    if ride is None or contact is None or given is None or recording.motion is None:
        return None
    if len(contact.normal) != len(ride.seat):
        return None
    section = OccupantSection.model_validate(given)
    model = section.model_of()
    head = None if model.head is None else recording.motion.acceleration.get(f"occupant{model.head}_z")
    return OccupantSignals(
        section.model, model, ride.sample_rate, ride.seat, contact.normal, head, contact.approach,
        "backrest" not in recording.contacts,
    )  # fmt: skip


def apparent_mass_of(signals: OccupantSignals) -> Transmissibility:
    """Force on the seat over its acceleration; magnitude in [kg]."""
    return transmissibility(signals.seat, signals.force, signals.sample_rate)


def seat_to_head_of(signals: OccupantSignals) -> Transmissibility | None:
    """Head over seat; None without a head."""
    return None if signals.head is None else transmissibility(signals.seat, signals.head, signals.sample_rate)
