"""Coupling of bodies and pressure fields: from one solution of the fields to the next, and how far.

From one solution to the next each contact has its tangent law and a height whose correction is
linear in time (decision 0004). A coupling step is as long as that allows:

* No longer than the footprint, half of it where the road is not nearly straight, so that no obstacle
  that the tire passes falls between two fields.
* The slopes of the effective-height correction over this coupling step, s1 over h1, and the one
  before, s0 over h0, give its curvature; a straight line misses a parabola of it by
  ``|s1 - s0| h1**2 / (4 (h0 + h1))`` at most. Above the allowed height the coupling step is
  repeated, shorter.
* With dissipation the rate of the height matters too: its error over this coupling step is
  ``|s1 - s0| h1 / (h0 + h1)``.
* No error makes a coupling step so short that the solver's own error would act as a speed.
* Where the rig or its contact fails within a coupling step, a shorter one is tried before that
  counts.

* Every few steps are checked in their middle (`check.py`). What they miss there bounds the way of
  the steps to come, and a step that misses too much is repeated, shorter.

The coupling steps of a viscoelastic tread have one length; the error is only reported.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.records.state import State
from contact_sim_pkg.rigs.vehicle.field.contact_field import law_at
from contact_sim_pkg.rigs.vehicle.field.coupling_rule import (
    STRAIGHT,
    Allowance,
    MeasuredWay,
    bend_of,
    even_part,
    extent_of,
)
from contact_sim_pkg.rigs.vehicle.field.driver import ContactField, FieldRecord, Turn
from contact_sim_pkg.rigs.vehicle.model import Model
from contact_sim_pkg.rigs.vehicle.motion.columns import FORCES, SEAT_NORMAL, TIRE_NORMAL, TIRE_SHEAR, TIRE_SLOPE
from contact_sim_pkg.rigs.vehicle.motion.entries import lay_slopes, raise_to
from contact_sim_pkg.rigs.vehicle.outputs import BlockRecord
from contact_sim_pkg.rigs.vehicle.run.bodies import LINEAR, Bodies, Corrections, CouplingStep, Saved
from contact_sim_pkg.rigs.vehicle.run.coupling_check import CouplingCheck, Middle, MissedSoFar, middle_of
from contact_sim_pkg.rigs.vehicle.run.drive import BlockDrive
from contact_sim_pkg.rigs.vehicle.seat.cushion_field import CushionField
from contact_sim_pkg.rigs.vehicle.tire.brush.rolling_shear import RollingShear, TireStep
from contact_sim_pkg.rigs.vehicle.tire.road_field import RoadField
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.run.saved_state import carry_state

SHRINK, GROW = 0.25, 2.0  # least and largest ratio of a coupling step to the one before
AGAIN = 0.7  # largest ratio of a coupling step that is repeated
SAFETY = 0.8
SLOPE = 0.6  # part of the largest error of a rate that counts: it is that of an instant, the allowed one is of a coupling step
SETTLED = 0.5  # a correction that changes by this part of what is allowed is not corrected again


Turns = tuple[Turn, Turn]


class StepOutcome(NamedTuple):
    """Outcome of a coupling step."""

    error: float  # estimated, over the allowed one
    ends: Corrections  # [m] that the bodies moved on
    bends: Corrections  # [m] the same
    found: Corrections  # [m] of the fields at the end
    turns: Turns  # the courses to these


class Coupling:
    """Bodies and their contact fields; ``start`` once, then ``advance`` interval by interval."""

    STATE = State(
        ("bodies", "tire", "seat", "shear", "_slope"),
        ("_proposed", "_before", "_largest", "missed", "_way", "_check"),
    )

    def __init__(self, model: Model) -> None:
        """Make the buffers and contact fields of ``model``."""
        self.model, self.bodies = model, Bodies(model)
        self.tire = RoadField(model.tire_field, model.tire_contact, model.tire_geometry, model.tread)
        self.seat = CushionField(model.seat_field, model.rig.seat_contact, model.seat_shape)
        self.fields: tuple[ContactField, ContactField] = (self.tire, self.seat)
        friction, grids = model.rolling_friction, model.tire_field
        self.shear = None if friction is None or grids is None else RollingShear(friction, grids.wide.settings)
        rule = model.coupling
        self._allowances = (Allowance(), Allowance()) if rule is None else rule.allowances
        self._shortest = 1 if rule is None else rule.shortest  # segments
        self._by_error = rule is not None and rule.segments is None
        # An edge is of first order in the cells, the slope on it first; bristles need a map at each step
        if self._by_error and self.shear is None and model.edge is None:
            self.tire.use_level(self._allowances[0].height)
        self._check = CouplingCheck(model, self.tire, self.seat) if self._by_error else None
        self._way = MeasuredWay(*((math.inf, 0.0) if rule is None else (*rule.ways, rule.tolerance)))
        self.reset()

    def reset(self) -> None:
        """Reset all but the buffers."""
        self.bodies.reset()
        self._slope = 0.0  # of the road under the tire, at the last solution of its field
        self._proposed = float(self.model.timing.segments)  # length of the next coupling step in segments
        self._before = 0  # segments of the one before
        self._largest = numpy.zeros(FORCES)  # so far
        self._largest[[TIRE_NORMAL, SEAT_NORMAL]] = [allowed.load for allowed in self._allowances]
        self.missed = MissedSoFar()
        self._way.reset()
        if self._check is not None:
            self._check.reset()
        for field in self.fields:
            field.reset()
        if self.shear is not None:
            self.shear.reset()

    def start(self, drive: BlockDrive, rate: float) -> None:
        """Set the rig in equilibrium on the road at the start of a run, with its fields; it rises at a ``rate``
        [m/s].
        """
        first, bodies = drive.part(0, 1), self.bodies
        bodies.stand(float(first.smooth[0]), rate)
        if self.tire.grids is not None:
            self.tire.place(drive.road, float(drive.travel[0]))
            load, machine = bodies.weight(float(first.smooth[0])), self.model.machine
            if load > 0.0:
                approach, rolled = self.tire.stand(load), self.tire.roll_in(load, drive.speed)
                if machine is None or machine.deflection is None:
                    bodies.lift(bodies.tire_approach(0.0) - (approach if rolled is None else rolled))
        self.tire.begin(self._solve_tire(first, 0, 0, is_published=True))
        if drive.speed != 0.0:
            self.tire.store()
        self._slope = self.tire.effective_slope()
        if self.shear is not None and self.tire.published is not None:
            found = self.tire.published
            load = float(found.pressure.sum()) * self.tire.cell_area
            origin = (found.origin_x, found.origin_y)
            self.shear.start(found.pressure, origin, found.travel, self.tire.slope_force(load))
        self.seat.begin(self._solve_seat(0))
        bodies.start(first, self._corrections())

    def take_over(self, before: Coupling, drive: BlockDrive, block: int) -> None:
        """Go on from the bodies, bristles and memory of another coupling at the start of a ``block``, with the fields
        that this model has there; steps begin as at the start of a run. Raises StateError where they do not fit.
        """
        carry_state(before, self, "the vehicle")
        self.bodies.restore(before.bodies.save())
        first = drive.part(0, 1)
        self.tire.begin(self._solve_tire(first, 0, block, is_published=True))
        self._slope = self.tire.effective_slope()
        self.seat.begin(self._solve_seat(block))

    def energies(self, smooth: float) -> Vector:
        """Energies [J] at the present instant over a ``smooth`` height [m], as `entries.energies`
        orders them.
        """
        found = self.bodies.energies(smooth + self.tire.correction, self.seat.correction)
        return found if self.shear is None or not self.shear.has_belt else found + self.shear.works().entries

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
            step = CouplingStep(
                block, (block * timing.intervals * timing.segments + first) * timing.segment_length,
                timing.segment_length, whole.part(first, count),
                done + count == timing.segments, -(-done // timing.sample_every), done % timing.sample_every, count,
            )  # fmt: skip
            if self._advance_step(step, record):
                done += count
        raise_to(self._largest, self.bodies.sampled[2])

    def _lay_slopes(self, step: CouplingStep) -> None:
        """Write the effective slope of the road at the samples of a coupling step, linear between the
        fields at its ends; without a field that of the effective height.
        """
        if self.model.tire_geometry is None:
            return
        every, drive = self.model.timing.sample_every, step.drive
        if self.tire.grids is None:
            at = numpy.arange(-step.behind_sample % every, step.segments, every)
            slopes = self.bodies.sampled[2][step.row : step.row + len(at), TIRE_SLOPE]
            way = numpy.gradient(drive.travel)[at]
            slopes[:] = 0.0
            numpy.divide(numpy.gradient(drive.smooth)[at], way, out=slopes, where=way != 0.0)
        else:
            end = self.tire.effective_slope()
            lay_slopes(self.bodies.sampled[2], step.row, step.behind_sample, every, step.segments, self._slope, end)
            self._slope = end
        loss = self.model.rolling_loss
        if loss is None or self.shear is not None:  # there it turns the wheel
            return
        count = len(range(-step.behind_sample % every, step.segments, every))
        rows = self.bodies.sampled[2][step.row : step.row + count]
        load = rows[:, TIRE_NORMAL]
        rows[:, TIRE_SLOPE] += numpy.divide(
            loss.along(load, step.speed), load, out=numpy.zeros(count), where=load > 0.0
        )

    def _roll(self, step: CouplingStep, outcome: StepOutcome, approach: float) -> None:
        """Roll bristles and belt on to the field at the end of a coupling step, at an ``approach`` [m];
        their samples go into their columns.
        """
        found = self.tire.published
        if self.shear is None or found is None:
            return
        # The pressure with its loss, by the approach and its rate at the end.
        rising = (outcome.ends[0] - self.tire.correction + outcome.bends[0]) / step.duration
        rate = float(step.drive.rate[-1]) + rising - self.bodies.tread_rate()
        pressure = self.tire.with_loss(found, approach, rate).pressure
        load = float(pressure.sum()) * self.tire.cell_area
        every = self.model.timing.sample_every
        tire_step = TireStep(
            step.start, step.segment_length, step.segments, float(step.drive.travel[-1]), self.tire.slope_force(load),
            self._resistance(load, step.speed), self.bodies.axle_deflection(approach), every, step.behind_sample,
        )  # fmt: skip
        samples = self.shear.roll(tire_step, pressure, (found.origin_x, found.origin_y))
        count = len(range(-step.behind_sample % every, step.segments, every))
        self.bodies.sampled[2][step.row : step.row + count, TIRE_SHEAR:] = samples[:count]

    def _resistance(self, load: float, speed: float) -> float:
        """Moment of rolling resistance over the radius [N] under a ``load`` [N] at a ``speed`` [m/s]: of the field's
        memory, or of the sum that stands for it.
        """
        loss = self.model.rolling_loss
        return self.tire.rolling_force() if loss is None else float(loss.along(numpy.array(load), speed))

    def _count(self, whole: BlockDrive, first: int, left: int) -> int:
        """Segments of the next coupling step from segment ``first`` on, at most ``left``."""
        rule = self.model.coupling
        if rule is None:
            return left
        if rule.segments is not None:
            return min(rule.segments, left)
        count, travel = left, extent_of(whole.travel[first : first + left + 1])
        # The longer way only where the road is nearly straight all along it.
        for longest in rule.longest:
            longest = min(longest, self._way.longest)
            steps = self._proposed if travel <= 0.0 else min(self._proposed, left * longest / travel)
            count = even_part(left, steps)
            if bend_of(whole.smooth[first : first + count + 1]) <= STRAIGHT * self._allowances[0].height:
                break
        return count

    def _advance_step(self, step: CouplingStep, record: BlockRecord) -> bool:
        """Advance by a coupling step; False where a shorter one must be tried from the same
        state.
        """
        saved, count = self.bodies.save(), step.segments
        least, now = self._shortest, self._corrections()
        # A failure within the step counts only where no shorter step can avoid it.
        try:
            outcome = self._corrected(step, saved)
        except RunError:
            if not self._by_error or count == 1:
                raise
            least = 1
            outcome = StepOutcome(math.inf, now, LINEAR, now, self._turns(now, step))
        # The error grows with the square of the length; a rejected step is restored and repeated.
        ratio = min(max(SAFETY / max(outcome.error, 1e-9) ** 0.5, SHRINK), GROW)
        # The last part of an interval may be one segment shorter than those before it, which is no reason to stay short
        even = self._before if step.last and self._before == count + 1 else count
        self._proposed = max(float(least), even * ratio)
        error = outcome.error
        if error <= 1.0 and self._check is not None and self._check.is_due(step, error):
            found = self._look(self._check, step, saved, outcome)
            missed = self._judged(found, step)
            if missed > 1.0 and count > least:
                error, self._proposed = missed, count * SAFETY / missed**0.5
            else:
                self.missed.add(found)
        if self._by_error and count > least and error > 1.0:
            self._proposed = max(float(least), min(self._proposed, AGAIN * count))
            self.bodies.restore(saved)
            record.coupling_steps_repeated += 1
            return False
        record.coupling_steps += 1
        self._before = count
        if self.model.coupling is not None:
            record.coupling_error = max(record.coupling_error, outcome.error * self.model.coupling.tolerance)
        self._close(step, outcome, record, SLOPE if error <= 1.0 else 1.0)
        return True

    def _look(self, check: CouplingCheck, step: CouplingStep, saved: Saved, outcome: StepOutcome) -> Middle:
        """What a step missed in its middle."""
        end, ends = self.bodies.save(), outcome.ends
        self.bodies.restore(saved)
        self.bodies.move(step, self._corrections(), ends, outcome.bends, middle_of(step))
        found = check.look(self.bodies, step, (self._slope, self.tire.effective_slope()))
        self.bodies.restore(end)
        return found

    def _judged(self, found: Middle, step: CouplingStep) -> float:
        """Largest error that was found in the middle of a step over the allowed one; the steps to come
        are as long as it lets them be.
        """
        errors = (max(found.tire.normal, found.tire.along), found.seat.normal)
        loads = self._largest[[TIRE_NORMAL, SEAT_NORMAL]].tolist()
        parts = [
            error / (allowed.force * largest / allowed.load)
            for error, allowed, largest in zip(errors, self._allowances, loads, strict=True)
            if math.isfinite(error)
        ]
        worst = max(parts, default=0.0)
        if step.segments < 2:  # its middle is its end
            return worst
        self._way.learn(extent_of(step.drive.travel), worst)
        return worst

    def _corrected(self, step: CouplingStep, saved: Saved) -> StepOutcome:
        """Predict, solve the fields at the end, correct; a rejected error ends it early."""
        most = self.model.corrector_passes
        solved = [step.last or not field.as_predicted for field in self.fields]
        ends = found = (self.tire.predicted(step.segments), self.seat.predicted(step.segments))
        turns, error = self._turns(ends, step), 0.0
        self.tire.begin_instant()
        for passes_left in range(most, -1, -1):
            if passes_left < most:
                self.bodies.restore(saved)
            bends = self._bends(turns)
            self.bodies.move(step, self._corrections(), ends, bends)
            # Between published fields the last corrections are kept, unless the field is
            # viscoelastic.
            if passes_left or step.last or not most or self.tire.is_viscoelastic:
                # The first passes go by the force alone
                found = self._solve(
                    step, solved, ends, is_published=step.last and (passes_left < most or not self.tire.goes_by_level)
                )
                turns = self._turns(found, step)
            if passes_left == most:
                (tire, seat), (of_tire, of_seat) = turns, self._allowances
                error = max(of_tire.part(tire.height, SLOPE * tire.rate), of_seat.part(seat.height, SLOPE * seat.rate))
                if self._by_error and step.segments > self._shortest and error > 1.0:
                    break
            if not passes_left or self._settled(ends, found, step.duration):
                break
            ends = found
        if step.last and self.tire.is_between and not error > 1.0:
            found = self._solve_tire(step.drive, -1, step.block, is_published=True), found[1]
            turns = self._turns(found, step)
        return StepOutcome(error, ends, bends, found, turns)

    def _settled(self, ends: Corrections, found: Corrections, duration: float) -> bool:
        """Whether the change of the corrections is small as a height, and as a speed over
        ``duration`` [s].
        """
        tire, seat = self._allowances
        most = min(tire.height, tire.speed * duration), min(seat.height, seat.speed * duration)
        return abs(ends[0] - found[0]) <= SETTLED * most[0] and abs(ends[1] - found[1]) <= SETTLED * most[1]

    def _bends(self, turns: Turns) -> Corrections:
        """Bends of the corrections over a step: of the parabolas through three solutions, and less
        where the step is as short as it may be and these say nothing, as at a wall.
        """
        (tire, seat), (of_tire, of_seat) = turns, self._allowances
        return (
            tire.bend / max(1.0, of_tire.part(tire.height, tire.rate)),
            seat.bend / max(1.0, of_seat.part(seat.height, seat.rate)),
        )

    def _turns(self, ends: Corrections, step: CouplingStep) -> Turns:
        """Courses of the corrections to the ``ends`` of a step."""
        count, length = step.segments, step.segment_length
        return self.tire.turn(ends[0], count, length), self.seat.turn(ends[1], count, length)

    def _corrections(self) -> Corrections:
        return self.tire.correction, self.seat.correction

    def _solve(
        self, step: CouplingStep, solved: list[bool], expected: Corrections, *, is_published: bool
    ) -> Corrections:
        """Corrections [m] by the fields at the end of the coupling step; ``expected`` where none is
        solved.
        """
        tire = expected[0]
        if solved[0]:
            tire = self._solve_tire(step.drive, -1, step.block, is_published=is_published)
        return tire, self._solve_seat(step.block) if solved[1] else expected[1]

    def _solve_tire(self, drive: BlockDrive, point: int, block: int, *, is_published: bool) -> float:
        """Solve the tire's field at the present state; returns its correction [m], 0 without a
        field.
        """
        if self.tire.grids is None:
            return 0.0
        self.tire.place(drive.road, float(drive.travel[point]))
        solve = self.tire.solve_published if is_published else self.tire.solve_between
        return solve(
            self.bodies.tire_approach(drive.table_at(point)),
            self.bodies.tire_approach(float(drive.smooth[point])),
            block,
        )

    def _solve_seat(self, block: int) -> float:
        """Solve the seat's field at the present state; returns its correction [m], 0 without a
        field.
        """
        approach = self.bodies.seat_approach(0.0)
        return self.seat.solve(approach, approach, block)

    def _close(self, step: CouplingStep, outcome: StepOutcome, record: BlockRecord, of_slope: float) -> None:
        """Accept the fields and their corrections; the energy of the remaining jump counts as supplied.

        What the curvature of the corrections means for the normal forces is counted as missed, with the
        part ``of_slope`` of a rate's error: all of it where the step is as short as it may be.
        """
        ends = outcome.ends
        approaches = (
            self.bodies.tire_approach(float(step.drive.smooth[-1]) + ends[0]),
            self.bodies.seat_approach(ends[1]),
        )
        self._roll(step, outcome, approaches[0])
        self.tire.store()
        self._lay_slopes(step)
        for place, (field, allowed, turn) in enumerate(zip(self.fields, self._allowances, outcome.turns, strict=True)):
            field.accept(outcome.found[place], step.segments, step.last or not field.as_predicted, allowed.height)
            if field.contact is None or field.grids is None:
                continue
            change = outcome.found[place] - ends[place]
            force, stiffness, jump, energy = law_at(field.contact.elastic, approaches[place], change)
            self.missed.add_estimate(place, allowed.missed_force(force, stiffness, turn.height, of_slope * turn.rate))
            if step.last and field is self.tire:
                self.missed.add_estimate(place, allowed.missed_force(force, stiffness, self.tire.renew_level(), 0.0))
            self.bodies.supply(energy)
            record.field_jump = max(record.field_jump, abs(jump))
