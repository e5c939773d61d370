"""The ground of a vehicle at an instant: heights of road and cushion, accelerations of the floor, gravity, and the push of
the road's asperities, between the ends of a segment.
"""

from __future__ import annotations

from typing import NamedTuple

from contact_sim_pkg.compiled.jit import borrowing_kernel

__all__ = ["Ground", "ground_at"]


class Ground(NamedTuple):
    """What moves the rig at an instant."""

    height: float  # [m] of the road under the tire
    height_rate: float  # [m/s]
    cushion: float  # [m] of the unloaded cushion over the floor
    cushion_rate: float  # [m/s]
    acceleration_x: float  # [m/s^2] of the floor
    acceleration_z: float  # [m/s^2] of the floor, or what the drive line gives to the free body of a car
    push: float  # [N] that road asperities add to the tire's force in contact
    gravity: float  # [m/s^2], > 0


@borrowing_kernel
def _between(start, end, part):
    return start + (end - start) * part


@borrowing_kernel
def _push_between(start, end, part):
    if start is None:
        return 0.0
    return _between(start, end, part)


@borrowing_kernel
def _height_between(start, end, rate, rate_end, length, part):
    """Height in [m] and its rate in [m/s] at a ``part`` of a segment of ``length`` [s]: the cubic
    of the heights and rates at its ends, or a straight line where no rates are given.
    """
    rise = end - start
    if rate is None:
        return start + rise * part, rise / length
    # Beside the straight line: nothing at the ends, the rates there
    before, behind = rate * length - rise, rate_end * length - rise
    beside = part * (1.0 - part) * (before * (1.0 - part) - behind * part)
    turned = before * (1.0 - part) * (1.0 - 3.0 * part) + behind * part * (3.0 * part - 2.0)
    return start + rise * part + beside, (rise + turned) / length


@borrowing_kernel
def ground_at(drive, time, gravity):
    """The ground at ``time`` [s] within the segment of a ``drive`` (``integrate/drive.py``), under ``gravity`` [m/s^2]."""
    part = (time - drive.start) / drive.length
    height, height_rate = _height_between(
        drive.height_0, drive.height_1, drive.height_rate_0, drive.height_rate_1, drive.length, part
    )
    cushion, cushion_rate = _height_between(
        drive.cushion_0, drive.cushion_1, drive.cushion_rate_0, drive.cushion_rate_1, drive.length, part
    )
    return Ground(
        height,
        height_rate,
        cushion,
        cushion_rate,
        _between(drive.acceleration_x_0, drive.acceleration_x_1, part),
        _between(drive.acceleration_z_0, drive.acceleration_z_1, part),
        _push_between(drive.push_0, drive.push_1, part),
        gravity,
    )
