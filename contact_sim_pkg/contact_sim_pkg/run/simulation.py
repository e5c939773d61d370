"""The simulation of one scene, block by block: the one implementation behind the offline run and the simulator node."""

from __future__ import annotations

import time
from typing import Any, NamedTuple

import numpy

from contact_sim_pkg.core.effects.footprint import effective_heights
from contact_sim_pkg.core.effects.normal_elastic import elastic_energy, elastic_force
from contact_sim_pkg.core.jit import freeze, thaw
from contact_sim_pkg.core.parameters import Vector
from contact_sim_pkg.core.results import DONE, SENTENCES
from contact_sim_pkg.core.rigs import advance as entries
from contact_sim_pkg.core.rigs.vehicle import MARGINS
from contact_sim_pkg.core.solvers.dormand_prince import make_workspace
from contact_sim_pkg.excitation.blocks import RoadPatch, VibrationBlock
from contact_sim_pkg.run.asperity_push import asperity_push
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.run.outputs import BlockRecord, encode_block
from contact_sim_pkg.run.rolling_shear import RollingShear
from contact_sim_pkg.run.sources import make_travel
from contact_sim_pkg.run.support import CushionSupport, RoadSupport
from contact_sim_pkg.scene.build import Model, build, standing_state

ROAD, VIBRATION = "road/patch", "platform/vibration"


class BlockResult(NamedTuple):
    """What one block gives."""

    messages: list[tuple[str, int, bytes]]  # topic, stamp [ns], CDR; in canonical order
    load: float  # [N] largest normal force
    peak_pressure: float  # [Pa]; 0 where no field is computed
    wall_time: float  # [s]


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
        road = inputs.get(ROAD)
        vibration = inputs.get(VIBRATION)
        record = BlockRecord.empty(self.model, block)
        a_x, a_z = self._accelerations(block, vibration)
        travel, smooth = self._smooth_road(block, road)
        push = self._push(road, travel)
        if block == 0:
            self._start(road, travel, smooth, a_x, a_z, push)
        self._work.counters[:] = 0.0
        for interval in range(self.model.timing.intervals):
            self._interval(block, interval, road, travel, smooth, a_x, a_z, push, record)
        self._next_block = block + 1
        record.counters[:] = self._work.counters
        for support in (self._tire, self._seat):
            iterations, residual = support.take_cost()
            record.field_iterations += iterations
            record.field_residual = max(record.field_residual, residual)
        wall = time.perf_counter() - began
        messages, load, peak = encode_block(self.model, record, self._shear, wall)
        return BlockResult(messages, load, peak, time.perf_counter() - began)

    def _accelerations(self, block: int, vibration: Any) -> tuple[Vector, Vector]:
        """Floor accelerations at every segment's end, straight between the samples."""
        timing = self.model.timing
        points = timing.intervals * timing.segments + 1
        if VIBRATION not in self.inputs:
            zeros = numpy.zeros(points)
            return zeros, zeros
        samples = (points - 1) // timing.vibration_stride + 1
        if vibration is None or vibration.block != block or len(vibration.acceleration_z) != samples:
            found = (
                "none" if vibration is None else f"block {vibration.block} with {len(vibration.acceleration_z)} samples"
            )
            raise RunError(f"{VIBRATION}: block {block} with {samples} samples was due, {found} came")
        position = numpy.arange(points) / timing.vibration_stride
        index = numpy.arange(samples)
        return (
            numpy.interp(position, index, vibration.acceleration_x),
            numpy.interp(position, index, vibration.acceleration_z),
        )

    def _smooth_road(self, block: int, road: Any) -> tuple[Vector, Vector]:
        """Travel of the wheel and the height that a smooth tire sees, at every segment's end."""
        timing, geometry = self.model.timing, self.model.tire_geometry
        points = timing.intervals * timing.segments + 1
        if geometry is None or self._travel is None:
            zeros = numpy.zeros(points)
            return zeros, zeros
        if road is None or road.block != block:
            raise RunError(f"{ROAD}: block {block} was due, {'none' if road is None else f'block {road.block}'} came")
        if (
            road.height.shape[1] != geometry.lattice.road_cols
            or abs(road.cell_x / geometry.lattice.cell_x - 1.0) > 1e-12
        ):
            raise RunError(
                f"{ROAD}: block {block} has {road.height.shape[1]} columns and cells of {road.cell_x} m, the scene needs "
                f"{geometry.lattice.road_cols} columns and cells of {geometry.lattice.cell_x} m"
            )
        steps = timing.intervals * timing.segments
        travel = numpy.array(
            [self._travel.position((block * steps + i) * timing.segment_length) for i in range(points)]
        )
        smooth = numpy.empty(points)
        inside = effective_heights(
            road.height, road.first_row, geometry.lattice.cell_x, geometry.lattice.cell_y, geometry.semi_axis_x,
            geometry.semi_axis_y, travel, smooth,
        )  # fmt: skip
        if not inside:
            raise RunError(
                f"{ROAD}: block {block} does not reach over the footprint from {travel[0]:.6g} to {travel[-1]:.6g} m"
            )
        return travel, smooth

    def _push(self, road: Any, travel: Vector) -> Vector | None:
        """Impulses of the road's asperities in [N] at every segment's end; None where the scene calls for none."""
        model = self.model
        if model.asperities is None or model.tire_geometry is None:
            return None
        return asperity_push(model.asperities, model.tire_geometry, road, travel)

    def _start(self, road: Any, travel: Vector, smooth: Vector, a_x: Vector, a_z: Vector, push: Vector | None) -> None:
        """Let the rig stand in balance on the road at the start, with the fields that belong to it."""
        self.state[:] = standing_state(self.model, float(smooth[0]))
        if self._tire.grids is not None:
            self._stand_on_road(road, float(travel[0]))
        self._tire.offset = self._solve_tire(road, float(travel[0]), float(smooth[0]))
        self._seat.offset = self._solve_seat()
        height = numpy.array([smooth[0] + self._tire.offset, smooth[1] + self._tire.offset])
        cushion = numpy.full(2, self._seat.offset)
        length = self.model.timing.segment_length
        entries.start(
            self.model.rig, self._mode, self.state, self._work, length, height, cushion, a_x[:2], a_z[:2],
            None if push is None else push[:2],
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

    def _interval(
        self,
        block: int,
        interval: int,
        road: Any,
        travel: Vector,
        smooth: Vector,
        a_x: Vector,
        a_z: Vector,
        push: Vector | None,
        record: BlockRecord,
    ) -> None:
        """One interval between field instants: predict, solve the fields at its end, correct."""
        model, timing = self.model, self.model.timing
        first = interval * timing.segments
        part = slice(first, first + timing.segments + 1)
        start = (block * timing.intervals * timing.segments + first) * timing.segment_length
        work = self._work
        saved = (self.state.copy(), self._mode.copy(), work.side.copy(), work.step.copy(), work.last_event.copy())
        tire_end, seat_end = (support.offset + support.change for support in (self._tire, self._seat))
        tire_next, seat_next = tire_end, seat_end
        fields = (self._tire.copy_published(), self._seat.copy_published())
        for passes_left in range(model.corrector_passes, -1, -1):
            if passes_left < model.corrector_passes:
                self.state[:], self._mode[:], work.side[:], work.step[:], work.last_event[:] = saved
            self._height[:] = smooth[part] + self._tire.offset + (tire_end - self._tire.offset) * self._ramp
            self._cushion[:] = self._seat.offset + (seat_end - self._seat.offset) * self._ramp
            if passes_left == model.corrector_passes:
                start_energy = self._energies()
            status = entries.advance(
                model.rig, self._mode, self.state, model.scale, self._work, start, timing.segment_length, self._height,
                self._cushion, a_x[part], a_z[part], None if push is None else push[part], timing.sample_every,
                *self._sampled,
            )  # fmt: skip
            if status != DONE:
                raise RunError(f"block {block}, {start:.6g} s: {SENTENCES[status]}")
            if self._tire.solves_in(passes_left):
                tire_next = self._solve_tire(road, float(travel[part][-1]), float(smooth[part][-1]), block)
            if self._seat.solves_in(passes_left):
                seat_next = self._solve_seat(block)
            if passes_left:
                tire_end, seat_end = tire_next, seat_next
        record.take(interval, self._sampled, start_energy, self._start_energy, a_x[part], a_z[part], fields)
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
