"""Contact of a coordinate with the road, and the push of the road's asperities while it lasts."""

from __future__ import annotations

from typing import NamedTuple

from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.laws.contact_force import contact_energy, contact_force, contact_lost_power, contact_tension_event
from contact_sim_pkg.laws.parameters import Contact
from contact_sim_pkg.rigs.vehicle.motion.columns import TIRE_APPROACH, TIRE_HEIGHT, TIRE_NORMAL, TIRE_PUSH, TIRE_RATE
from contact_sim_pkg.rigs.vehicle.motion.elements import register_element

__all__ = ["AsperityPush", "RoadContact"]


class RoadContact(NamedTuple):
    """What touches the road, wheel or belt, under the law of the tire."""

    place: int  # of its coordinate in the state
    law: Contact


class AsperityPush(NamedTuple):
    """Force that asperities add where the road is touched."""

    place: int  # of what touches it


@borrowing_kernel
def _approach(contact, ground, state):
    """In [m], and its rate [m/s]."""
    return ground.height - state[contact.place], ground.height_rate - state[contact.place + 1]


@borrowing_kernel
def _act(contact, ground, mode, state, out):
    approach, rate = _approach(contact, ground, state)
    force = contact_force(contact.law, approach, rate, state)
    out[contact.place + 1] += force
    lost = contact_lost_power(contact.law, approach, rate, force, state, out)
    elastic, hysteresis = contact_energy(contact.law, approach, state)
    return lost, force * ground.height_rate, elastic + hysteresis, hysteresis


@borrowing_kernel
def _events(contact, ground, state, first, out):
    approach, rate = _approach(contact, ground, state)
    out[first] = approach
    out[first + 1] = contact_tension_event(contact.law, approach, rate, state)


@borrowing_kernel
def _observe(contact, ground, mode, state, out):
    approach, rate = _approach(contact, ground, state)
    out[TIRE_NORMAL] = contact_force(contact.law, approach, rate, state)
    out[TIRE_APPROACH] = approach
    out[TIRE_HEIGHT] = ground.height
    out[TIRE_RATE] = rate


@borrowing_kernel
def _pushed(push, ground, state):
    return ground.push if ground.height - state[push.place] > 0.0 else 0.0


@borrowing_kernel
def _push(push, ground, mode, state, out):
    force = _pushed(push, ground, state)
    out[push.place + 1] += force
    return 0.0, force * state[push.place + 1], 0.0, 0.0


@borrowing_kernel
def _observe_push(push, ground, mode, state, out):
    out[TIRE_PUSH] = _pushed(push, ground, state)


register_element(RoadContact, _act, events=_events, event_count=2, observe=_observe)
register_element(AsperityPush, _push, observe=_observe_push)
