"""Mode of one contact from its velocities and impulse."""

from __future__ import annotations

from typing import NamedTuple

import numpy

from .geometry import Ground
from .rotation import Array

__all__ = ["REVERSED", "SLIDE", "STICK", "Mode", "classify"]

STICK, SLIDE, REVERSED = "stick", "slide", "slide, reversed"
SIGMAS = 3.0
FLOOR = 1e-8  # of the speed of approach


class Mode(NamedTuple):
    """What happened at one contact."""

    mode: str
    normal: float  # c_n/m, [m/s]
    tangential: float  # |c_t|/m, [m/s]
    friction: float | None  # mu = |c_t|/c_n where it slides
    restitution: float | None  # -u_n+/u_n-; None where it did not approach
    slip_before: float  # [m/s]
    slip_after: float  # [m/s]


def classify(push: Array, before: Array, after: Array, deviation: float, ground: Ground) -> Mode:
    """Stick, slide, or slide with reversed slip.

    Args:
        push: impulse over mass, [3] in [m/s].
        before: velocity of the contact point before, [3].
        after: the same after.
        deviation: standard deviation of a component of the slip after, [m/s].
        ground: its normal tells normal from tangential.
    """
    normal = float(push @ ground.normal)
    tangential = float(numpy.linalg.norm(push - normal * ground.normal))
    approach, departure = float(before @ ground.normal), float(after @ ground.normal)
    slips = [velocity - (velocity @ ground.normal) * ground.normal for velocity in (before, after)]
    speeds = [float(numpy.linalg.norm(slip)) for slip in slips]
    mode = SLIDE if slips[0] @ slips[1] >= 0.0 else REVERSED
    if speeds[1] <= max(SIGMAS * deviation, FLOOR * float(numpy.linalg.norm(before))):
        mode = STICK
    friction = tangential / normal if mode != STICK and normal > 0.0 else None
    restitution = -departure / approach if approach < 0.0 else None
    return Mode(mode, normal, tangential, friction, restitution, *speeds)
