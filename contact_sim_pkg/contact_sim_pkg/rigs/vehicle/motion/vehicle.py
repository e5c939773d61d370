"""Seat rig, tire rig and car: road -> tire -> suspension -> floor -> seat -> occupant, with any
part absent.

Vertical motion (z up), and the occupant's sliding on the cushion (x forward) where the scene calls
for friction.

* wheel  ``m_w z_w'' = F_tire - m_w g - F_susp``, ``F_susp = k (z_w - z_b) + c (z_w' - z_b')``; with
  a rigid ring the force of its sidewalls takes the place of F_tire
* belt   ``m_r z_r'' = F_tire - m_r g - F_side``, ``F_side = k (z_r - z_w) + c (z_r' - z_w')``
* body   ``m_b z_b'' = F_susp - m_b g - F_seat + m_b a_z(t)`` (a_z: what the drive line gives to the
  free body)
* masses of the occupant, the first on the cushion: ``rigs/vehicle/motion/seat.py``
* slide  ``M x'' = -M a_x(t) - F_t`` relative to the seat, M the whole occupant; against a seat back
  ``rigs/vehicle/motion/leaning.py``

Approaches: tire ``h(t) - z_w`` (belt: ``h(t) - z_r``), h the effective road height; seat ``z_floor
+ h_c(t) - z_0``, h_c that of the cushion, which stands on the upper part of a suspension where there is one.
Without a tire the floor is the (accelerated) frame of reference: z_floor = 0 and every mass feels
``-m a_z(t)``. State: [z_w, v_w, z_b, v_b] [z_r, v_r] [masses and own states of effects] [z_0 .. z_n,
v_0 .. v_n] [x, v_x, s] [z] [q] [z_b] [supplied, dissipated]; z and z_b are the hysteresis variables
of foam in cushion and seat back (``laws/foam_hysteresis.py``), q the mean square of softening links,
the last two are the works in [J] that the energy ledger needs. Works of friction and foam are counted
whole; what their springs hold is taken off in ``advance.energies``.
"""

from __future__ import annotations

from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.integrate.interface import register_rig
from contact_sim_pkg.laws.contact_force import (
    contact_force,
    contact_force_rate,
    contact_lost_power,
    contact_reversal_event,
    contact_tension_event,
)
from contact_sim_pkg.laws.friction import (
    SEPARATED,
    STICK,
    following_deflection,
    slip_event,
    stick_event,
)
from contact_sim_pkg.rigs.vehicle.motion.elements import act, events, events_of, finish, transition
from contact_sim_pkg.rigs.vehicle.motion.ends import base_of, motion_of, press
from contact_sim_pkg.rigs.vehicle.motion.ground import ground_at
from contact_sim_pkg.rigs.vehicle.motion.leaning import (
    back_approach,
    back_force,
    back_lost_power,
    forward_rates,
    pan_cosine,
    pan_friction,
    pan_motion,
    push_up,
    slid,
    sliding_in,
)
from contact_sim_pkg.rigs.vehicle.motion.masses import accelerate, clear
from contact_sim_pkg.rigs.vehicle.motion.parameters import Vehicle
from contact_sim_pkg.rigs.vehicle.motion.seat import (
    node_rate,
    seat_rates,
    settle_node,
    slide_index,
    softening_rate,
)

# Behind the events of the elements
SEAT_APPROACH, SEAT_TENSION, SEAT_FRICTION, SEAT_REVERSAL = 0, 1, 2, 3
BACK_APPROACH, BACK_TENSION, BACK_REVERSAL = 4, 5, 6  # with a seat back


def event_count(rig: Vehicle) -> int:
    """Number of event functions."""
    return events_of(rig.elements) + (4 if rig.back is None else 7)


@borrowing_kernel
def _node_of(seat):
    if seat is None:
        return None
    return seat.node


@borrowing_kernel
def _floor_acceleration(seat, derivative):
    """Of what the cushion stands on, in its frame of reference in [m/s^2]."""
    if seat is None:
        return 0.0
    return motion_of(base_of(seat.floor), derivative)[1]


@borrowing_kernel
def seat_approach(seat, contact, back, cushion, cushion_rate, state):
    """Approach in [m] and its rate in [m/s]; separated where there is no seat. Settles a massless
    seat interface.
    """
    if seat is None:
        return -1.0, 0.0
    floor, floor_rate = motion_of(base_of(seat.floor), state)
    velocity = floor_rate + cushion_rate
    approach = floor + cushion - pan_motion(back, seat, state)[0]
    settle_node(seat.node, seat, contact, approach, velocity + sliding_in(back, seat, state), pan_cosine(back), state)
    return approach, velocity - pan_motion(back, seat, state)[1]


@borrowing_kernel
def _load_floor_of(seat, force, out):
    if seat is not None:
        press(base_of(seat.floor), -force, out)


@borrowing_kernel
def _friction_of(contact):
    if contact is None:
        return None
    return contact.friction


@borrowing_kernel
def _rate(rig, drive, mode, time, state, out):
    ground = ground_at(drive, time)
    clear(rig.masses, out)
    lost, brought, _stored, _kept = act(rig.elements, ground, mode, state, out)
    # The occupant on the cushion, which stands on the floor.
    seat_x, seat_v = seat_approach(rig.seat, rig.seat_contact, rig.back, ground.cushion, ground.cushion_rate, state)
    seat_force = contact_force(rig.seat_contact, seat_x, seat_v, state)
    rub = pan_friction(_friction_of(rig.seat_contact), rig.back, rig.seat, mode, seat_force, state)
    back_x, back_v = back_approach(rig.back, rig.seat, state)
    leaning = back_force(rig.back, back_x, back_v, state)
    _load_floor_of(rig.seat, seat_force, out)
    # Rates of the bodies; that of a massless interface last, for it follows from all others.
    accelerate(rig.masses, -rig.gravity, state, out)
    brought += finish(rig.elements, ground, state, out)
    push_up(rig.back, rig.seat, seat_force, rub, leaning, out)
    lost_in_links, brought_z = seat_rates(rig.seat, rig.gravity, ground.acceleration_z, state, out)
    rubbed, brought_x = forward_rates(
        _friction_of(rig.seat_contact), rig.back, rig.seat, mode, (seat_force, rub, leaning), ground.acceleration_x,
        state, out,
    )  # fmt: skip
    lost += lost_in_links + rubbed
    lost += contact_lost_power(rig.seat_contact, seat_x, seat_v, seat_force, state, out)
    lost += back_lost_power(rig.back, back_x, back_v, leaning, state, out)
    node_rate(
        _node_of(rig.seat), rig.seat, rig.seat_contact, seat_x, seat_v,
        _floor_acceleration(rig.seat, out) + sliding_in(rig.back, rig.seat, out), pan_cosine(rig.back), state, out,
    )  # fmt: skip
    brought += softening_rate(rig.seat, ground.acceleration_z, state, out)
    last = state.shape[0]
    out[last - 2] = brought + brought_z + brought_x + seat_force * ground.cushion_rate
    out[last - 1] = lost


@borrowing_kernel
def _friction_event(friction, contact, back, seat, mode, approach, approach_rate, state, derivative):
    if friction is None:
        return 1.0
    if mode[0] == SEPARATED:
        return 1.0
    velocity = slid(back, seat, state)
    normal = contact_force(contact, approach, approach_rate, state)
    if mode[0] == STICK:
        return stick_event(friction, normal, state[slide_index(seat) + 2], velocity)
    approach_acceleration = _floor_acceleration(seat, derivative) - pan_motion(back, seat, derivative)[1]
    normal_rate = contact_force_rate(contact, approach, approach_rate, approach_acceleration, state, derivative)
    return slip_event(friction, mode[0], velocity, slid(back, seat, derivative), normal, normal_rate)


@borrowing_kernel
def _back_events(back, seat, state, first, out):
    """Event functions of the seat back, behind the others; none without one."""
    if back is None:
        return
    approach, approach_rate = back_approach(back, seat, state)
    out[first + BACK_APPROACH] = approach
    out[first + BACK_TENSION] = contact_tension_event(back.contact, approach, approach_rate, state)
    out[first + BACK_REVERSAL] = contact_reversal_event(back.contact, approach, approach_rate)


@borrowing_kernel
def _event_functions(rig, drive, mode, time, state, derivative, out):
    ground, first = ground_at(drive, time), events_of(rig.elements)
    events(rig.elements, ground, mode, state, 0, out)
    seat_x, seat_v = seat_approach(rig.seat, rig.seat_contact, rig.back, ground.cushion, ground.cushion_rate, state)
    out[first + SEAT_APPROACH] = seat_x
    out[first + SEAT_TENSION] = contact_tension_event(rig.seat_contact, seat_x, seat_v, state)
    out[first + SEAT_REVERSAL] = contact_reversal_event(rig.seat_contact, seat_x, seat_v)
    out[first + SEAT_FRICTION] = _friction_event(
        _friction_of(rig.seat_contact), rig.seat_contact, rig.back, rig.seat, mode, seat_x, seat_v, state, derivative
    )
    _back_events(rig.back, rig.seat, state, first, out)


@borrowing_kernel
def _friction_transition(friction, contact, back, seat, mode, approach, approach_rate, state, event, direction):
    """Switch the friction of the seat where an event of this contact has changed its sign to
    ``direction``.

    Friction acts where the contact carries a load, not where bodies overlap: while they part faster
    than the material recovers the load is zero, and stick and slip would both stand at their limit
    of zero, each ending the other at once.
    """
    if friction is None:
        return
    # The bristle keeps its deflection from stick to slip; from slip to stick it starts at the one
    # that follows the slip.
    x = slide_index(seat)
    velocity = slid(back, seat, state)
    if event == SEAT_FRICTION:
        normal = contact_force(contact, approach, approach_rate, state)
        if mode[0] == STICK:
            mode[0] = 1 if friction.stiffness * state[x + 2] + friction.damping * velocity > 0.0 else -1
        else:
            state[x + 2] = following_deflection(friction, mode[0], normal, velocity)
            mode[0] = STICK
    # A contact that gains its load starts unstrained, and sticks only from rest.
    elif event in (SEAT_APPROACH, SEAT_TENSION):
        other = contact_tension_event(contact, approach, approach_rate, state) if event == SEAT_APPROACH else approach
        state[x + 2] = 0.0
        if direction > 0.0 and other > 0.0:
            mode[0] = STICK if velocity == 0.0 else (1 if velocity > 0.0 else -1)
        else:
            mode[0] = SEPARATED


@borrowing_kernel
def _mode_transition(rig, drive, mode, time, state, event, direction):
    ground, of_seat = ground_at(drive, time), event - events_of(rig.elements)
    if of_seat < 0:
        return transition(rig.elements, ground, mode, state, event, direction)
    seat_x, seat_v = seat_approach(rig.seat, rig.seat_contact, rig.back, ground.cushion, ground.cushion_rate, state)
    _friction_transition(
        _friction_of(rig.seat_contact), rig.seat_contact, rig.back, rig.seat, mode, seat_x, seat_v, state, of_seat,
        direction,
    )  # fmt: skip
    return 1.0 if of_seat == SEAT_FRICTION else direction


@borrowing_kernel
def _slips(friction, mode):
    if friction is None:
        return False
    return mode[0] != STICK and mode[0] != SEPARATED


@borrowing_kernel
def _need_rate(rig, mode):
    return _slips(_friction_of(rig.seat_contact), mode)


register_rig(Vehicle, _rate, _event_functions, _mode_transition, _need_rate)
