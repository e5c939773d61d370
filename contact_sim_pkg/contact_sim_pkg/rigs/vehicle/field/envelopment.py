"""Envelopment: a belt under tension that yields beside the tread, so that the tire bends over a
short obstacle.

The belt is a string on an elastic foundation (the sidewalls), rigid across its width: `k w - T w''
= q(x)`, q the line load in [N/m]. Under a unit force it takes the form `w = exp(-|x| / l) / (2
sqrt(T k))`, `l = sqrt(T / k)`: even, positive and falling, so it adds to the influence of the
half-space, and one solve finds the contact of both in series.

A ring model's belt without bending stiffness and without the curvature of the ring: valid while the
contact is short against the wheel. Sources: Pacejka, Tire and Vehicle Dynamics, ch. 5 (stretched
string); Hetenyi, Beams on Elastic Foundation (1946).
"""

from __future__ import annotations

import math

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.pressure.settings import BeltSettings, InflatedBelt
from contact_sim_pkg.rigs.vehicle.field.inflated_belt import inflated_influence

__all__ = ["belt_influence", "relaxation_length", "yielding_of"]


def yielding_of(
    belt: BeltSettings | InflatedBelt | None, rows: int, cols: int, cell_x: float, cell_y: float
) -> NDArray[numpy.float64] | None:
    """Influence [m/Pa] [rows, cols] of the belt under a tread, of either kind; None without one."""
    if belt is None:
        return None
    influence = belt_influence if isinstance(belt, BeltSettings) else inflated_influence
    return influence(belt, rows, cols, cell_x, cell_y)  # type: ignore[arg-type]


def relaxation_length(belt: BeltSettings) -> float:
    """`l = sqrt(T / k)` in [m]: over it the bend beside an obstacle falls to 1/e. Raises ValueError
    unless T, k > 0.
    """
    for name, value, unit in (("tension", belt.tension, "N"), ("foundation", belt.foundation, "N/m^2")):
        if not 0.0 < value < math.inf:
            raise ValueError(f"belt: {name} = {value} {unit}, allowed are positive finite numbers")
    return math.sqrt(belt.tension / belt.foundation)


def belt_influence(belt: BeltSettings, rows: int, cols: int, cell_x: float, cell_y: float) -> NDArray[numpy.float64]:
    """Displacement [m/Pa] i rows and j cols away from a cell under unit pressure, [rows, cols]; the
    same for every j.

    The exact integral over the loaded cell: `cell_y / (2 k) [exp(-(d - c/2)/l) - exp(-(d +
    c/2)/l)]`, d = i cell_x, c = cell_x; in the loaded cell itself `cell_y / k (1 - exp(-c/(2 l)))`.
    """
    length = relaxation_length(belt)
    distance, half = numpy.arange(rows) * cell_x, 0.5 * cell_x
    along = numpy.exp(-abs(distance - half) / length) * -numpy.expm1(-cell_x / length)
    along[0] = -2.0 * numpy.expm1(-half / length)
    return numpy.repeat((0.5 * cell_y / belt.foundation * along)[:, None], cols, axis=1)
