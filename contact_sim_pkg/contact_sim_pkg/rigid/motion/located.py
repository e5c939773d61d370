"""A rigid body in time with located events: flight to the first touch, impact at an instant,
sliding and rest in between.

`rigid/motion/time_loop.py` goes on by itself in compiled code, over all output samples of a call.
What it cannot do, an impact or a sub-step that needs the general solvers or holds an event, is
done here, by compiled steps (`rigid/bodies/active_contacts.py`, `rigid/contact/solver.py`,
`rigid/impact/law.py`) called from Python: in one compiled function of all of them every solver
would be compiled again. Source: Identifiability eqs 9-11; Brogliato, Nonsmooth Mechanics
(event-driven schemes).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.records.state import State
from contact_sim_pkg.rigid.bodies import active_contacts
from contact_sim_pkg.rigid.bodies.body import Ground, Motion, RigidBody, contact_count, fitted_ground, load_acceleration
from contact_sim_pkg.rigid.bodies.flight import body_size
from contact_sim_pkg.rigid.bodies.motion import ACTIVE, SEPARATED, STICKING, TOUCHING, make_motion_workspace
from contact_sim_pkg.rigid.motion.packed import PackedSolver
from contact_sim_pkg.rigid.motion.slip import contacts_turn, slip_turns
from contact_sim_pkg.rigid.motion.substep_end import accept_substep, list_features, stay_on_the_ground
from contact_sim_pkg.rigid.motion.substep_solver import MOST_STOPS, SubstepSolver
from contact_sim_pkg.rigid.motion.time_loop import (
    COLLIDE,
    DONE,
    MOST_SHORT,
    PAUSE,
    advance_samples,
    make_time_loop_workspace,
)
from contact_sim_pkg.rigid.motion.track import BRIEF, SampleTrack, read_track, run_fields, track_columns
from contact_sim_pkg.rigid.motion.turning import INSTANT, advance_rotating, make_rotating_workspace
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
# times the speed of a fall by `active_contacts.LANDED`: slower landings beside active points do not
# bounce
LANDS = 3.0
LARGEST_TURN = 1.0e5  # [rad] in one interval: more are sub-steps without end
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
    """One body over a ground, and the state of its run. ``motion`` changes in place."""

    STATE = State(("motion", "work.flags", "work.feature", "_loop.run", "impulse"), held=("motion",))

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

        ``tolerance``: the error that a step may make while the body turns on active points,
        relative to its size and the speed of a fall by it, or slides round a bend. Flight, rest and
        sliding straight on are exact whatever it is.
        """
        ground = fitted_ground(body, ground)
        self._body, self.ground, self.motion, self.rule = body, ground, motion, rule
        points, coordinates = contact_count(body, ground), len(body.load)
        self.work = make_motion_workspace(body, ground, facets)
        self._loop = make_time_loop_workspace(points)
        self._run = run_fields(self._loop.run)
        self._columns = track_columns(body, points)
        self._solver = PackedSolver(coordinates, body.width, facets)
        self.size = float(body_size(body))
        self.gravity = load_acceleration(body)
        self._turning = make_rotating_workspace(body, ground, self.size, self.gravity, tolerance)
        self.rest_speed = REST * math.sqrt(self.gravity * self.size)
        self.landing_speed = max(
            self.rest_speed, LANDS * math.sqrt(2.0 * active_contacts.LANDED * self.gravity * self.size)
        )
        self.impacts: list[LocatedImpact] = []  # of the last call
        self.rested = math.nan  # [s] from the start of the call: when the last bounce ended
        self.impulse = numpy.zeros(points * body.width)  # [rows] in [N s] over the last call
        self._friction_turns = body.width != PLANE and facets == DISC  # with the slip
        self._substeps = SubstepSolver(
            body=body,
            ground=ground,
            motion=motion,
            work=self.work,
            solver=self._solver,
            run=self._run,
            size=self.size,
        )
        active_contacts.survey_points(body, ground, motion, self.work, self.size, self.gravity)
        self.work.flags[:] = numpy.where(self.work.gap <= 1e-9 * self.size, 1, 0)

    @property
    def body(self) -> RigidBody:
        """The body; one of another load, mass, friction or restitution may take its place between
        two calls.
        """
        return self._body

    @body.setter
    def body(self, body: RigidBody) -> None:
        self._body = self._substeps.body = body
        self._turning = self._turning._replace(rig=self._turning.rig._replace(body=body))

    @property
    def events(self) -> int:
        """Events located, in all."""
        return int(self._run.events[0])

    @property
    def solves(self) -> int:
        """Contact problems solved, in all."""
        return int(self._run.solves[0])

    @property
    def dissipated(self) -> float:
        """Energy in [J] lost in impacts and by sliding, in all."""
        return float(self._run.dissipated[0])

    @property
    def reached(self) -> float:
        """Time in [s] from the start of the last call at which it stopped."""
        return float(self._run.sample[0] * self._run.interval[0] + self._run.time[0])

    @property
    def residual(self) -> float:
        """Greatest residual of the contact solves of the last call."""
        return float(self._run.residual[0])

    def advance(self, interval: float) -> int:
        """One interval in [s]; returns a status of `rigid/results.py`, whose sentence names
        what went wrong.
        """
        return self.advance_over(interval, 1)[0]

    def advance_over(self, interval: float, samples: int) -> tuple[int, SampleTrack]:
        """``samples`` intervals in [s]; returns a status and the states at their ends (up to where
        it failed).
        """
        run = self._run
        track = numpy.zeros((samples, self._columns[-1]))
        self.impacts = []
        run.time[0], run.interval[0], run.rest_time[0], run.residual[0] = 0.0, interval, math.nan, 0.0
        run.sample[0], run.samples[0], run.stops[0], run.collided[0], run.short[0] = 0, samples, 0, 0, 0
        status = SOLVED
        # the compiled loop goes on until it is done or requests a solve
        while status == SOLVED:
            request = advance_samples(
                self.body,
                self.ground,
                self.motion,
                self.work,
                self._loop,
                size=self.size,
                gravity=self.gravity,
                rest_speed=self.rest_speed,
                impulse_column=self._columns[3],
                track=track,
            )
            if request == DONE:
                break
            # refusals: events or rotations without end
            if run.short[0] > MOST_SHORT:
                status = TOO_MANY_EVENTS
            elif request == PAUSE and self._spin() * interval > LARGEST_TURN:
                status = SPIN_TOO_FAST
            elif request != PAUSE:
                status = self._collide(track) if request == COLLIDE else self._pass(track)
        # results of the call, up to where it ended
        self.rested = float(run.rest_time[0])
        read = read_track(track, self._columns, self.body.width)
        self.impulse = read.impulse.sum(axis=0)
        return status, read

    def _spin(self) -> float:
        """In [rad/s]."""
        return float(numpy.linalg.norm(self.motion.velocity[self.body.width :]))

    def _add_impulse(self, track: Vector) -> None:
        track[self._run.sample[0], self._columns[3] : self._columns[4]] += self.work.impulse

    def _pass(self, track: Vector) -> int:
        """The sub-step that the time loop requested: a body that turns on active contacts, or one
        that needs the general solvers.
        """
        run, substeps, parts = self._run, self._substeps, (self.body, self.ground, self.motion, self.work)
        substep, rounding = float(run.substep[0]), float(run.rounding[0])
        over, turning = None, contacts_turn(*parts, self.motion.velocity, self.size)
        # a trial over the whole sub-step shows whether rows of contacts or slips turn in it
        if not turning:
            over = substeps.attempt(substep, rounding)
            turning = over[0] == SOLVED and contacts_turn(*parts, self.work.free, self.size)
            if over[0] == SOLVED and not turning and self._friction_turns:
                turning = substeps.slip_turns(substep, rounding, over)
                over = over if over[1] == 1.0 else None
        # turning contacts: by the integrator; where no mode fits, by a short sub-step
        if turning:
            if self._turn(rounding, track):
                return SOLVED
            substep, over = min(substep, substeps.longest(), self._next_try()), None
        # else by the general solvers, up to the next event
        status, passed = substeps.hold(substep, rounding, over)
        if status == SOLVED:
            self._add_impulse(track)
            left = run.interval[0] - run.time[0]
            self._run.short[0] += int(passed < BRIEF * min(left, run.substep[0]))
            run.time[0] = run.interval[0] if passed >= left else run.time[0] + passed
        return status

    def _next_try(self) -> float:
        """Time in [s] after which modes may fit again, where slip goes through 0: ever longer
        within a sample, so that it ends.
        """
        stops = self._run.stops[0]
        self._run.stops[0] += 1
        return INSTANT * math.sqrt(self.size / self.gravity) * LONGER**stops if stops < MOST_STOPS else math.inf

    def _turn(self, rounding: float, track: Vector) -> bool:
        """Turn the body on its active contacts for as long as they keep their modes; False where no
        mode fits.
        """
        if self._run.stops[0] >= MOST_STOPS:
            return False
        status, _part, _duration = self._substeps.attempt(INSTANT * math.sqrt(self.size / self.gravity), rounding)
        return status == SOLVED and self._turn_on(rounding, track)

    def _turn_on(self, rounding: float, track: Vector) -> bool:
        """Turn the body; the work space holds what each active contact does at this instant."""
        parts, loop = (self.body, self.ground, self.motion, self.work), self._loop
        list_features(*parts)
        moved = advance_rotating(
            self.body,
            self.motion,
            self.work,
            rotating=self._turning,
            run_state=loop.run,
            track=track,
            rounding=rounding,
        )
        if moved:
            stay_on_the_ground(*parts, self.size, rounding)
        return bool(moved)

    def warm_up(self) -> None:
        """Call every compiled step once, so that none is compiled in the middle of a run; the state
        is spoiled.
        """
        body, ground, motion, work = self.body, self.ground, self.motion, self.work
        work.flags[:] = ACTIVE
        # first what a drop comes to last: a second process begins here while the first drops a body
        self._turn_on(1e-9, numpy.zeros((1, self._columns[-1])))
        self._substeps.attempt(1e-3, 1e-9)
        for contacts in (len(work.flags), 1):  # an impact of several, and of one
            work.flags[:], work.u[:: body.width] = SEPARATED, -self.rest_speed
            work.flags[:contacts] = TOUCHING
            active_contacts.prepare_impact(body, work, 0.0)
            self._solver.collide(work, self.rule)
        active_contacts.finish_impact(body, motion, work, self.rest_speed)
        active_contacts.gap_after(body, ground, motion, work, 1e-3, 0)
        active_contacts.landing_part(body, ground, motion, work, 1e-3, self.size)
        accept_substep(body, ground, motion, work, 1e-3, self.size, 1e-9)
        contacts_turn(body, ground, motion, work, motion.velocity, self.size)
        slip_turns(body, motion, work, 1e-9)
        stay_on_the_ground(body, ground, motion, work, self.size, 1e-9)
        self.advance(1e-6)

    def kinetic_energy(self) -> float:
        """In [J]."""
        v, body, R = self.motion.velocity, self.body, self.motion.rotation
        spin = R.T @ v[3:] if body.width != PLANE else v[2:]
        return float(0.5 * body.mass * (v[: body.width] @ v[: body.width]) + 0.5 * (body.inertia @ spin**2))

    def _collide(self, track: Vector) -> int:
        work, width, run = self.work, self.body.width, self._run
        energy, before = self.kinetic_energy(), work.u.copy()
        # beside active points a slow landing does not bounce
        supported = bool((work.flags >= ACTIVE).any())
        active_contacts.prepare_impact(self.body, work, self.landing_speed if supported else self.rest_speed)
        found = self._solver.collide(work, self.rule)
        if found.status != SOLVED:
            return int(found.status)
        active_contacts.finish_impact(self.body, self.motion, work, self.rest_speed)
        # record of the impact
        points = tuple(int(i) for i in numpy.flatnonzero(work.impulse[::width]))
        modes = tuple(self._mode(before, i) for i in points)
        time = float(run.sample[0] * run.interval[0] + run.time[0])
        self.impacts.append(LocatedImpact(time, points, work.impulse.copy(), modes, energy - self.kinetic_energy()))
        # books: energy, events, and that the impact has been dealt with
        self._add_impulse(track)
        run.dissipated[0] += self.impacts[-1].lost
        run.events[0] += 1
        run.solves[0] += 1
        run.collided[0] = 1
        run.residual[0] = max(run.residual[0], float(found.residual))
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
            SEPARATE if not pushed[i] else (STICK if self.work.flags[i] == STICKING else SLIDE)
            for i in range(len(pushed))
        ]
