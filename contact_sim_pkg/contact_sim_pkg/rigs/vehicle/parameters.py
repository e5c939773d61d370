"""Parameter tuples of quarter car and seat.

An effect that a scene does not call for is ``None`` in place of its tuple (decision 0001). SI
units; all numbers are ``float`` unless stated otherwise.
The tuples are built in ``rigs/vehicle/model.py`` only.
"""

from __future__ import annotations

from typing import NamedTuple

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.laws.parameters import Contact


class Tire(NamedTuple):
    """Quarter vehicle on a tire; state [wheel_z, body_z, wheel_v, body_v], first in the state
    vector.
    """

    wheel_mass: float  # [kg]
    body_mass: float  # [kg]
    suspension_stiffness: float  # [N/m]
    suspension_damping: float  # [N s/m]


class RigidRing(NamedTuple):
    """Belt and tread as one rigid ring that the sidewalls carry; state [belt_z, belt_v] from
    ``offset``.

    Without load the belt's height equals the wheel's. Tread contact and sidewalls then stand in
    series.
    """

    offset: int  # index of belt_z in the state vector
    belt_mass: float  # [kg], not counted in Tire.wheel_mass
    stiffness: float  # [N/m] of the sidewalls
    damping: float  # [N s/m]


class Seat(NamedTuple):
    """Occupant on a cushion: a frame mass in contact, and masses that hang on it by spring and
    damper, in parallel.

    State, from ``offset``: frame_z, masses_z..., frame_v, masses_v...; with friction also
    occupant_x, occupant_vx and the deflection of the friction spring.
    """

    offset: int  # index of frame_z in the state vector
    frame_mass: float  # [kg]
    masses: Vector  # [kg], may be empty
    stiffness: Vector  # [N/m], one a mass
    damping: Vector  # [N s/m], one a mass


class Vehicle(NamedTuple):
    """Rig of seat and tire: each part and its contact may be absent (``None``), not both.

    Without a tire the motion is relative to the floor, which is then an accelerated frame.
    """

    gravity: float  # [m/s^2], > 0
    tire: Tire | None
    rigid_ring: RigidRing | None
    tire_contact: Contact | None
    seat: Seat | None
    seat_contact: Contact | None
