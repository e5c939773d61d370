"""What a test machine does to an axle: it holds it in height, or lets it slide under a load (`DriveLine` brings that)."""

from __future__ import annotations

from typing import NamedTuple

from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.rigs.vehicle.motion.elements import register_element

__all__ = ["HeldAxle", "Slide"]


class HeldAxle(NamedTuple):
    """A mass that does not move up or down; what holds it does no work."""

    place: int  # of its coordinate in the state


class Slide(NamedTuple):
    """``F = -c v`` of the slide that a loaded axle moves on, against the frame of the machine."""

    place: int
    damping: float  # [N s/m], >= 0


@borrowing_kernel
def _carry(held, ground, mode, state, out):
    return 0.0, 0.0, 0.0, 0.0


@borrowing_kernel
def _hold(held, ground, state, out):
    out[held.place + 1] = 0.0
    return 0.0


@borrowing_kernel
def _slide(slide, ground, mode, state, out):
    speed = state[slide.place + 1]
    out[slide.place + 1] -= slide.damping * speed
    return slide.damping * speed * speed, 0.0, 0.0, 0.0


register_element(HeldAxle, _carry, finish=_hold)
register_element(Slide, _slide)
