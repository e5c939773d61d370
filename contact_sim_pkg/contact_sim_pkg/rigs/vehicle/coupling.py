"""Bodies and pressure fields in turn: how a rig goes from one solution of its fields to the next,
and how far at once.

From one solution to the next each contact stands on its tangent law and on a height whose offset
goes straight (decision 0004). A coupling step is as long as that allows:

* No longer than a part of the footprint, so that no obstacle that the tire passes falls between two fields.
* The slopes of the effective-height correction over this coupling step, s1 over h1, and the one
  before, s0 over h0, give its curvature; a straight line misses a parabola of it by
  ``|s1 - s0| h1**2 / (4 (h0 + h1))`` at most. Above the allowed height the coupling step is taken
  again, shorter.
* With a loss the rate of the height matters too: over this coupling step it may err by ``|s1 - s0| h1 / (h0 + h1)``.
* No error makes a coupling step so short that the solver's own error of the field would be felt as a speed.
* Where the rig or its contact fails within a coupling step, a shorter one is tried before that counts.

A tread with memory has one step for all its coupling steps: they are all of the same length, and
the error is only reported.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.laws.elastic_law import elastic_energy, elastic_force
from contact_sim_pkg.rigs.vehicle.bodies import Bodies, CouplingStep, Offsets, Sampled, Saved
from contact_sim_pkg.rigs.vehicle.coupling_model import Allowance
from contact_sim_pkg.rigs.vehicle.drive import BlockDrive
from contact_sim_pkg.rigs.vehicle.entries import FORCES
from contact_sim_pkg.rigs.vehicle.field_driver import CushionSupport, Support
from contact_sim_pkg.rigs.vehicle.model import Model
from contact_sim_pkg.rigs.vehicle.outputs import BlockRecord, FieldRecord
from contact_sim_pkg.rigs.vehicle.tire.road_field import RoadSupport
from contact_sim_pkg.run.errors import RunError

SHRINK, GROW = 0.25, 2.0  # least and largest ratio of a coupling step to the one before
AGAIN = 0.7  # largest ratio of a coupling step that is taken again
SAFETY = 0.8
SLOPE = 0.3  # part of the largest error of a rate that counts: it is that of an instant, the allowed one is of a coupling step
SETTLED = 0.5  # an offset that changes by this part of what is allowed is not corrected again


class Passed(NamedTuple):
    """Outcome of a coupling step."""

    error: float  # estimated, over the allowed one
    ends: Offsets  # [m] that the bodies moved on
    found: Offsets  # [m] of the fields at the end


class Coupling:
    """Bodies and what supports them; ``start`` once, then ``advance`` interval by interval.
    ``sampled``: the samples of one.
    """

    def __init__(self, model: Model) -> None:
        """Make buffers and supports of ``model``."""
        rig, timing = model.rig, model.timing
        self.model, self.bodies = model, Bodies(model)
        self.tire = RoadSupport(model.tire_field, rig.tire_contact, model.tire_geometry, model.tread)
        self.seat = CushionSupport(model.seat_field, rig.seat_contact, model.seat_shape)
        self.supports: tuple[Support, Support] = (self.tire, self.seat)
        samples, states = timing.segments // timing.sample_every, model.states
        self.sampled: Sampled = (
            numpy.zeros((samples, states)), numpy.zeros((samples, states)), numpy.zeros((samples, FORCES))
        )  # fmt: skip
        rule = model.coupling
        self._allowances = (Allowance(), Allowance()) if rule is None else rule.allowances
        self._shortest = 1 if rule is None else rule.shortest  # segments
        self._by_error = rule is not None and rule.segments is None
        self.reset()

    def reset(self) -> None:
        """Forget everything but the buffers."""
        self.bodies.reset()
        self._proposed = float(self.model.timing.segments)  # length of the next coupling step in segments
        for support in self.supports:
            support.reset()

    def start(self, drive: BlockDrive) -> None:
        """Let the rig stand in balance on the road at the start, with the fields that belong to it."""
        first, bodies = drive.part(0, 1), self.bodies
        bodies.stand(float(first.smooth[0]))
        if self.tire.grids is not None:
            self.tire.place(drive.road, float(drive.travel[0]))
            bodies.lift(bodies.tire_approach(0.0) - self.tire.stand(bodies.weight()))
        self.tire.begin(self._solve_tire(first, 0, 0))
        self.seat.begin(self._solve_seat(0))
        bodies.start(first, self._offsets())

    def energies(self, smooth: float) -> Vector:
        """Energies in [J] at the present instant, over a ``smooth`` height in [m] (order of
        ``rigs/vehicle/entries.energies``).
        """
        return self.bodies.energies(smooth + self.tire.offset, self.seat.offset)

    def copy_published(self) -> tuple[FieldRecord | None, FieldRecord | None]:
        """The fields of the present instant."""
        return self.tire.copy_published(), self.seat.copy_published()

    def advance(self, block: int, interval: int, whole: BlockDrive, record: BlockRecord) -> None:
        """One interval between published fields, in one or several coupling steps.

        Raises RunError where the physics ends in a named failure.
        """
        timing, done = self.model.timing, 0
        while done < timing.segments:
            first = interval * timing.segments + done
            count = self._count(whole, first, timing.segments - done)
            row = -(-done // timing.sample_every)
            states, rates, forces = self.sampled
            step = CouplingStep(
                block, (block * timing.intervals * timing.segments + first) * timing.segment_length,
                timing.segment_length, whole.part(first, count),
                done + count == timing.segments, (states[row:], rates[row:], forces[row:]), done % timing.sample_every,
            )  # fmt: skip
            if self._pass(step, record):
                done += count

    def _count(self, whole: BlockDrive, first: int, left: int) -> int:
        """Segments of the next coupling step from segment ``first`` on; ``left`` segments are left
        of the interval.
        """
        rule = self.model.coupling
        if rule is None:
            return left
        if rule.segments is not None:
            return min(rule.segments, left)
        travel = float(numpy.ptp(whole.travel[first : first + left + 1]))
        longest = self._proposed if travel <= 0.0 else min(self._proposed, left * rule.longest_travel / travel)
        pieces = -(-left // max(1, int(longest)))
        return -(-left // pieces)

    def _pass(self, step: CouplingStep, record: BlockRecord) -> bool:
        """Pass a coupling step; False where a shorter one must be tried, with all as it was."""
        saved, count = self.bodies.save(), step.segments
        least = self._shortest
        try:
            passed = self._corrected(step, saved)
        except RunError:
            if not self._by_error or count == 1:
                raise
            least = 1
            passed = Passed(math.inf, self._offsets(), self._offsets())
        ratio = min(max(SAFETY / max(passed.error, 1e-9) ** 0.5, SHRINK), GROW)
        self._proposed = max(float(least), count * ratio)
        if self._by_error and count > least and passed.error > 1.0:
            self._proposed = max(float(least), min(self._proposed, AGAIN * count))
            self.bodies.restore(saved)
            record.stretches_repeated += 1
            return False
        record.stretches += 1
        if self.model.coupling is not None:
            record.coupling_error = max(record.coupling_error, passed.error * self.model.coupling.tolerance)
        self._close(step, passed, record)
        return True

    def _corrected(self, step: CouplingStep, saved: Saved) -> Passed:
        """Predict, solve the fields at the end, correct; an error that calls for a shorter coupling
        step ends it early.
        """
        most = self.model.corrector_passes
        solved = [step.last or not support.calm for support in self.supports]
        ends = found = (self.tire.expected(step.segments), self.seat.expected(step.segments))
        error = 0.0
        for passes_left in range(most, -1, -1):
            if passes_left < most:
                self.bodies.restore(saved)
            self.bodies.move(step, self._offsets(), ends)
            # between published fields the last offsets stand as they are, unless the field is remembered
            if passes_left or step.last or not most or self.tire.remembers:
                found = self._solve(step, solved, ends)
            if passes_left == most:
                error = self._error(found, step)
                if self._by_error and step.segments > self._shortest and error > 1.0:
                    break
            if not passes_left or self._settled(ends, found, step.duration):
                break
            ends = found
        return Passed(error, ends, found)

    def _settled(self, ends: Offsets, found: Offsets, duration: float) -> bool:
        """Whether offsets found need no correction: small as heights, and as speeds over a coupling
        step of ``duration`` [s].
        """
        return all(
            abs(a - b) <= SETTLED * min(allowed.height, allowed.speed * duration)
            for a, b, allowed in zip(ends, found, self._allowances, strict=True)
        )

    def _offsets(self) -> Offsets:
        return self.tire.offset, self.seat.offset

    def _solve(self, step: CouplingStep, solved: list[bool], expected: Offsets) -> Offsets:
        """Offsets that belong to the fields at the end of the coupling step; those ``expected``
        where none is solved.
        """
        tire = self._solve_tire(step.drive, -1, step.block) if solved[0] else expected[0]
        return tire, self._solve_seat(step.block) if solved[1] else expected[1]

    def _solve_tire(self, drive: BlockDrive, point: int, block: int) -> float:
        """Solve the tire's field at the present state; returns the offset that belongs to it, 0
        without a field.
        """
        if self.tire.grids is None:
            return 0.0
        self.tire.place(drive.road, float(drive.travel[point]))
        return self.tire.solve(
            self.bodies.tire_approach(0.0), self.bodies.tire_approach(float(drive.smooth[point])), block
        )

    def _solve_seat(self, block: int) -> float:
        """Solve the seat's field at the present state; returns the offset that belongs to it, 0
        without a field.
        """
        approach = self.bodies.seat_approach(0.0)
        return self.seat.solve(approach, approach, block)

    def _error(self, found: Offsets, step: CouplingStep) -> float:
        """Largest height, or rate of it, that a straight offset misses, over the allowed one."""
        worst, count = 0.0, step.segments
        for support, offset, allowed in zip(self.supports, found, self._allowances, strict=True):
            turned = support.turn(offset, count) / step.segment_length
            worst = max(worst, support.bend(offset, count) / allowed.height, SLOPE * turned / allowed.speed)
        return worst

    def _close(self, step: CouplingStep, passed: Passed, record: BlockRecord) -> None:
        """Take the fields and their offsets over; the energy that the remaining jump brings in
        counts as supplied.
        """
        self.tire.keep()
        height, cushion = float(step.drive.smooth[-1]) + passed.ends[0], passed.ends[1]
        approaches = (self.bodies.tire_approach(height), self.bodies.seat_approach(cushion))
        pairs = zip(self.supports, approaches, passed.ends, passed.found, self._allowances, strict=True)
        for support, approach, end, offset, allowed in pairs:
            support.take(offset, step.segments, step.last or not support.calm, allowed.height)
            change = offset - end
            if support.contact is None or change == 0.0:
                continue
            law = support.contact.elastic
            self.bodies.supply(elastic_energy(law, approach + change) - elastic_energy(law, approach))
            jump = abs(elastic_force(law, approach + change) - elastic_force(law, approach))
            record.field_jump = max(record.field_jump, jump)
