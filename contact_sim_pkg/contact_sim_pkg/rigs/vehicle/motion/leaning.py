"""The occupant between a tilted pan and a seat back: one trunk that both carry, in x and z.

With the tilt phi of the pan and the angle theta of the seat back from the vertical, the pan pushes
along ``n_p = (-sin phi, cos phi)``, the seat back along ``n_b = (cos theta, sin theta)`` in (x, z), x
forward. The whole occupant, of mass M, moves in x as one; in z the pan carries node 0 and the seat
back the trunk, node t:

* ``M x'' = -M a_x - F_p sin phi + F_b cos theta - F_t cos phi - P``, P what feet or hands push;
* node 0 feels ``F_p cos phi - F_t sin phi``, the trunk ``F_b sin theta``;
* approaches ``d_p = x sin phi - z_0 cos phi``, ``d_b = d_0 - x cos theta - z_t sin theta``.

The vertical forces of both add up to the weight once. Without a seat back the pan is level, and x is
the slide on it that friction drives.
"""

from __future__ import annotations

from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.laws.contact_force import contact_energy, contact_force, contact_lost_power
from contact_sim_pkg.laws.friction import SLIP_BACKWARD, SLIP_FORWARD, STICK, following_deflection, friction_force
from contact_sim_pkg.rigs.vehicle.motion.seat import seat_mass, slide_index


@borrowing_kernel
def pan_cosine(back):
    """Vertical part [1] of the pan's force."""
    if back is None:
        return 1.0
    return back.pan_cosine


@borrowing_kernel
def pan_motion(back, seat, state):
    """Height in [m] and velocity in [m/s] of node 0 along the normal of the pan."""
    v = seat.offset + seat.masses.shape[0]
    if back is None:
        return state[seat.offset], state[v]
    x = slide_index(seat)
    return (
        back.pan_cosine * state[seat.offset] - back.pan_sine * state[x],
        back.pan_cosine * state[v] - back.pan_sine * state[x + 1],
    )


@borrowing_kernel
def sliding_in(back, seat, values):
    """Velocity in [m/s] with which x takes the occupant into the pan; of rates, acceleration."""
    if back is None:
        return 0.0
    return back.pan_sine * values[slide_index(seat) + 1]


@borrowing_kernel
def slid(back, seat, values):
    """Velocity in [m/s] along the pan; of ``values`` that are rates of the state, acceleration."""
    x = slide_index(seat)
    if back is None:
        return values[x + 1]
    return back.pan_cosine * values[x + 1] + back.pan_sine * values[seat.offset + seat.masses.shape[0]]


@borrowing_kernel
def back_approach(back, seat, state):
    """Approach in [m] of the trunk to the seat back and its rate in [m/s]; separated without one."""
    if back is None:
        return -1.0, 0.0
    x = slide_index(seat)
    trunk = seat.offset + back.trunk
    return (
        back.place - back.back_cosine * state[x] - back.back_sine * state[trunk],
        -back.back_cosine * state[x + 1] - back.back_sine * state[trunk + seat.masses.shape[0]],
    )


@borrowing_kernel
def back_force(back, approach, approach_rate, state):
    """Force of the seat back in [N] on the trunk; 0 without one."""
    if back is None:
        return 0.0
    return contact_force(back.contact, approach, approach_rate, state)


@borrowing_kernel
def back_lost_power(back, approach, approach_rate, force, state, out):
    """Power in [W] that the seat back's foam takes."""
    if back is None:
        return 0.0
    return contact_lost_power(back.contact, approach, approach_rate, force, state, out)


@borrowing_kernel
def back_energy(back, approach, state):
    """Energies in [J] of the seat back's elastic law and beside it of its hysteresis."""
    if back is None:
        return 0.0, 0.0
    return contact_energy(back.contact, approach, state)


@borrowing_kernel
def _upward(back, normal, friction):
    if back is None:
        return normal
    return back.pan_cosine * normal - back.pan_sine * friction


@borrowing_kernel
def _push_trunk(back, first, pushed, out):
    if back is not None:
        out[first + back.trunk] += back.back_sine * pushed


@borrowing_kernel
def push_up(back, seat, normal, friction, pushed, out):
    """Add the vertical forces [N] of pan and seat back in the places of the accelerations."""
    v = seat.offset + seat.masses.shape[0]
    out[v] += _upward(back, normal, friction)
    _push_trunk(back, v, pushed, out)


@borrowing_kernel
def _pushed(back, normal, friction, held):
    """Force in [N] along x, and what of it is no contact force."""
    if back is None:
        return -friction, 0.0
    along = back.back_cosine * held - back.pan_sine * normal - back.preload
    return along - back.pan_cosine * friction, -back.preload


@borrowing_kernel
def pan_friction(friction, back, seat, mode, normal, state):
    """Friction force in [N] of the occupant on the pan; 0 without friction."""
    if friction is None:
        return 0.0
    return friction_force(friction, mode[0], normal, state[slide_index(seat) + 2], slid(back, seat, state))


@borrowing_kernel
def push_along(friction, back, seat, mode, forces, state, out):
    """Add the force [N] along x of pan, friction and seat back, which are the ``forces`` [N], in the place of the
    acceleration, and write the rate of the friction spring; returns the power [W] that friction takes, and that which
    the push of feet or hands brings in.
    """
    if friction is None and back is None:
        return 0.0, 0.0
    x = slide_index(seat)
    velocity = slid(back, seat, state)
    along, preload = _pushed(back, forces[0], forces[1], forces[2])
    out[x + 1] += along
    out[x + 2] = _stuck(friction, mode, velocity)
    return forces[1] * velocity, preload * state[x + 1]


@borrowing_kernel
def accelerate_along(friction, back, seat, acceleration_x, state, out):
    """Turn the force [N] along x into rates; returns the power [W] that the floor's x motion brings in."""
    if friction is None and back is None:
        return 0.0
    x, mass = slide_index(seat), seat_mass(seat)
    out[x] = state[x + 1]
    out[x + 1] = -acceleration_x + out[x + 1] / mass
    return -mass * acceleration_x * state[x + 1]


@borrowing_kernel
def kinetic_along(friction, back, seat, state):
    """Kinetic energy of x in [J]."""
    if friction is None and back is None:
        return 0.0
    return 0.5 * seat_mass(seat) * state[slide_index(seat) + 1] ** 2


@borrowing_kernel
def spring_energy(friction, back, seat, mode, normal, state):
    """What the spring of friction holds in [J] under a ``normal`` force [N]."""
    if friction is None:
        return 0.0
    deflection = state[slide_index(seat) + 2]
    if mode[0] == SLIP_FORWARD or mode[0] == SLIP_BACKWARD:
        deflection = following_deflection(friction, mode[0], normal, slid(back, seat, state))
    return 0.5 * friction.stiffness * deflection**2


@borrowing_kernel
def _stuck(friction, mode, velocity):
    if friction is None:
        return 0.0
    return velocity if mode[0] == STICK else 0.0
