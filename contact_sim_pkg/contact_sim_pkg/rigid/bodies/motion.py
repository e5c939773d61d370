"""What both time-stepping schemes share: work space, free flight, displacement, the contact problem
of the points that touch.

Source: Identifiability eqs 3, 4 and 9.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
import numpy.typing

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import borrowing_kernel, kernel
from contact_sim_pkg.rigid.bodies.body import Ground, RigidBody, contact_count, contact_rows, fill_inverse_inertia
from contact_sim_pkg.rigid.problem import DISC, INACTIVE, PLANE, ContactProblem, fill_delassus, make_problem
from contact_sim_pkg.rigid.rotation import free_rotation, gyroscopic_step, orthonormalize, rotate_by, spin_in_body

Flags = numpy.typing.NDArray[numpy.int64]
SEPARATED, TOUCHING, ACTIVE, STICKING = 0, 1, 2, 3
"""States of a contact: in the air; on the ground for an instant; active, which slides unless it is
sticking. A flag of ACTIVE or more is an active contact.
"""


class MotionWorkspace(NamedTuple):
    """Arrays of a body's motion; ``flags`` and ``impulse`` are results as well. The solvers have
    their own.
    """

    problem: ContactProblem
    J: Vector  # [rows, coordinates]
    W: Vector  # [coordinates, coordinates]
    gap: Vector  # [points]
    u: Vector  # [rows]
    impulse: Vector  # [rows], of the last contact solve
    restitution: Vector  # [points]
    free: Vector  # [coordinates], velocity at the end of the sub-step
    shift: Vector  # [width], displacement of the centre of mass over the sub-step
    turned: Vector  # [width, width], rotation at its end
    turn: Vector  # [1], angle turned, in the plane
    flags: Flags  # [contacts]
    push: Vector  # [coordinates], momentum
    feature: Flags  # [contacts], face or edge that each lies on


def make_motion_workspace(body: RigidBody, ground: Ground, facets: int = DISC) -> MotionWorkspace:
    """Work space of ``body`` over a ground that was fitted to it."""
    points, width = contact_count(body, ground), body.width
    coordinates, rows, zeros = len(body.load), points * width, numpy.zeros
    return MotionWorkspace(
        problem=make_problem(points, width, facets),
        J=zeros((rows, coordinates)),
        W=zeros((coordinates, coordinates)),
        gap=zeros(points),
        u=zeros(rows),
        impulse=zeros(rows),
        restitution=zeros(points),
        free=zeros(coordinates),
        shift=zeros(width),
        turned=zeros((width, width)),
        turn=zeros(1),
        flags=zeros(points, numpy.int64),
        push=zeros(coordinates),
        feature=zeros(points, numpy.int64),
    )


@kernel
def update_contacts(body, ground, motion, work):
    """Gaps, Jacobian, inverse inertia and contact velocities of the state as it is."""
    contact_rows(body, ground, motion, work.gap, work.J)
    fill_inverse_inertia(body, motion.rotation, work.W)
    contact_velocities(work.J, motion.velocity, work.u)


@kernel
def contact_velocities(J, velocity, u):
    """``u = J v``."""
    for row in range(u.shape[0]):
        total = 0.0
        for k in range(velocity.shape[0]):
            total += J[row, k] * velocity[k]
        u[row] = total


@kernel
def fill_active_problem(body, work, least):
    """Fill ``A`` and the friction: points with a flag of ``least`` or more are in the problem, the
    others are INACTIVE.
    """
    problem, flags, width = work.problem, work.flags, body.width
    A, friction = problem.A, problem.friction
    fill_delassus(work.J, work.W, A)
    for i in range(flags.shape[0]):
        friction[i] = body.friction if flags[i] >= least else INACTIVE
        if flags[i] >= least:
            continue
        for row in range(i * width, (i + 1) * width):
            for j in range(A.shape[0]):
                A[row, j] = 0.0
                A[j, row] = 0.0
            A[row, row] = 1.0


@borrowing_kernel
def _push_in_plane(J, W, c, velocity):
    """`apply_impulse` of one body in the plane."""
    x, y, turn = 0.0, 0.0, 0.0
    for row in range(c.shape[0]):
        x, y, turn = x + J[row, 0] * c[row], y + J[row, 1] * c[row], turn + J[row, 2] * c[row]
    for k in range(3):
        velocity[k] = velocity[k] + W[k, 0] * x + W[k, 1] * y + W[k, 2] * turn


@borrowing_kernel
def _push_in_space(J, W, c, velocity):
    """`apply_impulse` of one body in space."""
    x, y, z, a, b, d = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for row in range(c.shape[0]):
        p = c[row]
        x, y, z = x + J[row, 0] * p, y + J[row, 1] * p, z + J[row, 2] * p
        a, b, d = a + J[row, 3] * p, b + J[row, 4] * p, d + J[row, 5] * p
    for k in range(6):
        velocity[k] = velocity[k] + W[k, 0] * x + W[k, 1] * y + W[k, 2] * z + W[k, 3] * a + W[k, 4] * b + W[k, 5] * d


@kernel
def apply_impulse(J, W, c, velocity):
    """``v += W J' c`` of one body."""
    if velocity.shape[0] == 3:
        _push_in_plane(J, W, c, velocity)
    else:
        _push_in_space(J, W, c, velocity)


@kernel
def free_velocity(body, motion, work, time):
    """Velocity after ``time`` [s] without contact, into ``work.free``: load, and the gyroscopic
    term by implicit midpoint.
    """
    free, velocity, load, W = work.free, motion.velocity, body.load, work.W
    n = velocity.shape[0]
    for k in range(n):
        free[k] = velocity[k] + (time * load[k] / body.mass if k < body.width else 0.0)
    if body.width == PLANE:
        free[2] += time * load[2] * W[2, 2]
        return
    R = motion.rotation
    before = spin_in_body(R, velocity)
    after = gyroscopic_step(body.inertia[0], body.inertia[1], body.inertia[2], before[0], before[1], before[2], time)
    gain = (after[0] - before[0], after[1] - before[1], after[2] - before[2])
    for k in range(3):
        free[3 + k] = velocity[3 + k] + R[k, 0] * gain[0] + R[k, 1] * gain[1] + R[k, 2] * gain[2]
        for m in range(3):
            free[3 + k] += time * W[3 + k, 3 + m] * load[3 + m]


@kernel
def displace(body, motion, end, work, time):
    """Displacement over ``time`` from the mean of the velocities at its ends, exact for uniform
    acceleration.
    """
    v, shift, turned, R = motion.velocity, work.shift, work.turned, motion.rotation
    for k in range(body.width):
        shift[k] = 0.5 * time * (v[k] + end[k])
        for m in range(body.width):
            turned[k, m] = R[k, m]
    if body.width == PLANE:
        work.turn[0] = 0.5 * time * (v[2] + end[2])
        turn_in_plane(R, work.turn[0], turned)
        return
    # ``end`` is given in the axes of the start
    first, last = spin_in_body(R, v), spin_in_body(R, end)
    rotate_by(turned, 0.5 * (first[0] + last[0]), 0.5 * (first[1] + last[1]), 0.5 * (first[2] + last[2]), time)


@kernel
def turn_in_plane(R, angle, turned):
    """``turned`` = R turned by ``angle`` [rad]."""
    cosine, sine = math.cos(angle), math.sin(angle)
    for m in range(2):
        turned[0, m] = cosine * R[0, m] - sine * R[1, m]
        turned[1, m] = sine * R[0, m] + cosine * R[1, m]


@kernel
def set_turn(R, angle):
    """Rotation by ``angle`` [rad] into ``R`` (plane)."""
    cosine, sine = math.cos(angle), math.sin(angle)
    R[0, 0], R[0, 1], R[1, 0], R[1, 1] = cosine, -sine, sine, cosine


@kernel
def commit(body, motion, end, work):
    """Make the displacement and the velocity ``end`` the state."""
    R = motion.rotation
    for k in range(end.shape[0]):
        motion.velocity[k] = end[k]
    for k in range(body.width):
        motion.position[k] += work.shift[k]
        for m in range(body.width):
            R[k, m] = work.turned[k, m]
    if body.width == PLANE:
        motion.angle[0] += work.turn[0]
        set_turn(R, motion.angle[0])


@kernel
def has_equal_inertias(body):
    """Whether the moments of inertia are equal: the inverse inertia then does not turn with the
    body.
    """
    alike = True
    for k in range(body.inertia.shape[0]):
        alike = alike and body.inertia[k] == body.inertia[0]
    return alike


@kernel
def carry_spin(body, motion, end, work):
    """Turn the spin of ``end`` from the axes of the start of the sub-step to those of its end
    (space).

    That keeps the angular momentum in the axes of the body; one of equal moments of inertia keeps
    its spin in space.
    """
    if body.width == PLANE or has_equal_inertias(body):
        return
    w, turned = spin_in_body(motion.rotation, end), work.turned
    for k in range(3):
        end[3 + k] = turned[k, 0] * w[0] + turned[k, 1] * w[1] + turned[k, 2] * w[2]


@kernel
def free_motion(body, motion, work, time):
    """Displacement, rotation and velocity after ``time`` [s] without contact; ``work.free`` is in
    the axes at its end.
    """
    v, free, load, R, turned = motion.velocity, work.free, body.load, motion.rotation, work.turned
    # centre of mass: exact under a uniform load
    for k in range(body.width):
        gain = time * load[k] / body.mass
        free[k] = v[k] + gain
        work.shift[k] = time * (v[k] + 0.5 * gain)
        for m in range(body.width):
            turned[k, m] = R[k, m]
    if body.width == PLANE:
        gain = time * load[2] / body.inertia[0]
        free[2] = v[2] + gain
        work.turn[0] = time * (v[2] + 0.5 * gain)
        turn_in_plane(R, work.turn[0], turned)
        return
    # spin in space: without spin and torque nothing turns
    w = spin_in_body(R, v)
    if w[0] == 0.0 and w[1] == 0.0 and w[2] == 0.0 and load[3] == 0.0 and load[4] == 0.0 and load[5] == 0.0:
        free[3], free[4], free[5] = 0.0, 0.0, 0.0
        return
    # else by the step of order 6, in body axes
    w = free_rotation(turned, body.inertia, load, w[0], w[1], w[2], time)
    orthonormalize(turned)
    for k in range(3):
        free[3 + k] = turned[k, 0] * w[0] + turned[k, 1] * w[1] + turned[k, 2] * w[2]
