"""Seat rig, tire rig and car: road -> tire -> suspension -> floor -> seat -> occupant, with any
part absent.

Vertical motion (z up), and the occupant's sliding on the cushion (x forward) where the scene calls
for friction.

* wheel  ``m_w z_w'' = F_tire - m_w g - F_susp``, ``F_susp = k (z_w - z_b) + c (z_w' - z_b')``; with
  a rigid ring the force of its sidewalls takes the place of F_tire
* belt   ``m_r z_r'' = F_tire - m_r g - F_side``, ``F_side = k (z_r - z_w) + c (z_r' - z_w')``
* body   ``m_b z_b'' = F_susp - m_b g - F_seat + m_b a_z(t)`` (a_z: what the drive line gives to the
  free body)
* frame  ``m_0 z_0'' = F_seat - m_0 g + sum_i [k_i (z_i - z_0) + c_i (z_i' - z_0')]``
* masses ``m_i z_i'' = -m_i g - k_i (z_i - z_0) - c_i (z_i' - z_0')``
* slide  ``M x'' = -M a_x(t) - F_t`` relative to the seat, M the whole occupant

Approaches: tire ``h(t) - z_w`` (belt: ``h(t) - z_r``), h the effective road height; seat ``z_floor
+ h_c(t) - z_0``, h_c that of the cushion.
Without a tire the floor is the (accelerated) frame of reference: z_floor = 0 and every mass feels
``-m a_z(t)``. State: [z_w, z_b, v_w, v_b] [z_r, v_r] [z_0 .. z_n, v_0 .. v_n] [x, v_x, s] [z]
[supplied, dissipated]; z is the hysteresis variable of a foam cushion
(``laws/foam_hysteresis.py``), the last two are the works in [J] that the energy ledger needs. Works
of friction and foam are counted whole; what their springs hold is taken off in
``advance.energies``.
"""

from __future__ import annotations

from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.integrate.interface import register_rig
from contact_sim_pkg.laws import normal_force as law
from contact_sim_pkg.laws.elastic_law import elastic_force
from contact_sim_pkg.laws.foam_hysteresis import (
    hysteresis_factor,
    hysteresis_factor_rate,
    hysteresis_rate,
    reversal_event,
)
from contact_sim_pkg.laws.friction import (
    SEPARATED,
    STICK,
    following_deflection,
    friction_force,
    slip_event,
    stick_event,
)
from contact_sim_pkg.rigs.vehicle.parameters import Vehicle
from contact_sim_pkg.rigs.vehicle.quarter_car import (
    body_power,
    drive_at,
    push_at,
    rigid_ring_rates,
    tire_approach,
    tire_rates,
    tread_velocity,
)

TIRE_APPROACH, TIRE_TENSION, SEAT_APPROACH, SEAT_TENSION, SEAT_FRICTION, SEAT_REVERSAL, EVENT_FUNCTIONS = (
    0,
    1,
    2,
    3,
    4,
    5,
    6,
)


@borrowing_kernel
def _floor(tire, state):
    if tire is None:
        return 0.0, 0.0
    return state[1], state[3]


@borrowing_kernel
def seat_approach(tire, seat, cushion, cushion_rate, state):
    """Approach in [m] and its rate in [m/s]; separated where there is no seat."""
    if seat is None:
        return -1.0, 0.0
    floor, floor_rate = _floor(tire, state)
    frame = seat.offset
    frame_rate = seat.offset + 1 + seat.masses.shape[0]
    return floor + cushion - state[frame], floor_rate + cushion_rate - state[frame_rate]


@borrowing_kernel
def normal_force(contact, approach, approach_rate, state):
    """Normal force of a contact in [N]; 0 where the contact is absent."""
    if contact is None:
        return 0.0
    factor = hysteresis_factor(contact.hysteresis, state)
    return law.normal_force(contact.elastic, contact.dissipative, approach, approach_rate, factor)


@borrowing_kernel
def _lost_power(contact, approach, approach_rate, force, state, out):
    """Power in [W] that the loss of a contact takes: (F - F_elastic) x'. Writes the rate of the
    hysteresis variable.
    """
    if contact is None:
        return 0.0
    carried = elastic_force(contact.elastic, approach)
    hysteresis_rate(contact.hysteresis, carried * approach_rate, state, out)
    return (force - carried) * approach_rate


@borrowing_kernel
def _seat_rates(tire, seat, gravity, force, acceleration_z, state, out):
    """Rates of frame and masses; returns the power that their links take and that the frame's
    inertia brings in.
    """
    if seat is None:
        return 0.0, 0.0
    # Without a tire the seat moves in the frame of the shaken floor.
    field = -gravity
    if tire is None:
        field -= acceleration_z
    count = seat.masses.shape[0]
    z = seat.offset
    v = seat.offset + 1 + count
    # Links between frame and masses; `brought` is the momentum that the floor accelerates.
    total = force
    lost = 0.0
    brought = seat.frame_mass * state[v]
    for i in range(count):
        closing = state[v + 1 + i] - state[v]
        link = seat.stiffness[i] * (state[z + 1 + i] - state[z]) + seat.damping[i] * closing
        total += link
        lost += seat.damping[i] * closing * closing
        brought += seat.masses[i] * state[v + 1 + i]
        out[z + 1 + i] = state[v + 1 + i]
        out[v + 1 + i] = field - link / seat.masses[i]
    out[z] = state[v]
    out[v] = field + total / seat.frame_mass
    if tire is None:
        return lost, -acceleration_z * brought
    return lost, 0.0


@borrowing_kernel
def seat_mass(seat):
    """Mass of the whole occupant in [kg]."""
    if seat is None:
        return 0.0
    total = seat.frame_mass
    for i in range(seat.masses.shape[0]):
        total += seat.masses[i]
    return total


@borrowing_kernel
def _slide_index(seat):
    return seat.offset + 2 * (1 + seat.masses.shape[0])


@borrowing_kernel
def _slide_rates(friction, seat, mode, normal, acceleration_x, state, out):
    """Rates of the slide; returns the power that friction takes up and the power that the floor's x
    motion brings in.
    """
    if friction is None:
        return 0.0, 0.0
    x = _slide_index(seat)
    velocity = state[x + 1]
    force = friction_force(friction, mode[0], normal, state[x + 2], velocity)
    mass = seat_mass(seat)
    out[x] = velocity
    out[x + 1] = -acceleration_x - force / mass
    out[x + 2] = velocity if mode[0] == STICK else 0.0
    return force * velocity, -mass * acceleration_x * velocity


@borrowing_kernel
def _friction_of(contact):
    if contact is None:
        return None
    return contact.friction


@borrowing_kernel
def _rate(rig, drive, mode, time, state, out):
    height, height_rate, cushion, cushion_rate, a_x, a_z = drive_at(drive, time)
    tire_x, tire_v = tire_approach(rig.tire, rig.rigid_ring, height, height_rate, state)
    tire_force = normal_force(rig.tire_contact, tire_x, tire_v, state)
    push = push_at(drive, time) if tire_x > 0.0 else 0.0
    on_wheel, lost_in_sidewalls = rigid_ring_rates(rig.rigid_ring, rig.gravity, tire_force + push, state, out)
    seat_x, seat_v = seat_approach(rig.tire, rig.seat, cushion, cushion_rate, state)
    seat_force = normal_force(rig.seat_contact, seat_x, seat_v, state)
    lost = lost_in_sidewalls
    lost += tire_rates(rig.tire, rig.gravity, on_wheel, seat_force, a_z, state, out)
    lost_in_links, brought = _seat_rates(rig.tire, rig.seat, rig.gravity, seat_force, a_z, state, out)
    rubbed, brought_x = _slide_rates(_friction_of(rig.seat_contact), rig.seat, mode, seat_force, a_x, state, out)
    lost += lost_in_links + rubbed
    lost += _lost_power(rig.tire_contact, tire_x, tire_v, tire_force, state, out)
    lost += _lost_power(rig.seat_contact, seat_x, seat_v, seat_force, state, out)
    last = state.shape[0]
    out[last - 2] = brought + brought_x + tire_force * height_rate + seat_force * cushion_rate
    out[last - 2] += body_power(rig.tire, a_z, state) + push * tread_velocity(rig.tire, rig.rigid_ring, state)
    out[last - 1] = lost


@borrowing_kernel
def _tension_of(contact, approach, approach_rate, state):
    if contact is None:
        return 1.0
    factor = hysteresis_factor(contact.hysteresis, state)
    return law.tension_event(contact.elastic, contact.dissipative, approach, approach_rate, factor)


@borrowing_kernel
def _reversal_of(contact, approach, approach_rate):
    if contact is None:
        return 1.0
    return reversal_event(contact.hysteresis, approach, approach_rate)


@borrowing_kernel
def _normal_rate(contact, approach, approach_rate, approach_acceleration, state, derivative):
    """Rate of the normal force in [N/s]; 0 where the bodies part faster than the material
    recovers.
    """
    factor = hysteresis_factor(contact.hysteresis, state)
    force_rate = law.normal_force_rate(
        contact.elastic, contact.dissipative, approach, approach_rate, approach_acceleration, factor
    )
    return force_rate + hysteresis_factor_rate(contact.hysteresis, derivative) * elastic_force(
        contact.elastic, approach
    )


@borrowing_kernel
def _friction_event(friction, contact, tire, seat, mode, approach, approach_rate, state, derivative):
    if friction is None:
        return 1.0
    if mode[0] == SEPARATED:
        return 1.0
    x = _slide_index(seat)
    normal = normal_force(contact, approach, approach_rate, state)
    if mode[0] == STICK:
        return stick_event(friction, normal, state[x + 2], state[x + 1])
    floor_acceleration = 0.0
    if tire is not None:
        floor_acceleration = derivative[3]
    frame_acceleration = derivative[seat.offset + 1 + seat.masses.shape[0]]
    normal_rate = _normal_rate(
        contact, approach, approach_rate, floor_acceleration - frame_acceleration, state, derivative
    )
    return slip_event(friction, mode[0], state[x + 1], derivative[x + 1], normal, normal_rate)


@borrowing_kernel
def _event_functions(rig, drive, mode, time, state, derivative, out):
    height, height_rate, cushion, cushion_rate, _a_x, _a_z = drive_at(drive, time)
    tire_x, tire_v = tire_approach(rig.tire, rig.rigid_ring, height, height_rate, state)
    seat_x, seat_v = seat_approach(rig.tire, rig.seat, cushion, cushion_rate, state)
    out[TIRE_APPROACH] = tire_x
    out[TIRE_TENSION] = _tension_of(rig.tire_contact, tire_x, tire_v, state)
    out[SEAT_APPROACH] = seat_x
    out[SEAT_TENSION] = _tension_of(rig.seat_contact, seat_x, seat_v, state)
    out[SEAT_REVERSAL] = _reversal_of(rig.seat_contact, seat_x, seat_v)
    out[SEAT_FRICTION] = _friction_event(
        _friction_of(rig.seat_contact), rig.seat_contact, rig.tire, rig.seat, mode, seat_x, seat_v, state, derivative
    )


@borrowing_kernel
def _friction_transition(friction, contact, seat, mode, approach, approach_rate, state, event, direction):
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
    x = _slide_index(seat)
    velocity = state[x + 1]
    if event == SEAT_FRICTION:
        normal = normal_force(contact, approach, approach_rate, state)
        if mode[0] == STICK:
            mode[0] = 1 if friction.stiffness * state[x + 2] + friction.damping * velocity > 0.0 else -1
        else:
            state[x + 2] = following_deflection(friction, mode[0], normal, velocity)
            mode[0] = STICK
    # A contact that gains its load starts unstrained, and sticks only from rest.
    elif event in (SEAT_APPROACH, SEAT_TENSION):
        other = _tension_of(contact, approach, approach_rate, state) if event == SEAT_APPROACH else approach
        state[x + 2] = 0.0
        if direction > 0.0 and other > 0.0:
            mode[0] = STICK if velocity == 0.0 else (1 if velocity > 0.0 else -1)
        else:
            mode[0] = SEPARATED


@borrowing_kernel
def _mode_transition(rig, drive, mode, time, state, event, direction):
    _height, _height_rate, cushion, cushion_rate, _a_x, _a_z = drive_at(drive, time)
    seat_x, seat_v = seat_approach(rig.tire, rig.seat, cushion, cushion_rate, state)
    _friction_transition(
        _friction_of(rig.seat_contact), rig.seat_contact, rig.seat, mode, seat_x, seat_v, state, event, direction
    )
    return 1.0 if event == SEAT_FRICTION else direction


@borrowing_kernel
def _slips(friction, mode):
    if friction is None:
        return False
    return mode[0] != STICK and mode[0] != SEPARATED


@borrowing_kernel
def _need_rate(rig, mode):
    return _slips(_friction_of(rig.seat_contact), mode)


register_rig(Vehicle, _rate, _event_functions, _mode_transition, _need_rate)
