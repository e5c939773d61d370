"""Parameters, drive and discrete state of the backrest rig (``rigs/backrest/motion.py``), in SI
units.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Modes, Vector
from contact_sim_pkg.laws.parameters import Contact

APART, CLOSING, OPENING, RELEASED = 0, 1, 2, 3  # what the normal contact of a point does
MOST_EPISODES = 4096  # that can end within one block

# Rows of Backrest.modal: mass [kg] > 0, stiffness [N/m], damping [N s/m], constant force towards
# the seat [N], and force over forward acceleration of the seat back [kg]
MASS, STIFFNESS, DAMPING, PRELOAD, SHAKEN, MODAL_ROWS = 0, 1, 2, 3, 4, 5

# Rows of Backrest.coupling: approach over modal coordinate, and tangential velocity of the face,
# backwards, over modal velocity; of a shell half the thickness times the slope of each mode along
# the slide
SHAPE, SLOPE, COUPLING_ROWS = 0, 1, 2

# Rows of Backrest.places: gap at rest [m], and the part of the contact law that each point carries
GAP, SHARE, PLACE_ROWS = 0, 1, 2

# Rows of BackrestMode.doing: APART, CLOSING, OPENING or RELEASED (overlap without force); friction,
# see laws/friction.py
CONTACT, FRICTION, DOING_ROWS = 0, 1, 2

# Columns of BackrestMode.lasting
START, CARRIED, CLOSING_WORK, OPENING_WORK, DEEPEST, TOUCHED, LASTING_COLUMNS = 0, 1, 2, 3, 4, 5, 6
PLACE = (
    6  # the columns of BackrestMode.ended are those of lasting, works and force between start and end, and the place
)
ENDED_COLUMNS = 7
OVERLAPPING, ENDED = 0, 1  # entries of BackrestMode.counts


class ContactSearch(NamedTuple):
    """What the search for a shell's nearest point needs (``rigs/backrest/contact_search.py``); it
    begins at candidate points.
    """

    length_1: float  # [m] sides
    length_2: float  # [m]
    curvature_1: float  # [1/m]
    curvature_2: float  # [1/m]
    lever: float  # [m] half the thickness
    side: int  # modes along each side: their number is its square
    places: Vector  # [candidates, 2] [m] along the two sides, row by row of a grid
    candidates: Vector  # [candidates, modes] shapes there
    gaps: Vector  # [candidates] [m]
    depths: Vector  # [rows + 2, cols + 2] [m] room for the depths of the grid, with a rim of -infinity


class Backrest(NamedTuple):
    """A back in modal form with its candidate contact points; one mass is one mode with one point.

    Vectors of one length are the rows of one array: a kernel compiles the faster the fewer arrays
    it is handed.
    """

    modal: Vector  # [MODAL_ROWS, modes]
    coupling: Vector  # [COUPLING_ROWS, points, modes]
    places: Vector  # [PLACE_ROWS, points]
    contact: Contact  # the law of the whole back
    slide_amplitude: float  # [m] of the rigid sliding along the seat back
    slide_frequency: float  # [rad/s]
    search: ContactSearch | None = None  # moves the one contact point; its shapes, slopes and gap then change in place

    @property
    def mass(self) -> Vector:
        """[modes] [kg]."""
        return self.modal[MASS]

    @property
    def stiffness(self) -> Vector:
        """[modes] [N/m]."""
        return self.modal[STIFFNESS]

    @property
    def preload(self) -> Vector:
        """[modes] [N]."""
        return self.modal[PRELOAD]

    @property
    def shapes(self) -> Vector:
        """[points, modes]."""
        return self.coupling[SHAPE]

    @property
    def gaps(self) -> Vector:
        """[points] [m]."""
        return self.places[GAP]

    @property
    def shares(self) -> Vector:
        """[points]."""
        return self.places[SHARE]


class BackrestDrive(NamedTuple):
    """What moves the rig during one segment, straight from its start to its end."""

    start: float  # [s]
    length: float  # [s]
    acceleration_0: float  # [m/s^2] of the seat back, forward (towards the occupant) positive
    acceleration_1: float


class Shaking(NamedTuple):
    """Motion of the seat back over a series of segments of one length, linear within each."""

    begin: float  # [s]
    segment_length: float  # [s]
    acceleration: Vector  # [segments + 1] [m/s^2] at the ends of the segments


class BackrestSamples(NamedTuple):
    """Outputs of a run, sampled at the starts of segments; forces act on the back."""

    every: int  # segments from sample to sample
    states: Vector  # [samples, states]
    rates: Vector  # [samples, states]
    forces: Vector  # [samples, FORCES] of the whole contact
    points: Vector  # [samples, points, POINT_COLUMNS]


class BackrestMode(NamedTuple):
    """Discrete state of the rig, and its contact episodes: one a point, and one, the last, of the
    whole contact.
    """

    doing: Modes  # [DOING_ROWS, points]
    lasting: Vector  # [points + 1, LASTING_COLUMNS] start [s], when the force was last lost [s], works of closing and opening
    #   at the start [J], largest approach at a turning point [m], whether it began with a touch
    ended: Vector  # [MOST_EPISODES, ENDED_COLUMNS]
    counts: Modes  # [2] points that overlap; episodes that ended since it was set to 0, which may exceed MOST_EPISODES


def make_mode(points: int) -> BackrestMode:
    """Discrete state of ``points`` points, all separated."""

    doing, counts = numpy.zeros((DOING_ROWS, points), dtype=numpy.int64), numpy.zeros(2, dtype=numpy.int64)
    lasting, ended = numpy.zeros((points + 1, LASTING_COLUMNS)), numpy.zeros((MOST_EPISODES, ENDED_COLUMNS))
    return BackrestMode(doing, lasting, ended, counts)
