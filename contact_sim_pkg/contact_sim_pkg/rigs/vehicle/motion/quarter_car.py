"""The quarter car inside the vehicle rig: what drives it, wheel and body on their suspension, the
belt on its sidewalls.

Equations and state are those of ``rigs/vehicle/motion/vehicle.py``; a part that the rig lacks is ``None``.
"""

from __future__ import annotations

from contact_sim_pkg.compiled.jit import borrowing_kernel


@borrowing_kernel
def _between(start, end, part):
    return start + (end - start) * part


@borrowing_kernel
def _push_between(start, end, part):
    if start is None:
        return 0.0
    return _between(start, end, part)


@borrowing_kernel
def _height_between(start, end, rate, rate_end, length, part):
    """Height in [m] and its rate in [m/s] at a ``part`` of a segment of ``length`` [s]: the cubic
    of the heights and rates at its ends, or a straight line where no rates are given.
    """
    rise = end - start
    if rate is None:
        return start + rise * part, rise / length
    # Beside the straight line: nothing at the ends, the rates there
    before, behind = rate * length - rise, rate_end * length - rise
    beside = part * (1.0 - part) * (before * (1.0 - part) - behind * part)
    turned = before * (1.0 - part) * (1.0 - 3.0 * part) + behind * part * (3.0 * part - 2.0)
    return start + rise * part + beside, (rise + turned) / length


@borrowing_kernel
def drive_at(drive, time):
    """Road height, its rate, cushion height, its rate, floor accelerations x and z at ``time``."""
    part = (time - drive.start) / drive.length
    height, height_rate = _height_between(
        drive.height_0, drive.height_1, drive.height_rate_0, drive.height_rate_1, drive.length, part
    )
    cushion, cushion_rate = _height_between(
        drive.cushion_0, drive.cushion_1, drive.cushion_rate_0, drive.cushion_rate_1, drive.length, part
    )
    return (
        height,
        height_rate,
        cushion,
        cushion_rate,
        _between(drive.acceleration_x_0, drive.acceleration_x_1, part),
        _between(drive.acceleration_z_0, drive.acceleration_z_1, part),
    )


@borrowing_kernel
def push_at(drive, time):
    """Force in [N] that road asperities add at ``time``; 0 where the scene calls for none."""
    return _push_between(drive.push_0, drive.push_1, (time - drive.start) / drive.length)


@borrowing_kernel
def tread_motion(rigid_ring, state):
    """Height in [m] and velocity in [m/s] of what touches the road: the belt, or the wheel without
    a rigid ring.
    """
    if rigid_ring is None:
        return state[0], state[2]
    return state[rigid_ring.offset], state[rigid_ring.offset + 1]


@borrowing_kernel
def tire_approach(tire, rigid_ring, height, height_rate, state):
    """Approach in [m] and its rate in [m/s]; separated where there is no tire."""
    if tire is None:
        return -1.0, 0.0
    tread, tread_rate = tread_motion(rigid_ring, state)
    return height - tread, height_rate - tread_rate


@borrowing_kernel
def rigid_ring_rates(rigid_ring, gravity, force, state, out):
    """Rates of the belt; returns the force on the wheel and the power that the sidewalls
    dissipate.
    """
    if rigid_ring is None:
        return force, 0.0
    belt = rigid_ring.offset
    closing = state[belt + 1] - state[2]
    sidewalls = rigid_ring.stiffness * (state[belt] - state[0]) + rigid_ring.damping * closing
    out[belt] = state[belt + 1]
    out[belt + 1] = (force - sidewalls) / rigid_ring.belt_mass - gravity
    return sidewalls, rigid_ring.damping * closing * closing


@borrowing_kernel
def tire_rates(tire, gravity, force, seat_force, acceleration_z, state, out):
    """Rates of wheel and body; returns the power that the suspension dissipates."""
    if tire is None:
        return 0.0
    closing = state[2] - state[3]
    suspension = tire.suspension_stiffness * (state[0] - state[1]) + tire.suspension_damping * closing
    out[0] = state[2]
    out[1] = state[3]
    out[2] = (force - suspension) / tire.wheel_mass - gravity
    out[3] = (suspension - seat_force) / tire.body_mass - gravity + acceleration_z
    return tire.suspension_damping * closing * closing


@borrowing_kernel
def body_power(tire, acceleration_z, state):
    if tire is None:
        return 0.0
    return tire.body_mass * acceleration_z * state[3]


@borrowing_kernel
def tread_velocity(tire, rigid_ring, state):
    if tire is None:
        return 0.0
    return tread_motion(rigid_ring, state)[1]
