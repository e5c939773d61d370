"""Stops at both ends of the travel of one mass over another, under a contact law.

With ``x = z_u - z_l`` a stop is pressed in by ``low - x`` or ``x - high``, and pushes back with ``F = A d^n (1 + l d')``,
never pulling (Hunt-Crossley; `laws/contact_force.py`).
"""

from __future__ import annotations

from typing import NamedTuple

from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.laws.contact_force import contact_energy, contact_force, contact_lost_power, contact_tension_event
from contact_sim_pkg.laws.parameters import Contact, NormalDissipative, NormalElastic
from contact_sim_pkg.rigs.vehicle.effects.travel_stops import StopKeys
from contact_sim_pkg.rigs.vehicle.motion.elements import register_element
from contact_sim_pkg.rigs.vehicle.motion.ends import between, push_apart

__all__ = ["TravelStops", "stop_law"]


class TravelStops(NamedTuple):
    """Stops where one end lies ``low`` or ``high`` over the other."""

    lower: int | None  # place of an end in the state; None: the frame of reference
    upper: int
    low: float  # [m]
    high: float  # [m]
    law: Contact


def stop_law(keys: StopKeys) -> Contact:
    """Law of each of two stops."""
    elastic = NormalElastic(keys.stop_force / keys.stop_depth**keys.stop_exponent, keys.stop_exponent)
    return Contact(elastic, NormalDissipative(keys.stop_damping), None)


@borrowing_kernel
def _act(stops, ground, mode, state, out):
    travel, rate = between(stops.lower, stops.upper, state)
    below, above = stops.low - travel, travel - stops.high
    from_below = contact_force(stops.law, below, -rate, state)
    from_above = contact_force(stops.law, above, rate, state)
    push_apart(stops.lower, stops.upper, from_below - from_above, out)
    lost = contact_lost_power(stops.law, below, -rate, from_below, state, out)
    lost += contact_lost_power(stops.law, above, rate, from_above, state, out)
    stored = contact_energy(stops.law, below, state)[0] + contact_energy(stops.law, above, state)[0]
    return lost, 0.0, stored, 0.0


@borrowing_kernel
def _events(stops, ground, state, first, out):
    travel, rate = between(stops.lower, stops.upper, state)
    out[first] = stops.low - travel
    out[first + 1] = contact_tension_event(stops.law, stops.low - travel, -rate, state)
    out[first + 2] = travel - stops.high
    out[first + 3] = contact_tension_event(stops.law, travel - stops.high, rate, state)


register_element(TravelStops, _act, events=_events, event_count=4)
