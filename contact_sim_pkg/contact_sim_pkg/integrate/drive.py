"""What moves a rig during one segment, in SI units."""

from __future__ import annotations

from typing import NamedTuple


class Drive(NamedTuple):
    """What moves a rig during one segment: values that change linearly from its start to its end;
    heights by a cubic where their rates at both ends are given.
    """

    start: float  # [s]
    length: float  # [s]
    height_0: float  # [m] effective height of the road under the tire at the start
    height_1: float  # [m] the same at the end
    cushion_0: float  # [m] effective height of the unloaded cushion above the floor at the start
    cushion_1: float  # [m]
    acceleration_x_0: float  # [m/s^2] of the floor
    acceleration_x_1: float
    acceleration_z_0: float  # [m/s^2] of the floor (seat rig) or of the free body (car)
    acceleration_z_1: float
    # [N] that road asperities add to the tire's force while it is in contact
    push_0: float | None = None
    push_1: float | None = None
    # [m/s] rates of the heights at the start and the end of the segment
    height_rate_0: float | None = None
    height_rate_1: float | None = None
    cushion_rate_0: float | None = None
    cushion_rate_1: float | None = None
