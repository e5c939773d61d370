"""Backrest rig: an occupant's back pressed on a shaken seat back, which slaps and slips (Driver and
Seat, eqs 6 to 11).

Everything is seen from the seat back, an accelerated frame; x points forward, out of the seat back.
The back moves in modal coordinates q, positive towards the seat, with one mass as the case of one
mode without stiffness:

* ``M_i q_i'' = P_i + m_i a(t) - K_i q_i - C_i q_i' - sum_c phi_ci F_c + sum_c s_ci T_c``, a the
  seat back's acceleration;
* approach of point c: ``d_c = sum_i phi_ci q_i - gap_c``; its velocity along the seat: ``u_c = u(t)
  - sum_i s_ci q_i'``, ``u(t) = X w cos(w t)`` the rigid sliding and ``s_ci = (h/2) dphi_ci/dx`` the
    motion of a shell's
  face;
* normal force ``F_c = share_c F(d_c, d_c')``, friction ``T_c`` of ``laws/friction.py`` with spring,
damper and limit of the
  same share: the law belongs to the whole back, so the force does not change with the number of
  points.

Touch, turning point, loss of contact (end rule ``force``: the material recovers more slowly than
the bodies part), stick and slip of every point are located events. Works of closing and opening are
integrated per point, so that an episode's restitution is ``sqrt(W_r / -W_c)``.

State: [q, q'] [spring deflection of each point] [work of closing] [work of opening, of each point]
[hysteresis variable of the foam at each point, where it has one] [supplied, dissipated]. Every
event function is positive while the present mode of its point lasts.
"""

from __future__ import annotations

import math

from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.integrate.interface import register_rig
from contact_sim_pkg.laws.elastic_law import elastic_force
from contact_sim_pkg.laws.foam_hysteresis import hysteresis_factor, hysteresis_factor_rate, hysteresis_rate
from contact_sim_pkg.laws.friction import SEPARATED as UNLOADED
from contact_sim_pkg.laws.friction import STICK, following_deflection, friction_force, slip_event, stick_event
from contact_sim_pkg.laws.normal_force import normal_force, normal_force_rate, tension_event
from contact_sim_pkg.rigs.backrest.contact_search import move_point
from contact_sim_pkg.rigs.backrest.episodes import begin_episode, end_episode, note_loss, note_turn
from contact_sim_pkg.rigs.backrest.parameters import (
    APART,
    CLOSING,
    CONTACT,
    DAMPING,
    FRICTION,
    GAP,
    MASS,
    OPENING,
    PRELOAD,
    RELEASED,
    SHAKEN,
    SHAPE,
    SHARE,
    SLOPE,
    STIFFNESS,
    Backrest,
)

APPROACH_EVENT, TENSION_EVENT, TURN_EVENT, FRICTION_EVENT, EVENTS_A_POINT = (
    0,
    1,
    2,
    3,
    4,
)  # each for all points in a row
SIMULTANEOUS = 1.0e-12  # [m]: points that symmetry lets touch or leave together do so in one event
AT_REST = 1.0e-9  # [m/s]: below, a point so near to contact may as well stay where it is


def memory_offset(modes: int, points: int) -> int:
    """Index of the first hysteresis variable of the foam in the state."""
    return 2 * modes + 3 * points


def state_count(modes: int, points: int, hysteresis: bool = False) -> int:
    """Number of state variables."""
    return memory_offset(modes, points) + (points if hysteresis else 0) + 2


def event_count(points: int) -> int:
    """Number of event functions."""
    return EVENTS_A_POINT * points


@borrowing_kernel
def approach_of(rig, state, point):
    """Approach in [m] and its rate in [m/s]."""
    modes = rig.modal.shape[1]
    approach = -rig.places[GAP, point]
    rate = 0.0
    for i in range(modes):
        approach += rig.coupling[SHAPE, point, i] * state[i]
        rate += rig.coupling[SHAPE, point, i] * state[modes + i]
    return approach, rate


@borrowing_kernel
def slide_of(rig, time):
    """Displacement [m], velocity [m/s] and acceleration [m/s^2] of the rigid sliding."""
    phase = rig.slide_frequency * time
    speed = rig.slide_amplitude * rig.slide_frequency
    return (
        rig.slide_amplitude * math.sin(phase),
        speed * math.cos(phase),
        -speed * rig.slide_frequency * math.sin(phase),
    )


@borrowing_kernel
def tangential_velocity(rig, time, state, point):
    """Velocity of the back's face along the seat in [m/s]."""
    modes = rig.modal.shape[1]
    _displacement, velocity, _acceleration = slide_of(rig, time)
    for i in range(modes):
        velocity -= rig.coupling[SLOPE, point, i] * state[modes + i]
    return velocity


@borrowing_kernel
def seat_acceleration(drive, time):
    """Forward acceleration of the seat back in [m/s^2]."""
    part = (time - drive.start) / drive.length
    return drive.acceleration_0 + part * (drive.acceleration_1 - drive.acceleration_0)


@borrowing_kernel
def unit_normal(rig, mode, point, approach, approach_rate, state):
    """Normal force in [N] of the whole law at this approach; 0 where the point is separated or
    released.
    """
    if mode.doing[CONTACT, point] == APART or mode.doing[CONTACT, point] == RELEASED:
        return 0.0
    factor = hysteresis_factor(rig.contact.hysteresis, state, point)
    return normal_force(rig.contact.elastic, rig.contact.dissipative, approach, approach_rate, factor)


@borrowing_kernel
def unit_friction(friction, rig, mode, point, time, normal, state):
    """Friction force in [N] of the whole law, and the velocity along the seat in [m/s]; 0 without
    friction.
    """
    if friction is None:
        return 0.0, 0.0
    velocity = tangential_velocity(rig, time, state, point)
    deflection = state[2 * rig.modal.shape[1] + point]
    return friction_force(friction, mode.doing[FRICTION, point], normal, deflection, velocity), velocity


@borrowing_kernel
def _free_rates(rig, acceleration, state, out):
    """Modal forces without contact, into the places of the accelerations; returns supplied and lost
    power.
    """
    modes = rig.modal.shape[1]
    supplied = 0.0
    lost = 0.0
    for i in range(modes):
        velocity = state[modes + i]
        shaking = rig.modal[SHAKEN, i] * acceleration
        damper = rig.modal[DAMPING, i] * velocity
        out[i] = velocity
        out[modes + i] = rig.modal[PRELOAD, i] + shaking - rig.modal[STIFFNESS, i] * state[i] - damper
        supplied += shaking * velocity
        lost += damper * velocity
    return supplied, lost


@borrowing_kernel
def _point_rates(rig, mode, point, time, state, out):
    """Add a touching point's forces to the modal forces; returns supplied and lost power."""
    modes, points = rig.modal.shape[1], rig.places.shape[1]
    share = rig.places[SHARE, point]
    approach, approach_rate = approach_of(rig, state, point)
    normal = unit_normal(rig, mode, point, approach, approach_rate, state)
    tangential, velocity = unit_friction(rig.contact.friction, rig, mode, point, time, normal, state)
    for i in range(modes):
        out[modes + i] += share * (rig.coupling[SLOPE, point, i] * tangential - rig.coupling[SHAPE, point, i] * normal)
    power = share * normal * approach_rate
    out[2 * modes + point] = velocity if mode.doing[FRICTION, point] == STICK else 0.0
    out[2 * modes + points + point] = power if mode.doing[CONTACT, point] == CLOSING else 0.0
    out[2 * modes + 2 * points + point] = -power if mode.doing[CONTACT, point] == OPENING else 0.0
    _displacement, slide_velocity, _acceleration = slide_of(rig, time)
    rubbed = share * tangential * velocity
    elastic_power = elastic_force(rig.contact.elastic, approach) * approach_rate
    hysteresis_rate(rig.contact.hysteresis, elastic_power, state, out, point)
    lost = power - share * elastic_power
    return share * tangential * slide_velocity, lost + rubbed


@borrowing_kernel
def _rate(rig, drive, mode, time, state, out):
    modes, points = rig.modal.shape[1], rig.places.shape[1]
    move_point(rig.search, rig, state)
    supplied, lost = _free_rates(rig, seat_acceleration(drive, time), state, out)
    for c in range(points):
        if mode.doing[CONTACT, c] == APART:
            out[2 * modes + c] = 0.0
            out[2 * modes + points + c] = 0.0
            out[2 * modes + 2 * points + c] = 0.0
            hysteresis_rate(rig.contact.hysteresis, 0.0, state, out, c)
            continue
        supplied_here, lost_here = _point_rates(rig, mode, c, time, state, out)
        supplied += supplied_here
        lost += lost_here
    for i in range(modes):
        out[modes + i] /= rig.modal[MASS, i]
    out[state.shape[0] - 2] = supplied
    out[state.shape[0] - 1] = lost


@borrowing_kernel
def _friction_event(friction, rig, mode, point, time, approach, approach_rate, state, derivative):
    if friction is None:
        return 1.0
    doing = mode.doing[FRICTION, point]
    if doing == UNLOADED:
        return 1.0
    modes = rig.modal.shape[1]
    normal = unit_normal(rig, mode, point, approach, approach_rate, state)
    velocity = tangential_velocity(rig, time, state, point)
    if doing == STICK:
        return stick_event(friction, normal, state[2 * modes + point], velocity)
    # While it slides, the event needs the rates of velocity and normal force.
    _displacement, _velocity, acceleration = slide_of(rig, time)
    approach_acceleration = 0.0
    for i in range(modes):
        approach_acceleration += rig.coupling[SHAPE, point, i] * derivative[modes + i]
        acceleration -= rig.coupling[SLOPE, point, i] * derivative[modes + i]
    contact = rig.contact
    factor = hysteresis_factor(contact.hysteresis, state, point)
    normal_rate = normal_force_rate(
        contact.elastic, contact.dissipative, approach, approach_rate, approach_acceleration, factor
    )
    normal_rate += hysteresis_factor_rate(contact.hysteresis, derivative, point) * elastic_force(
        contact.elastic, approach
    )
    return slip_event(friction, doing, velocity, acceleration, normal, normal_rate)


@borrowing_kernel
def _tension_event(rig, doing, point, approach, approach_rate, state):
    if doing in (APART, CLOSING):
        return 1.0
    factor = hysteresis_factor(rig.contact.hysteresis, state, point)
    tension = tension_event(rig.contact.elastic, rig.contact.dissipative, approach, approach_rate, factor)
    return -tension if doing == RELEASED else tension


@borrowing_kernel
def _reversal_event(doing, approach_rate):
    if doing == CLOSING:
        return approach_rate
    return -approach_rate if doing == OPENING else 1.0


@borrowing_kernel
def _event_functions(rig, drive, mode, time, state, derivative, out):
    points = rig.places.shape[1]
    move_point(rig.search, rig, state)
    for c in range(points):
        approach, approach_rate = approach_of(rig, state, c)
        # Four event functions for each point: touch, tension, reversal, friction.
        doing = mode.doing[CONTACT, c]
        out[c] = -approach if doing == APART else approach
        out[points + c] = _tension_event(rig, doing, c, approach, approach_rate, state)
        out[2 * points + c] = _reversal_event(doing, approach_rate)
        out[3 * points + c] = _friction_event(
            rig.contact.friction,
            rig,
            mode,
            point=c,
            time=time,
            approach=approach,
            approach_rate=approach_rate,
            state=state,
            derivative=derivative,
        )


@borrowing_kernel
def _load(rig, mode, point, time, approach_rate, state):
    """A point begins to carry, and slips the way it moves."""
    mode.doing[CONTACT, point] = CLOSING if approach_rate > 0.0 else OPENING
    velocity = tangential_velocity(rig, time, state, point)
    mode.doing[FRICTION, point] = STICK if velocity == 0.0 else (1 if velocity > 0.0 else -1)
    state[2 * rig.modal.shape[1] + point] = 0.0


@borrowing_kernel
def _unload(rig, mode, point, time, state, becomes):
    """A point ceases to carry or to overlap, and its friction spring is free."""
    if mode.doing[CONTACT, point] != RELEASED:
        note_loss(mode, point, time)
    mode.doing[CONTACT, point] = becomes
    mode.doing[FRICTION, point] = UNLOADED
    state[2 * rig.modal.shape[1] + point] = 0.0


@borrowing_kernel
def _pass_approach(rig, mode, point, time, approach, approach_rate, state):
    if mode.doing[CONTACT, point] == APART:
        begin_episode(rig, mode, point, time, approach, state)
        _load(rig, mode, point, time, approach_rate, state)
    else:
        _unload(rig, mode, point, time, state, APART)
        end_episode(rig, mode, point, state)


@borrowing_kernel
def _pass_turn(mode, point, approach):
    note_turn(mode, point, approach)
    mode.doing[CONTACT, point] = OPENING if mode.doing[CONTACT, point] == CLOSING else CLOSING


@borrowing_kernel
def _pass_friction(friction, rig, mode, point, time, approach, approach_rate, state):
    if friction is None:
        return
    place = 2 * rig.modal.shape[1] + point
    velocity = tangential_velocity(rig, time, state, point)
    if mode.doing[FRICTION, point] == STICK:
        mode.doing[FRICTION, point] = 1 if friction.stiffness * state[place] + friction.damping * velocity > 0.0 else -1
    else:
        normal = unit_normal(rig, mode, point, approach, approach_rate, state)
        state[place] = following_deflection(friction, mode.doing[FRICTION, point], normal, velocity)
        mode.doing[FRICTION, point] = STICK


@borrowing_kernel
def _pass_kinematic(rig, mode, event_point, turns, time, state):
    """Let the event's point touch, leave or turn, and with it every other whose event falls on the
    same instant.
    """
    for c in range(rig.places.shape[1]):
        approach, approach_rate = approach_of(rig, state, c)
        doing = mode.doing[CONTACT, c]
        passes = (
            abs(approach) <= SIMULTANEOUS and abs(approach_rate) > AT_REST and (approach_rate > 0.0) == (doing == APART)
        )
        is_reversed = _reversal_event(doing, approach_rate) < 0.0
        if c == event_point:
            passes, is_reversed = not turns, turns
        if passes:
            _pass_approach(rig, mode, c, time, approach, approach_rate, state)
        elif is_reversed:
            _pass_turn(mode, c, approach)


@borrowing_kernel
def _mode_transition(rig, drive, mode, time, state, event, direction):
    points = rig.places.shape[1]
    point = event % points
    kind = event // points
    move_point(rig.search, rig, state)
    if kind in (APPROACH_EVENT, TURN_EVENT):
        _pass_kinematic(rig, mode, point, kind == TURN_EVENT, time, state)
        return 1.0
    approach, approach_rate = approach_of(rig, state, point)
    if kind == FRICTION_EVENT:
        _pass_friction(
            rig.contact.friction, rig, mode, point, time, approach=approach, approach_rate=approach_rate, state=state
        )
    elif mode.doing[CONTACT, point] == RELEASED:
        _load(rig, mode, point, time, approach_rate, state)
    else:
        _unload(rig, mode, point, time, state, RELEASED)
    return 1.0


@borrowing_kernel
def _slips(friction, mode):
    if friction is None:
        return False
    slipping = 0
    for c in range(mode.doing.shape[1]):
        slipping += 1 if mode.doing[FRICTION, c] != STICK and mode.doing[FRICTION, c] != UNLOADED else 0
    return slipping > 0


@borrowing_kernel
def _need_rate(rig, mode):
    return _slips(rig.contact.friction, mode)


register_rig(Backrest, _rate, _event_functions, _mode_transition, _need_rate)
