"""Pieces of time with held contacts by the general solvers: what no closed form and no path of
`rigid/motion/turning.py` takes.

A velocity step with contact impulses, exact where the body does not turn; it ends where the first
slip stops or the first free contact lands. Source: Identifiability eqs 9-11.
"""

from __future__ import annotations

import math
from typing import TypeAlias

import numpy
import numpy.typing

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.rigid.body import Ground, Motion, RigidBody
from contact_sim_pkg.rigid.contact.packed import PackedSolver
from contact_sim_pkg.rigid.geometry.track import EVENTS, LOST, RESIDUAL, SOLVES, STOPS
from contact_sim_pkg.rigid.motion import active_contacts as held
from contact_sim_pkg.rigid.motion.motion import MotionWorkspace
from contact_sim_pkg.rigid.motion.slip import slip_turns, stop_of_slip, turns
from contact_sim_pkg.rigid.motion.substep_end import take_piece
from contact_sim_pkg.rigid.results import SOLVED

__all__ = ["MOST_STOPS", "Attempt", "SupportedPieces"]

Attempt: TypeAlias = tuple[
    int, float, float
]  # status, part of the piece after which slip stops, how many pieces it lasts

LARGEST_TURN = 0.005  # [rad] of a piece, whose position is of second order
STOP_HALVINGS = 60
LANDING_STEPS = 30
MOST_STOPS = 20  # that are located in one interval: an edge that pivots may slip back and forth without end


class SupportedPieces:
    """Of one body, which changes in place; ``clock`` and ``counts`` are those of its march
    (`rigid/geometry/track.py`).
    """

    def __init__(
        self, body: RigidBody, ground: Ground, motion: Motion, work: MotionWorkspace, solver: PackedSolver, clock: Vector,
        counts: numpy.typing.NDArray[numpy.int64], size: float,
    ) -> None:  # fmt: skip
        """``size`` of the body in [m]."""
        self.body, self.ground, self.motion, self.work, self._solver = body, ground, motion, work, solver
        self.clock, self.counts, self.size = clock, counts, size

    def longest(self) -> float:
        """Longest piece in [s] of a body that spins as it does now."""
        spin = float(numpy.abs(self.motion.velocity[self.body.width :]).sum())
        return LARGEST_TURN / spin if spin > 0.0 else math.inf

    def attempt(self, time: float, still: float) -> Attempt:
        """Status, part of ``time`` after which slip stops, and how many times ``time`` it lasts."""
        work = self.work
        for bend in (
            1.0,
            0.0,
        ):  # points that come to stick within the piece contradict each other where their paths bend
            held.prepare_attempt(self.body, self.ground, self.motion, work, time, bend)
            found = self._solver.hold(work)
            self.counts[SOLVES] += 1
            if found.status == SOLVED:
                break
        if found.status != SOLVED:
            return int(found.status), 1.0, math.inf
        clock = self.clock
        clock[RESIDUAL] = max(clock[RESIDUAL], float(found.residual))
        part, stretch = stop_of_slip(self.body, self.ground, self.motion, work, time, self.size, still)
        return SOLVED, part, stretch

    def slip_turns(self, time: float, still: float, found: Attempt) -> bool:
        """Whether a slip turns over ``time`` [s], or before it stops where it stops by then: the
        last attempt is ``found``.
        """
        part = found[1]
        for _ in range(STOP_HALVINGS):
            if part == 1.0:
                break
            time *= 0.5
            _status, part, _stretch = self.attempt(time, still)
        return bool(slip_turns(self.body, self.motion, self.work, still))

    def hold(self, piece: float, still: float, found: Attempt | None = None) -> tuple[int, float]:
        """Held contacts over at most ``piece`` [s], ended where a slip stops or a point lands;
        returns (status, time).

        ``found``: the attempt over ``piece``, where it stands in the work space.
        """
        status, part, _stretch = self.attempt(piece, still) if found is None else found
        time = piece
        count = self.counts
        if status == SOLVED and part < 1.0 and count[STOPS] < MOST_STOPS:
            count[STOPS] += 1
            status, time = self._to_the_stop(piece, still)
            count[EVENTS] += 1
        if status == SOLVED:
            status, time = self._to_the_landing(time, still)
        if status != SOLVED:
            return status, time
        self.clock[LOST] += take_piece(self.body, self.ground, self.motion, self.work, time, self.size, still)
        return status, time

    def _to_the_landing(self, time: float, still: float) -> tuple[int, float]:
        """The time, up to ``time``, at which the first free contact is on the ground; the piece up
        to it is in the work space.
        """
        parts = (self.body, self.ground, self.motion, self.work)
        for _ in range(LANDING_STEPS):
            part, first = held.landing_part(*parts, time, self.size)
            if first < 0:
                return SOLVED, time
            high, below = time, held.gap_after(*parts, time, first)
            low, above, near = 0.0, max(float(self.work.gap[first]), 0.0), held.LANDED * self.size
            side = 0
            for _ in range(LANDING_STEPS):
                time = low + (high - low) * above / (above - below) if above > near else part * high
                status, _part, _stretch = self.attempt(time, still)
                if status != SOLVED:
                    return status, time
                gap = held.gap_after(*parts, time, first)
                if abs(gap) <= near:
                    break
                if gap < 0.0:
                    high, below, above, side = time, gap, above * (0.5 if side < 0 else 1.0), -1
                else:
                    low, above, below, side = time, gap, below * (0.5 if side > 0 else 1.0), 1
        return SOLVED, time

    def _to_the_stop(self, piece: float, still: float) -> tuple[int, float]:
        """The time at which the first sliding point stops: a piece in which it still slides gives
        its deceleration.
        """
        probe, part, stretch, status = piece, 0.0, math.inf, SOLVED
        for _ in range(STOP_HALVINGS):
            probe *= 0.5
            status, part, stretch = self.attempt(probe, still)
            if status != SOLVED or part == 1.0:
                break
        time = min(piece, probe * stretch)
        if status == SOLVED and part == 1.0 and self._goes_straight(still):
            self._prolong(probe, time, still)
        elif status == SOLVED:
            status, _part, _stretch = self.attempt(time, still)
        return status, time

    def _goes_straight(self, still: float) -> bool:
        """Whether neither rows of contacts nor slips turn in the last attempt: its impulses then
        grow with time.
        """
        parts = (self.body, self.ground, self.motion, self.work)
        turning = any(turns(*parts, velocity, self.size) for velocity in (self.motion.velocity, self.work.free))
        return not turning and not slip_turns(self.body, self.motion, self.work, still)

    def _prolong(self, probe: float, time: float, still: float) -> None:
        """The attempt over ``probe`` [s] brought to the stop after ``time``, where a solve has no
        firm ground: stick meets slip.
        """
        parts = (self.body, self.ground, self.motion, self.work)
        held.prepare_attempt(*parts, time, 1.0)
        self.work.impulse[:] *= time / probe
        stop_of_slip(*parts, time, self.size, still)
