"""A rigid body on compliant contact in time: the twin of ``located.LocatedBody``, by the integrator
with error control.
"""

from __future__ import annotations

import math

import numpy
import numpy.typing

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import entry
from contact_sim_pkg.compiled.results import DONE, SENTENCES
from contact_sim_pkg.integrate.dormand_prince import (
    EVENTS,
    REJECTED,
    STEPS,
    DormandPrinceWorkspace,
    integrate,
    make_workspace,
    set_event_directions,
)
from contact_sim_pkg.laws.parameters import Friction, NormalElastic
from contact_sim_pkg.laws.restitution import LOWEST_RESTITUTION, damping_of_restitution
from contact_sim_pkg.records.state import State
from contact_sim_pkg.rigid.bodies.body import Ground, Motion, RigidBody, contact_count, fitted_ground, load_acceleration
from contact_sim_pkg.rigid.bodies.body_state import IntegrationSpan, places_of
from contact_sim_pkg.rigid.bodies.flight import body_size
from contact_sim_pkg.rigid.forces.compliant_body import (
    EVENTS_PER_POINT,
    CompliantBody,
    CompliantLaw,
    make_rig,
    set_loss,
    state_count,
    stored_energy,
    update_contacts,
)
from contact_sim_pkg.rigid.problem import PLANE

__all__ = ["CompliantMotion", "compliant_contact", "requested_loss", "sentence_of"]

# [rad] of a sub-step that is integrated at once, so that no contact event is missed
LARGEST_TURN = 0.2
LONGEST_SUBSTEP = 0.02  # [s]
TOUCH = 1e-12  # of the body's size
SMALLEST_LOSS = 1e-9  # so that the slowest speed is never 0


def requested_loss(restitution: float) -> float:
    """lambda [s/m] times the speed of approach [m/s] with which a contact ends with ``restitution``
    (below 0.01: 0.01).
    """
    return damping_of_restitution(max(restitution, LOWEST_RESTITUTION), 1.0)


def resting_swing(body: RigidBody, elastic: NormalElastic) -> tuple[float, float]:
    """Depth in [m] of a body at rest on one point under its `load_acceleration`, and its frequency
    there in [rad/s].
    """
    weight = body.mass * load_acceleration(body)
    depth = (weight / elastic.coefficient) ** (1.0 / elastic.exponent)
    return depth, math.sqrt(elastic.exponent * weight / (depth * body.mass))


def compliant_contact(
    body: RigidBody, elastic: NormalElastic, tangential_stiffness: float, tangential_damping: float | None = None
) -> CompliantLaw:
    """The contact of ``body`` with its restitution and friction; ``tangential_stiffness`` in [N/m],
    ``tangential_damping`` in [N s/m], None: critical for its mass.

    Below the speed ``n d g/(2 w)``, n the exponent, g the `load_acceleration` and w the frequency
    of the body at rest on one point, the loss no longer grows: a body at rest is then about
    critically damped, and bounces as slow as that hardly leave the ground. A body without weight is
    measured as if 0.1 m/s^2 pulled it, and rebounds faster than requested below that speed.
    """
    loss, (depth, frequency) = requested_loss(body.restitution), resting_swing(body, elastic)
    damping = tangential_damping or 2.0 * math.sqrt(tangential_stiffness * body.mass)
    friction = Friction(tangential_stiffness, damping, body.friction, body.friction)
    slowest = 0.5 * max(loss, SMALLEST_LOSS) * depth * frequency
    return CompliantLaw(elastic, friction, loss, slowest, TOUCH * float(body_size(body)))


@entry
def _begin(rig: CompliantBody, mode: Vector, state: Vector, work: DormandPrinceWorkspace) -> None:
    update_contacts(rig, state)
    for point in range(rig.gap.shape[0]):
        set_loss(rig, mode, point)
    drive = IntegrationSpan(0.0, 1.0)
    set_event_directions(rig, drive, mode, 0.0, state, work)


@entry
def _advance(
    rig: CompliantBody, mode: Vector, state: Vector, scale: Vector, work: DormandPrinceWorkspace,
    interval: IntegrationSpan, substeps: int,
) -> int:  # fmt: skip
    for substep in range(substeps):
        begin = interval.start + interval.length * substep / substeps
        drive = IntegrationSpan(begin, interval.length / substeps)
        end = interval.start + interval.length * (substep + 1) / substeps
        status = integrate(rig, drive, mode, end, state, scale, work)
        if status != DONE:
            return status
    update_contacts(rig, state)
    return DONE


@entry
def _stored(rig: CompliantBody, state: Vector) -> tuple[float, float]:
    return stored_energy(rig, state)


class CompliantMotion:
    """One body on compliant contact, and the state of its run. ``motion`` changes in place."""

    STATE = State(
        ("motion", "state", "mode", "time", "stored", "dissipated"),
        ("work.event_direction", "work.step", "work.last_event", "work.counters"),
        ("motion",),
    )

    def __init__(
        self, body: RigidBody, ground: Ground, motion: Motion, contact: CompliantLaw, tolerance: float
    ) -> None:
        """Take a body at the start; ``tolerance`` is the error a step may make, relative to depth
        and speed of an impact.
        """
        ground = fitted_ground(body, ground)
        self.body, self.ground, self.motion, self.contacts = body, ground, motion, contact_count(body, ground)
        self.rig = make_rig(body, ground, contact)
        self.state, self.mode = _state_of(body, motion, self.contacts), numpy.zeros(self.contacts)
        self.size = float(body_size(body))
        self.scale = tolerance * self._scales()
        self.work = make_workspace(len(self.state), EVENTS_PER_POINT * self.contacts)
        self.time = 0.0
        rows = self.contacts * body.width
        self._impulses = slice(len(self.state) - 1 - rows, len(self.state) - 1)
        # [N s] over the last interval: normal, then tangents, of each point
        self.impulse = numpy.zeros(rows)
        self.stored = 0.0  # [J] in contacts and friction springs
        self.dissipated = 0.0  # [J] in all
        _begin(self.rig, self.mode, self.state, self.work)

    def advance(self, interval: float) -> int:
        """One interval in [s]; returns a status of `compiled/results.py`, whose sentence
        `sentence_of` gives.
        """
        width, state = self.body.width, self.state
        spin = float(numpy.abs(self.motion.velocity[width:]).sum())
        # short enough that no contact event is stepped over
        substeps = max(1, math.ceil(interval / LONGEST_SUBSTEP), math.ceil(interval * spin / LARGEST_TURN))
        state[self._impulses] = 0.0
        span = IntegrationSpan(self.time, interval)
        status = int(_advance(self.rig, self.mode, state, self.scale, self.work, span, substeps))
        if status != DONE:
            return status
        self.time += interval
        if width != PLANE:
            # the quaternion keeps unit length
            state[3:7] /= numpy.linalg.norm(state[3:7])
        for mine, found in zip(self.motion, self.rig.motion, strict=True):
            mine[:] = found
        self.impulse[:] = state[self._impulses]
        # the state counts what friction springs hold as lost
        contacts, springs = _stored(self.rig, state)
        self.stored = float(contacts + springs)
        self.dissipated = float(state[-1] - springs)
        return status

    @property
    def solves(self) -> int:
        """Steps so far, accepted and rejected."""
        return int(self.work.counters[STEPS] + self.work.counters[REJECTED])

    @property
    def events(self) -> int:
        """Events located so far: touches, losses of contact, ends of stick and slip."""
        return int(self.work.counters[EVENTS])

    def sticks(self) -> numpy.typing.NDArray[numpy.bool_]:
        """Which points stick at the end of the last interval."""
        touches = self.rig.gap < 0.0
        return numpy.asarray(touches & (self.work.event_direction[2 * self.contacts :] > 0.0))

    def _scales(self) -> Vector:
        """Size of each state: depth and speed of the swing of the body at rest on one point.

        They are below those of an impact, which the error control then meets the better; with
        larger ones a body at rest would be shaken loose by the errors of its own steps.
        """
        body, width = self.body, self.body.width
        depth, frequency = resting_swing(body, self.rig.contact.elastic)
        speed, springs = depth * frequency, self.contacts * (width - 1)
        sizes = [depth] * width + [depth / self.size] * (places_of(width) - width) + [speed] * width
        sizes += [speed / self.size] * (len(body.load) - width) + [depth] * springs
        return numpy.array(sizes + [math.inf] * (len(self.state) - len(sizes)))


def sentence_of(status: int) -> str:
    """The sentence of a status."""
    return SENTENCES[status]


def _state_of(body: RigidBody, motion: Motion, contacts: int) -> Vector:
    state, width = numpy.zeros(state_count(body, contacts)), body.width
    state[:width] = motion.position
    if width == PLANE:
        state[2], state[3:6] = motion.angle[0], motion.velocity
        return state
    state[3:7] = quaternion_of(motion.rotation)
    state[7:10], state[10:13] = motion.velocity[:3], motion.rotation.T @ motion.velocity[3:]
    return state


def quaternion_of(rotation: Vector) -> Vector:
    """Unit quaternion (w, x, y, z) of a rotation matrix [3, 3], from its largest component."""
    m, trace = rotation, float(numpy.trace(rotation))
    squares = numpy.array([1.0 + trace, *(1.0 - trace + 2.0 * m[i, i] for i in range(3))])
    skew = numpy.array([m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]])
    greatest = int(squares.argmax())
    if greatest == 0:
        found = numpy.array([squares[0], *skew])
    else:
        i = greatest - 1
        found = numpy.array([skew[i], *(m[i, j] + m[j, i] for j in range(3))])
        found[greatest] = squares[greatest]
    return found / numpy.linalg.norm(found)
