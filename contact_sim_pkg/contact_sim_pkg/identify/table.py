"""Impacts as a table: one velocity sample before and one after each, orientation and contact
known.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.identify.contact.stacked import ParameterEstimate, estimate
from contact_sim_pkg.identify.errors import IdentificationError
from contact_sim_pkg.identify.motion.flight import FlightModel
from contact_sim_pkg.identify.motion.geometry import GroundPlane, Shape, flattened, gaps, plane
from contact_sim_pkg.identify.motion.rotation import Array
from contact_sim_pkg.identify.motion.states import BodyStates, SampleNoise
from contact_sim_pkg.identify.motion.wrench import NO_WRENCH
from contact_sim_pkg.identify.problem import (
    ContactSpan,
    IdentificationProblem,
    planar_basis,
    spatial_basis,
    starting_parameters,
)

__all__ = ["ImpactTable", "estimate_from_impacts", "problem_of_impacts"]

EXACT = 1e-9  # [m], [rad]: noise of what is taken as known


class ImpactTable(NamedTuple):
    """k impacts, world axes."""

    rotation: Array  # [k, 3, 3], body to world
    velocity_before: Array  # [k, 3], [m/s], centre of mass
    velocity_after: Array
    spin_before: Array  # [k, 3], [rad/s]
    spin_after: Array


def problem_of_impacts(
    table: ImpactTable,
    shape: Shape,
    noise: tuple[float, float],
    axis: Array | None = None,
    ground: GroundPlane | None = None,
) -> IdentificationProblem:
    """The table as a problem: each side of an impact is a flight of one sample.

    Args:
        table: the impacts.
        shape: of the body; its lowest point is the contact.
        noise: standard deviation of a component of velocity [m/s] and of angular velocity [rad/s].
        axis: normal [x, y, z] of the plane of motion, the same in world and body axes; None in
            space.
        ground: level at height 0 where it is None.

    Raises:
        IdentificationError: there is no impact, or a value is not finite.
    """
    count, base = len(table.rotation), ground or plane()
    if not count or not all(numpy.isfinite(field).all() for field in table):
        raise IdentificationError(f"a table of impacts needs one impact or more of finite values; it has {count}")
    body = shape if axis is None else flattened(shape, axis)
    pairs = ((table.velocity_before, table.velocity_after), (table.spin_before, table.spin_after))
    velocity, spin = (numpy.stack(pair, axis=1).reshape(-1, 3) for pair in pairs)
    # Two samples an impact, at whole numbers as times: no flight connects them
    time = numpy.repeat(numpy.arange(count, dtype=numpy.float64), 2)
    states = BodyStates(time, numpy.zeros((2 * count, 3)), numpy.repeat(table.rotation, 2, axis=0), velocity, spin)
    points = gaps(body, base, numpy.zeros((count, 3)), table.rotation).argmin(axis=1)
    contacts = [ContactSpan(2 * k, 2 * k + 1, float(k), float(k), int(points[k])) for k in range(count)]
    model = FlightModel(spatial_basis() if axis is None else planar_basis(), False, NO_WRENCH, 0.0)
    flights = [(place, place) for place in range(2 * count)]
    return IdentificationProblem(
        states=states,
        flights=flights,
        contacts=contacts,
        shape=body,
        ground=base,
        model=model,
        noise=SampleNoise(EXACT, EXACT, *noise),
        axis=axis,
    )


def estimate_from_impacts(problem: IdentificationProblem) -> ParameterEstimate:
    """I0/m, or J/m in a plane, from a table of impacts, with its covariance and rank."""
    return estimate(problem, *starting_parameters(problem.shape, problem.model, problem.axis, 0.0))
