"""Rest of a vehicle by Newton's method on its elements: whatever is engaged at rest is engaged in balance."""

from __future__ import annotations

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.rigs.vehicle.motion.ends import base_of
from contact_sim_pkg.rigs.vehicle.motion.entries import forces_of_elements
from contact_sim_pkg.rigs.vehicle.motion.parameters import Vehicle
from contact_sim_pkg.run.errors import RunError

__all__ = ["settle"]

STEPS, HALVINGS = 200, 40
NEAR = 1e-7  # [m] between two heights that a slope is taken from
BALANCED = 1e-9  # of the weight: force that may be left


def settle(rig: Vehicle, modes: int, seated: float, state: Vector, road: tuple[float, float]) -> None:
    """Move the masses of the table to where all forces on them balance, from the heights in ``state`` [states].

    ``seated`` [N] is the weight of the occupant, who rests on pan or floor; ``road``: height [m] under the tire and its
    rate [m/s]; ``modes``: number of those of elements, which stick. Newton with a Jacobian by differences, its steps
    halved until the largest force falls. Raises RunError where no balance is found.
    """
    places = numpy.array([each.place for each in rig.masses])
    weights = numpy.array([each.mass for each in rig.masses]) * rig.gravity
    if rig.seat is not None:
        weights[places == base_of(rig.seat.floor)] += seated
    mode, out = numpy.zeros(1 + modes, dtype=numpy.int64), numpy.zeros_like(state)
    unloaded = rig.unloaded()  # the occupant is a weight

    def left(heights: Vector) -> Vector:
        state[places] = heights
        forces_of_elements(unloaded, mode, state, *road, out)
        return out[places + 1] - weights

    heights = state[places]
    force, total = left(heights), float(weights.sum())
    for _step in range(STEPS):
        if numpy.abs(force).max() <= BALANCED * total:
            break
        slope = numpy.empty((len(places), len(places)))
        for column, beside in enumerate(NEAR * numpy.eye(len(places))):
            slope[:, column] = (left(heights + beside) - left(heights - beside)) / (2.0 * NEAR)
        way = numpy.linalg.lstsq(slope, force, rcond=None)[0]
        for halving in range(HALVINGS):
            moved = heights - 0.5**halving * way
            found = left(moved)
            if numpy.abs(found).max() < numpy.abs(force).max():
                break
        else:
            break
        heights, force = moved, found
    state[places] = heights
    if not numpy.abs(force).max() <= BALANCED * total:
        raise RunError("no height was found at which the springs and stops of the rig carry its weight at rest")
