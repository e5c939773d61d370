"""The occupant on a cushion, and against a seat back where there is one: an element with masses of its own.

* masses, the first on the cushion: ``rigs/vehicle/motion/seat.py``
* slide  ``M x'' = -M a_x(t) - F_t`` relative to the seat, M the whole occupant; against a seat back
  ``rigs/vehicle/motion/leaning.py``

Approach: ``z_floor + h_c(t) - z_0``, h_c the height of the cushion, which stands on the upper part of a suspension where
there is one. Without a floor of its own (z_floor = 0) the seat moves in the shaken frame: every mass feels ``-m a_z(t)``.

Works of friction and foam are counted whole; what their springs hold is *kept* (``motion/elements.py``).
"""

from __future__ import annotations

from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.laws.contact_force import (
    contact_energy,
    contact_force,
    contact_force_rate,
    contact_lost_power,
    contact_reversal_event,
    contact_tension_event,
)
from contact_sim_pkg.laws.friction import SEPARATED, STICK, following_deflection, slip_event, stick_event
from contact_sim_pkg.rigs.vehicle.motion.columns import (
    BACK_APPROACH,
    BACK_NORMAL,
    SEAT_APPROACH,
    SEAT_HEIGHT,
    SEAT_NORMAL,
    SEAT_RATE,
    SEAT_TANGENTIAL,
)
from contact_sim_pkg.rigs.vehicle.motion.elements import register_element
from contact_sim_pkg.rigs.vehicle.motion.ends import base_of, motion_of, press
from contact_sim_pkg.rigs.vehicle.motion.leaning import (
    accelerate_along,
    back_approach,
    back_energy,
    back_force,
    back_lost_power,
    kinetic_along,
    pan_cosine,
    pan_friction,
    pan_motion,
    push_along,
    push_up,
    slid,
    sliding_in,
    spring_energy,
)
from contact_sim_pkg.rigs.vehicle.motion.parameters import Leaning, Seated
from contact_sim_pkg.rigs.vehicle.motion.seat import (
    accelerate_masses,
    energies_of_seat,
    energy_of_links,
    node_rate,
    pull_links,
    settle_node,
    slide_index,
    softening_rate,
)

TOUCH, TENSION, FRICTION, REVERSAL = 0, 1, 2, 3  # events on the cushion
BACK_TOUCH, BACK_TENSION, BACK_REVERSAL = 4, 5, 6  # on the seat back


@borrowing_kernel
def _cushion(seat, ground, state):
    """Height [m] and velocity [m/s] of the unloaded cushion."""
    floor, floor_rate = motion_of(base_of(seat.floor), state)
    return floor + ground.cushion, floor_rate + ground.cushion_rate


@borrowing_kernel
def _approach(seated, ground, state):
    """Approach [m] to the cushion and its rate [m/s], a massless interface being settled."""
    height, velocity = _cushion(seated.seat, ground, state)
    touching, closing = pan_motion(seated.back, seated.seat, state)
    return height - touching, velocity - closing


@borrowing_kernel
def _settled(seated, ground, state):
    """As `_approach`; settles a massless interface before."""
    seat, back = seated.seat, seated.back
    height, velocity = _cushion(seat, ground, state)
    settle_node(
        seat.node, seat, seated.contact, height - pan_motion(back, seat, state)[0],
        velocity + sliding_in(back, seat, state), pan_cosine(back), state,
    )  # fmt: skip
    return _approach(seated, ground, state)


@borrowing_kernel
def _act(seated, ground, mode, state, out):
    seat, contact, back = seated.seat, seated.contact, seated.back
    approach, rate = _settled(seated, ground, state)
    normal = contact_force(contact, approach, rate, state)
    rub = pan_friction(contact.friction, back, seat, mode, normal, state)
    back_x, back_v = back_approach(back, seat, state)
    leaning = back_force(back, back_x, back_v, state)
    press(base_of(seat.floor), -normal, out)
    push_up(back, seat, normal, rub, leaning, out)
    lost = pull_links(seat, state, out)
    rubbed, pushed = push_along(contact.friction, back, seat, mode, (normal, rub, leaning), state, out)
    lost += rubbed
    lost += contact_lost_power(contact, approach, rate, normal, state, out)
    lost += back_lost_power(back, back_x, back_v, leaning, state, out)
    # What springs of friction and the memory of foam hold is among the losses all the same.
    spring = spring_energy(contact.friction, back, seat, mode, normal, state)
    in_cushion, hysteresis = contact_energy(contact, approach, state)
    in_back, back_hysteresis = back_energy(back, back_x, state)
    kept = spring + hysteresis + back_hysteresis
    return lost, pushed + normal * ground.cushion_rate, energy_of_links(seat, state) + in_cushion + in_back + kept, kept


@borrowing_kernel
def _finish(seated, ground, state, out):
    seat, contact, back = seated.seat, seated.contact, seated.back
    brought = accelerate_masses(seat, ground, state, out)
    brought += accelerate_along(contact.friction, back, seat, ground.acceleration_x, state, out)
    # That of a massless interface follows from all others
    approach, rate = _approach(seated, ground, state)
    floor = motion_of(base_of(seat.floor), out)[1]
    node_rate(
        seat.node, seat, contact, approach, rate, floor + sliding_in(back, seat, out), pan_cosine(back), state, out
    )
    return brought + softening_rate(seat.softening, seat, ground.acceleration_z, state, out)


@borrowing_kernel
def _energies(seated, gravity, state):
    kinetic, potential = energies_of_seat(seated.seat, gravity, state)
    return kinetic + kinetic_along(seated.contact.friction, seated.back, seated.seat, state), potential


@borrowing_kernel
def _friction_event(friction, seated, mode, approach, rate, state, derivative):
    if friction is None:
        return 1.0
    if mode[0] == SEPARATED:
        return 1.0
    seat, contact, back = seated.seat, seated.contact, seated.back
    velocity = slid(back, seat, state)
    normal = contact_force(contact, approach, rate, state)
    if mode[0] == STICK:
        return stick_event(friction, normal, state[slide_index(seat) + 2], velocity)
    acceleration = motion_of(base_of(seat.floor), derivative)[1] - pan_motion(back, seat, derivative)[1]
    normal_rate = contact_force_rate(contact, approach, rate, acceleration, state, derivative)
    return slip_event(friction, mode[0], velocity, slid(back, seat, derivative), normal, normal_rate)


@borrowing_kernel
def _back_events(back, seat, state, first, out):
    """Event functions of the seat back; none without one."""
    if back is None:
        return
    approach, rate = back_approach(back, seat, state)
    out[first + BACK_TOUCH] = approach
    out[first + BACK_TENSION] = contact_tension_event(back.contact, approach, rate, state)
    out[first + BACK_REVERSAL] = contact_reversal_event(back.contact, approach, rate)


@borrowing_kernel
def _events(seated, ground, mode, state, derivative, first, out):
    contact = seated.contact
    approach, rate = _settled(seated, ground, state)
    out[first + TOUCH] = approach
    out[first + TENSION] = contact_tension_event(contact, approach, rate, state)
    out[first + FRICTION] = _friction_event(contact.friction, seated, mode, approach, rate, state, derivative)
    out[first + REVERSAL] = contact_reversal_event(contact, approach, rate)
    _back_events(seated.back, seated.seat, state, first, out)


@borrowing_kernel
def _friction_transition(friction, seated, mode, approach, rate, state, event, direction):
    """Switch the friction where an event of the cushion has changed its sign to ``direction``.

    Friction acts where the contact carries a load, not where bodies overlap: while they part faster
    than the material recovers the load is zero, and stick and slip would both stand at their limit
    of zero, each ending the other at once.
    """
    if friction is None:
        return
    # The bristle keeps its deflection from stick to slip; from slip to stick it starts at the one
    # that follows the slip.
    x = slide_index(seated.seat)
    velocity = slid(seated.back, seated.seat, state)
    if event == FRICTION:
        normal = contact_force(seated.contact, approach, rate, state)
        if mode[0] == STICK:
            mode[0] = 1 if friction.stiffness * state[x + 2] + friction.damping * velocity > 0.0 else -1
        else:
            state[x + 2] = following_deflection(friction, mode[0], normal, velocity)
            mode[0] = STICK
    # A contact that gains its load starts unstrained, and sticks only from rest.
    elif event in (TOUCH, TENSION):
        other = contact_tension_event(seated.contact, approach, rate, state) if event == TOUCH else approach
        state[x + 2] = 0.0
        if direction > 0.0 and other > 0.0:
            mode[0] = STICK if velocity == 0.0 else (1 if velocity > 0.0 else -1)
        else:
            mode[0] = SEPARATED


@borrowing_kernel
def _transition(seated, ground, mode, state, event, direction):
    approach, rate = _settled(seated, ground, state)
    _friction_transition(seated.contact.friction, seated, mode, approach, rate, state, event, direction)
    return 1.0 if event == FRICTION else direction


@borrowing_kernel
def _slips(friction, mode):
    if friction is None:
        return False
    return mode[0] != STICK and mode[0] != SEPARATED


@borrowing_kernel
def _needs_rate(seated, mode):
    return _slips(seated.contact.friction, mode)


@borrowing_kernel
def _observe(seated, ground, mode, state, out):
    seat, contact, back = seated.seat, seated.contact, seated.back
    approach, rate = _settled(seated, ground, state)
    normal = contact_force(contact, approach, rate, state)
    out[SEAT_NORMAL] = normal
    out[SEAT_TANGENTIAL] = -pan_friction(contact.friction, back, seat, mode, normal, state)
    out[SEAT_APPROACH] = approach
    out[SEAT_HEIGHT] = ground.cushion
    out[SEAT_RATE] = rate
    back_x, back_v = back_approach(back, seat, state)
    out[BACK_NORMAL] = back_force(back, back_x, back_v, state)
    out[BACK_APPROACH] = back_x


for _kind, _count in ((Seated, 4), (Leaning, 7)):
    register_element(
        _kind, _act, finish=_finish, energies=_energies, events=_events, event_count=_count, transition=_transition,
        needs_rate=_needs_rate, observe=_observe,
    )  # fmt: skip
