"""A rigid body in time with located events: flight to the first touch, impact at an instant, sliding and rest in between.

The steps are compiled (`flight.py`, `held.py`, `contact_solver.py`, `impact_law.py`), each by itself: one function of them all
takes minutes to compile, and between two events a call from Python costs microseconds. Source: SEEDS 7.2 (`located`), 7.3.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy

from ..parameters import Vector
from . import held
from .body import Ground, Motion, RigidBody
from .contact_solver import GAUSS_SEIDEL, contact_impulses, make_solver
from .flight import body_size, fly
from .impact_law import impact_impulses, make_impact_workspace
from .motion import STUCK, make_motion_workspace
from .parameters import ENERGETIC
from .problem import DISC, PLANE
from .results import CONTACT_NOT_FINITE, NOT_CONVERGED, REVERSE, SEPARATE, SLIDE, SOLVED, STICK, TOO_MANY_IMPACTS

__all__ = ["Impact", "LocatedBody"]

MOST_IMPACTS = 100_000  # in one interval
STOP_HALVINGS = 60
LANDING_STEPS = 30
MOST_STOPS = (
    20  # stops of slip that are located in one interval: an edge that pivots may slip back and forth without end
)
LARGEST_TURN = 0.02  # [rad] of a piece of free flight in space, where the spin is of order 6
LARGEST_PLANAR_TURN = 0.2  # [rad] of a piece of free flight in the plane, which is exact: it only has to find the touch
LARGEST_SUPPORTED_TURN = 0.005  # [rad] of a piece while a point is held: there the position is of second order
REST = 1.0e-6  # rest speed over sqrt(g L)
ACCEPTED = 1.0e-6  # residual up to which a solve goes on: corners whose heights differ by rounding contradict each other a little
SWEEPS = 2000  # of Gauss-Seidel where the exact solvers find that contradiction
STICKS = 1.0e-9  # of the speed before the impact: slip below it counts as none


class Impact(NamedTuple):
    """One impact, of all points that touch."""

    time: float  # [s] from the start of the interval
    points: tuple[int, ...]  # that took an impulse
    impulse: Vector  # [rows] in [N s]: normal, then tangents, of each point
    modes: tuple[int, ...]  # of `points`: results.STICK, SLIDE, REVERSE
    lost: float  # kinetic energy in [J]


class LocatedBody:
    """One body over a ground, and where it stands. ``motion`` changes in place."""

    def __init__(
        self, body: RigidBody, ground: Ground, motion: Motion, rule: int = ENERGETIC, facets: int = DISC
    ) -> None:
        """Take a body in the air or on the ground; ``motion`` is its state at the start, with no point below the ground."""
        self.body, self.ground, self.motion, self.rule = body, ground, motion, rule
        points, coordinates = len(body.points), len(body.load)
        self.work = make_motion_workspace(body, facets)
        self._impact = make_impact_workspace(points, coordinates, body.width, facets)
        self._sweeps = make_solver(points, coordinates, body.width, facets, GAUSS_SEIDEL, SWEEPS)
        self._before, self._after = numpy.zeros(points), numpy.zeros(points)
        self.size = float(body_size(body))
        self.gravity = float(numpy.linalg.norm(body.load[: body.width]) / body.mass)
        self.rest_speed = REST * math.sqrt(self.gravity * self.size)
        self.impacts: list[Impact] = []  # of the last interval
        self.events = 0  # located, in all
        self.solves = 0  # of contact problems, in all
        self._stops = 0  # of slip, in the interval
        self.rested = math.nan  # [s] from the start of the interval: when the last bounce ended
        self.impulse = numpy.zeros(points * body.width)  # [rows] in [N s] over the last interval
        self.dissipated = 0.0  # [J] by impacts and sliding, in all
        self.residual = 0.0  # largest of the contact solves of the last interval
        held.survey(body, ground, motion, self.work, self.size, self.gravity)
        self.work.flags[:] = numpy.where(self.work.gap <= 1e-9 * self.size, 1, 0)

    def advance(self, interval: float) -> int:
        """One interval in [s]; returns a status of `results.py`, whose sentence says what went wrong."""
        self.impacts, self.rested, self.residual = [], math.nan, 0.0
        self.impulse[:] = 0.0
        self._stops = 0
        time, status = 0.0, SOLVED
        while time < interval and status == SOLVED:
            still, approaches = held.survey(self.body, self.ground, self.motion, self.work, self.size, self.gravity)
            if approaches:
                status = self._collide(time)
                if status != SOLVED:
                    break
            wait, holds = held.settle(self.body, self.motion, self.work, self.rest_speed, still)
            if wait > 0.0:
                self.rested = time + wait
            left = interval - time
            if holds:
                status, passed = self._support(min(left, self._longest(LARGEST_SUPPORTED_TURN)), still)
            else:
                turn = LARGEST_PLANAR_TURN if self.body.width == PLANE else LARGEST_TURN
                passed, point = fly(
                    self.body,
                    self.ground,
                    self.motion,
                    self.work,
                    min(left, self._longest(turn)),
                    self._before,
                    self._after,
                )
                self.events += point >= 0
            time = interval if passed >= left else time + passed
        return status

    def warm_up(self) -> None:
        """Call every compiled step once, so that none is compiled in the middle of a run; the state is spoiled."""
        body, ground, motion, work = self.body, self.ground, self.motion, self.work
        held.prepare_impact(body, work, self.rest_speed)
        impact_impulses(work.problem, work.J, work.W, work.u, work.restitution, self.rule, self._impact, work.impulse)
        held.finish_impact(body, motion, work, self.rest_speed)
        held.settle(body, motion, work, self.rest_speed, 1e-9)
        self._attempt(1e-3, 1e-9)
        contact_impulses(work.problem, work.J, work.W, self._sweeps, work.impulse)
        held.landing(body, ground, motion, work, 1e-3, self.size)
        held.finish_support(body, ground, motion, work, self.size, 1e-9)
        fly(body, ground, motion, work, 1e-6, self._before, self._after)

    def kinetic_energy(self) -> float:
        """In [J]."""
        v, body, R = self.motion.velocity, self.body, self.motion.rotation
        spin = R.T @ v[3:] if body.width != PLANE else v[2:]
        return float(0.5 * body.mass * (v[: body.width] @ v[: body.width]) + 0.5 * (body.inertia @ spin**2))

    def _longest(self, turn: float) -> float:
        spin = float(numpy.abs(self.motion.velocity[self.body.width :]).sum())
        longest = turn / spin if spin > 0.0 else math.inf
        if self.ground.heights.size:  # the normal changes along the way
            speed = float(numpy.abs(self.motion.velocity[: self.body.width]).max())
            longest = min(longest, 0.1 * self.ground.cell / speed) if speed > 0.0 else longest
        return longest

    def _collide(self, time: float) -> int:
        work, width = self.work, self.body.width
        energy, before = self.kinetic_energy(), work.u.copy()
        held.prepare_impact(self.body, work, self.rest_speed)
        found = impact_impulses(
            work.problem, work.J, work.W, work.u, work.restitution, self.rule, self._impact, work.impulse
        )
        if not found.residual <= ACCEPTED:
            return int(found.status) or NOT_CONVERGED
        held.finish_impact(self.body, self.motion, work, self.rest_speed)
        points = tuple(int(i) for i in numpy.flatnonzero(work.impulse[::width]))
        modes = tuple(self._mode(before, i) for i in points)
        self.impacts.append(Impact(time, points, work.impulse.copy(), modes, energy - self.kinetic_energy()))
        self.impulse += work.impulse
        self.dissipated += self.impacts[-1].lost
        self.events += 1
        self.solves += 1
        self.residual = max(self.residual, float(found.residual))
        return SOLVED if len(self.impacts) < MOST_IMPACTS else TOO_MANY_IMPACTS

    def _mode(self, before: Vector, point: int) -> int:
        """How the slip of a point came out of the impact."""
        rows = slice(point * self.body.width + 1, (point + 1) * self.body.width)
        first, last = before[rows], self.work.u[rows]
        if numpy.linalg.norm(last) <= STICKS * max(numpy.abs(before).max(), self.rest_speed):
            return STICK
        return SLIDE if first @ last >= 0.0 else REVERSE

    def modes(self) -> list[int]:
        """Mode of every point at the end of the last interval."""
        width = self.body.width
        pushed = self.impulse[::width] > 0.0
        return [
            SEPARATE if not pushed[i] else (STICK if self.work.flags[i] == STUCK else SLIDE) for i in range(len(pushed))
        ]

    def _attempt(self, time: float, still: float) -> tuple[int, float, float]:
        """Status, part of ``time`` after which slip stops, and how many times ``time`` it lasts."""
        work = self.work
        held.prepare_attempt(self.body, self.motion, work, time, self.size, self.gravity)
        found = contact_impulses(work.problem, work.J, work.W, self._impact.solver, work.impulse)
        if found.status not in (SOLVED, CONTACT_NOT_FINITE):
            found = contact_impulses(work.problem, work.J, work.W, self._sweeps, work.impulse)
        self.solves += 1
        if not found.residual <= ACCEPTED:
            return int(found.status) or NOT_CONVERGED, 1.0, math.inf
        self.residual = max(self.residual, float(found.residual))
        part, stretch = held.finish_attempt(self.body, self.motion, work, still)
        return SOLVED, part, stretch

    def _support(self, piece: float, still: float) -> tuple[int, float]:
        """Held contacts over at most ``piece``, ended where a slip stops or a point lands; returns (status, time)."""
        status, part, _stretch = self._attempt(piece, still)
        time = piece
        if status == SOLVED and part < 1.0 and self._stops < MOST_STOPS:
            self._stops += 1
            status, time = self._to_the_stop(piece, still)
            self.events += 1
        for _ in range(LANDING_STEPS):
            if status != SOLVED:
                return status, time
            part = held.landing(self.body, self.ground, self.motion, self.work, time, self.size)
            if part == 1.0:
                break
            time *= part
            status, _part, _stretch = self._attempt(time, still)
        self.impulse += self.work.impulse
        means = 0.5 * (self.motion.velocity + self.work.free)
        self.dissipated -= float(self.work.impulse @ (self.work.J @ means))
        held.finish_support(self.body, self.ground, self.motion, self.work, self.size, still)
        return status, time

    def _to_the_stop(self, piece: float, still: float) -> tuple[int, float]:
        """The time at which the first sliding point stops: a piece in which it still slides gives its deceleration."""
        probe, stretch, status = piece, math.inf, SOLVED
        for _ in range(STOP_HALVINGS):
            probe *= 0.5
            status, part, stretch = self._attempt(probe, still)
            if status != SOLVED or part == 1.0:
                break
        time = min(piece, probe * stretch)
        if status == SOLVED:
            status, _part, _stretch = self._attempt(time, still)
        return status, time
