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
NEAR = 1e-7  # [m] between two heights, or of a state's size, that a slope is taken from
BALANCED = 1e-9  # of the weight: force that may be left


def settle(
    rig: Vehicle,
    modes: int,
    seated: float,
    own: tuple[tuple[int, float], ...],
    state: Vector,
    road: tuple[float, float],
) -> None:
    """Move the masses of the table to where all forces on them balance, from the heights in ``state`` [states], and the
    ``own`` states of elements to where they rest.

    ``seated`` [N] is the weight of the occupant, who rests on pan or floor; ``own``: places and sizes; ``road``: height
    [m] under the tire and its rate [m/s]; ``modes``: number of those of elements, which stick. Newton with a Jacobian by
    differences, its steps halved until the largest force falls. A state whose rate no height and no state changes keeps
    its value. Raises RunError where no balance is found.
    """
    masses = numpy.array([each.place for each in rig.masses])
    weights = numpy.array([each.mass for each in rig.masses]) * rig.gravity
    if rig.seat is not None:
        weights[masses == base_of(rig.seat.floor)] += seated
    total = float(weights.sum())
    mode, out = numpy.zeros(1 + modes, dtype=numpy.int64), numpy.zeros_like(state)
    unloaded = rig.unloaded()  # the occupant is a weight
    places = numpy.array([*masses, *(place for place, _size in own)])
    steps = NEAR * numpy.array([*numpy.ones(len(masses)), *(size for _place, size in own)])
    # What must vanish: forces, and the rates of own states as forces.
    rows = numpy.array([*(masses + 1), *(place for place, _size in own)])
    rest, unit = numpy.array([*weights, *numpy.zeros(len(own))]), numpy.ones(len(rows))

    def left(values: Vector) -> Vector:
        state[places] = values
        forces_of_elements(unloaded, mode, state, *road, out)
        return (out[rows] - rest) * unit

    def slopes(values: Vector) -> Vector:
        columns = [
            (left(values + beside) - left(values - beside)) / (2.0 * step)
            for step, beside in zip(steps, numpy.diag(steps), strict=True)
        ]
        return numpy.transpose(columns)

    values = state[places]
    if own:
        # A rate counts as the weight where it would be that of states and heights off by their sizes.
        first = len(masses)
        largest = numpy.abs(slopes(values)[first:] * (steps / NEAR)).sum(axis=1)
        unit[first:] = numpy.divide(total, largest, out=numpy.zeros(len(own)), where=largest > 0.0)
    force = left(values)
    for _step in range(STEPS):
        if numpy.abs(force).max() <= BALANCED * total:
            break
        way = numpy.linalg.lstsq(slopes(values), force, rcond=None)[0]
        for halving in range(HALVINGS):
            moved = values - 0.5**halving * way
            found = left(moved)
            if numpy.abs(found).max() < numpy.abs(force).max():
                break
        else:
            break
        values, force = moved, found
    state[places] = values
    if not numpy.abs(force).max() <= BALANCED * total:
        raise RunError("no height was found at which the springs and stops of the rig carry its weight at rest")
