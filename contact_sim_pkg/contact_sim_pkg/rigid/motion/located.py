"""A rigid body in time with located events: flight to the first touch, impact at an instant,
sliding and rest in between.

`rigid/motion/time_loop.py` goes on by itself in compiled code, over all output samples of a call.
What it cannot do, an impact or a piece of time that takes the general solvers or holds an event, is
done here, by compiled steps (`rigid/motion/active_contacts.py`, `rigid/contact/solver.py`,
`rigid/impact/law.py`) called from Python: in one compiled function of all of them every solver
would be compiled again. Source: Identifiability eqs 9-11; Brogliato, Nonsmooth Mechanics
(event-driven schemes).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.rigid.body import Ground, Motion, RigidBody, contact_count, laid_under, pull
from contact_sim_pkg.rigid.contact.packed import PackedSolver
from contact_sim_pkg.rigid.geometry.track import (
    BRIEF,
    COLLIDED,
    EVENTS,
    INTERVAL,
    LOST,
    PIECE,
    RESIDUAL,
    RESTED,
    SAMPLE,
    SAMPLES,
    SHORT,
    SOLVES,
    STILL,
    STOPS,
    TIME,
    SampleTrack,
    read_track,
    track_columns,
)
from contact_sim_pkg.rigid.motion import active_contacts as held
from contact_sim_pkg.rigid.motion.flight import body_size
from contact_sim_pkg.rigid.motion.motion import APART, HELD, STUCK, TOUCHING, make_motion_workspace
from contact_sim_pkg.rigid.motion.slip import slip_turns, turns
from contact_sim_pkg.rigid.motion.substep_end import list_features, stay_on_the_ground, take_piece
from contact_sim_pkg.rigid.motion.supported import MOST_STOPS, SupportedPieces
from contact_sim_pkg.rigid.motion.time_loop import (
    COLLIDE,
    DONE,
    MOST_SHORT,
    PAUSE,
    advance_samples,
    make_march_workspace,
)
from contact_sim_pkg.rigid.motion.turning import INSTANT, make_turn_workspace, turn_held
from contact_sim_pkg.rigid.parameters import ENERGETIC
from contact_sim_pkg.rigid.problem import DISC, PLANE
from contact_sim_pkg.rigid.results import (
    REVERSE,
    SEPARATE,
    SLIDE,
    SOLVED,
    SPIN_TOO_FAST,
    STICK,
    TOO_MANY_EVENTS,
    TOO_MANY_IMPACTS,
)

__all__ = ["LocatedBody", "LocatedImpact", "SampleTrack"]

MOST_IMPACTS = 100_000  # in one interval
REST = 1.0e-6  # rest speed over sqrt(g L)
TOLERANCE = 1.0e-10
LANDS = 3.0  # times the speed of a fall by `held.LANDED`: slower landings beside held points do not bounce
LARGEST_TURN = 1.0e5  # [rad] in one interval: more are pieces without end
LONGER = 4.0  # times, from one try for modes that fit to the next
STICKS = 1.0e-9  # of the speed before the impact: slip below it counts as none


class LocatedImpact(NamedTuple):
    """One impact, of all points that touch."""

    time: float  # [s] from the start of the interval
    points: tuple[int, ...]  # that took an impulse
    impulse: Vector  # [rows] in [N s]: normal, then tangents, of each point
    modes: tuple[int, ...]  # of `points`: results.STICK, SLIDE, REVERSE
    lost: float  # kinetic energy in [J]


class LocatedBody:
    """One body over a ground, and where it stands. ``motion`` changes in place."""

    def __init__(
        self,
        body: RigidBody,
        ground: Ground,
        motion: Motion,
        rule: int = ENERGETIC,
        facets: int = DISC,
        tolerance: float = TOLERANCE,
    ) -> None:
        """Take a body in the air or on the ground; ``motion`` is its state at the start, with no
        point below the ground.

        ``tolerance``: the error that a step may make while the body turns on held points, relative
        to its size and the speed of a fall by it, or slides round a bend. Flight, rest and sliding
        straight on are exact whatever it is.
        """
        ground = laid_under(body, ground)
        self._body, self.ground, self.motion, self.rule = body, ground, motion, rule
        points, coordinates = contact_count(body, ground), len(body.load)
        self.work = make_motion_workspace(body, ground, facets)
        self._march = make_march_workspace(points)
        self._columns = track_columns(body, points)
        self._solver = PackedSolver(coordinates, body.width, facets)
        self.size = float(body_size(body))
        self.gravity = pull(body)
        self._turning = make_turn_workspace(body, ground, self.size, self.gravity, tolerance)
        self.rest_speed = REST * math.sqrt(self.gravity * self.size)
        self.landing_speed = max(self.rest_speed, LANDS * math.sqrt(2.0 * held.LANDED * self.gravity * self.size))
        self.impacts: list[LocatedImpact] = []  # of the last call
        self.rested = math.nan  # [s] from the start of the call: when the last bounce ended
        self.impulse = numpy.zeros(points * body.width)  # [rows] in [N s] over the last call
        self._friction_turns = body.width != PLANE and facets == DISC  # with the slip
        self._pieces = SupportedPieces(
            body=body,
            ground=ground,
            motion=motion,
            work=self.work,
            solver=self._solver,
            clock=self._march.clock,
            counts=self._march.counts,
            size=self.size,
        )
        held.survey_points(body, ground, motion, self.work, self.size, self.gravity)
        self.work.flags[:] = numpy.where(self.work.gap <= 1e-9 * self.size, 1, 0)

    @property
    def body(self) -> RigidBody:
        """The body; one of another load, mass, friction or restitution may take its place between
        two calls.
        """
        return self._body

    @body.setter
    def body(self, body: RigidBody) -> None:
        self._body = self._pieces.body = body
        self._turning = self._turning._replace(rig=self._turning.rig._replace(body=body))

    @property
    def events(self) -> int:
        """Events located, in all."""
        return int(self._march.counts[EVENTS])

    @property
    def solves(self) -> int:
        """Contact problems solved, in all."""
        return int(self._march.counts[SOLVES])

    @property
    def dissipated(self) -> float:
        """Energy in [J] lost in impacts and by sliding, in all."""
        return float(self._march.clock[LOST])

    @property
    def reached(self) -> float:
        """Time in [s] from the start of the last call at which it stopped."""
        return float(self._march.counts[SAMPLE] * self._march.clock[INTERVAL] + self._march.clock[TIME])

    @property
    def residual(self) -> float:
        """Greatest residual of the contact solves of the last call."""
        return float(self._march.clock[RESIDUAL])

    def advance(self, interval: float) -> int:
        """One interval in [s]; returns a status of `rigid/results.py`, whose sentence says what
        went wrong.
        """
        return self.advance_over(interval, 1)[0]

    def advance_over(self, interval: float, samples: int) -> tuple[int, SampleTrack]:
        """``samples`` intervals in [s]; returns a status and the states at their ends (up to where
        it failed).
        """
        clock, count = self._march.clock, self._march.counts
        track = numpy.zeros((samples, self._columns[-1]))
        self.impacts = []
        clock[TIME], clock[INTERVAL], clock[RESTED], clock[RESIDUAL] = 0.0, interval, math.nan, 0.0
        count[SAMPLE], count[SAMPLES], count[STOPS], count[COLLIDED], count[SHORT] = 0, samples, 0, 0, 0
        status = SOLVED
        while status == SOLVED:
            request = advance_samples(
                self.body,
                self.ground,
                self.motion,
                self.work,
                self._march,
                size=self.size,
                gravity=self.gravity,
                rest_speed=self.rest_speed,
                impulse_column=self._columns[3],
                track=track,
            )
            if request == DONE:
                break
            if count[SHORT] > MOST_SHORT:
                status = TOO_MANY_EVENTS
            elif request == PAUSE and self._spin() * interval > LARGEST_TURN:
                status = SPIN_TOO_FAST
            elif request != PAUSE:
                status = self._collide(track) if request == COLLIDE else self._pass(track)
        self.rested = float(clock[RESTED])
        read = read_track(track, self._columns, self.body.width)
        self.impulse = read.impulse.sum(axis=0)
        return status, read

    def _spin(self) -> float:
        """In [rad/s]."""
        return float(numpy.linalg.norm(self.motion.velocity[self.body.width :]))

    def _add_impulse(self, track: Vector) -> None:
        track[self._march.counts[SAMPLE], self._columns[3] : self._columns[4]] += self.work.impulse

    def _pass(self, track: Vector) -> int:
        """The time that the march left: a body that turns on held contacts, or a piece that takes
        the general solvers.
        """
        clock, pieces, parts = self._march.clock, self._pieces, (self.body, self.ground, self.motion, self.work)
        piece, still = float(clock[PIECE]), float(clock[STILL])
        over, turning = None, turns(*parts, self.motion.velocity, self.size)
        if not turning:
            over = pieces.attempt(piece, still)
            turning = over[0] == SOLVED and turns(*parts, self.work.free, self.size)
            if over[0] == SOLVED and not turning and self._friction_turns:
                turning = pieces.slip_turns(piece, still, over)
                over = over if over[1] == 1.0 else None
        if turning:
            if self._turn(still, track):
                return SOLVED
            piece, over = min(piece, pieces.longest(), self._next_try()), None
        status, passed = pieces.hold(piece, still, over)
        if status == SOLVED:
            self._add_impulse(track)
            left = clock[INTERVAL] - clock[TIME]
            self._march.counts[SHORT] += int(passed < BRIEF * min(left, clock[PIECE]))
            clock[TIME] = clock[INTERVAL] if passed >= left else clock[TIME] + passed
        return status

    def _next_try(self) -> float:
        """Time in [s] after which modes may fit again, where slip goes through 0: ever longer
        within a sample, so that it ends.
        """
        stops = self._march.counts[STOPS]
        self._march.counts[STOPS] += 1
        return INSTANT * math.sqrt(self.size / self.gravity) * LONGER**stops if stops < MOST_STOPS else math.inf

    def _turn(self, still: float, track: Vector) -> bool:
        """Turn the body on its held contacts for as long as they keep their modes; False where no
        mode fits.
        """
        if self._march.counts[STOPS] >= MOST_STOPS:
            return False
        status, _part, _stretch = self._pieces.attempt(INSTANT * math.sqrt(self.size / self.gravity), still)
        return status == SOLVED and self._turn_on(still, track)

    def _turn_on(self, still: float, track: Vector) -> bool:
        """With what each held contact does at this instant in the work space."""
        parts, march = (self.body, self.ground, self.motion, self.work), self._march
        list_features(*parts)
        moved = turn_held(
            self.body,
            self.motion,
            self.work,
            turn=self._turning,
            clock=march.clock,
            count=march.counts,
            track=track,
            still=still,
        )
        if moved:
            stay_on_the_ground(*parts, self.size, still)
        return bool(moved)

    def warm_up(self) -> None:
        """Call every compiled step once, so that none is compiled in the middle of a run; the state
        is spoiled.
        """
        body, ground, motion, work = self.body, self.ground, self.motion, self.work
        for contacts in (len(work.flags), 1):  # an impact of several, and of one
            work.flags[:], work.u[:: body.width] = APART, -self.rest_speed
            work.flags[:contacts] = TOUCHING
            held.prepare_impact(body, work, 0.0)
            self._solver.collide(work, self.rule)
        held.finish_impact(body, motion, work, self.rest_speed)
        work.flags[:] = HELD
        self._pieces.attempt(1e-3, 1e-9)
        held.gap_after(body, ground, motion, work, 1e-3, 0)
        held.landing_part(body, ground, motion, work, 1e-3, self.size)
        take_piece(body, ground, motion, work, 1e-3, self.size, 1e-9)
        turns(body, ground, motion, work, motion.velocity, self.size)
        slip_turns(body, motion, work, 1e-9)
        self._turn_on(1e-9, numpy.zeros((1, self._columns[-1])))
        stay_on_the_ground(body, ground, motion, work, self.size, 1e-9)
        self.advance(1e-6)

    def kinetic_energy(self) -> float:
        """In [J]."""
        v, body, R = self.motion.velocity, self.body, self.motion.rotation
        spin = R.T @ v[3:] if body.width != PLANE else v[2:]
        return float(0.5 * body.mass * (v[: body.width] @ v[: body.width]) + 0.5 * (body.inertia @ spin**2))

    def _collide(self, track: Vector) -> int:
        work, width, clock, count = self.work, self.body.width, self._march.clock, self._march.counts
        energy, before = self.kinetic_energy(), work.u.copy()
        supported = bool((work.flags >= HELD).any())
        held.prepare_impact(self.body, work, self.landing_speed if supported else self.rest_speed)
        found = self._solver.collide(work, self.rule)
        if found.status != SOLVED:
            return int(found.status)
        held.finish_impact(self.body, self.motion, work, self.rest_speed)
        points = tuple(int(i) for i in numpy.flatnonzero(work.impulse[::width]))
        modes = tuple(self._mode(before, i) for i in points)
        time = float(count[SAMPLE] * clock[INTERVAL] + clock[TIME])
        self.impacts.append(LocatedImpact(time, points, work.impulse.copy(), modes, energy - self.kinetic_energy()))
        self._add_impulse(track)
        clock[LOST] += self.impacts[-1].lost
        count[EVENTS] += 1
        count[SOLVES] += 1
        count[COLLIDED] = 1
        clock[RESIDUAL] = max(clock[RESIDUAL], float(found.residual))
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
