"""The end of a sub-step with active contacts: it becomes the state, the contacts stay on the
ground, the energy is kept.

The impulses were found with the normals at the start. Half of the normal ones then act along the
normals at the end, so that they do no work to second order; contacts that a turn has left beside
the ground are moved back; what is left of the error in energy goes into the speed. Source: Hairer
and Wanner, Solving Ordinary Differential Equations II, VII.2 (projection).
"""

from __future__ import annotations

import math

from contact_sim_pkg.compiled.jit import entry, kernel
from contact_sim_pkg.rigid.bodies.active_contacts import DRIFT, path_acceleration, remove_normal_velocity
from contact_sim_pkg.rigid.bodies.body import Ground, Motion, RigidBody, contact_rows, lies_on
from contact_sim_pkg.rigid.bodies.flight import TOUCH
from contact_sim_pkg.rigid.bodies.motion import (
    ACTIVE,
    SEPARATED,
    STICKING,
    TOUCHING,
    MotionWorkspace,
    carry_spin,
    commit,
    contact_velocities,
    set_turn,
    update_contacts,
)
from contact_sim_pkg.rigid.motion.slip import slip_of
from contact_sim_pkg.rigid.problem import PLANE
from contact_sim_pkg.rigid.rotation import rotate_by, spin_in_body

USED_UP = 1.0e-9  # of the friction: less left than that counts as slip
LIFTS = 10  # times that the active points are moved back on the ground after a sub-step
SLIGHT = 0.5  # of the kinetic energy: the greatest error of a sub-step that is corrected


@kernel
def _lift(body, ground, motion, work, size):
    """Close the gaps of active contacts: the curved paths of turning bodies leave them beside it
    by errors of third order.
    """
    W, J, R = work.W, work.J, motion.rotation
    for _ in range(LIFTS):
        moved = False
        for i in range(work.flags.shape[0]):
            row, weight = i * body.width, 0.0
            if work.flags[i] < ACTIVE or abs(work.gap[i]) <= DRIFT * size:
                continue
            # move along the inverse mass of the normal row until the gap is closed
            moved = True
            for k in range(work.free.shape[0]):
                work.free[k] = 0.0
                for m in range(work.free.shape[0]):
                    work.free[k] += W[k, m] * J[row, m]
                weight += J[row, k] * work.free[k]
            part = -work.gap[i] / weight
            for k in range(body.width):
                motion.position[k] += part * work.free[k]
            # the rotation that belongs to it
            if body.width == PLANE:
                motion.angle[0] += part * work.free[2]
                set_turn(R, motion.angle[0])
            else:
                w = spin_in_body(R, work.free)
                rotate_by(R, w[0], w[1], w[2], part)
            # gaps and rows of the new place
            contact_rows(body, ground, motion, work.gap, J)
        if not moved:
            break
    for k in range(work.free.shape[0]):
        work.free[k] = motion.velocity[k]


@kernel
def _fill_push(body, work, part):
    """``part`` of the normal impulses, as momentum, added to ``work.push``, which is cleared first
    where the part is negative.
    """
    for k in range(work.push.shape[0]):
        total = 0.0
        for i in range(work.flags.shape[0]):
            total += work.J[i * body.width, k] * work.impulse[i * body.width]
        work.push[k] = part * total if part < 0.0 else work.push[k] + part * total


@kernel
def _turn_push(body, motion, work):
    """Let half of the normal impulses act along the normals at the end of the sub-step: they then
    do no work to second order.
    """
    _fill_push(body, work, 0.5)
    for k in range(work.push.shape[0]):
        for m in range(work.push.shape[0]):
            motion.velocity[k] += work.W[k, m] * work.push[m]


@kernel
def _kinetic_energy(body, motion):
    """In [J]."""
    v, total = motion.velocity, 0.0
    for k in range(body.width):
        total += 0.5 * body.mass * v[k] * v[k]
    if body.width == PLANE:
        return total + 0.5 * body.inertia[0] * v[2] * v[2]
    w = spin_in_body(motion.rotation, v)
    for k in range(3):
        total += 0.5 * body.inertia[k] * w[k] * w[k]
    return total


@kernel
def _mechanical_energy(body, motion):
    """Kinetic energy and that of the uniform load in [J]."""
    total = _kinetic_energy(body, motion)
    for k in range(body.width):
        total -= body.load[k] * motion.position[k]
    return total


@kernel
def _friction_work(body, ground, motion, work, time):
    """Of the tangential impulses on the mean slip of a sub-step of ``time`` [s], in [J]; arms and
    normals turn meanwhile.
    """
    total = 0.0
    for i in range(work.flags.shape[0]):
        row = i * body.width
        first, second = work.impulse[row + 1], work.impulse[row + 2] if body.width != PLANE else 0.0
        if first == 0.0 and second == 0.0:
            continue
        _normal, along_path, across_path = path_acceleration(body, ground, motion, work.J, i)
        a, b = slip_of(body, work, motion.velocity, i)
        c, d = slip_of(body, work, work.free, i)
        total += 0.5 * first * (a + c + time * along_path) + 0.5 * second * (b + d + time * across_path)
    return total


@kernel
def _keep_energy(body, motion, energy):
    """Scale the velocities of a turning body to ``energy`` [J]: that corrects the error of a
    sub-step, if it is slight.
    """
    v, contacts_turn, driven = motion.velocity, False, False
    for k in range(body.width, v.shape[0]):
        contacts_turn, driven = contacts_turn or v[k] != 0.0, driven or body.load[k] != 0.0
    kinetic = _kinetic_energy(body, motion)
    excess = _mechanical_energy(body, motion) - energy
    if not contacts_turn or driven or abs(excess) > SLIGHT * kinetic:
        return
    part = math.sqrt(1.0 - excess / kinetic)
    for k in range(v.shape[0]):
        v[k] *= part


@kernel
def _sticks(body, work, i, rounding):
    """Whether contact ``i`` ends the sub-step without slip: none is left, or friction is not used
    up.
    """
    row = i * body.width
    first, second = slip_of(body, work, work.free, i)
    limit = body.friction * work.impulse[row] * (1.0 - USED_UP)
    across = work.impulse[row + 2] if body.width != PLANE else 0.0
    return math.hypot(first, second) <= 10.0 * rounding or math.hypot(work.impulse[row + 1], across) < limit


@entry
def list_features(body: RigidBody, ground: Ground, motion: Motion, work: MotionWorkspace) -> None:
    """Face or edge of every active contact, into ``work.feature``."""
    for i in range(work.flags.shape[0]):
        if work.flags[i] >= ACTIVE:
            work.feature[i] = lies_on(body, ground, motion, i)


@entry
def stay_on_the_ground(
    body: RigidBody, ground: Ground, motion: Motion, work: MotionWorkspace, size: float, rounding: float
) -> None:
    """Release contacts that left the ground or went over a peak, correct the gaps of the others and
    their normal velocities to 0; ``rounding`` [m/s].
    """
    update_contacts(body, ground, motion, work)
    for i in range(work.flags.shape[0]):
        speed = work.u[i * body.width]
        if work.flags[i] >= ACTIVE:
            over = work.feature[i] != lies_on(body, ground, motion, i)
            if over or (speed > rounding and work.impulse[i * body.width] == 0.0):
                work.flags[i] = SEPARATED if speed > rounding else TOUCHING
        else:
            work.flags[i] = TOUCHING if work.gap[i] <= TOUCH * size else SEPARATED
    _lift(body, ground, motion, work, size)
    update_contacts(body, ground, motion, work)
    remove_normal_velocity(body, motion, work, size, rounding)
    contact_velocities(work.J, motion.velocity, work.u)


@entry
def accept_substep(
    body: RigidBody, ground: Ground, motion: Motion, work: MotionWorkspace, time: float, size: float, rounding: float
) -> float:
    """Accept the sub-step of ``time`` [s] as the state; returns the energy lost in [J].

    Points whose slip has ended stick until friction gives way, points that left are released.
    """
    # modes at the end of the sub-step
    list_features(body, ground, motion, work)
    for i in range(work.flags.shape[0]):
        if work.flags[i] >= ACTIVE:
            work.flags[i] = STICKING if _sticks(body, work, i, rounding) else ACTIVE
    # half of the normal impulses is taken back, to act along the normals at the end
    _fill_push(body, work, -0.5)
    done = _friction_work(body, ground, motion, work, time)
    energy = _mechanical_energy(body, motion) + done
    # the state at the end
    carry_spin(body, motion, work.free, work)
    commit(body, motion, work.free, work)
    update_contacts(body, ground, motion, work)
    # corrections: normals, gaps, energy
    _turn_push(body, motion, work)
    stay_on_the_ground(body, ground, motion, work, size, rounding)
    _keep_energy(body, motion, energy)
    contact_velocities(work.J, motion.velocity, work.u)
    return -done
