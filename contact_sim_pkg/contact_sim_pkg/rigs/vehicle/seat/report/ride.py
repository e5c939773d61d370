"""Vibration of a recording: the signals of floor and seat surface, and the ranges that
a run has left.
"""

from __future__ import annotations

from typing import NamedTuple

from contact_sim_pkg.report.ranges import cushion_warnings
from contact_sim_pkg.report.series import FloatArray, MotionSeries, Recording
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


def seat_warnings(recording: Recording) -> list[str]:
    """Ranges of the cushion that the run has left."""
    return cushion_warnings("seat", recording)
