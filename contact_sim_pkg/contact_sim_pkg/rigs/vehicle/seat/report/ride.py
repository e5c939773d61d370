"""Which signals of a recording are the floor and the seat surface."""

from __future__ import annotations

from typing import NamedTuple

from contact_sim_pkg.report.series import FloatArray, MotionSeries

SEAT_BODIES = ("seat_frame_z",)
"""The mass that rests on the cushion moves as the seat surface does."""
FLOOR_BODIES = ("floor_z", "body_z")
"""The seat stands on the platform, or on the body of the car."""


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
    """Floor and seat surface; None for a rig without a seat, or a recording of fewer than 2 samples."""
    if motion is None or motion.time.size < 2:
        return None
    seat = next((motion.acceleration[name] for name in SEAT_BODIES if name in motion.acceleration), None)
    floor = next((motion.acceleration[name] for name in FLOOR_BODIES if name in motion.acceleration), None)
    if seat is None or floor is None:
        return None
    return RideSignals(motion.time, 1.0 / motion.sample_period, floor, seat)
