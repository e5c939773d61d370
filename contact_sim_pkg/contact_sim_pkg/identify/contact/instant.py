"""The instant of an impact, which lies between samples: the root of the gap on the flight before,
with all its error.

The gap `g = n.(x + r) - h` closes at the rate `g' = n.(v + w x r)`. An error of the flight, dx and
a small rotation d, moves the root by `dt = -(n.dx + n.(d x l)) / g'`, l the lever from the centre
of mass to the point; what the fit leaves of the gap moves it by `-g / g'`. Both flights are taken
at that instant, so every quantity taken there has the error `(df/dt) dt` besides that of the
flights: 1 mm at 1 m/s is a millisecond, in which the arm turns with the body.

Mode of one contact from its velocities and impulse, with friction and restitution.

Source: Identifiability eqs 12 to 18 and 32 to 34.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.identify.contact.balance import Balance, Side, balance
from contact_sim_pkg.identify.motion.flight import FlightModel, rates
from contact_sim_pkg.identify.motion.geometry import GroundPlane, Shape, arm
from contact_sim_pkg.identify.motion.rotation import Array

__all__ = ["REVERSED", "SLIDE", "STICK", "ImpactInstant", "Mode", "classify", "impact_balance", "instant"]


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


STICK, SLIDE, REVERSED = "stick", "slide", "slide, reversed"
SIGMAS = 3.0
FLOOR = 1e-8  # of the speed of approach
STRAIGHT = 1e-5  # [rad] between friction and the opposite of slip: an error of mu of this squared over six


class Mode(NamedTuple):
    """What happened at one contact."""

    mode: str
    normal: float  # c_n/m, [m/s]
    tangential: float  # |c_t|/m, [m/s]
    friction: float | None  # mu; None unless it slid straight on all the time
    friction_at_least: float | None  # |c_t|/c_n, at most mu by Coulomb's law; None where c_n <= 0
    newton_restitution: float | None  # -u_n+/u_n-, of normal speeds; None where it did not approach
    slip_before: float  # [m/s]
    slip_after: float  # [m/s]


def classify(
    push: Array, before: Array, after: Array, deviation: float, ground: GroundPlane, push_deviation: float = 0.0
) -> Mode:
    """Stick, slide, or slide with reversed slip.

    Friction opposes the slip at every instant of an impact, so `|c_t|/c_n <= mu`, with the equal
    sign only where the slip kept its direction. Slip that sticks, reverses, or turns on the way
    leaves the bound. It kept its direction where the impulse lies against the slip before or after,
    and the slip did not reverse.

    Args:
        push: impulse over mass, [x, y, z] in [m/s].
        before: velocity of the contact point before, [x, y, z] in [m/s].
        after: the same after.
        deviation: standard deviation of a component of the slip, [m/s].
        ground: its normal separates normal from tangential.
        push_deviation: standard deviation of the tangential impulse over mass, [m/s].
    """
    normal = float(push @ ground.normal)
    along = push - normal * ground.normal
    tangential = float(numpy.linalg.norm(along))
    approach, departure = float(before @ ground.normal), float(after @ ground.normal)
    # Slip before and after, and the mode that it shows
    slips = [velocity - (velocity @ ground.normal) * ground.normal for velocity in (before, after)]
    speeds = [float(numpy.linalg.norm(slip)) for slip in slips]
    smallest = max(SIGMAS * deviation, FLOOR * float(numpy.linalg.norm(before)))
    mode = SLIDE if slips[0] @ slips[1] >= 0.0 else REVERSED
    if speeds[1] <= smallest:
        mode = STICK
    # The ratio of impulses is the friction only where the slip kept its direction
    ratio = tangential / normal if normal > 0.0 else None
    against = [_against(along, slip, deviation, push_deviation) for slip in slips if numpy.linalg.norm(slip) > smallest]
    friction = ratio if mode == SLIDE and any(against) else None
    restitution = -departure / approach if approach < 0.0 else None
    return Mode(mode, normal, tangential, friction, ratio, restitution, *speeds)


def _against(along: Array, slip: Array, deviation: float, push_deviation: float) -> bool:
    """Whether a tangential impulse lies against a slip, within the noise; that of no friction
    does.
    """
    strength, speed = float(numpy.linalg.norm(along)), float(numpy.linalg.norm(slip))
    if strength == 0.0:
        return True
    allowed = max(STRAIGHT, SIGMAS * float(numpy.hypot(deviation / speed, push_deviation / strength)))
    sine = float(numpy.linalg.norm(numpy.cross(along, slip))) / (strength * speed)
    return (sine if along @ slip < 0.0 else 1.0) <= allowed
