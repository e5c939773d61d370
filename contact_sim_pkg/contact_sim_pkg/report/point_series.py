"""The series of a contact that is made of points: what all of them do, and one of them in full."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact_sim_pkg.records.messages import ContactPoints

FloatArray = NDArray[np.float64]

APART, TOUCHES, STICKS, SLIPS = ContactPoints.APART, ContactPoints.TOUCHES, ContactPoints.STICKS, ContactPoints.SLIPS
"""State of a point, as the message has it."""


class PointSnapshot(NamedTuple):
    """All points at one instant."""

    time: float
    """[s]"""
    x: FloatArray
    y: FloatArray
    """[m] in the contact's frame"""
    approach: FloatArray
    """[m] positive in compression"""
    normal: FloatArray
    """[N]"""
    state: NDArray[np.uint8]
    """APART, TOUCHES, STICKS or SLIPS"""


class PointSeries(NamedTuple):
    """Points of one contact over time. Point 1 is the one that carries most at the first instant
    with a force.
    """

    time: FloatArray
    """[s]"""
    points: int
    """candidate points"""
    apart: FloatArray
    touching: FloatArray
    sticking: FloatArray
    slipping: FloatArray
    """number of points in each state, in the order of the states"""
    first_x: float
    first_y: float
    """[m] place of point 1"""
    approach: FloatArray
    """[m] of point 1, as the others below"""
    normal: FloatArray
    tangential: FloatArray
    """[N]"""
    displacement: FloatArray
    """[m] of the upper body's face along x, from its rest"""
    touch: PointSnapshot
    """the first instant with a force after one without; without such a one the first of all"""
    heaviest: PointSnapshot
    """the instant with the largest sum of normal forces"""
