"""International Roughness Index of a road profile (Sayers, World Bank Technical Paper 46; ASTM E1926)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["LONGEST_STEP", "SHORTEST_ROAD", "roughness_index"]

SPEED = 80.0 / 3.6
"""[m/s] of the golden car"""
SUSPENSION, TIRE, DAMPING, UNSPRUNG = 63.3, 653.0, 6.0, 0.15
"""Stiffnesses [1/s^2] and damping [1/s] over the sprung mass, and its share that is unsprung."""
BASE = 0.25
"""[m] over which the tire averages the profile"""
START = 11.0
"""[m] whose mean slope the car begins on, and half a second of travel"""
LONGEST_STEP = 0.3
"""[m] between heights, at most"""
SHORTEST_ROAD = 2.0 * START
"""[m]"""


def roughness_index(distance: NDArray[np.float64], height: NDArray[np.float64]) -> float:
    """IRI = 1/L int |z_s' - z_u'| dx [m/km]: travel of the suspension of the golden car over the way; nan for a road
    shorter than 22 m, or with heights more than 0.3 m apart.

    The state (slopes and their rates of sprung and unsprung mass) goes from height to height by the exact solution
    for a slope that is constant between them.

    Args:
        distance: [m] ascending.
        height: [m] same shape.
    """
    length = float(distance[-1] - distance[0]) if distance.size > 1 else 0.0
    if length < SHORTEST_ROAD or float(np.diff(distance).max()) > LONGEST_STEP:
        return float("nan")
    from scipy.linalg import expm
    from scipy.signal import lfilter, ss2tf

    # At even steps; the heights between are on straight lines
    step = min(0.05, length / 1000.0)
    places = np.arange(distance[0], distance[-1], step)
    profile = np.interp(places, distance, height)
    width = max(1, round(BASE / step))
    sums = np.concatenate([[0.0], np.cumsum(profile)])
    smooth = (sums[width:] - sums[:-width]) / width
    slope = np.diff(smooth) / step
    matrix = np.array([
        [0.0, 1.0, 0.0, 0.0],
        [-SUSPENSION, -DAMPING, SUSPENSION, DAMPING],
        [0.0, 0.0, 0.0, 1.0],
        [SUSPENSION / UNSPRUNG, DAMPING / UNSPRUNG, -(TIRE + SUSPENSION) / UNSPRUNG, -DAMPING / UNSPRUNG],
    ])  # fmt: skip
    drive = np.array([0.0, 0.0, 0.0, TIRE / UNSPRUNG])
    advance = expm(matrix * (step / SPEED))
    push = np.linalg.solve(matrix, (advance - np.eye(4)) @ drive)
    # On an even slope nothing moves, so the car begins at rest on that of the first metres
    above, below = ss2tf(advance, push[:, np.newaxis], np.array([[1.0, 0.0, -1.0, 0.0]]), np.zeros((1, 1)))
    travel = lfilter(above[0], below, slope - slope[: max(1, round(START / step))].mean())
    return 1e3 * float(np.abs(travel).mean())
