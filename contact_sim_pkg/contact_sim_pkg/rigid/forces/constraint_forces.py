"""Forces of active contacts, each in its mode: it sticks, it slides, or it is free.

They keep the contacts on the ground: ``J a + b = 0`` for the normal row of each active contact and
for the tangents of those that stick, with ``a = W (load + gyroscopic torque + J' f)`` and b the
acceleration of the contact at constant velocities (`rigid/bodies/active_contacts.py`); a sliding
contact has ``f_t = -mu f_n s``, s the direction of slip. Where the rows are dependent the forces of
least norm are taken. Source: Identifiability eqs 12-18 and 32-38 at the level of
accelerations.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Modes, Vector
from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.rigid.bodies.active_contacts import path_acceleration
from contact_sim_pkg.rigid.bodies.body import (
    Ground,
    Motion,
    RigidBody,
    contact_count,
    contact_rows,
    fill_inverse_inertia,
)
from contact_sim_pkg.rigid.bodies.body_state import fill_motion, fill_turn
from contact_sim_pkg.rigid.bodies.motion import contact_velocities
from contact_sim_pkg.rigid.contact.line import contact_arm, reach_in_cone
from contact_sim_pkg.rigid.contact.linear import solve_consistent
from contact_sim_pkg.rigid.problem import PLANE
from contact_sim_pkg.rigid.rotation import gyroscopic_rate, spin_in_body

FREE, SLIDES, STICKS = 0, 1, 2  # modes of a contact
GAP, FIRST, SECOND, DEEP, SPARE, PLACE = 0, 1, 2, 3, 4, 5  # rows of `contacts`
VELOCITY, FORCE, RIGHT, ANSWER = 0, 1, 2, 3  # rows of `rows`
SPEED, NEWTONS, NEAR, SECONDS = 0, 1, 2, 3  # entries of `unit`
# times the weight: of friction left, where contacts may squeeze each other without end
PLENTY = 1.0e3
SLIGHT_SLIP = 1.0e-7  # of the speed: below it slip has the direction that it starts with


class ConstrainedBody(NamedTuple):
    """The body, its ground, and arrays to work in."""

    body: RigidBody
    ground: Ground
    # [width, width], rotation at the start; the quaternion of the state turns on from there
    start: Vector
    motion: Motion  # of the state last looked at
    J: Vector  # [rows, coordinates]
    W: Vector  # [coordinates, coordinates]
    # [6, contacts]: gap [m], slip's direction, depth at the start, friction left, face at the start
    contacts: Vector
    rows: Vector  # [4, rows]
    matrices: Vector  # [3, rows, rows]
    columns: Vector  # [coordinates, rows], accelerations by a unit of each unknown force
    # [2, coordinates]: acceleration without contact, then force and torque of everything
    push: Vector
    order: Modes  # [2, rows]: the rows that are active, and work space
    # [4]: speed in [m/s], force in [N], gap in [m] at which a contact has landed, time in [s]
    unit: Vector


def make_constrained_body(body: RigidBody, ground: Ground) -> ConstrainedBody:
    """The rig over a ground that was fitted to ``body``."""
    width, contacts, coordinates, zeros = body.width, contact_count(body, ground), len(body.load), numpy.zeros
    motion, rows = Motion(zeros(width), zeros(1), zeros((width, width)), zeros(coordinates)), contacts * width
    return ConstrainedBody(
        body=body,
        ground=ground,
        start=zeros((width, width)),
        motion=motion,
        J=zeros((rows, coordinates)),
        W=zeros((coordinates, coordinates)),
        contacts=zeros((6, contacts)),
        rows=zeros((4, rows)),
        matrices=zeros((3, rows, rows)),
        columns=zeros((coordinates, rows)),
        push=zeros((2, coordinates)),
        order=zeros((2, rows), numpy.int64),
        unit=zeros(4),
    )


@borrowing_kernel
def update_contacts(rig, state):
    """Motion, gaps, rows, inertia and contact velocities of a state, into the rig's arrays."""
    motion, R, start = rig.motion, rig.motion.rotation, rig.start
    fill_turn(R, state)
    if rig.body.width != PLANE:
        for j in range(3):
            a, b, c = R[0, j], R[1, j], R[2, j]
            for i in range(3):
                R[i, j] = start[i, 0] * a + start[i, 1] * b + start[i, 2] * c
    fill_motion(motion, state)
    contact_rows(rig.body, rig.ground, rig.motion, rig.contacts[GAP], rig.J)
    fill_inverse_inertia(rig.body, rig.motion.rotation, rig.W)
    contact_velocities(rig.J, rig.motion.velocity, rig.rows[VELOCITY])


@borrowing_kernel
def slip_direction(rig, i):
    """Unit direction of the slip of contact ``i``: that of the start where it hardly slips, and
    always in the plane.
    """
    first, second = rig.contacts[FIRST, i], rig.contacts[SECOND, i]
    if rig.body.width == PLANE:
        return first, second
    u, row = rig.rows[VELOCITY], i * rig.body.width
    length = math.hypot(u[row + 1], u[row + 2])
    if length <= SLIGHT_SLIP * rig.unit[SPEED]:
        return first, second
    return u[row + 1] / length, u[row + 2] / length


@borrowing_kernel
def _list_rows(rig, mode):
    """The rows that are active, into ``rig.order``; returns how many."""
    width, count = rig.body.width, 0
    for i in range(mode.shape[0] - 1):
        if mode[i] == FREE:
            continue
        for row in range(i * width, (i + 1) * width if mode[i] == STICKS else i * width + 1):
            rig.order[0, count] = row
            count += 1
    return count


@borrowing_kernel
def _pattern(rig, mode, row, part):
    """How much of row ``part`` of its contact belongs to the unknown force of ``row``: 1 and 0, or
    a unit along the cone's edge.
    """
    width = rig.body.width
    i = row // width
    if mode[i] == STICKS:
        return 1.0 if row == i * width + part else 0.0
    friction = rig.body.friction
    length = math.sqrt(1.0 + friction * friction)
    if part == 0:
        return 1.0 / length
    first, second = slip_direction(rig, i)
    return -friction * (first if part == 1 else second) / length


@borrowing_kernel
def _fill_system(rig, mode, count):
    """Accelerations by the unknown forces, and of the active rows by them."""
    J, W, width, matrix = rig.J, rig.W, rig.body.width, rig.matrices[0]
    n = W.shape[0]
    for place in range(count):
        row = rig.order[0, place]
        base = row // width * width
        for k in range(n):
            rig.columns[k, place] = 0.0
        # acceleration of the body by a unit of the unknown force
        for part in range(width):
            share = _pattern(rig, mode, row, part)
            if share != 0.0:
                for k in range(n):
                    for m in range(n):
                        rig.columns[k, place] += share * W[k, m] * J[base + part, m]
    # its part along each active row
    for i in range(count):
        row = rig.order[0, i]
        for place in range(count):
            total = 0.0
            for k in range(n):
                total += J[row, k] * rig.columns[k, place]
            matrix[i, place] = total


@borrowing_kernel
def _solve(rig, count):
    """Forces of least norm with ``matrices[0] f = RIGHT``, into ``ANSWER``."""
    matrix, copy, square = rig.matrices[0], rig.matrices[1], rig.matrices[2]
    right, answer, order = rig.rows[RIGHT], rig.rows[ANSWER], rig.order[1]
    for i in range(count):
        answer[i] = right[i]
        for j in range(count):
            copy[i, j] = matrix[i, j]
    # full rank: the only answer
    if solve_consistent(copy, answer, rig.rows[FORCE], order, count) == count:
        for i in range(count):
            answer[i] = rig.rows[FORCE, i]
        return
    for i in range(count):
        answer[i] = right[i]
        for j in range(count):
            # short of rank: f = M' y with M M' y = right is the answer of least norm
            square[i, j] = 0.0
            for k in range(count):
                square[i, j] += matrix[i, k] * matrix[j, k]
    solve_consistent(square, answer, rig.rows[FORCE], order, count)
    for j in range(count):
        answer[j] = 0.0
        for i in range(count):
            answer[j] += matrix[i, j] * rig.rows[FORCE, i]


@borrowing_kernel
def _fill_free_acceleration(rig):
    """Acceleration by load and spin, without contact."""
    body, motion, W, gain = rig.body, rig.motion, rig.W, rig.push[0]
    for k in range(body.width):
        gain[k] = body.load[k] / body.mass
    if body.width == PLANE:
        gain[2] = body.load[2] / body.inertia[0]
        return
    R = motion.rotation
    w = spin_in_body(R, motion.velocity)
    x, y, z = gyroscopic_rate(body.inertia, w[0], w[1], w[2])
    for k in range(3):
        gain[3 + k] = R[k, 0] * x + R[k, 1] * y + R[k, 2] * z
        for m in range(3):
            gain[3 + k] += W[3 + k, 3 + m] * body.load[3 + m]


@borrowing_kernel
def _share_friction(rig, i, j):
    """Forces of two sticking contacts along the line through them, of which only the sum is known.

    As little as can be is moved from one to the other so that both stay in their cones; what is
    spare is that of both.
    """
    force, spare, a, b = rig.rows[FORCE], rig.contacts[SPARE], 3 * i, 3 * j
    # unit vector from one contact to the other
    x_i, y_i, z_i = contact_arm(rig.J, a)
    x, y, z = contact_arm(rig.J, b)
    x, y, z = x - x_i, y - y_i, z - z_i
    length = math.sqrt(x * x + y * y + z * z)
    x, y, z = x / length, y / length, z / length
    # how far a force along it leaves each contact in its cone
    room_i, low, high = reach_in_cone(rig.J, force, rig.body.friction, a, x, y, z)
    room_j, low_j, high_j = reach_in_cone(rig.J, force, rig.body.friction, b, -x, -y, -z)
    room = min(room_i, room_j)
    # outside of both cones or never inside: the mode has ended, nothing is shared
    if room < 0.0:
        spare[i], spare[j] = room, room
    if room < 0.0 or math.isnan(low + high) or math.isnan(low_j + high_j):
        return
    # the part that both cones allow
    low, high = max(low, low_j), min(high, high_j)
    spare[i] = min(room, 0.5 * (high - low), PLENTY * rig.unit[NEWTONS])
    spare[j] = spare[i]
    moved = min(max(0.0, low), high) if low <= high else 0.5 * (low + high)
    # equal and opposite along the line: no change of the wrench
    for part in range(3):
        along_i = rig.J[a + part, 0] * x + rig.J[a + part, 1] * y + rig.J[a + part, 2] * z
        along_j = rig.J[b + part, 0] * x + rig.J[b + part, 1] * y + rig.J[b + part, 2] * z
        force[a + part] += moved * along_i
        force[b + part] -= moved * along_j


@borrowing_kernel
def _fill_spare_friction(rig, mode):
    """Friction that sticking contacts have left, in [N], into ``SPARE``."""
    force, width, count, last, other = rig.rows[FORCE], rig.body.width, 0, -1, -1
    for i in range(mode.shape[0] - 1):
        row = i * width
        across = force[row + 2] if width != PLANE else 0.0
        rig.contacts[SPARE, i] = rig.body.friction * force[row] - math.hypot(force[row + 1], across)
        if mode[i] != FREE:
            count += 1
            other, last = (last, i) if mode[i] == STICKS else (other, last)
    if width != PLANE and count == 2 and other >= 0:
        _share_friction(rig, other, last)


@borrowing_kernel
def fill_forces(rig, mode):
    """Forces of all contacts at the state looked at, into ``FORCE``."""
    _fill_free_acceleration(rig)
    J, width, right, force = rig.J, rig.body.width, rig.rows[RIGHT], rig.rows[FORCE]
    count = _list_rows(rig, mode)
    # required accelerations: against those of the path and of the load
    for place in range(count):
        row = rig.order[0, place]
        i = row // width
        normal, first, second = path_acceleration(rig.body, rig.ground, rig.motion, J, i)
        part = row - i * width
        right[place] = -(normal if part == 0 else (first if part == 1 else second))
        for k in range(J.shape[1]):
            right[place] -= J[row, k] * rig.push[0, k]
    _fill_system(rig, mode, count)
    _solve(rig, count)
    # unknown forces as normal and tangential forces of their contacts
    for row in range(force.shape[0]):
        force[row] = 0.0
    for place in range(count):
        row = rig.order[0, place]
        base = row // width * width
        for part in range(width):
            force[base + part] += _pattern(rig, mode, row, part) * rig.rows[ANSWER, place]
    _fill_spare_friction(rig, mode)


@borrowing_kernel
def stop_rows(rig, mode, impulse):
    """Take the rest of the velocity from the active rows of ``rig.motion``, which was looked at, by
    impulses along their forces.

    They are added to ``impulse`` [rows] in [N s].
    """
    count, velocity = _list_rows(rig, mode), rig.motion.velocity
    for place in range(count):
        rig.rows[RIGHT, place] = -rig.rows[VELOCITY, rig.order[0, place]]
    _fill_system(rig, mode, count)
    _solve(rig, count)
    for place in range(count):
        for k in range(velocity.shape[0]):
            velocity[k] += rig.columns[k, place] * rig.rows[ANSWER, place]
        row = rig.order[0, place]
        base = row // rig.body.width * rig.body.width
        for part in range(rig.body.width):
            impulse[base + part] += _pattern(rig, mode, row, part) * rig.rows[ANSWER, place]
