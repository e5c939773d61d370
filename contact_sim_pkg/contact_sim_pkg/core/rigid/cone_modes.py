"""Equations of contacts with the true friction cone in space while each keeps its mode, and how far each is from leaving it.

Normal: at its floor, or touching (``u_n = 0``). Tangential: sliding (``c_t = -mu c_n d``, ``u_t = s d``, the direction d at an
angle; unknowns angle and s) or sticking (``u_t = 0``, unknowns c_t). Where ``mu c_n`` cannot be but 0 there is no tangential part.
In these unknowns the equations are smooth up to the ends of a mode, also where a slip stops. The problem carries a cover: its
velocities are ``q + t d + (A + shift I) c``, its floors ``(1 - t/T) floor``. At ``t = T`` nothing but ``c = 0`` solves it, at
``t = 0`` it is the one that was given. Contacts are scaled by sqrt(A_nn,i), velocities by the greatest.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
import numpy.typing

from ..parameters import Vector
from .problem import SPACE, ContactProblem

__all__ = ["NORMAL", "TANGENTIAL", "ContactModes", "State"]

NORMAL, TANGENTIAL = 0, 1  # kinds of modes, columns of `State.margins`
GOLDEN = 0.6180339887498949
TANGENTIAL_COVER = 0.3  # over 1 + mu: less than what friction could turn into a push against the cover


class State(NamedTuple):
    """The equations at one set of unknowns."""

    unknowns: Vector  # [equations + 1], the last is t
    values: Vector  # [equations]
    slopes: Vector  # [equations, equations + 1]
    impulse: Vector  # [rows], scaled
    velocity: Vector  # [rows], scaled
    margins: Vector  # [contacts, 2]; below 0: the mode of the contact has ended; inf: no such mode


class ContactModes:
    """The modes of all contacts of a problem in space, from ``t = T`` on where all separate."""

    def __init__(self, problem: ContactProblem, shift: float, way: int) -> None:
        """``shift`` of the diagonal of the scaled A; ``way`` picks one of many covers."""
        contacts = len(problem.friction)
        own = numpy.sqrt(numpy.diag(problem.A)[::SPACE])
        self._own = numpy.repeat(own, SPACE)
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
        """Column of the first unknown of each contact, and the rows that are equations."""
        counts = self.touching + 2 * self.rubbing
        self._first = numpy.cumsum(counts) - counts
        equations = numpy.stack([self.touching, self.rubbing, self.rubbing], axis=1)
        self._rows = numpy.flatnonzero(equations)

    def unknowns(self) -> Vector:
        """Of all contacts in their modes, and t."""
        x: list[float] = []
        for i in range(len(self.friction)):
            if self.touching[i]:
                x.append(self._impulse[i, 0])
            if self.rubbing[i]:
                x += [self._angle[i], self._slip[i]] if self.sliding[i] else list(self._impulse[i, 1:])
        return numpy.array([*x, self._t])

    def evaluate(self, x: Vector) -> State:
        """Values and slopes of the equations, impulses, velocities and margins at the unknowns ``x``."""
        c, slopes = self._impulses(x)
        u = self.q + x[-1] * self.cover + self.A @ c
        values, gradient = u[self._rows], self.A[self._rows] @ slopes
        gradient[:, -1] += self.cover[self._rows]
        for i in numpy.flatnonzero(self.rubbing & self.sliding):
            place = int(numpy.searchsorted(self._rows, SPACE * i + 1))
            column = self._first[i] + int(self.touching[i])
            d, slip = _direction(x[column]), x[column + 1]
            values[place : place + 2] -= slip * d
            gradient[place : place + 2, column] -= slip * numpy.array([-d[1], d[0]])
            gradient[place : place + 2, column + 1] -= d
        return State(x, values, gradient, c, u, self._margins(x, c, u))

    def _impulses(self, x: Vector) -> tuple[Vector, Vector]:
        """Impulses [rows] and their slopes [rows, unknowns]."""
        c, slopes = numpy.zeros(len(self.q)), numpy.zeros((len(self.q), len(x)))
        for i, friction in enumerate(self.friction):
            row, column = SPACE * i, self._first[i]
            if self.touching[i]:
                c[row], slopes[row, column] = x[column], 1.0
                column += 1
            else:
                c[row], slopes[row, -1] = self._floor(i, x[-1]), -self.floor[i] / self.begin
            if self.rubbing[i] and self.sliding[i]:
                d = _direction(x[column])
                c[row + 1 : row + 3] = -friction * c[row] * d
                slopes[row + 1 : row + 3] = -friction * numpy.outer(d, slopes[row])
                slopes[row + 1 : row + 3, column] -= friction * c[row] * numpy.array([-d[1], d[0]])
            elif self.rubbing[i]:
                c[row + 1 : row + 3] = x[column : column + 2]
                slopes[row + 1, column] = slopes[row + 2, column + 1] = 1.0
        return c, slopes

    def _floor(self, i: int, t: float) -> float:
        return float(self.floor[i] * (1.0 - t / self.begin))

    def _margins(self, x: Vector, c: Vector, u: Vector) -> Vector:
        margins = numpy.full((len(self.friction), 2), math.inf)
        for i, friction in enumerate(self.friction):
            row = SPACE * i
            margins[i, NORMAL] = c[row] - self._floor(i, x[-1]) if self.touching[i] else u[row]
            if self.rubbing[i] and self.sliding[i]:
                margins[i, TANGENTIAL] = x[self._first[i] + int(self.touching[i]) + 1]
            elif self.rubbing[i]:
                margins[i, TANGENTIAL] = friction * c[row] - math.hypot(c[row + 1], c[row + 2])
        return margins

    def switch(self, state: State, contact: int, kind: int) -> None:
        """Contact ``contact`` leaves its mode at ``state``, for the one beside it."""
        self._t, self._impulse = state.unknowns[-1], state.impulse.reshape(-1, SPACE).copy()
        for i in numpy.flatnonzero(self.rubbing & self.sliding):
            column = self._first[i] + int(self.touching[i])
            self._angle[i], self._slip[i] = state.unknowns[column], state.unknowns[column + 1]
        if kind == NORMAL:
            self._switch_normal(state, contact)
        else:
            self.sliding[contact] = not self.sliding[contact]
            against = -self._impulse[contact]
            if self.sliding[contact]:
                self._angle[contact], self._slip[contact] = math.atan2(against[2], against[1]), 0.0
        self._lay_out()

    def _switch_normal(self, state: State, i: int) -> None:
        self.touching[i] = not self.touching[i]
        if self.floor[i] > 0.0 or self.friction[i] == 0.0:
            return
        self.rubbing[i] = self.touching[i]
        if self.touching[i]:  # it slides from the first: its friction is 0
            slip = state.velocity[SPACE * i + 1 : SPACE * i + 3]
            self.sliding[i], self._angle[i] = True, math.atan2(slip[1], slip[0])
            self._slip[i] = math.hypot(slip[0], slip[1])

    def impulses(self, state: State) -> Vector:
        """Impulses [rows] in [N s]."""
        return state.impulse * self._scale / self._own


def _direction(angle: float) -> Vector:
    return numpy.array([math.cos(angle), math.sin(angle)])


def _cover(friction: Vector, way: int) -> Vector:
    """Covering velocities d [rows]: apart between 1 and 2, and a little along; no two alike, so that no two modes end at once."""
    cover = numpy.zeros((len(friction), SPACE))
    part = GOLDEN * (way + 1) * numpy.arange(1, len(friction) + 1)
    part -= numpy.floor(part)
    angle, length = 14.0 * part, TANGENTIAL_COVER / (1.0 + friction)
    cover[:, 0], cover[:, 1], cover[:, 2] = 1.0 + part, length * numpy.cos(angle), length * numpy.sin(angle)
    return cover.ravel()
