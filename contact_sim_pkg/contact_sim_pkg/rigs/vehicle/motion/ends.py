"""Ends of an element: a place in the state, or ``None``, the frame of reference."""

from __future__ import annotations

from typing import Any, NamedTuple, TypeAlias

from contact_sim_pkg.compiled.jit import borrowing_kernel, kernel_overload

__all__ = ["Floor", "Pan", "base_of", "between", "is_shaken", "motion_of", "press", "push_apart"]


class Pan(NamedTuple):
    """What carries a cushion above a suspension whose floor is the shaken frame of reference."""

    place: int  # in the state


Floor: TypeAlias = int | Pan | None
"""What a cushion stands on: a mass by its place, or the shaken frame of reference (None), or a pan above that."""


def base_of(floor: Floor) -> int | None:
    """Place of what a cushion stands on; None: the frame of reference."""
    return floor.place if isinstance(floor, Pan) else floor


def is_shaken(floor: Floor) -> bool:
    """Whether what stands on it moves in the shaken frame of reference."""
    return not isinstance(floor, int)


@kernel_overload(base_of, thin=True)
def _base_of(floor):
    return (lambda floor: floor.place) if _is_pan(floor) else lambda floor: floor


@kernel_overload(is_shaken, thin=True)
def _is_shaken(floor):
    shaken = _is_pan(floor) or str(floor) == "none"
    return lambda floor: shaken


def _is_pan(floor: Any) -> bool:
    return getattr(floor, "instance_class", None) is Pan


@borrowing_kernel
def motion_of(place, state):
    """Height [m] and velocity [m/s] of an end; of a derivative of the state its velocity [m/s] and acceleration
    [m/s^2].
    """
    if place is None:
        return 0.0, 0.0
    return state[place], state[place + 1]


@borrowing_kernel
def press(place, force, out):
    """Add a ``force`` [N], upwards, on an end."""
    if place is not None:
        out[place + 1] += force


@borrowing_kernel
def between(lower, upper, state):
    """Height [m] of an end over another, and its rate [m/s]."""
    low, low_rate = motion_of(lower, state)
    high, high_rate = motion_of(upper, state)
    return high - low, high_rate - low_rate


@borrowing_kernel
def push_apart(lower, upper, force, out):
    """Add a ``force`` [N] that pushes two ends apart."""
    press(lower, -force, out)
    press(upper, force, out)
