"""Spring and damper between two coordinates, and the accelerations that a drive line gives: to a free body, and to a mass
in the frame of the floor.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.rigs.vehicle.motion.elements import register_element

__all__ = ["DriveLine", "ShakenMass", "Spring", "spring_force"]


class Spring(NamedTuple):
    """``F = k (z_1 - z_2) + c (v_1 - v_2)`` pulls its ends together."""

    first: int  # place of a coordinate in the state
    second: int
    stiffness: float  # [N/m], >= 0
    damping: float  # [N s/m], >= 0


class DriveLine(NamedTuple):
    """The vertical acceleration of the drive line, given to a free body."""

    place: int
    mass: float  # [kg] of the body


class ShakenMass(NamedTuple):
    """A mass in the shaken frame of reference, which the floor is without a tire: it feels ``-m a_z``."""

    place: int
    mass: float  # [kg]


def spring_force(spring: Spring, state: Vector) -> Any:
    """Force [N] on the second end; state: [states], or [states, samples] in columns."""
    extension, closing = state[spring.first] - state[spring.second], state[spring.first + 1] - state[spring.second + 1]
    return spring.stiffness * extension + spring.damping * closing


_force = borrowing_kernel(spring_force)


@borrowing_kernel
def _act(spring, ground, mode, state, out):
    force = _force(spring, state)
    extension, closing = state[spring.first] - state[spring.second], state[spring.first + 1] - state[spring.second + 1]
    out[spring.first + 1] -= force
    out[spring.second + 1] += force
    return spring.damping * closing * closing, 0.0, 0.5 * spring.stiffness * extension * extension, 0.0


@borrowing_kernel
def _drive(drive_line, ground, mode, state, out):
    return 0.0, drive_line.mass * ground.acceleration_z * state[drive_line.place + 1], 0.0, 0.0


@borrowing_kernel
def _shake(drive_line, ground, state, out):
    out[drive_line.place + 1] += ground.acceleration_z
    return 0.0


register_element(Spring, _act)


@borrowing_kernel
def _carry(mass, ground, mode, state, out):
    return 0.0, -mass.mass * ground.acceleration_z * state[mass.place + 1], 0.0, 0.0


@borrowing_kernel
def _lag(mass, ground, state, out):
    out[mass.place + 1] -= ground.acceleration_z
    return 0.0


register_element(DriveLine, _drive, finish=_shake)
register_element(ShakenMass, _carry, finish=_lag)
