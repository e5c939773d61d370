"""A rigid body on a ground that its points press into: the compliant twin of
``rigid/motion/located.py``.

Each point carries a Hunt and Crossley force ``A x**n (1 + lambda x')`` of its own depth x, and the
friction of ``laws/point_friction.py``. lambda is set at every touch from the speed of approach
there, ``lambda = d/x'``, d the loss that delivers the requested restitution
(``laws/restitution.py``): then the ratio of speeds is the requested one at any speed and for any
mass at the point. Below ``slowest`` the speed counts as that, so that a resting contact is damped.

State: [place and turn] [v, omega] (`rigid/bodies/body_state.py`) [spring deflection of each point]
[impulse of each point, normal then tangents, in N s] [work dissipated or lent to friction springs,
in J]. Mode: lambda of each point.

Source: Driver and Seat eqs 7 to 9.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import kernel
from contact_sim_pkg.integrate.interface import register_rig
from contact_sim_pkg.laws.elastic_law import elastic_energy, elastic_force
from contact_sim_pkg.laws.normal_force import normal_force, tension_event
from contact_sim_pkg.laws.parameters import Friction, NormalDissipative, NormalElastic
from contact_sim_pkg.laws.point_friction import point_friction, point_stick_event
from contact_sim_pkg.rigid.bodies.body import Ground, Motion, RigidBody, contact_count, contact_rows
from contact_sim_pkg.rigid.bodies.body_state import fill_motion, fill_rates, fill_turn, places_of
from contact_sim_pkg.rigid.bodies.motion import contact_velocities
from contact_sim_pkg.rigid.problem import PLANE

EVENTS_PER_POINT = 3  # approach, tension, stick
FREE = 0.0  # lambda of a point that has not touched


class CompliantLaw(NamedTuple):
    """What acts at each point."""

    elastic: NormalElastic
    friction: Friction  # of one ratio; damping > 0
    loss: float  # lambda x' at the touch, >= 0: `damping_of_restitution` at 1 m/s
    slowest: float  # [m/s] approach that counts at least when lambda is set, > 0
    # [m] depth at which a touch begins and ends: above the rounding of a body that is laid on its
    # ground
    touch: float


class CompliantBody(NamedTuple):
    """The body, its ground and contact, and arrays to work in."""

    body: RigidBody
    ground: Ground
    contact: CompliantLaw
    motion: Motion  # of the state last looked at
    gap: Vector  # [points]
    J: Vector  # [rows, coordinates]
    u: Vector  # [rows] velocities of the points, normal then tangents
    push: Vector  # [coordinates] force and torque of all contacts and loads, world axes


def make_rig(body: RigidBody, ground: Ground, contact: CompliantLaw) -> CompliantBody:
    """The rig, with its arrays."""
    width, points, coordinates, zeros = body.width, contact_count(body, ground), len(body.load), numpy.zeros
    motion = Motion(zeros(width), zeros(1), zeros((width, width)), zeros(coordinates))
    rows = points * width
    return CompliantBody(
        body=body,
        ground=ground,
        contact=contact,
        motion=motion,
        gap=zeros(points),
        J=zeros((rows, coordinates)),
        u=zeros(rows),
        push=zeros(coordinates),
    )


def state_count(body: RigidBody, contacts: int) -> int:
    """Number of state variables."""
    return places_of(body.width) + len(body.load) + contacts * (2 * body.width - 1) + 1


@kernel
def _first_deflection(rig):
    return (3 if rig.body.width == PLANE else 7) + rig.body.load.shape[0]


@kernel
def update_contacts(rig, state):
    """Motion, gaps, Jacobian and point velocities of a ``state`` [states], into the rig's
    arrays.
    """
    motion = rig.motion
    fill_turn(motion.rotation, state)
    fill_motion(motion, state)
    contact_rows(rig.body, rig.ground, motion, rig.gap, rig.J)
    contact_velocities(rig.J, motion.velocity, rig.u)


@kernel
def _tangents(rig, state, point):
    """Deflection of a point's spring and its slip velocity, two components each; the second is 0 in
    the plane.
    """
    width = rig.body.width
    place = _first_deflection(rig) + point * (width - 1)
    if width == PLANE:
        return state[place], 0.0, rig.u[2 * point + 1], 0.0
    return state[place], state[place + 1], rig.u[3 * point + 1], rig.u[3 * point + 2]


@kernel
def _normal(rig, mode, point):
    """Normal force of a point in [N]."""
    loss = NormalDissipative(mode[point])
    return normal_force(rig.contact.elastic, loss, -rig.gap[point], -rig.u[point * rig.body.width], 1.0)


@kernel
def _add_point(rig, mode, point, state, out):
    """Add a touching point's forces to ``rig.push``; fills its rates and returns the lost power, or
    lent to the spring.
    """
    width = rig.body.width
    first = _first_deflection(rig)
    row, place = point * width, first + point * (width - 1)
    impulse = first + rig.gap.shape[0] * (width - 1) + row
    # forces of the point, and rates of its spring and of its impulse
    normal = _normal(rig, mode, point)
    s_1, s_2, v_1, v_2 = _tangents(rig, state, point)
    force_1, force_2, rate_1, rate_2 = point_friction(rig.contact.friction, normal, s_1, s_2, v_1, v_2)
    out[place], out[impulse], out[impulse + 1] = rate_1, normal, -force_1
    # as force and torque on the body
    for k in range(rig.push.shape[0]):
        rig.push[k] += rig.J[row, k] * normal - rig.J[row + 1, k] * force_1
    if width != PLANE:
        out[place + 1], out[impulse + 2] = rate_2, -force_2
        for k in range(rig.push.shape[0]):
            rig.push[k] -= rig.J[row + 2, k] * force_2
    # power lost: damping of the normal force, friction with what its spring stores
    elastic = elastic_force(rig.contact.elastic, -rig.gap[point])
    return (elastic - normal) * rig.u[row] + force_1 * v_1 + force_2 * v_2


@kernel
def _rate(rig, drive, mode, time, state, out):
    update_contacts(rig, state)
    for i in range(_first_deflection(rig), state.shape[0]):
        out[i] = 0.0
    for k in range(rig.push.shape[0]):
        rig.push[k] = rig.body.load[k]
    lost = 0.0
    for point in range(rig.gap.shape[0]):
        if rig.gap[point] < 0.0:
            lost += _add_point(rig, mode, point, state, out)
    out[state.shape[0] - 1] = lost
    fill_rates(rig.body, rig.motion.rotation, rig.push, state, out)


@kernel
def _event_functions(rig, drive, mode, time, state, derivative, out):
    update_contacts(rig, state)
    points, width = rig.gap.shape[0], rig.body.width
    for point in range(points):
        out[point] = -rig.gap[point] - rig.contact.touch
        # in the air, and slipping when it lands
        out[points + point], out[2 * points + point] = 1.0, -1.0
        if out[point] <= 0.0:
            continue
        loss = NormalDissipative(mode[point])
        out[points + point] = tension_event(rig.contact.elastic, loss, -rig.gap[point], -rig.u[point * width], 1.0)
        normal = _normal(rig, mode, point)
        if normal * rig.contact.friction.coefficient_kinetic > 0.0:
            s_1, s_2, v_1, v_2 = _tangents(rig, state, point)
            out[2 * points + point] = point_stick_event(rig.contact.friction, normal, s_1, s_2, v_1, v_2)


@kernel
def set_loss(rig, mode, point):
    """lambda of a point that touches, of the speed at which it does; the rig must have looked at
    the state.
    """
    mode[point] = rig.contact.loss / max(-rig.u[point * rig.body.width], rig.contact.slowest)


@kernel
def _mode_transition(rig, drive, mode, time, state, event, direction):
    points, width = rig.gap.shape[0], rig.body.width
    if event >= points:
        return direction
    update_contacts(rig, state)
    if direction > 0.0:
        set_loss(rig, mode, event)
    else:
        place = _first_deflection(rig) + event * (width - 1)
        for k in range(width - 1):
            state[place + k] = 0.0
    return direction


@kernel
def _need_rate(rig, mode):
    return False


@kernel
def stored_energy(rig, state):
    """Energy of the contacts and of the friction springs, in [J]; looks at the state."""
    update_contacts(rig, state)
    normal, springs = 0.0, 0.0
    for point in range(rig.gap.shape[0]):
        normal += elastic_energy(rig.contact.elastic, -rig.gap[point])
        s_1, s_2, _v_1, _v_2 = _tangents(rig, state, point)
        springs += 0.5 * rig.contact.friction.stiffness * (s_1 * s_1 + s_2 * s_2)
    return normal, springs


register_rig(CompliantBody, _rate, _event_functions, _mode_transition, _need_rate)
