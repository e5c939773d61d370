"""The simulation of one scene, block by block: the one implementation behind the offline run and the simulator node."""

from __future__ import annotations

import time
from typing import Any

import numpy

from contact_sim_pkg.core.effects.normal_elastic import elastic_energy, elastic_force
from contact_sim_pkg.core.jit import freeze, thaw
from contact_sim_pkg.core.parameters import Vector
from contact_sim_pkg.core.results import DONE, SENTENCES
from contact_sim_pkg.core.rigs import advance as entries
from contact_sim_pkg.core.rigs.vehicle import MARGINS
from contact_sim_pkg.core.solvers.dormand_prince import make_workspace
from contact_sim_pkg.excitation.blocks import RoadPatch, VibrationBlock
from contact_sim_pkg.run.block_drive import ROAD, VIBRATION, BlockDrive, block_drive, effective_between
from contact_sim_pkg.run.block_simulation import BlockResult
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.run.outputs import BlockRecord, encode_block
from contact_sim_pkg.run.rolling_shear import RollingShear
from contact_sim_pkg.run.sources import make_travel
from contact_sim_pkg.run.support import CushionSupport, RoadSupport
from contact_sim_pkg.scene.build import Model, build, standing_state


class Simulation:
    """Owns the state of a run. ``prepare`` once, then ``advance`` block by block, in order from 0."""

    def __init__(self, scene: Any) -> None:
        """Build the parameters of a resolved scene (``scene.data`` is its plain dict)."""
        thaw()
        self.scene = scene
        self.model: Model = build(scene.data)
        self.blocks = self.model.timing.blocks
        inputs = [ROAD] if self.model.tire_geometry is not None else []
        if scene.data.get("vibration"):
            inputs.append(VIBRATION)
        self.inputs = tuple(inputs)
        self._travel = make_travel(scene.data) if self.model.tire_geometry is not None else None
        rig = self.model.rig
        self._tire = RoadSupport(self.model.tire_field, rig.tire_contact, self.model.tire_geometry, self.model.tread)
        self._seat = CushionSupport(self.model.seat_field, rig.seat_contact, self.model.seat_shape)
        friction, field = self.model.rolling_friction, self.model.tire_field
        self._shear = None if friction is None or field is None else RollingShear(friction, field.wide.settings)
        self._next_block = 0
        self._reset()

    def _reset(self) -> None:
        model, timing = self.model, self.model.timing
        self.state: Vector = numpy.zeros(model.states)
        self._mode = numpy.zeros(1, dtype=numpy.int64)
        self._work = make_workspace(model.states, MARGINS)
        points = timing.segments + 1
        samples = timing.segments // timing.sample_every
        self._sampled = (
            numpy.zeros((samples, model.states)),
            numpy.zeros((samples, model.states)),
            numpy.zeros((samples, entries.FORCES)),
        )
        self._height = numpy.zeros(points)
        self._cushion = numpy.zeros(points)
        self._ramp = numpy.linspace(0.0, 1.0, points)
        self._start_energy: Vector | None = None

    def prepare(self) -> None:
        """Compile or load every kernel that the scene needs, by one interval on a flat road; then close compilation."""
        timing = self.model.timing
        inputs: dict[str, RoadPatch | VibrationBlock] = {}
        if ROAD in self.inputs:
            inputs[ROAD] = self._flat_patch()
        if VIBRATION in self.inputs:
            count = timing.intervals * timing.segments // timing.vibration_stride + 1
            period = timing.segment_length * timing.vibration_stride
            inputs[VIBRATION] = VibrationBlock(0, period, numpy.zeros(count), numpy.zeros(count))
        self.advance(0, inputs)
        self._reset()
        self._next_block = 0
        for support in (self._tire, self._seat):
            support.reset()
        if self._shear is not None:
            self._shear.reset()
        freeze()

    def _flat_patch(self) -> RoadPatch:
        geometry, travel = self.model.tire_geometry, self._travel
        assert geometry is not None
        assert travel is not None
        length = self.model.timing.block_length
        low, high = travel.extent(0.0, length)
        first = int(numpy.floor(low / geometry.lattice.cell_x)) - geometry.lattice.road_rows
        rows = int(numpy.ceil((high - low) / geometry.lattice.cell_x)) + 2 * geometry.lattice.road_rows + 2
        height = numpy.zeros((rows, geometry.lattice.road_cols), dtype=numpy.float32)
        return RoadPatch(
            0, 0.0, travel.position(length), first, geometry.lattice.cell_x, geometry.lattice.cell_y, height
        )

    def advance(self, block: int, inputs: dict[str, RoadPatch | VibrationBlock]) -> BlockResult:
        """Advance block number ``block`` with the blocks of every input topic.

        Raises RunError where a block is out of turn, does not fit the scene, or the physics ends in a named failure.
        """
        began = time.perf_counter()
        if block != self._next_block:
            raise RunError(f"block {block} came, block {self._next_block} was due")
        record = BlockRecord.empty(self.model, block)
        drive = block_drive(self.model, self._travel, block, inputs.get(ROAD), inputs.get(VIBRATION))
        if block == 0:
            self._start(drive)
        self._work.counters[:] = 0.0
        for interval in range(self.model.timing.intervals):
            self._interval(block, interval, drive, record)
        self._next_block = block + 1
        record.counters[:] = self._work.counters
        for support in (self._tire, self._seat):
            iterations, residual = support.take_cost()
            record.field_iterations += iterations
            record.field_residual = max(record.field_residual, residual)
        wall = time.perf_counter() - began
        messages, load, peak = encode_block(self.model, record, self._shear, wall)
        return BlockResult(messages, load, peak, time.perf_counter() - began)

    def _start(self, drive: BlockDrive) -> None:
        """Let the rig stand in balance on the road at the start, with the fields that belong to it."""
        smooth, first = drive.smooth, drive.part(0, 1)
        self.state[:] = standing_state(self.model, float(smooth[0]))
        if self._tire.grids is not None:
            self._stand_on_road(drive.road, float(drive.travel[0]))
        self._tire.offset = self._solve_tire(drive.road, float(drive.travel[0]), float(smooth[0]))
        self._seat.offset = self._solve_seat()
        height = first.smooth + self._tire.offset
        cushion = numpy.full(2, self._seat.offset)
        length = self.model.timing.segment_length
        entries.start(
            self.model.rig, self._mode, self.state, self._work, length, height, cushion, first.acceleration_x,
            first.acceleration_z, first.push,
        )  # fmt: skip

    def _stand_on_road(self, road: Any, travel: float) -> None:
        """Shift the rig up or down so that the tire's field carries its weight on the road at the start."""
        self._tire.place(road, travel)
        rig = self.model.rig
        assert rig.tire is not None
        mass = rig.tire.wheel_mass + rig.tire.body_mass
        if rig.carcass is not None:
            mass += rig.carcass.belt_mass
        if rig.seat is not None:
            mass += rig.seat.frame_mass + float(rig.seat.masses.sum())
        shift = -self._tire.stand(mass * rig.gravity) - self._tread()[0]
        vertical = [0, 1] if rig.carcass is None else [0, 1, rig.carcass.offset]
        if rig.seat is not None:
            vertical += range(rig.seat.offset, rig.seat.offset + 1 + len(rig.seat.masses))
        self.state[vertical] += shift

    def _interval(self, block: int, interval: int, whole: BlockDrive, record: BlockRecord) -> None:
        """One interval between field instants: predict, solve the fields at its end, correct."""
        model, timing = self.model, self.model.timing
        first = interval * timing.segments
        drive = whole.part(first, timing.segments)
        start = (block * timing.intervals * timing.segments + first) * timing.segment_length
        work = self._work
        saved = (self.state.copy(), self._mode.copy(), work.side.copy(), work.step.copy(), work.last_event.copy())
        tire_end, seat_end = (support.offset + support.change for support in (self._tire, self._seat))
        tire_next, seat_next = tire_end, seat_end
        fields = (self._tire.copy_published(), self._seat.copy_published())
        for passes_left in range(model.corrector_passes, -1, -1):
            if passes_left < model.corrector_passes:
                self.state[:], self._mode[:], work.side[:], work.step[:], work.last_event[:] = saved
            self._height[:] = effective_between(drive.smooth, self._tire.offset, tire_end)
            self._cushion[:] = self._seat.offset + (seat_end - self._seat.offset) * self._ramp
            if passes_left == model.corrector_passes:
                start_energy = self._energies()
            status = entries.advance(
                model.rig, self._mode, self.state, model.scale, self._work, start, timing.segment_length, self._height,
                self._cushion, drive.acceleration_x, drive.acceleration_z, drive.push, timing.sample_every, *self._sampled,
            )  # fmt: skip
            if status != DONE:
                raise RunError(f"block {block}, {start:.6g} s: {SENTENCES[status]}")
            if self._tire.solves_in(passes_left):
                tire_next = self._solve_tire(drive.road, float(drive.travel[-1]), float(drive.smooth[-1]), block)
            if self._seat.solves_in(passes_left):
                seat_next = self._solve_seat(block)
            if passes_left:
                tire_end, seat_end = tire_next, seat_next
        accelerations = drive.acceleration_x, drive.acceleration_z
        record.take(interval, self._sampled, start_energy, self._start_energy, *accelerations, fields)
        if self._tire.grids is not None or self._seat.grids is not None:
            self._close_interval(tire_end, tire_next, seat_end, seat_next, record)

    def _energies(self) -> Vector:
        values = numpy.array(
            entries.energies(self.model.rig, self._mode, self.state, float(self._height[0]), float(self._cushion[0]))
        )
        if self._start_energy is None:
            self._start_energy = values
        return values

    def _approaches(self, tire_height: float, cushion: float) -> tuple[float, float]:
        """Approaches of tire and seat at the present state for given heights in [m]."""
        rig = self.model.rig
        floor = self.state[1] if rig.tire is not None else 0.0
        tire = tire_height - self._tread()[0] if rig.tire is not None else 0.0
        seat = floor + cushion - self.state[rig.seat.offset] if rig.seat is not None else 0.0
        return float(tire), float(seat)

    def _tread(self) -> tuple[float, float]:
        """Height in [m] and velocity in [m/s] of what touches the road."""
        carcass = self.model.rig.carcass
        height, velocity = (0, 2) if carcass is None else (carcass.offset, carcass.offset + 1)
        return float(self.state[height]), float(self.state[velocity])

    def _solve_tire(self, road: Any, travel: float, smooth: float, block: int = 0) -> float:
        """Solve the tire's field at the present state; returns the offset that belongs to it, 0 without a field."""
        self._tire.place(road, travel)
        approach = -self._tread()[0]
        return self._tire.solve(approach, smooth + approach, block)

    def _solve_seat(self, block: int = 0) -> float:
        """Solve the seat's field at the present state; returns the offset that belongs to it, 0 without a field."""
        approach = self._approaches(0.0, 0.0)[1]
        return self._seat.solve(approach, approach, block)

    def _close_interval(
        self, tire_end: float, tire_next: float, seat_end: float, seat_next: float, record: BlockRecord
    ) -> None:
        """Take the fields and their offsets over; the energy that the remaining jump brings in counts as supplied."""
        rig = self.model.rig
        self._tire.keep()
        tire, seat = self._approaches(float(self._height[-1]), float(self._cushion[-1]))
        for contact, approach, change in (
            (rig.tire_contact, tire, tire_next - tire_end),
            (rig.seat_contact, seat, seat_next - seat_end),
        ):
            if contact is None or change == 0.0:
                continue
            law = contact.elastic
            self.state[-2] += elastic_energy(law, approach + change) - elastic_energy(law, approach)
            jump = abs(elastic_force(law, approach + change) - elastic_force(law, approach))
            record.field_jump = max(record.field_jump, jump)
        for support, offset in ((self._tire, tire_next), (self._seat, seat_next)):
            support.change = offset - support.offset
            support.offset = offset
