"""Stops between wheel and body."""

from __future__ import annotations

from contact_sim_pkg.rigs.vehicle.acting import Acting, Chassis
from contact_sim_pkg.rigs.vehicle.effects.bump_stop import BumpStopSection
from contact_sim_pkg.rigs.vehicle.effects.travel_stops_kernel import TravelStops, stop_law
from contact_sim_pkg.rigs.vehicle.motion.scales import contact_scale

__all__ = ["bump_stop"]


def bump_stop(keys: BumpStopSection, chassis: Chassis) -> Acting:
    """Stops of a scene between wheel and body, the lower end of its travel being the bump."""
    wheel, body, law = chassis.wheel, chassis.body, stop_law(keys)
    assert wheel is not None
    assert body is not None
    stops = TravelStops(wheel.place, body.place, chassis.hangs - keys.bump, chassis.hangs + keys.rebound, law)
    load = (body.mass + chassis.seated) * chassis.gravity
    return Acting((stops,), scales=tuple((each.place, *contact_scale(law, load, each.mass)) for each in (wheel, body)))
