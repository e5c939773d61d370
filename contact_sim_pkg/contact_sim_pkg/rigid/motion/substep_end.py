"""The end of a piece of time with held contacts: it becomes the state, the contacts stay on the
ground, the energy is kept.

The impulses were found with the normals at the start. Half of the normal ones then act along the
normals at the end, so that they do no work to second order; contacts that a turn has left beside
the ground are put back; what is left of the error in energy goes into the speed. Source: Hairer and
Wanner, Solving Ordinary Differential Equations II, VII.2 (projection).
"""

from __future__ import annotations

import math

from contact_sim_pkg.compiled.jit import entry, kernel
from contact_sim_pkg.rigid.body import Ground, Motion, RigidBody, contact_rows, lies_on
from contact_sim_pkg.rigid.motion.active_contacts import DRIFT, hold_back, path_acceleration
from contact_sim_pkg.rigid.motion.flight import TOUCH
from contact_sim_pkg.rigid.motion.motion import (
    APART,
    HELD,
    STUCK,
    TOUCHING,
    MotionWorkspace,
    carry_spin,
    commit,
    contact_velocities,
    look,
    set_turn,
)
from contact_sim_pkg.rigid.motion.slip import slip_of
from contact_sim_pkg.rigid.problem import PLANE
from contact_sim_pkg.rigid.rotation import rotate_by, spin_in_body

USED_UP = 1.0e-9  # of the friction: less left than that counts as slip
LIFTS = 10  # times that the held points are put back on the ground after a piece
SLIGHT = 0.5  # of the kinetic energy: the greatest error of a piece that is made good


@kernel
def _lift(body, ground, motion, work, size):
    """Put held contacts back on the ground: the curved paths of turning bodies leave them beside it
    by errors of third order.
    """
    W, J, R = work.W, work.J, motion.rotation
    for _ in range(LIFTS):
        moved = False
        for i in range(work.flags.shape[0]):
            row, weight = i * body.width, 0.0
            if work.flags[i] < HELD or abs(work.gap[i]) <= DRIFT * size:
                continue
            moved = True
            for k in range(work.free.shape[0]):
                work.free[k] = 0.0
                for m in range(work.free.shape[0]):
                    work.free[k] += W[k, m] * J[row, m]
                weight += J[row, k] * work.free[k]
            part = -work.gap[i] / weight
            for k in range(body.width):
                motion.position[k] += part * work.free[k]
            if body.width == PLANE:
                motion.angle[0] += part * work.free[2]
                set_turn(R, motion.angle[0])
            else:
                w = spin_in_body(R, work.free)
                rotate_by(R, w[0], w[1], w[2], part)
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
    """Let half of the normal impulses act along the normals at the end of the piece: they then do
    no work to second order.
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
    """Of the tangential impulses on the mean slip of a piece of ``time`` [s], in [J]; arms and
    normals turn meanwhile.
    """
    total = 0.0
    for i in range(work.flags.shape[0]):
        row = i * body.width
        first, second = work.impulse[row + 1], work.impulse[row + 2] if body.width != PLANE else 0.0
        if first == 0.0 and second == 0.0:
            continue
        _normal, bend, across_bend = path_acceleration(body, ground, motion, work.J, i)
        a, b = slip_of(body, work, motion.velocity, i)
        c, d = slip_of(body, work, work.free, i)
        total += 0.5 * first * (a + c + time * bend) + 0.5 * second * (b + d + time * across_bend)
    return total


@kernel
def _keep_energy(body, motion, energy):
    """Scale the velocities of a turning body to ``energy`` [J]: that makes good the error of a
    piece, if it is slight.
    """
    v, turns, driven = motion.velocity, False, False
    for k in range(body.width, v.shape[0]):
        turns, driven = turns or v[k] != 0.0, driven or body.load[k] != 0.0
    kinetic = _kinetic_energy(body, motion)
    excess = _mechanical_energy(body, motion) - energy
    if not turns or driven or abs(excess) > SLIGHT * kinetic:
        return
    part = math.sqrt(1.0 - excess / kinetic)
    for k in range(v.shape[0]):
        v[k] *= part


@kernel
def _sticks(body, work, i, still):
    """Whether contact ``i`` ends the piece without slip: none is left, or friction is not used up."""
    row = i * body.width
    first, second = slip_of(body, work, work.free, i)
    limit = body.friction * work.impulse[row] * (1.0 - USED_UP)
    across = work.impulse[row + 2] if body.width != PLANE else 0.0
    return math.hypot(first, second) <= 10.0 * still or math.hypot(work.impulse[row + 1], across) < limit


@entry
def list_features(body: RigidBody, ground: Ground, motion: Motion, work: MotionWorkspace) -> None:
    """Face or edge of every held contact, into ``work.feature``."""
    for i in range(work.flags.shape[0]):
        if work.flags[i] >= HELD:
            work.feature[i] = lies_on(body, ground, motion, i)


@entry
def stay_on_the_ground(
    body: RigidBody, ground: Ground, motion: Motion, work: MotionWorkspace, size: float, still: float
) -> None:
    """Let contacts go that left the ground or went over a peak, put the others back on it, normal
    velocities to 0.
    """
    look(body, ground, motion, work)
    for i in range(work.flags.shape[0]):
        speed = work.u[i * body.width]
        if work.flags[i] >= HELD:
            over = work.feature[i] != lies_on(body, ground, motion, i)
            if over or (speed > still and work.impulse[i * body.width] == 0.0):
                work.flags[i] = APART if speed > still else TOUCHING
        else:
            work.flags[i] = TOUCHING if work.gap[i] <= TOUCH * size else APART
    _lift(body, ground, motion, work, size)
    look(body, ground, motion, work)
    hold_back(body, motion, work, size, still)
    contact_velocities(work.J, motion.velocity, work.u)


@entry
def take_piece(
    body: RigidBody, ground: Ground, motion: Motion, work: MotionWorkspace, time: float, size: float, still: float
) -> float:
    """Take the piece of ``time`` [s] as the state; returns the energy lost in [J].

    Points whose slip has ended stick until friction gives way, points that left are let go.
    """
    list_features(body, ground, motion, work)
    for i in range(work.flags.shape[0]):
        if work.flags[i] >= HELD:
            work.flags[i] = STUCK if _sticks(body, work, i, still) else HELD
    _fill_push(body, work, -0.5)
    done = _friction_work(body, ground, motion, work, time)
    energy = _mechanical_energy(body, motion) + done
    carry_spin(body, motion, work.free, work)
    commit(body, motion, work.free, work)
    look(body, ground, motion, work)
    _turn_push(body, motion, work)
    stay_on_the_ground(body, ground, motion, work, size, still)
    _keep_energy(body, motion, energy)
    contact_velocities(work.J, motion.velocity, work.u)
    return -done
