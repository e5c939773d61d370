"""The instant of an impact, which lies between samples: the root of the gap on the flight before,
with all its error.

The gap `g = n.(x + r) - h` closes at the rate `g' = n.(v + w x r)`. An error of the flight, dx and
a small rotation d, moves the root by `dt = -(n.dx + n.(d x l)) / g'`, l the lever from the centre
of mass to the point; what the fit leaves of the gap moves it by `-g / g'`. Both flights are taken
at that instant, so every quantity taken there has the error `(df/dt) dt` besides that of the
flights: 1 mm at 1 m/s is a millisecond, in which the arm turns with the body.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.identify.diagnostics.balance import Balance, Side, balance
from contact_sim_pkg.identify.geometry import GroundPlane, Shape, arm
from contact_sim_pkg.identify.motion.flight import FlightModel, rates
from contact_sim_pkg.identify.motion.rotation import Array

__all__ = ["ImpactInstant", "impact_balance", "instant"]


class ImpactInstant(NamedTuple):
    """The root of the gap seen from the time of the sides, and its derivatives by the flight
    before.
    """

    later: float  # [s], to first order
    by_state: Array  # [12], of the flight before
    by_parameters: Array  # [p]


def instant(before: Side, shape: Shape, ground: GroundPlane, point: int) -> ImpactInstant:
    """Root of the gap of `point` on the flight before: `-g / g'` later, and how it moves with that
    flight.
    """
    state, normal = before.state, ground.normal
    reach, lever = arm(shape, ground, state.rotation, point), state.rotation @ shape.points[point]
    rate = float(normal @ (state.velocity + numpy.cross(state.angular_velocity, reach)))
    gap = float(normal @ (state.position + reach)) - ground.height
    by_motion = numpy.concatenate([normal, numpy.zeros(3), numpy.cross(lever, normal), numpy.zeros(3)])
    return ImpactInstant(-gap / rate, -by_motion @ before.by_state / rate, -by_motion @ before.by_parameters / rate)


def impact_balance(
    before: Side, after: Side, parameters: Array, model: FlightModel, shape: Shape, ground: GroundPlane, point: int
) -> Balance:
    """The balance of one impact at the root of the gap: `f + f' dt`, to first order, and its
    derivatives with those of the root.

    parameters: [parameters]; point: number of the corner.
    """
    known = (parameters, model, shape, ground, point)
    found, root = balance(before, after, *known), instant(before, shape, ground, point)
    along = [_in_time(side, parameters, model) for side in (before, after)]
    passing = balance(along[0], along[1], *known)
    slope = (passing.by_before + passing.by_after)[:, 0]
    return found._replace(
        value=found.value + slope * root.later,
        by_before=found.by_before + numpy.outer(slope, root.by_state),
        by_parameters=found.by_parameters + numpy.outer(slope, root.by_parameters),
    )


def _in_time(side: Side, parameters: Array, model: FlightModel) -> Side:
    """The same motion with its derivative by time, [12, 1], in the place of that by the state."""
    return Side(side.state, rates(side.state, parameters, model)[:, None], numpy.zeros_like(side.by_parameters))
