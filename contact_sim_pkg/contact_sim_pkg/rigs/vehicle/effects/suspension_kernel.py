"""A seat suspension: the upper part on a spring with preload and a damper, dry friction, and two end stops.

With ``x = z_u - z_l``, 0 at mid-travel: ``F = P - k x - c x' - F_t`` pushes the ends apart; the friction F_t holds as a
stiff spring up to its limit and slides there, with located transitions (`laws/friction.py`, without damper, under a load of
1).
"""

from __future__ import annotations

from typing import NamedTuple

from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.laws.friction import STICK, friction_force, slip_event, stick_event
from contact_sim_pkg.laws.parameters import Friction
from contact_sim_pkg.rigs.vehicle.acting import Acting, Chassis, Joined
from contact_sim_pkg.rigs.vehicle.effects.suspension import SuspensionSection
from contact_sim_pkg.rigs.vehicle.effects.travel_stops_kernel import TravelStops, stop_law
from contact_sim_pkg.rigs.vehicle.motion.elements import register_element
from contact_sim_pkg.rigs.vehicle.motion.ends import between, push_apart
from contact_sim_pkg.rigs.vehicle.motion.masses import Mass
from contact_sim_pkg.rigs.vehicle.motion.scales import contact_scale
from contact_sim_pkg.rigs.vehicle.motion.spring import ShakenMass
from contact_sim_pkg.scene.schema.fields import given

__all__ = ["DryFriction", "Strut", "suspension"]


class Strut(NamedTuple):
    """``F = P - k x - c x'`` pushes its ends apart."""

    lower: int | None  # place of an end in the state; None: the frame of reference
    upper: int
    preload: float  # [N] where x is 0
    stiffness: float  # [N/m]
    damping: float  # [N s/m]


class DryFriction(NamedTuple):
    """Friction between two ends that does not depend on a load."""

    lower: int | None
    upper: int
    deflection: int  # place of that of its spring [m]
    mode: int  # place of `laws/friction.py`'s
    force: float  # [N], > 0
    stiffness: float  # [N/m] of the spring that holds


@borrowing_kernel
def _act(strut, ground, mode, state, out):
    travel, rate = between(strut.lower, strut.upper, state)
    push_apart(strut.lower, strut.upper, strut.preload - strut.stiffness * travel - strut.damping * rate, out)
    stored = (0.5 * strut.stiffness * travel - strut.preload) * travel
    return strut.damping * rate * rate, 0.0, stored, 0.0


@borrowing_kernel
def _law(friction):
    return Friction(friction.stiffness, 0.0, friction.force, friction.force)


@borrowing_kernel
def _rub(friction, ground, mode, state, out):
    _travel, rate = between(friction.lower, friction.upper, state)
    deflection, now = state[friction.deflection], mode[friction.mode]
    force = friction_force(_law(friction), now, 1.0, deflection, rate)
    push_apart(friction.lower, friction.upper, -force, out)
    out[friction.deflection] = rate if now == STICK else 0.0
    # The work of the friction is counted whole; what its spring holds is no loss yet.
    held = 0.5 * friction.stiffness * deflection * deflection
    return force * rate, 0.0, held, held


@borrowing_kernel
def _rub_events(friction, ground, mode, state, derivative, first, out):
    _travel, rate = between(friction.lower, friction.upper, state)
    now = mode[friction.mode]
    if now == STICK:
        out[first] = stick_event(_law(friction), 1.0, state[friction.deflection], rate)
    else:
        out[first] = slip_event(_law(friction), now, rate, 0.0, 1.0, 0.0)


@borrowing_kernel
def _rub_transition(friction, ground, mode, state, event, direction):
    if mode[friction.mode] == STICK:
        mode[friction.mode] = 1 if state[friction.deflection] > 0.0 else -1
        state[friction.deflection] = mode[friction.mode] * friction.force / friction.stiffness
    else:
        mode[friction.mode] = STICK
    return 1.0


register_element(Strut, _act)
register_element(DryFriction, _rub, events=_rub_events, event_count=1, transition=_rub_transition)


def suspension(keys: SuspensionSection, chassis: Chassis) -> Acting:
    """The suspension of a scene on its floor: the body of a car, or the frame of reference."""
    floor = None if chassis.body is None else chassis.body.place
    pan, law = Mass(chassis.first_state, keys.upper_mass), stop_law(keys)
    load = (keys.upper_mass + chassis.seated) * chassis.gravity
    elements: list[tuple[object, ...]] = [
        Strut(floor, pan.place, given(keys.preload), keys.stiffness, keys.damping),
        TravelStops(floor, pan.place, -0.5 * keys.travel, 0.5 * keys.travel, law),
    ]
    states: tuple[float, ...] = ()
    if keys.friction > 0.0:
        rubs = DryFriction(
            floor, pan.place, pan.place + 2, chassis.first_mode, keys.friction, keys.friction / keys.presliding
        )
        elements.append(rubs)
        states = (keys.presliding,)
    if floor is None:
        elements.append(ShakenMass(pan.place, pan.mass))
    return Acting(
        tuple(elements), (Joined("suspension_z", pan, contact_scale(law, load, pan.mass)),), states, len(states),
        pan=pan.place,
    )  # fmt: skip
