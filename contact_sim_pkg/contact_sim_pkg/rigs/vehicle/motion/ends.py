"""Ends of an element: a place in the state, or ``None``, the frame of reference."""

from __future__ import annotations

from contact_sim_pkg.compiled.jit import borrowing_kernel, kernel_overload

__all__ = ["base_of", "between", "motion_of", "press", "push_apart"]


def base_of(pan: int | None, floor: int | None) -> int | None:
    """What a cushion stands on: the ``pan`` of a suspension where there is one, or the ``floor``."""
    return floor if pan is None else pan


@kernel_overload(base_of, thin=True)
def _base_of(pan, floor):
    return (lambda pan, floor: floor) if str(pan) == "none" else lambda pan, floor: pan


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
