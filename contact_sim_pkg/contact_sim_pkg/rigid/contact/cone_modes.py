"""Equations of contacts with the true friction cone in space while each keeps its mode, and how far
each is from leaving it.

Normal: at its floor, or touching (``u_n = 0``). Tangential: sliding (``c_t = -mu c_n d``, ``u_t = s
d``, the direction d at an angle; unknowns angle and s) or sticking (``u_t = 0``, unknowns c_t).
Where ``mu c_n`` cannot be but 0 there is no tangential part. In these unknowns the equations are
smooth up to the ends of a mode, also where a slip stops. The problem carries a cover: its
velocities are ``q + t d + (A + shift I) c``, its floors ``(1 - t/T) floor``. At ``t = T`` nothing
but ``c = 0`` solves it, at ``t = 0`` it is the one that was given. Contacts are scaled by
sqrt(A_nn,i), velocities by the greatest.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
import numpy.typing

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.rigid.problem import SPACE, ContactProblem

__all__ = ["NORMAL", "TANGENTIAL", "ContactModes", "ModeEquations"]

NORMAL, TANGENTIAL = 0, 1  # kinds of modes, columns of `ModeEquations.event_values`
GOLDEN = 0.6180339887498949
# over 1 + mu: less than what friction could turn into a push against the cover
TANGENTIAL_COVER = 0.3


class ModeEquations(NamedTuple):
    """The equations at one set of unknowns."""

    unknowns: Vector  # [equations + 1], the last is t
    values: Vector  # [equations]
    slopes: Vector  # [equations, equations + 1]
    impulse: Vector  # [rows], scaled
    velocity: Vector  # [rows], scaled
    # [contacts, 2]; below 0: the mode of the contact has ended; inf: no such mode
    event_values: Vector


class ContactModes:
    """The modes of all contacts of a problem in space, from ``t = T`` on where all separate."""

    def __init__(self, problem: ContactProblem, shift: float, way: int) -> None:
        """``shift`` of the diagonal of the scaled A; ``way`` picks one of many covers."""
        contacts = len(problem.friction)
        own = numpy.sqrt(numpy.diag(problem.A)[::SPACE])
        self._own, self.shift = numpy.repeat(own, SPACE), shift
        self.A = problem.A / numpy.outer(self._own, self._own) + shift * numpy.eye(len(self._own))
        q, floor = problem.q / self._own, problem.floor * own
        self._scale = max(float(numpy.abs(q).max()), float(floor.max())) or 1.0
        self.q, self.floor = q / self._scale, floor / self._scale
        self.friction = numpy.maximum(problem.friction, 0.0)
        self.cover = _cover(self.friction, way)
        self.begin = 4.0 * (1.0 + float(self.friction.max()))  # T
        self._start(contacts)

    def _start(self, contacts: int) -> None:
        self._t, self._impulse = self.begin, numpy.zeros((contacts, SPACE))
        velocity = (self.q + self.begin * self.cover).reshape(contacts, SPACE)
        self._angle = numpy.arctan2(velocity[:, 2], velocity[:, 1])
        self._slip = numpy.hypot(velocity[:, 1], velocity[:, 2])
        self.touching = numpy.zeros(contacts, bool)
        self.sliding = numpy.ones(contacts, bool)
        self.rubbing = (self.friction > 0.0) & (self.floor > 0.0)  # those with a tangential part
        self._lay_out()

    def _lay_out(self) -> None:
        """Contacts of each mode, the columns of their unknowns, and the rows that are equations."""
        counts = self.touching + 2 * self.rubbing
        first = numpy.cumsum(counts) - counts
        self._unknowns = int(counts.sum()) + 1
        self._rows = numpy.flatnonzero(numpy.stack([self.touching, self.rubbing, self.rubbing], axis=1))
        self._active = numpy.flatnonzero(self.touching)
        self._sliding = numpy.flatnonzero(self.rubbing & self.sliding)
        self._sticking = numpy.flatnonzero(self.rubbing & ~self.sliding)
        self._normal, second = first[self._active], first + self.touching
        # of the angle; of the first tangent
        self._turn, self._along = second[self._sliding], second[self._sticking]
        # of their first equation of slip
        self._place = numpy.searchsorted(self._rows, SPACE * self._sliding + 1)

    def unknowns(self) -> Vector:
        """Of all contacts in their modes, and t."""
        x = numpy.full(self._unknowns, self._t)
        x[self._normal] = self._impulse[self._active, 0]
        x[self._turn], x[self._turn + 1] = self._angle[self._sliding], self._slip[self._sliding]
        x[self._along], x[self._along + 1] = self._impulse[self._sticking, 1], self._impulse[self._sticking, 2]
        return x

    def evaluate(self, x: Vector) -> ModeEquations:
        """Values and slopes of the equations, impulses, velocities and event values at the
        unknowns ``x``.
        """
        c, slopes = self._impulses(x)
        u = self.q + x[-1] * self.cover + self.A @ c
        values, gradient = u[self._rows], self.A[self._rows] @ slopes
        gradient[:, -1] += self.cover[self._rows]
        place, turn, slip = self._place, self._turn, x[self._turn + 1]
        for a, part, change in zip((0, 1), *_direction(x[turn]), strict=True):
            values[place + a] -= slip * part
            gradient[place + a, turn] -= slip * change
            gradient[place + a, turn + 1] -= part
        return ModeEquations(x, values, gradient, c, u, self._event_values(x, c, u))

    def _impulses(self, x: Vector) -> tuple[Vector, Vector]:
        """Impulses [rows] and their slopes [rows, unknowns]."""
        c, slopes = numpy.zeros(len(self.q)), numpy.zeros((len(self.q), len(x)))
        c[::SPACE], slopes[::SPACE, -1] = self._floor(x[-1]), -self.floor / self.begin
        active, sticking, sliding = SPACE * self._active, SPACE * self._sticking, SPACE * self._sliding
        c[active], slopes[active, -1] = x[self._normal], 0.0
        slopes[active, self._normal] = 1.0
        friction = self.friction[self._sliding]
        for a, part, change in zip((0, 1), *_direction(x[self._turn]), strict=True):
            c[sliding + 1 + a] = -friction * c[sliding] * part
            slopes[sliding + 1 + a] = -(friction * part)[:, None] * slopes[sliding]
            slopes[sliding + 1 + a, self._turn] -= friction * c[sliding] * change
            c[sticking + 1 + a] = x[self._along + a]
            slopes[sticking + 1 + a, self._along + a] = 1.0
        return c, slopes

    def _floor(self, t: float) -> Vector:
        return self.floor * (1.0 - t / self.begin)

    def _event_values(self, x: Vector, c: Vector, u: Vector) -> Vector:
        event_values = numpy.full((len(self.friction), 2), math.inf)
        event_values[:, NORMAL] = numpy.where(self.touching, c[::SPACE] - self._floor(x[-1]), u[::SPACE])
        event_values[self._sliding, TANGENTIAL] = x[self._turn + 1]
        row = SPACE * self._sticking
        event_values[self._sticking, TANGENTIAL] = self.friction[self._sticking] * c[row] - numpy.hypot(
            c[row + 1], c[row + 2]
        )
        return event_values

    def change_mode(self, state: ModeEquations, contact: int, kind: int) -> None:
        """Contact ``contact`` leaves its mode at ``state``, for the one beside it."""
        self._t, self._impulse = state.unknowns[-1], state.impulse.reshape(-1, SPACE).copy()
        self._angle[self._sliding], self._slip[self._sliding] = (
            state.unknowns[self._turn],
            state.unknowns[self._turn + 1],
        )
        if kind == NORMAL:
            self._change_normal_mode(state, contact)
        else:
            self.sliding[contact] = not self.sliding[contact]
            against = -self._impulse[contact]
            if self.sliding[contact]:
                self._angle[contact], self._slip[contact] = math.atan2(against[2], against[1]), 0.0
        self._lay_out()

    def _change_normal_mode(self, state: ModeEquations, i: int) -> None:
        self.touching[i] = not self.touching[i]
        if self.floor[i] > 0.0 or self.friction[i] == 0.0:
            return
        self.rubbing[i] = self.touching[i]
        if self.touching[i]:  # it slides from the first: its friction is 0
            slip = state.velocity[SPACE * i + 1 : SPACE * i + 3]
            self.sliding[i], self._angle[i] = True, math.atan2(slip[1], slip[0])
            self._slip[i] = math.hypot(slip[0], slip[1])

    def impulses(self, state: ModeEquations) -> Vector:
        """Impulses [rows] in [N s]."""
        return state.impulse * self._scale / self._own


def _direction(angle: Vector) -> tuple[tuple[Vector, Vector], tuple[Vector, Vector]]:
    """Both parts of the directions at these angles, and their changes with the angle."""
    cosine, sine = numpy.cos(angle), numpy.sin(angle)
    return (cosine, sine), (-sine, cosine)


def _cover(friction: Vector, way: int) -> Vector:
    """Covering velocities d [rows]: of separation between 1 and 2, and a little along; no two
    alike, so that no two modes end at once.
    """
    cover = numpy.zeros((len(friction), SPACE))
    part = GOLDEN * (way + 1) * numpy.arange(1, len(friction) + 1)
    part -= numpy.floor(part)
    angle, length = 14.0 * part, TANGENTIAL_COVER / (1.0 + friction)
    cover[:, 0], cover[:, 1], cover[:, 2] = 1.0 + part, length * numpy.cos(angle), length * numpy.sin(angle)
    return cover.ravel()
