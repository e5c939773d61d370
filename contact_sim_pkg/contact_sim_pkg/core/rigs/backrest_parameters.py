"""Parameters, drive and discrete state of the backrest rig (``rigs/backrest.py``), in SI units."""

from __future__ import annotations

from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from ..parameters import Contact, Modes, Vector

APART, CLOSING, OPENING, RELEASED = 0, 1, 2, 3  # what the normal contact of a point does
MOST_EPISODES = 4096  # that can end within one block

# Columns of BackrestMode.lasting
START, CARRIED, CLOSING_WORK, OPENING_WORK, DEEPEST, TOUCHED, LASTING_COLUMNS = 0, 1, 2, 3, 4, 5, 6
PLACE = (
    6  # the columns of BackrestMode.ended are those of lasting, works and force between start and end, and the place
)
ENDED_COLUMNS = 7
OVERLAPPING, ENDED = 0, 1  # entries of BackrestMode.counts


class Backrest(NamedTuple):
    """A back in modal form with its candidate contact points; one mass is one mode with one point.

    ``shapes`` may be those of a shell; then ``slopes`` are half the thickness times the slope of each mode along the slide.
    """

    mass: Vector  # [modes] [kg], > 0
    stiffness: Vector  # [modes] [N/m]
    damping: Vector  # [modes] [N s/m]
    preload: Vector  # [modes] [N], constant force towards the seat
    shaken: Vector  # [modes] [kg], force over forward acceleration of the seat back
    shapes: Vector  # [points, modes] approach over modal coordinate
    slopes: Vector  # [points, modes] tangential velocity of the face, backwards, over modal velocity
    gaps: Vector  # [points] [m] at rest
    shares: Vector  # [points] part of the contact law that each point carries
    contact: Contact  # the law of the whole back
    slide_amplitude: float  # [m] of the rigid sliding along the seat back
    slide_frequency: float  # [rad/s]


class BackrestDrive(NamedTuple):
    """What moves the rig during one segment, straight from its start to its end."""

    start: float  # [s]
    length: float  # [s]
    acceleration_0: float  # [m/s^2] of the seat back, forward (towards the occupant) positive
    acceleration_1: float


class BackrestMode(NamedTuple):
    """Discrete state of the rig, and its contact episodes: one a point, and one, the last, of the whole contact."""

    contact: Modes  # [points] APART, CLOSING, OPENING or RELEASED (overlap without force)
    friction: Modes  # [points] see effects/friction.py
    lasting: Vector  # [points + 1, LASTING_COLUMNS] start [s], when the force was last lost [s], works of closing and opening
    #   at the start [J], largest approach at a turning point [m], whether it began with a touch
    ended: Vector  # [MOST_EPISODES, ENDED_COLUMNS]
    counts: Modes  # [2] points that overlap; episodes that ended since it was set to 0, which may exceed MOST_EPISODES


def make_mode(points: int) -> BackrestMode:
    """Discrete state of ``points`` points, all apart."""

    def whole(size: int) -> NDArray[numpy.int64]:
        return numpy.zeros(size, dtype=numpy.int64)

    lasting, ended = numpy.zeros((points + 1, LASTING_COLUMNS)), numpy.zeros((MOST_EPISODES, ENDED_COLUMNS))
    return BackrestMode(whole(points), whole(points), lasting, ended, whole(2))
