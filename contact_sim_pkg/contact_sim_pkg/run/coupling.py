"""Bodies and pressure fields in turn: how a rig goes from one solution of its fields to the next, and how far at once.

From one solution to the next each contact stands on its tangent law and on a height whose offset goes straight (decision 0004).
A stretch is as long as that allows:

* No longer than a part of the footprint, so that no obstacle that the tire passes falls between two fields.
* The offset's slopes over this stretch, s1 over h1, and the one before, s0 over h0, tell its curvature; a straight line misses
  a parabola of it by ``|s1 - s0| h1**2 / (4 (h0 + h1))`` at most. Above the allowed height the stretch is taken again, shorter.
* Where the rig or its contact fails within a stretch, a shorter one is tried before that counts.

A tread with memory has one step for all its stretches: they are all of the same length, and the error is only told.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy

from contact_sim_pkg.core.effects.footprint import effective_between
from contact_sim_pkg.core.effects.normal_elastic import elastic_energy, elastic_force
from contact_sim_pkg.core.parameters import Vector
from contact_sim_pkg.core.results import DONE, SENTENCES
from contact_sim_pkg.core.rigs import advance as entries
from contact_sim_pkg.core.rigs.vehicle import MARGINS
from contact_sim_pkg.core.solvers.dormand_prince import make_workspace
from contact_sim_pkg.run.block_drive import BlockDrive
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.run.outputs import BlockRecord, FieldRecord
from contact_sim_pkg.run.support import CushionSupport, RoadSupport, Support
from contact_sim_pkg.scene.build import Model, standing_state

Fields = tuple[FieldRecord | None, FieldRecord | None]
Sampled = tuple[Vector, Vector, Vector]

SHRINK, GROW = 0.25, 2.0  # least and largest ratio of a stretch to the one before
SAFETY = 0.8
SETTLED = 0.5  # an offset that changes by this part of the allowed height is not corrected again


class Stretch(NamedTuple):
    """A row of segments from one solution of the fields to the next."""

    block: int
    start: float  # [s]
    drive: BlockDrive
    last: bool  # of its interval: its fields are published
    sampled: Sampled  # rows from the next sample on
    behind_sample: int  # segments since the last sample


class Coupling:
    """State of the bodies and what supports them. ``start`` once, then ``advance`` interval by interval."""

    def __init__(self, model: Model) -> None:
        """Make buffers and supports of ``model``."""
        rig, timing = model.rig, model.timing
        self.model = model
        self.tire = RoadSupport(model.tire_field, rig.tire_contact, model.tire_geometry, model.tread)
        self.seat = CushionSupport(model.seat_field, rig.seat_contact, model.seat_shape)
        self.supports: tuple[Support, Support] = (self.tire, self.seat)
        samples = timing.segments // timing.sample_every
        self.sampled: Sampled = (
            numpy.zeros((samples, model.states)),
            numpy.zeros((samples, model.states)),
            numpy.zeros((samples, entries.FORCES)),
        )
        self._height = numpy.zeros(timing.segments + 1)
        self._cushion = numpy.zeros(timing.segments + 1)
        self.reset()

    def reset(self) -> None:
        """Forget everything but the buffers."""
        model = self.model
        self.state: Vector = numpy.zeros(model.states)
        self.mode = numpy.zeros(1, dtype=numpy.int64)
        self.work = make_workspace(model.states, MARGINS)
        self._proposed = float(model.timing.segments)  # length of the next stretch in segments
        for support in self.supports:
            support.reset()

    def start(self, drive: BlockDrive) -> None:
        """Let the rig stand in balance on the road at the start, with the fields that belong to it."""
        smooth, first = drive.smooth, drive.part(0, 1)
        self.state[:] = standing_state(self.model, float(smooth[0]))
        if self.tire.grids is not None:
            self._stand_on_road(drive.road, float(drive.travel[0]))
        self.tire.begin(self._solve_tire(first, 0, 0))
        self.seat.begin(self._solve_seat(0))
        height = first.smooth + self.tire.offset
        cushion = numpy.full(2, self.seat.offset)
        length = self.model.timing.segment_length
        entries.start(
            self.model.rig, self.mode, self.state, self.work, length, height, cushion, first.acceleration_x,
            first.acceleration_z, first.push,
        )  # fmt: skip

    def _stand_on_road(self, road: Any, travel: float) -> None:
        """Shift the rig up or down so that the tire's field carries its weight on the road at the start."""
        self.tire.place(road, travel)
        rig = self.model.rig
        assert rig.tire is not None
        mass = rig.tire.wheel_mass + rig.tire.body_mass
        if rig.carcass is not None:
            mass += rig.carcass.belt_mass
        if rig.seat is not None:
            mass += rig.seat.frame_mass + float(rig.seat.masses.sum())
        shift = -self.tire.stand(mass * rig.gravity) - self._tread_height()
        vertical = [0, 1] if rig.carcass is None else [0, 1, rig.carcass.offset]
        if rig.seat is not None:
            vertical += range(rig.seat.offset, rig.seat.offset + 1 + len(rig.seat.masses))
        self.state[vertical] += shift

    def energies(self, smooth: float) -> Vector:
        """Energies in [J] of the present state (columns of ``core/rigs/advance.energies``) over a ``smooth`` height in [m]."""
        height, cushion = smooth + self.tire.offset, self.seat.offset
        return numpy.array(entries.energies(self.model.rig, self.mode, self.state, height, cushion))

    def copy_published(self) -> Fields:
        """The fields of the present instant."""
        return self.tire.copy_published(), self.seat.copy_published()

    def advance(self, block: int, interval: int, whole: BlockDrive, record: BlockRecord) -> None:
        """One interval between published fields, in one or several stretches; ``sampled`` holds its samples.

        Raises RunError where the physics ends in a named failure.
        """
        timing, done = self.model.timing, 0
        while done < timing.segments:
            first = interval * timing.segments + done
            count = self._count(whole, first, timing.segments - done)
            row = -(-done // timing.sample_every)
            states, rates, forces = self.sampled
            stretch = Stretch(
                block, (block * timing.intervals * timing.segments + first) * timing.segment_length, whole.part(first, count),
                done + count == timing.segments, (states[row:], rates[row:], forces[row:]), done % timing.sample_every,
            )  # fmt: skip
            if self._stretch(stretch, count, record):
                done += count

    def _count(self, whole: BlockDrive, first: int, left: int) -> int:
        """Segments of the next stretch from segment ``first`` on; ``left`` segments are left of the interval."""
        rule = self.model.coupling
        if rule is None:
            return left
        if rule.segments is not None:
            return min(rule.segments, left)
        travel = float(numpy.ptp(whole.travel[first : first + left + 1]))
        longest = self._proposed if travel <= 0.0 else min(self._proposed, left * rule.longest_travel / travel)
        pieces = -(-left // max(1, int(longest)))
        return -(-left // pieces)

    def _stretch(self, stretch: Stretch, count: int, record: BlockRecord) -> bool:
        """Predict, solve the fields at the end, correct; False where a shorter stretch must be tried, with all as it was."""
        work, rule = self.work, self.model.coupling
        saved = (self.state.copy(), self.mode.copy(), work.side.copy(), work.step.copy(), work.last_event.copy())
        free = rule is not None and rule.segments is None and count > 1
        try:
            error, ends, found = self._corrected(stretch, count, saved, free)
        except RunError:
            if not free:
                raise
            error, ends, found = numpy.inf, None, None
        if rule is not None and rule.segments is None:
            ratio = SAFETY / max(error, 1e-9) ** 0.5
            self._proposed = max(1.0, count * min(max(ratio, SHRINK), GROW))
        if ends is None or found is None:
            self._proposed = min(self._proposed, 0.7 * count)
            self._restore(saved)
            record.stretches_repeated += 1
            return False
        record.stretches += 1
        if rule is not None:
            record.coupling_error = max(record.coupling_error, error * rule.tolerance)
        self._close(stretch, ends, found, count, record)
        return True

    def _corrected(self, stretch: Stretch, count: int, saved: Any, free: bool) -> Any:
        """Error over the allowed one, offsets at the end that the bodies moved on and those that were found there."""
        passes = self.model.corrector_passes
        solved = [stretch.last or not support.calm for support in self.supports]
        ends = found = tuple(support.expected(count) for support in self.supports)
        error = 0.0
        for passes_left in range(passes, -1, -1):
            if passes_left < passes:
                self._restore(saved)
            self._integrate(stretch, ends)
            if passes_left or stretch.last or not passes:  # between published fields the last offsets stand as they are
                found = self._solve(stretch, solved, ends)
            if passes_left == passes:
                error = self._error(found, count)
                if free and error > 1.0:
                    return error, None, None
            if self._settled(ends, found):
                break
            if passes_left:
                ends = found
        return error, ends, found

    def _restore(self, saved: Any) -> None:
        work = self.work
        self.state[:], self.mode[:], work.side[:], work.step[:], work.last_event[:] = saved

    def _integrate(self, stretch: Stretch, ends: tuple[float, ...]) -> None:
        timing, drive = self.model.timing, stretch.drive
        points = len(drive.smooth)
        height, cushion = self._height[:points], self._cushion[:points]
        effective_between(drive.smooth, self.tire.offset, ends[0], height)
        cushion[:] = numpy.linspace(self.seat.offset, ends[1], points)
        status = entries.advance(
            self.model.rig, self.mode, self.state, self.model.scale, self.work, stretch.start, timing.segment_length, height,
            cushion, drive.acceleration_x, drive.acceleration_z, drive.push, timing.sample_every, stretch.behind_sample,
            *stretch.sampled,
        )  # fmt: skip
        if status != DONE:
            raise RunError(f"block {stretch.block}, {stretch.start:.6g} s: {SENTENCES[status]}")

    def _solve(self, stretch: Stretch, solved: list[bool], expected: tuple[float, ...]) -> tuple[float, ...]:
        """Offsets that belong to the fields at the end of the stretch; those ``expected`` where none is solved."""
        tire, seat = expected
        if solved[0]:
            tire = self._solve_tire(stretch.drive, -1, stretch.block)
        if solved[1]:
            seat = self._solve_seat(stretch.block)
        return tire, seat

    def _error(self, found: tuple[float, ...], count: int) -> float:
        """Largest height that a straight offset misses, over the allowed one."""
        rule = self.model.coupling
        if rule is None:
            return 0.0
        pairs = zip(self.supports, found, rule.heights, strict=True)
        return max(support.bend(offset, count) / height for support, offset, height in pairs)

    def _settled(self, ends: tuple[float, ...], found: tuple[float, ...]) -> bool:
        rule = self.model.coupling
        if rule is None:
            return True
        return all(abs(a - b) <= SETTLED * h for a, b, h in zip(ends, found, rule.heights, strict=True))

    def _tread_height(self) -> float:
        """Height in [m] of what touches the road."""
        carcass = self.model.rig.carcass
        return float(self.state[0 if carcass is None else carcass.offset])

    def _solve_tire(self, drive: BlockDrive, point: int, block: int) -> float:
        """Solve the tire's field at the present state; returns the offset that belongs to it, 0 without a field."""
        if self.tire.contact is None:
            return 0.0
        self.tire.place(drive.road, float(drive.travel[point]))
        approach = -self._tread_height()
        return self.tire.solve(approach, float(drive.smooth[point]) + approach, block)

    def _seat_approach(self, cushion: float) -> float:
        """Approach in [m] of the seat over a cushion of height ``cushion`` [m]."""
        rig = self.model.rig
        if rig.seat is None:
            return 0.0
        floor = float(self.state[1]) if rig.tire is not None else 0.0
        return floor + cushion - float(self.state[rig.seat.offset])

    def _solve_seat(self, block: int) -> float:
        """Solve the seat's field at the present state; returns the offset that belongs to it, 0 without a field."""
        approach = self._seat_approach(0.0)
        return self.seat.solve(approach, approach, block)

    def _close(
        self, stretch: Stretch, ends: tuple[float, ...], found: tuple[float, ...], count: int, record: BlockRecord
    ) -> None:
        """Take the fields and their offsets over; the energy that the remaining jump brings in counts as supplied."""
        self.tire.keep()
        tire = 0.0 if self.tire.contact is None else float(self._height[count]) - self._tread_height()
        rule = self.model.coupling
        allowed_heights = (0.0, 0.0) if rule is None else rule.heights
        approaches = (tire, self._seat_approach(float(self._cushion[count])))
        for support, approach, end, offset, allowed in zip(
            self.supports, approaches, ends, found, allowed_heights, strict=True
        ):
            support.take(offset, count, stretch.last or not support.calm, allowed)
            change = offset - end
            if support.contact is None or change == 0.0:
                continue
            law = support.contact.elastic
            self.state[-2] += elastic_energy(law, approach + change) - elastic_energy(law, approach)
            jump = abs(elastic_force(law, approach + change) - elastic_force(law, approach))
            record.field_jump = max(record.field_jump, jump)
