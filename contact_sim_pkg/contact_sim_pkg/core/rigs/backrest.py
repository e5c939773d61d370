"""Backrest rig: an occupant's back pressed on a shaken seat back, which slaps and slips (driver-seat paper, eqs 6 to 11).

Everything is seen from the seat back, an accelerated frame; x points forward, out of the seat back. The back moves in modal
coordinates q, positive towards the seat, with one mass as the case of one mode without stiffness:

* ``M_i q_i'' = P_i + m_i a(t) - K_i q_i - C_i q_i' - sum_c phi_ci F_c + sum_c s_ci T_c``, a the seat back's acceleration;
* approach of point c: ``d_c = sum_i phi_ci q_i - gap_c``; its velocity along the seat: ``u_c = u(t) - sum_i s_ci q_i'``,
  ``u(t) = X w cos(w t)`` the rigid sliding and ``s_ci = (h/2) dphi_ci/dx`` the motion of a shell's face;
* normal force ``F_c = share_c F(d_c, d_c')``, friction ``T_c`` of ``effects/friction.py`` with spring, damper and limit of the
  same share: the law belongs to the whole back, so the force does not change with the number of points.

Touch, turning point, loss of contact (end rule ``force``: the material recovers more slowly than the bodies part), stick and
slip of every point are located events. Works of closing and opening are integrated per point, so that an episode's restitution
is ``sqrt(W_r / -W_c)``.

State: [q, q'] [spring deflection of each point] [work of closing] [work of opening, of each point] [supplied, dissipated].
Every event function is positive while the present mode of its point lasts.
"""

from __future__ import annotations

import math

from ..effects.elastic_law import elastic_force
from ..effects.friction import APART as UNLOADED
from ..effects.friction import STICK, following_deflection, friction_force, slip_margin, stick_margin
from ..effects.normal_force import normal_force, normal_force_rate, tension_margin
from ..jit import kernel
from .backrest_episodes import begin_episode, end_episode, note_loss, note_turn
from .backrest_parameters import APART, CLOSING, OPENING, RELEASED, Backrest
from .interface import register

APPROACH_EVENT, TENSION_EVENT, TURN_EVENT, FRICTION_EVENT, EVENTS_A_POINT = (
    0,
    1,
    2,
    3,
    4,
)  # each for all points in a row
SIMULTANEOUS = 1.0e-12  # [m]: points that symmetry lets touch or leave together do so in one event
AT_REST = 1.0e-9  # [m/s]: below, a point so near to contact may as well stay where it is


def state_count(modes: int, points: int) -> int:
    """Number of state variables."""
    return 2 * modes + 3 * points + 2


def margin_count(points: int) -> int:
    """Number of event functions."""
    return EVENTS_A_POINT * points


@kernel
def approach_of(rig, state, point):
    """Approach in [m] and its rate in [m/s]."""
    modes = rig.mass.shape[0]
    approach = -rig.gaps[point]
    rate = 0.0
    for i in range(modes):
        approach += rig.shapes[point, i] * state[i]
        rate += rig.shapes[point, i] * state[modes + i]
    return approach, rate


@kernel
def slide_of(rig, time):
    """Displacement [m], velocity [m/s] and acceleration [m/s^2] of the rigid sliding."""
    phase = rig.slide_frequency * time
    speed = rig.slide_amplitude * rig.slide_frequency
    return (
        rig.slide_amplitude * math.sin(phase),
        speed * math.cos(phase),
        -speed * rig.slide_frequency * math.sin(phase),
    )


@kernel
def tangential_velocity(rig, time, state, point):
    """Velocity of the back's face along the seat in [m/s]."""
    modes = rig.mass.shape[0]
    _displacement, velocity, _acceleration = slide_of(rig, time)
    for i in range(modes):
        velocity -= rig.slopes[point, i] * state[modes + i]
    return velocity


@kernel
def seat_acceleration(drive, time):
    """Forward acceleration of the seat back in [m/s^2]."""
    part = (time - drive.start) / drive.length
    return drive.acceleration_0 + part * (drive.acceleration_1 - drive.acceleration_0)


@kernel
def unit_normal(rig, mode, point, approach, approach_rate):
    """Normal force in [N] of the whole law at this approach; 0 where the point is apart or released."""
    if mode.contact[point] == APART or mode.contact[point] == RELEASED:
        return 0.0
    return normal_force(rig.contact.elastic, rig.contact.dissipative, approach, approach_rate, 1.0)


@kernel
def unit_friction(friction, rig, mode, point, time, normal, state):
    """Friction force in [N] of the whole law, and the velocity along the seat in [m/s]; 0 without friction."""
    if friction is None:
        return 0.0, 0.0
    velocity = tangential_velocity(rig, time, state, point)
    deflection = state[2 * rig.mass.shape[0] + point]
    return friction_force(friction, mode.friction[point], normal, deflection, velocity), velocity


@kernel
def _free_rates(rig, acceleration, state, out):
    """Modal forces without contact, into the places of the accelerations; returns supplied and lost power."""
    modes = rig.mass.shape[0]
    supplied = 0.0
    lost = 0.0
    for i in range(modes):
        velocity = state[modes + i]
        shaking = rig.shaken[i] * acceleration
        damper = rig.damping[i] * velocity
        out[i] = velocity
        out[modes + i] = rig.preload[i] + shaking - rig.stiffness[i] * state[i] - damper
        supplied += shaking * velocity
        lost += damper * velocity
    return supplied, lost


@kernel
def _point_rates(rig, mode, point, time, state, out):
    """Add a touching point's forces to the modal forces; returns supplied and lost power."""
    modes, points = rig.mass.shape[0], rig.gaps.shape[0]
    share = rig.shares[point]
    approach, approach_rate = approach_of(rig, state, point)
    normal = unit_normal(rig, mode, point, approach, approach_rate)
    tangential, velocity = unit_friction(rig.contact.friction, rig, mode, point, time, normal, state)
    for i in range(modes):
        out[modes + i] += share * (rig.slopes[point, i] * tangential - rig.shapes[point, i] * normal)
    power = share * normal * approach_rate
    out[2 * modes + point] = velocity if mode.friction[point] == STICK else 0.0
    out[2 * modes + points + point] = power if mode.contact[point] == CLOSING else 0.0
    out[2 * modes + 2 * points + point] = -power if mode.contact[point] == OPENING else 0.0
    _displacement, slide_velocity, _acceleration = slide_of(rig, time)
    rubbed = share * tangential * velocity
    lost = power - share * elastic_force(rig.contact.elastic, approach) * approach_rate
    return share * tangential * slide_velocity, lost + rubbed


@kernel
def _rate(rig, drive, mode, time, state, out):
    modes, points = rig.mass.shape[0], rig.gaps.shape[0]
    supplied, lost = _free_rates(rig, seat_acceleration(drive, time), state, out)
    for c in range(points):
        if mode.contact[c] == APART:
            out[2 * modes + c] = 0.0
            out[2 * modes + points + c] = 0.0
            out[2 * modes + 2 * points + c] = 0.0
            continue
        supplied_here, lost_here = _point_rates(rig, mode, c, time, state, out)
        supplied += supplied_here
        lost += lost_here
    for i in range(modes):
        out[modes + i] /= rig.mass[i]
    out[state.shape[0] - 2] = supplied
    out[state.shape[0] - 1] = lost


@kernel
def _friction_margin(friction, rig, mode, point, time, approach, approach_rate, state, derivative):
    if friction is None:
        return 1.0
    doing = mode.friction[point]
    if doing == UNLOADED:
        return 1.0
    modes = rig.mass.shape[0]
    normal = unit_normal(rig, mode, point, approach, approach_rate)
    velocity = tangential_velocity(rig, time, state, point)
    if doing == STICK:
        return stick_margin(friction, normal, state[2 * modes + point], velocity)
    _displacement, _velocity, acceleration = slide_of(rig, time)
    approach_acceleration = 0.0
    for i in range(modes):
        approach_acceleration += rig.shapes[point, i] * derivative[modes + i]
        acceleration -= rig.slopes[point, i] * derivative[modes + i]
    contact = rig.contact
    normal_rate = normal_force_rate(
        contact.elastic, contact.dissipative, approach, approach_rate, approach_acceleration, 1.0
    )
    return slip_margin(friction, doing, velocity, acceleration, normal, normal_rate)


@kernel
def _tension_margin(rig, doing, approach, approach_rate):
    if doing in (APART, CLOSING):
        return 1.0
    margin = tension_margin(rig.contact.elastic, rig.contact.dissipative, approach, approach_rate, 1.0)
    return -margin if doing == RELEASED else margin


@kernel
def _turn_margin(doing, approach_rate):
    if doing == CLOSING:
        return approach_rate
    return -approach_rate if doing == OPENING else 1.0


@kernel
def _margins(rig, drive, mode, time, state, derivative, out):
    points = rig.gaps.shape[0]
    for c in range(points):
        approach, approach_rate = approach_of(rig, state, c)
        doing = mode.contact[c]
        out[c] = -approach if doing == APART else approach
        out[points + c] = _tension_margin(rig, doing, approach, approach_rate)
        out[2 * points + c] = _turn_margin(doing, approach_rate)
        out[3 * points + c] = _friction_margin(
            rig.contact.friction, rig, mode, c, time, approach, approach_rate, state, derivative
        )


@kernel
def _load(rig, mode, point, time, approach_rate, state):
    """A point begins to carry, and slips the way it moves."""
    mode.contact[point] = CLOSING if approach_rate > 0.0 else OPENING
    velocity = tangential_velocity(rig, time, state, point)
    mode.friction[point] = STICK if velocity == 0.0 else (1 if velocity > 0.0 else -1)
    state[2 * rig.mass.shape[0] + point] = 0.0


@kernel
def _unload(rig, mode, point, time, state, becomes):
    """A point ceases to carry or to overlap, and its friction spring is free."""
    if mode.contact[point] != RELEASED:
        note_loss(mode, point, time)
    mode.contact[point] = becomes
    mode.friction[point] = UNLOADED
    state[2 * rig.mass.shape[0] + point] = 0.0


@kernel
def _pass_approach(rig, mode, point, time, approach, approach_rate, state):
    if mode.contact[point] == APART:
        begin_episode(rig, mode, point, time, approach, state)
        _load(rig, mode, point, time, approach_rate, state)
    else:
        _unload(rig, mode, point, time, state, APART)
        end_episode(rig, mode, point, state)


@kernel
def _pass_turn(mode, point, approach):
    note_turn(mode, point, approach)
    mode.contact[point] = OPENING if mode.contact[point] == CLOSING else CLOSING


@kernel
def _pass_friction(friction, rig, mode, point, time, approach, approach_rate, state):
    if friction is None:
        return
    place = 2 * rig.mass.shape[0] + point
    velocity = tangential_velocity(rig, time, state, point)
    if mode.friction[point] == STICK:
        mode.friction[point] = 1 if friction.stiffness * state[place] + friction.damping * velocity > 0.0 else -1
    else:
        normal = unit_normal(rig, mode, point, approach, approach_rate)
        state[place] = following_deflection(friction, mode.friction[point], normal, velocity)
        mode.friction[point] = STICK


@kernel
def _pass_kinematic(rig, mode, event_point, turns, time, state):
    """Let the event's point touch, leave or turn, and with it every other whose event falls on the same instant."""
    for c in range(rig.gaps.shape[0]):
        approach, approach_rate = approach_of(rig, state, c)
        doing = mode.contact[c]
        passes = (
            abs(approach) <= SIMULTANEOUS and abs(approach_rate) > AT_REST and (approach_rate > 0.0) == (doing == APART)
        )
        turned = _turn_margin(doing, approach_rate) < 0.0
        if c == event_point:
            passes, turned = not turns, turns
        if passes:
            _pass_approach(rig, mode, c, time, approach, approach_rate, state)
        elif turned:
            _pass_turn(mode, c, approach)


@kernel
def _switch(rig, drive, mode, time, state, event, side):
    points = rig.gaps.shape[0]
    point = event % points
    kind = event // points
    if kind in (APPROACH_EVENT, TURN_EVENT):
        _pass_kinematic(rig, mode, point, kind == TURN_EVENT, time, state)
        return 1.0
    approach, approach_rate = approach_of(rig, state, point)
    if kind == FRICTION_EVENT:
        _pass_friction(rig.contact.friction, rig, mode, point, time, approach, approach_rate, state)
    elif mode.contact[point] == RELEASED:
        _load(rig, mode, point, time, approach_rate, state)
    else:
        _unload(rig, mode, point, time, state, RELEASED)
    return 1.0


@kernel
def _slips(friction, mode):
    if friction is None:
        return False
    slipping = 0
    for c in range(mode.friction.shape[0]):
        slipping += 1 if mode.friction[c] != STICK and mode.friction[c] != UNLOADED else 0
    return slipping > 0


@kernel
def _need_rate(rig, mode):
    return _slips(rig.contact.friction, mode)


register(Backrest, _rate, _margins, _switch, _need_rate)
