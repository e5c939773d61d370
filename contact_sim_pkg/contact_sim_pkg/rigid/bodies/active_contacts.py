"""Points on the ground: when a rebound ends in rest, what holds them over a sub-step, where a
point lands.

Each function is one step of `rigid/motion/time_loop.py` and `rigid/motion/located.py`, which solve
the contact problems between them. A rebound below the rest speed ends after ``2 u/(a (1 - e))``,
the rest of the geometric series. Source: Identifiability eqs 9-11.
"""

from __future__ import annotations

import math

from contact_sim_pkg.compiled.jit import entry, kernel
from contact_sim_pkg.rigid.bodies.body import Ground, Motion, RigidBody, is_ridge, on_profile, point_arm
from contact_sim_pkg.rigid.bodies.flight import gap_change
from contact_sim_pkg.rigid.bodies.motion import (
    ACTIVE,
    SEPARATED,
    STICKING,
    TOUCHING,
    MotionWorkspace,
    apply_impulse,
    contact_velocities,
    displace,
    fill_active_problem,
    free_velocity,
    update_contacts,
)
from contact_sim_pkg.rigid.geometry.profile import time_to_kink
from contact_sim_pkg.rigid.problem import PLANE
from contact_sim_pkg.rigid.rotation import gyroscopic_rate, spin_in_body

ROUNDING_SPEED = 1.0e-13  # of the speed scale: below it a velocity is rounding
LANDED = 1.0e-11  # of the size: a point this far below the ground has landed
# of the size: a gap of an active point that is closed again, which turning bodies need
DRIFT = 1.0e-10
LEAVES = 1.0e-9  # [m/s^2]: less is the rounding of an acceleration
HOLD_SWEEPS = 20


@entry
def survey_points(
    body: RigidBody, ground: Ground, motion: Motion, work: MotionWorkspace, size: float, gravity: float
) -> tuple[float, bool]:
    """Gaps and contact velocities; returns the velocity [m/s] that counts as rounding, and whether
    a touching point approaches.
    """
    update_contacts(body, ground, motion, work)
    scale = math.sqrt(gravity * size)
    for k in range(motion.velocity.shape[0]):
        scale = max(scale, abs(motion.velocity[k]) * (1.0 if k < body.width else size))
    rounding, found = ROUNDING_SPEED * scale, False
    for i in range(work.flags.shape[0]):
        found = found or (work.flags[i] == TOUCHING and work.u[i * body.width] < -rounding)
    return rounding, found


@entry
def prepare_impact(body: RigidBody, work: MotionWorkspace, rest_speed: float) -> None:
    """The problem of all points on the ground; those slower than ``rest_speed`` [m/s] do not
    bounce.
    """
    for i in range(work.flags.shape[0]):
        work.restitution[i] = body.restitution if work.u[i * body.width] < -rest_speed else 0.0
    fill_active_problem(body, work, TOUCHING)


@entry
def finish_impact(body: RigidBody, motion: Motion, work: MotionWorkspace, rest_speed: float) -> None:
    """Apply the impulses; active points that now leave faster than ``rest_speed`` [m/s] are active
    no longer.
    """
    apply_impulse(work.J, work.W, work.impulse, motion.velocity)
    contact_velocities(work.J, motion.velocity, work.u)
    for i in range(work.flags.shape[0]):
        if work.flags[i] >= ACTIVE and work.u[i * body.width] > rest_speed:
            work.flags[i] = TOUCHING


@kernel
def _turning_acceleration(body, ground, motion, J, i):
    """``w x (w x r)`` of the point of contact ``i`` along its rows; the sphere about the point
    rolls and does not count.
    """
    v, R, row, width = motion.velocity, motion.rotation, i * body.width, body.width
    x, y, z = point_arm(body, R, i // ground.profile.reach)
    if width == PLANE:
        a_x, a_z = -v[2] * v[2] * x, -v[2] * v[2] * z
        return J[row, 0] * a_x + J[row, 1] * a_z, J[row + 1, 0] * a_x + J[row + 1, 1] * a_z, 0.0
    along, square = v[3] * x + v[4] * y + v[5] * z, v[3] * v[3] + v[4] * v[4] + v[5] * v[5]
    a_x, a_y, a_z = v[3] * along - square * x, v[4] * along - square * y, v[5] * along - square * z
    return (
        J[row, 0] * a_x + J[row, 1] * a_y + J[row, 2] * a_z,
        J[row + 1, 0] * a_x + J[row + 1, 1] * a_y + J[row + 1, 2] * a_z,
        J[row + 2, 0] * a_x + J[row + 2, 1] * a_y + J[row + 2, 2] * a_z,
    )


@kernel
def path_acceleration(body, ground, motion, J, i):
    """Accelerations of contact ``i`` along its rows in [m/s^2] at constant velocities: its arm
    turns, the ground is curved.
    """
    if ground.profile.nodes.shape[0] == 0:
        return _turning_acceleration(body, ground, motion, J, i)
    v, row, width = motion.velocity, i * body.width, body.width
    if is_ridge(body, ground, i):  # its axes turn with the body
        away = v[0] * J[row, 0] + v[1] * J[row, 1]
        along = v[0] * J[row + 1, 0] + v[1] * J[row + 1, 1]
        return -v[2] * v[2] * J[row + 1, 2] - 2.0 * v[2] * along, v[2] * (v[2] * J[row, 2] + 2.0 * away), 0.0
    x, z = motion.position[0], motion.position[width - 1]
    _gap, n_x, n_z, _x, _y, _z, curvature, _feature = on_profile(body, ground, motion.rotation, x, z, i)
    along = v[0] * n_z - v[width - 1] * n_x
    normal, first, second = _turning_acceleration(body, ground, motion, J, i)
    # over a peak the arm of a sphere turns with the normal, about which it spins
    if width != PLANE:
        second -= body.radius * curvature * along * (v[3] * n_x + v[5] * n_z)
    return normal + curvature * along * along, first, second


@kernel
def _gyroscopic_acceleration(body, motion, work, row):
    """Along ``row`` of a contact, from the spin that a body in space changes by itself: ``I dw/dt =
    -w x Iw``.
    """
    R = motion.rotation
    w = spin_in_body(R, motion.velocity)
    gain = gyroscopic_rate(body.inertia, w[0], w[1], w[2])
    total = 0.0
    for k in range(3):
        total += work.J[row, 3 + k] * (R[k, 0] * gain[0] + R[k, 1] * gain[1] + R[k, 2] * gain[2])
    return total


@kernel
def _normal_acceleration(body, ground, motion, work, i):
    """Of a point without contact forces: from the load, from its path, and from the gyroscopic
    term.
    """
    total = path_acceleration(body, ground, motion, work.J, i)[0]
    if body.width != PLANE:
        total += _gyroscopic_acceleration(body, motion, work, i * body.width)
    for k in range(body.load.shape[0]):
        for m in range(body.load.shape[0]):
            total += work.J[i * body.width, k] * work.W[k, m] * body.load[m]
    return total


@kernel
def drop_spin(body, velocity, size, rounding):
    """Set spins of ``velocity`` to 0 that move no point of the body faster than ``rounding`` [m/s]:
    they are rounding.
    """
    for k in range(body.width, velocity.shape[0]):
        if abs(velocity[k]) * size <= rounding:
            velocity[k] = 0.0


@kernel
def remove_normal_velocity(body, motion, work, size, rounding):
    """Remove the rest of the normal velocity of active points, one after the other (it is below the
    rest speed).

    The impulses that this takes, towards the ground, are added to ``work.impulse``. On a slope the
    normal velocity of a body that slides has rounding, and taking it from one point after the other
    spins the body by as much: `drop_spin`.
    """
    n = motion.velocity.shape[0]
    # Gauss-Seidel sweeps over the active normals, until none moves
    for _ in range(HOLD_SWEEPS):
        moved = False
        for i in range(work.flags.shape[0]):
            row, speed, weight = i * body.width, 0.0, 0.0
            if work.flags[i] >= ACTIVE:
                for k in range(n):
                    speed += work.J[row, k] * motion.velocity[k]
            if speed == 0.0:
                continue
            moved = True
            for k in range(n):
                for m in range(n):
                    # inverse mass of the contact along its normal
                    weight += work.J[row, k] * work.W[k, m] * work.J[row, m]
            # impulse that stops it
            work.impulse[row] -= speed / weight
            for k in range(n):
                for m in range(n):
                    motion.velocity[k] -= work.W[k, m] * work.J[row, m] * speed / weight
        if not moved:
            break
    drop_spin(body, motion.velocity, size, rounding)


@kernel
def settle_points(
    body: RigidBody,
    ground: Ground,
    motion: Motion,
    work: MotionWorkspace,
    rest_speed: float,
    size: float,
    rounding: float,
) -> tuple[float, bool]:
    """Make points active whose rebound is below the rest speed and that the load, or may be the
    others, press down.

    Also those that approach by rounding and that nothing takes away.

    Returns the time in [s] that their last bounces take, and whether any point is active.
    ``work.impulse`` is what takes the speed of their rebound from them: the weight carries them
    over the last bounces, and this much less.
    """
    wait, active = 0.0, False
    for row in range(work.impulse.shape[0]):
        work.impulse[row] = 0.0
    for i in range(work.flags.shape[0]):
        speed = work.u[i * body.width]
        if work.flags[i] == ACTIVE or work.flags[i] == STICKING:
            active = True
            continue
        if work.flags[i] == SEPARATED or abs(speed) > rest_speed:
            continue
        acceleration = _normal_acceleration(body, ground, motion, work, i)
        if acceleration < 0.0 or (
            speed < 0.0 and acceleration < LEAVES
        ):  # without weight rounding alone may drive it in
            if speed > rounding and acceleration < 0.0 and body.restitution < 1.0:
                wait = max(wait, 2.0 * speed / (-acceleration * (1.0 - body.restitution)))
            work.flags[i] = ACTIVE
            active = True
    if active:
        for i in range(work.flags.shape[0]):
            if work.flags[i] == TOUCHING and abs(work.u[i * body.width]) <= rest_speed:
                work.flags[i] = ACTIVE
        remove_normal_velocity(body, motion, work, size, rounding)
    return wait, active


@entry
def prepare_attempt(
    body: RigidBody, ground: Ground, motion: Motion, work: MotionWorkspace, time: float, curved: float
) -> None:
    """The problem of the active points over ``time`` [s], without bounce; ``work.free`` is the
    velocity without them.

    ``curved`` 1 counts how arms and normals turn over the sub-step, 0 leaves it out.
    """
    fill_active_problem(body, work, ACTIVE)
    free_velocity(body, motion, work, time)
    q = work.problem.q
    # velocities at the end of the sub-step without contact
    contact_velocities(work.J, work.free, q)
    for i in range(work.flags.shape[0]):
        work.problem.floor[i] = 0.0
        row = i * body.width
        if work.flags[i] < ACTIVE:
            for k in range(row, row + body.width):
                q[k] = 0.0
            continue
        # their change by the curved path of the contact
        gain = path_acceleration(body, ground, motion, work.J, i)
        q[row] += curved * time * gain[0]
        q[row + 1] += curved * time * gain[1]
        if body.width != PLANE:
            q[row + 2] += curved * time * gain[2]


@entry
def landing_part(
    body: RigidBody, ground: Ground, motion: Motion, work: MotionWorkspace, time: float, size: float
) -> tuple[float, int]:
    """Displacement over ``time`` [s]; the part of it after which the first free contact lands, and
    which (1, -1: none does).
    """
    displace(body, motion, work.free, work, time)
    part, first, near = 1.0, -1, LANDED * size
    for i in range(work.flags.shape[0]):
        if work.flags[i] >= ACTIVE:
            continue
        above, speed = max(work.gap[i], 0.0), work.u[i * body.width]
        change = gap_change(body, ground, motion, work, i)
        if above + change >= -near:
            continue
        share = 1.0
        if above > near:
            share = -above / change
        elif speed > 0.0:  # it leaves and comes back
            share = speed / (speed - change / time)
        if share < part:
            part, first = share, i
    return part, first


@entry
def gap_after(body: RigidBody, ground: Ground, motion: Motion, work: MotionWorkspace, time: float, i: int) -> float:
    """Gap in [m] of contact ``i`` after the sub-step of ``time`` [s] whose velocity at its end is
    in ``work.free``.
    """
    displace(body, motion, work.free, work, time)
    return max(work.gap[i], 0.0) + gap_change(body, ground, motion, work, i)


@kernel
def time_to_peak(body, ground, motion, work):
    """Time in [s] until the first sliding contact goes over a peak, at the slip that it has now."""
    profile, width, least = ground.profile, body.width, math.inf
    x, z = motion.position[0], motion.position[width - 1]
    for i in range(work.flags.shape[0]):
        if work.flags[i] >= ACTIVE:
            _gap, _n_x, n_z, r_x, _y, r_z, _c, feature = on_profile(body, ground, motion.rotation, x, z, i)
            # a corner leaves its face, a peak its edge of the body
            ridge, slip = is_ridge(body, ground, i), work.u[i * width + 1]
            time = time_to_kink(
                profile,
                body.points,
                motion.rotation,
                feature,
                is_ridge=ridge,
                x=x + r_x,
                r_x=r_x,
                r_z=r_z,
                along=n_z,
                slip=slip,
            )
            least = min(least, time)
    return least
