"""Sub-steps with active contacts by the general solvers: what no closed form and no path of
`rigid/motion/turning.py` takes.

A velocity step with contact impulses, exact where the body does not turn; it ends where the first
slip stops or the first free contact lands. Source: Identifiability eqs 9-11.
"""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import TypeAlias

import numpy
import numpy.typing

from contact_sim_pkg.rigid.bodies import active_contacts
from contact_sim_pkg.rigid.bodies.body import Ground, Motion, RigidBody
from contact_sim_pkg.rigid.bodies.motion import MotionWorkspace
from contact_sim_pkg.rigid.motion.packed import PackedSolver
from contact_sim_pkg.rigid.motion.slip import contacts_turn, slip_turns, stop_of_slip
from contact_sim_pkg.rigid.motion.substep_end import accept_substep
from contact_sim_pkg.rigid.results import SOLVED

__all__ = ["MOST_STOPS", "Attempt", "SubstepSolver"]

Attempt: TypeAlias = tuple[
    int, float, float
]  # status, part of the sub-step after which slip stops, how many sub-steps it lasts

LARGEST_TURN = 0.005  # [rad] of a sub-step, whose position is of second order
STOP_HALVINGS = 60
LANDING_STEPS = 30
# that are located in one interval: an edge that pivots may slip back and forth without end
MOST_STOPS = 20


class SubstepSolver:
    """Sub-steps of one body, which changes in place, as does the state of its run."""

    def __init__(
        self, body: RigidBody, ground: Ground, motion: Motion, work: MotionWorkspace, solver: PackedSolver,
        run: SimpleNamespace, size: float,
    ) -> None:  # fmt: skip
        """``size`` of the body in [m]; ``run``: `run_fields` of its run."""
        self.body, self.ground, self.motion, self.work, self._solver = body, ground, motion, work, solver
        self._run, self.size = run, size

    def longest(self) -> float:
        """Longest sub-step in [s] of a body that spins as it does now."""
        spin = float(numpy.abs(self.motion.velocity[self.body.width :]).sum())
        return LARGEST_TURN / spin if spin > 0.0 else math.inf

    def attempt(self, time: float, rounding: float) -> Attempt:
        """Status, part of ``time`` after which slip stops, and how many times ``time`` it lasts."""
        work = self.work
        for curved in (
            1.0,
            0.0,
        ):  # points that come to stick within the sub-step contradict each other where their paths bend
            active_contacts.prepare_attempt(self.body, self.ground, self.motion, work, time, curved)
            found = self._solver.hold(work)
            self._run.solves[0] += 1
            if found.status == SOLVED:
                break
        if found.status != SOLVED:
            return int(found.status), 1.0, math.inf
        run = self._run
        run.residual[0] = max(run.residual[0], float(found.residual))
        part, duration = stop_of_slip(self.body, self.ground, self.motion, work, time, self.size, rounding)
        return SOLVED, part, duration

    def slip_turns(self, time: float, rounding: float, found: Attempt) -> bool:
        """Whether a slip turns over ``time`` [s], or before it stops where it stops by then: the
        last attempt is ``found``.
        """
        part = found[1]
        for _ in range(STOP_HALVINGS):
            if part == 1.0:
                break
            time *= 0.5
            _status, part, _duration = self.attempt(time, rounding)
        return bool(slip_turns(self.body, self.motion, self.work, rounding))

    def hold(self, substep: float, rounding: float, found: Attempt | None = None) -> tuple[int, float]:
        """Active contacts over at most ``substep`` [s], ended where a slip stops or a point lands;
        returns (status, time).

        ``found``: the attempt over ``substep``, if it is the one in the work space.
        """
        status, part, _duration = self.attempt(substep, rounding) if found is None else found
        time = substep
        run = self._run
        # located ends of slip are limited: an edge may slip back and forth without end
        if status == SOLVED and part < 1.0 and run.stops[0] < MOST_STOPS:
            run.stops[0] += 1
            status, time = self._to_the_stop(substep, rounding)
            run.events[0] += 1
        # a free contact that lands before ends the sub-step
        if status == SOLVED:
            status, time = self._to_the_landing(time, rounding)
        if status != SOLVED:
            return status, time
        self._run.dissipated[0] += accept_substep(
            self.body, self.ground, self.motion, self.work, time, self.size, rounding
        )
        return status, time

    def _to_the_landing(self, time: float, rounding: float) -> tuple[int, float]:
        """The time, up to ``time``, at which the first free contact is on the ground; the sub-step
        up to it is in the work space.
        """
        parts = (self.body, self.ground, self.motion, self.work)
        for _ in range(LANDING_STEPS):
            part, first = active_contacts.landing_part(*parts, time, self.size)
            if first < 0:
                return SOLVED, time
            # bracket: free at its start, below the ground at its end
            high, below = time, active_contacts.gap_after(*parts, time, first)
            low, above, near = 0.0, max(float(self.work.gap[first]), 0.0), active_contacts.LANDED * self.size
            side = 0
            for _ in range(LANDING_STEPS):
                # regula falsi; each trial solves the contact problem anew
                time = low + (high - low) * above / (above - below) if above > near else part * high
                status, _part, _duration = self.attempt(time, rounding)
                if status != SOLVED:
                    return status, time
                gap = active_contacts.gap_after(*parts, time, first)
                if abs(gap) <= near:
                    break
                # Illinois: the end that stays twice counts half
                if gap < 0.0:
                    high, below, above, side = time, gap, above * (0.5 if side < 0 else 1.0), -1
                else:
                    low, above, below, side = time, gap, below * (0.5 if side > 0 else 1.0), 1
        return SOLVED, time

    def _to_the_stop(self, substep: float, rounding: float) -> tuple[int, float]:
        """The time at which the first sliding point stops: a sub-step in which it still slides
        gives its deceleration.
        """
        probe, part, duration, status = substep, 0.0, math.inf, SOLVED
        for _ in range(STOP_HALVINGS):
            probe *= 0.5
            status, part, duration = self.attempt(probe, rounding)
            if status != SOLVED or part == 1.0:
                break
        time = min(substep, probe * duration)
        if status == SOLVED and part == 1.0 and self._goes_straight(rounding):
            self._prolong(probe, time, rounding)
        elif status == SOLVED:
            status, _part, _duration = self.attempt(time, rounding)
        return status, time

    def _goes_straight(self, rounding: float) -> bool:
        """Whether neither rows of contacts nor slips turn in the last attempt: its impulses then
        grow with time.
        """
        parts = (self.body, self.ground, self.motion, self.work)
        turning = any(contacts_turn(*parts, velocity, self.size) for velocity in (self.motion.velocity, self.work.free))
        return not turning and not slip_turns(self.body, self.motion, self.work, rounding)

    def _prolong(self, probe: float, time: float, rounding: float) -> None:
        """The attempt over ``probe`` [s] brought to the stop after ``time``, where a solve has no
        firm ground: stick meets slip.
        """
        parts = (self.body, self.ground, self.motion, self.work)
        active_contacts.prepare_attempt(*parts, time, 1.0)
        self.work.impulse[:] *= time / probe
        stop_of_slip(*parts, time, self.size, rounding)
