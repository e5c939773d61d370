"""Instant and point of an impact: the root of the gap on the incoming flight, and on the outgoing
one where it lasts.

Source: Identifiability eqs 10 and 19 to 31.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.identify.geometry import GroundPlane, Shape, arms, gaps, size
from contact_sim_pkg.identify.motion.flight import FlightModel, FlightState, plain_motion
from contact_sim_pkg.identify.motion.rotation import Array

__all__ = ["ContactEvent", "locate"]

STEPS = 12
SAME = 1e-7  # of the body's size: corners this close touch together


class ContactEvent(NamedTuple):
    """Where and when a flight meets the ground."""

    time: float  # [s]
    point: int  # of the shape
    together: int  # points that touch at once, this one included
    found: bool  # whether the gap has a root in the interval
    gap: float  # [m], at `time`


def locate(
    flight: FlightState,
    parameters: Array,
    model: FlightModel,
    shape: Shape,
    ground: GroundPlane,
    bounds: tuple[float, float],
    start: float,
    deviation: float,
    *,
    leaving: bool = False,
) -> ContactEvent:
    """Touch on a flight within `bounds`, by Newton's method on the gap of the point that touches first.

    Args:
        flight: the incoming flight.
        parameters: of the model, [parameters].
        model: of flights.
        shape: of the body.
        ground: below it.
        bounds: where to look, [s].
        start: where to begin with it, [s].
        deviation: standard deviation of the gap, [m]: points within three of it touch together.
        leaving: the flight comes after the contact, and the root is where it leaves the ground.
    """  # fmt: skip
    time, point = start, 0
    lifts: Array = numpy.zeros(1)
    for _ in range(STEPS):
        position, velocity, rotation, spin = (
            field[0] for field in plain_motion(flight, parameters, model, numpy.array([time]))
        )
        lifts = gaps(shape, ground, position, rotation)
        rates = ground.normal @ velocity + numpy.cross(spin, arms(shape, ground, rotation)) @ ground.normal
        point = _next(lifts, rates, time, bounds, leaving=leaving)
        rate = float(rates[point])
        if (rate <= 0.0) if leaving else (rate >= 0.0):
            return ContactEvent(time, point, _together(lifts, shape, deviation), False, float(lifts[point]))
        last, time = time, float(numpy.clip(time - lifts[point] / rate, *bounds))
        if abs(time - last) <= 1e-15 * max(1.0, abs(time)):
            break
    closed = abs(lifts[point]) <= max(6.0 * deviation, 1e-9 * size(shape))
    return ContactEvent(time, point, _together(lifts, shape, deviation), bool(closed), float(lifts[point]))


def _next(lifts: Array, rates: Array, time: float, bounds: tuple[float, float], *, leaving: bool) -> int:
    """The point whose gap closes first within the bounds, or opens last; the lowest where none
    does.

    The lowest may be one that has just touched and goes up, while another comes down.
    """
    turned = rates > 0.0 if leaving else rates < 0.0
    roots = time - lifts / numpy.where(turned, rates, 1.0)
    within = numpy.flatnonzero(turned & (roots >= bounds[0]) & (roots <= bounds[1]))
    if not len(within):
        return int(lifts.argmin())
    return int(within[roots[within].argmax() if leaving else roots[within].argmin()])


def _together(lifts: Array, shape: Shape, deviation: float) -> int:
    return int(numpy.sum(lifts <= lifts.min() + max(3.0 * deviation, SAME * size(shape))))
