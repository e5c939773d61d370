"""Vibration of a recording: the signals of floor and seat surface, their metrics, and the key
numbers of the page.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from contact_sim_pkg.report.ranges import cushion_warnings
from contact_sim_pkg.report.series import FloatArray, MotionSeries, Recording
from contact_sim_pkg.report.signal.metrics import ride_metrics, seat_factor
from contact_sim_pkg.report.signal.spectrum import shortage_of_record
from contact_sim_pkg.report.tiles import Tile, number
from contact_sim_pkg.rigs.vehicle.seat.response import FLOOR_BODIES, SEAT_BODY


class RideSignals(NamedTuple):
    """Vertical accelerations below and on the cushion."""

    time: FloatArray
    """[s]"""
    sample_rate: float
    """[Hz]"""
    floor: FloatArray
    seat: FloatArray
    """[m/s^2]"""


def ride_signals(motion: MotionSeries | None) -> RideSignals | None:
    """Floor and seat surface; None for a rig without a seat, or a recording of fewer than 2
    samples.
    """
    if motion is None or motion.time.size < 2:
        return None
    seat = motion.acceleration.get(SEAT_BODY)
    floor = next((motion.acceleration[name] for name in FLOOR_BODIES if name in motion.acceleration), None)
    if seat is None or floor is None:
        return None
    return RideSignals(motion.time, 1.0 / motion.sample_period, floor, seat)


def vibration_numbers(signals: RideSignals) -> dict[str, Any]:
    """Floor and seat accelerations, plain and Wk-weighted, and SEAT in per cent; where the record is
    short, what is to be said of SEAT and of a peak.
    """
    floor = ride_metrics(signals.floor, signals.sample_rate)
    seat = ride_metrics(signals.seat, signals.sample_rate)
    caution = shortage_of_record(signals.time.size, signals.sample_rate)
    return {
        "floor_rms_m_s2": floor.rms,
        "floor_weighted_rms_m_s2": floor.weighted_rms,
        "floor_dose_m_s1_75": floor.vibration_dose,
        "floor_crest_factor": floor.crest_factor,
        "seat_rms_m_s2": seat.rms,
        "seat_weighted_rms_m_s2": seat.weighted_rms,
        "seat_dose_m_s1_75": seat.vibration_dose,
        "seat_crest_factor": seat.crest_factor,
        "seat_factor_percent": seat_factor(seat.weighted_rms, floor.weighted_rms),
        "seat_factor_dose_percent": seat_factor(seat.vibration_dose, floor.vibration_dose),
        **({"seat_factor_caution": caution} if caution else {}),
    }


def ride_tiles(summary: dict[str, Any]) -> list[Tile]:
    """Weighted acceleration of the seat and SEAT; none without a seat."""
    vibration = summary.get("seat_vibration")
    if not vibration:
        return []
    detail = f"Wk; not weighted {number(vibration['seat_rms_m_s2'])} m/s²"
    found = [Tile("seat vibration", number(vibration["seat_weighted_rms_m_s2"]), "m/s²", detail)]
    if vibration["seat_factor_percent"] is not None:
        detail = f"floor {number(vibration['floor_weighted_rms_m_s2'])} m/s², Wk"
        if caution := vibration.get("seat_factor_caution"):
            detail += f"; {caution}"
        found.append(Tile("SEAT", number(vibration["seat_factor_percent"]), "%", detail))
    return found


def seat_warnings(recording: Recording) -> list[str]:
    """Ranges of the cushion that the run has left."""
    return cushion_warnings("seat", recording)
