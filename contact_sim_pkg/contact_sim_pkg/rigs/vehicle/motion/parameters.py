"""Parameter tuples of the vehicle: its masses and elements, and the occupant on the seat.

An effect that a scene does not call for is ``None`` in place of its tuple (decision 0001). SI
units; all numbers are ``float`` unless stated otherwise.
The tuples are built in ``rigs/vehicle/model.py`` only.
"""

from __future__ import annotations

from typing import Any, NamedTuple, TypeAlias

import numpy

from contact_sim_pkg.compiled.arrays import Modes, Vector
from contact_sim_pkg.laws.parameters import Contact
from contact_sim_pkg.rigs.vehicle.motion.ends import Floor
from contact_sim_pkg.rigs.vehicle.motion.masses import Mass

Element: TypeAlias = Any
"""A tuple of a class that is registered (`motion/elements.py`), by this package or by another."""


class MasslessNode(NamedTuple):
    """Seat interface without a mass: its velocity follows from the balance of its forces."""

    damping: float  # [N s/m] of its links together, > 0


class Softening(NamedTuple):
    """Links of an occupant that soften with the running mean square of the seat's acceleration."""

    offset: int  # of the mean square [m^2/s^4] in the state vector
    exponent: float  # beta: stiffness by r^-2 beta, damping by r^-beta, r the rms over 1 m/s^2
    time_constant: float  # [s]
    least: float  # [m/s^2] rms, below which nothing changes
    most: float  # [m/s^2]
    rest: Vector  # [links] [m] deflections about which they soften


class Seat(NamedTuple):
    """Occupant on a cushion: masses, the first of them in contact, on springs and dampers between
    any two.

    State, from ``offset``: heights of the masses..., velocities...; with friction or a seat back
    also occupant_x, occupant_vx and the deflection of the friction spring.
    """

    offset: int  # index of the first height in the state vector
    masses: Vector  # [kg]
    ends: Modes  # [links, 2] numbers of the masses, the lower first
    springs: Vector  # [2, links] stiffness [N/m], damping [N s/m]
    node: MasslessNode | None = None  # None where the first mass is above 0
    softening: Softening | None = None
    floor: Floor = None  # what the cushion stands on; None: the frame of reference


def rigid_occupant(mass: float, offset: int = 0) -> Seat:
    """A seat under one rigid ``mass`` [kg], its height at ``offset`` of the state vector."""
    return Seat(offset, numpy.array([mass]), numpy.zeros((0, 2), dtype=numpy.int64), numpy.zeros((2, 0)))


class Back(NamedTuple):
    """Seat back that the trunk of the occupant leans on, and the tilt of the pan before it
    (``rigs/vehicle/motion/leaning.py``).
    """

    trunk: int  # number of the mass that leans
    pan_sine: float  # of the tilt of the pan, front edge up
    pan_cosine: float
    back_sine: float  # of the angle of the seat back from the vertical
    back_cosine: float
    place: float  # [m] approach where x and the height of the trunk are 0
    preload: float  # [N] that feet or hands push the occupant back with
    contact: Contact


class Seated(NamedTuple):
    """Element: an occupant on a cushion (``rigs/vehicle/motion/seated.py``)."""

    seat: Seat
    contact: Contact  # of the first mass with the cushion
    back: None = None


class Leaning(NamedTuple):
    """Element: an occupant on a cushion who leans on a seat back, on a floor that is the frame of reference."""

    seat: Seat
    contact: Contact
    back: Back


class Vehicle(NamedTuple):
    """Rig of seat and tire: masses, and what acts between them.

    Without masses the motion is relative to the floor, which is then an accelerated frame.
    """

    gravity: float  # [m/s^2], > 0
    masses: tuple[Mass, ...]
    elements: tuple[Element, ...]  # in the order in which forces are added; an occupant last

    @property
    def seated(self) -> Seated | Leaning | None:
        """The occupant; None without one."""
        return next((each for each in self.elements if isinstance(each, Seated | Leaning)), None)

    @property
    def seat(self) -> Seat | None:
        """The occupant's masses and links."""
        return None if self.seated is None else self.seated.seat

    @property
    def seat_contact(self) -> Contact | None:
        """Laws between occupant and cushion."""
        return None if self.seated is None else self.seated.contact

    @property
    def back(self) -> Back | None:
        """The seat back."""
        return None if self.seated is None else self.seated.back

    def unloaded(self) -> Vehicle:
        """The rig without its occupant."""
        return self._replace(elements=tuple(each for each in self.elements if each is not self.seated))
