"""The simulation of one scene, block by block: the one implementation behind the offline run and
the simulator node.
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping

import numpy

from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.records.messages import RoadPatch, VibrationBlock
from contact_sim_pkg.records.state import State
from contact_sim_pkg.rigs.vehicle.field.coupling_rule import request_cautions
from contact_sim_pkg.rigs.vehicle.field.driver import FieldRecord
from contact_sim_pkg.rigs.vehicle.model import Model, build
from contact_sim_pkg.rigs.vehicle.motion import columns
from contact_sim_pkg.rigs.vehicle.outputs import BlockRecord, block_outputs
from contact_sim_pkg.rigs.vehicle.run.coupling import Coupling
from contact_sim_pkg.rigs.vehicle.run.coupling_check import KINDS
from contact_sim_pkg.rigs.vehicle.run.drive import ROAD, VIBRATION, BlockDrive, block_drive, rate_at_start
from contact_sim_pkg.rigs.vehicle.seat.biodynamics import ringing_cautions
from contact_sim_pkg.rigs.vehicle.seat.response import RunningResponse
from contact_sim_pkg.rigs.vehicle.seat.schema import SeatSection
from contact_sim_pkg.rigs.vehicle.tire.edges import edge_cautions
from contact_sim_pkg.rigs.vehicle.tire.magic_formula.section import MagicFormulaSection
from contact_sim_pkg.rigs.vehicle.tire.rolling_formula import Followed, RollingFormula, formula_cautions
from contact_sim_pkg.rigs.vehicle.tire.static_stiffness import stiffness_cautions
from contact_sim_pkg.run.block_simulation import BlockResult, refuse_out_of_turn
from contact_sim_pkg.run.outputs import BlockStamps, largest, open_energy
from contact_sim_pkg.run.saved_state import carry_state
from contact_sim_pkg.run.sources import make_travel
from contact_sim_pkg.scene.resolved_scene import ResolvedScene


class Simulation:
    """Owns the state of a run. ``prepare`` once, then ``advance`` block by block, in order
    from 0.
    """

    STATE = State(("_first_block", "_next_block", "_start_energy", "_coupling", "_formula"), ("_response",))

    def __init__(self, scene: ResolvedScene, model: Model | None = None) -> None:
        """Build the parameters of a resolved scene, unless its ``model`` is given."""
        self.scene = scene
        self.model: Model = model or build(scene)
        self.blocks = self.model.timing.blocks
        inputs = [ROAD] if self.model.tire_geometry is not None else []
        if scene.vibration is not None:
            inputs.append(VIBRATION)
        self.inputs = tuple(inputs)
        self._travel = make_travel(scene) if self.model.tire_geometry is not None else None
        self._coupling = Coupling(self.model)
        self._formula = None if self.model.magic_formula is None else RollingFormula(self.model.magic_formula)
        self.cautions = self._cautions()
        self._begin()

    def _cautions(self) -> tuple[str, ...]:
        """See `cautions_of`."""
        grids, occupant = self.model.tire_field, self.model.occupant
        ringing = () if occupant is None else ringing_cautions(occupant, self.scene.outputs.force_rate)
        if self.model.quarter is None:
            return ringing
        standing = self.model.tire_standing
        return (
            *ringing,
            *self._formula_cautions(),
            *(() if standing is None else stiffness_cautions(standing.stiffness, standing.load)),
            *edge_cautions(self.scene, None if grids is None else grids.usual.settings),
            *request_cautions(self.scene, self.model.coupling, grids),
        )

    def _formula_cautions(self) -> Iterator[str]:
        """See `formula_cautions`."""
        parts, keys, standing = (
            self.model.magic_formula, self.scene.effect("tire", MagicFormulaSection), self.model.tire_standing
        )  # fmt: skip
        if parts is not None and keys is not None and standing is not None:
            yield from formula_cautions(parts, standing.load, keys.unused or "")

    def reset(self) -> None:
        """Before the first block."""
        self._begin()
        self._coupling.reset()
        if self._formula is not None:
            self._formula.reset()

    def _begin(self) -> None:
        self._first_block = self._next_block = 0
        self._start_energy: Vector | None = None  # of the run
        self._response = self._new_response()

    def _new_response(self) -> RunningResponse | None:
        """Responses of the seat before the first block; None where the scene calls for none."""
        if self.model.occupant is None:
            return None
        segment = self.scene.section(SeatSection).response_segment
        return RunningResponse(segment, self.scene.outputs.force_rate, self.model.occupant.head) if segment else None

    def prepare(self) -> None:
        """Compile or load every kernel that the scene needs, by one interval on a flat road."""
        timing = self.model.timing
        inputs: dict[str, RoadPatch | VibrationBlock] = {}
        if ROAD in self.inputs:
            inputs[ROAD] = self._flat_patch()
        if VIBRATION in self.inputs:
            count = timing.intervals * timing.segments // timing.vibration_stride + 1
            period = timing.segment_length * timing.vibration_stride
            inputs[VIBRATION] = VibrationBlock(
                block=0, sample_period=period, acceleration_x=numpy.zeros(count), acceleration_z=numpy.zeros(count)
            )
        self.advance(0, inputs)
        self.reset()

    def take_over(self, before: Simulation, block: int, inputs: Mapping[str, RoadPatch | VibrationBlock]) -> None:
        """See `Steerable`: bodies, bristles and memory go on; the fields are solved where they are, by the laws of now."""
        road, vibration = inputs.get(ROAD), inputs.get(VIBRATION)
        drive = block_drive(before.model, before._travel, block, road, vibration)
        then = open_energy(before._coupling.energies(float(drive.smooth[0])))
        self._first_block, self._next_block = before._first_block, before._next_block
        # The smooth height has the weights of another footprint
        drive = block_drive(self.model, self._travel, block, road, vibration)
        self._coupling.take_over(before._coupling, drive, block)
        self._coupling.bodies.supply(then - open_energy(self._coupling.energies(float(drive.smooth[0]))))
        if self._formula is not None and before._formula is not None:
            carry_state(before._formula, self._formula, "the Magic Formula")
        self._start_energy, self._response = before._start_energy, before._response

    def begin_at(self, block: int) -> None:
        """Begin the run with a later block, standing on the road there. After `prepare`."""
        self._first_block = self._next_block = block

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
            block=0,
            travel_start=0.0,
            travel_end=travel.position(length),
            first_row=first,
            cell_x=geometry.lattice.cell_x,
            cell_y=geometry.lattice.cell_y,
            height=height,
        )

    def advance(self, block: int, inputs: dict[str, RoadPatch | VibrationBlock]) -> BlockResult:
        """Advance block number ``block`` with the blocks of every input topic.

        Raises RunError where a block is out of turn, does not fit the scene, or the physics ends in
        a named failure.
        """
        began = time.perf_counter()
        refuse_out_of_turn(block, self._next_block)
        record = BlockRecord.empty(self.model, block)
        drive = block_drive(self.model, self._travel, block, inputs.get(ROAD), inputs.get(VIBRATION))
        coupling = self._coupling
        # The run starts in equilibrium, rising with the road.
        if block == self._first_block:
            time_now = block * self.model.timing.block_length
            coupling.start(drive, rate_at_start(self.model, self._travel, drive.road, float(drive.rate[0]), time_now))
            record.standing = self.model.tire_standing
        coupling.bodies.work.counters[:] = 0.0
        for interval in range(self.model.timing.intervals):
            self._interval(block, interval, drive, record)
        # Cost of the block.
        self._next_block = block + 1
        record.counters[:] = coupling.bodies.work.counters
        for field in coupling.fields:
            record.field_iterations += field.pop_iterations()
        published = (found for _sample, found in (*record.tire_fields, *record.seat_fields))
        record.field_residual = max((found.residual for found in published), default=0.0)
        record.missed = coupling.missed.pop()
        if self.model.edge is not None:
            record.missed[0, KINDS.index("peak")] = numpy.nan
        self._map_seat(record)
        outputs = self._outputs(record, began)
        if self._response is not None:
            outputs += self._response.outputs(BlockStamps(block, self.model.timing), outputs)
        load, peak = largest(outputs, "force", "normal"), largest(outputs, "patch", "peak")
        return BlockResult(outputs, load, peak, time.perf_counter() - began)

    def _outputs(self, record: BlockRecord, began: float) -> list[Output]:
        """Outputs of a block whose computation began at ``began`` [s] of the performance counter."""
        return block_outputs(self.model, record, time.perf_counter() - began)

    def _interval(self, block: int, interval: int, whole: BlockDrive, record: BlockRecord) -> None:
        """One interval between published fields."""
        segments = self.model.timing.segments
        drive = whole.part(interval * segments, segments)
        energy = self._coupling.energies(float(drive.smooth[0]))
        if self._start_energy is None:
            self._start_energy = energy
        fields, shear = self._coupling.copy_published(), self._coupling.shear
        rolled = None if shear is None or fields[0] is None else shear.publish(fields[0].pressure)
        if interval == 0 and shear is not None and shear.has_belt:
            record.works = shear.works()
        self._coupling.advance(block, interval, whole, record)
        followed = self._follow(block * self.model.timing.intervals + interval, drive)
        if followed is not None:
            energy = energy + followed.entries
        accelerations = drive.acceleration_x, drive.acceleration_z
        first = record.store_samples(
            interval, self._coupling.bodies.sampled, energy, self._start_energy, *accelerations
        )
        self._publish(first, fields, record)
        if rolled is not None:
            record.shears.append((first, record.tire_fields[-1][1], rolled))
        if followed is not None:
            record.followed.append((first, followed))

    def _follow(self, interval: int, drive: BlockDrive) -> Followed | None:
        """The Magic Formula over the samples of an interval, counted from the start of the run; None where it does not
        act.
        """
        if self._formula is None:
            return None
        timing, forces = self.model.timing, self._coupling.bodies.sampled[2]
        every, segment = timing.sample_every, timing.segment_length
        first = float(interval * timing.segments)
        times = (first + every * numpy.arange(len(forces), dtype=numpy.float64)) * segment
        speed = numpy.diff(drive.travel)[::every] / segment
        return self._formula.follow(
            times, drive.travel[:-1:every], speed, forces[:, columns.TIRE_NORMAL], forces[:, columns.TIRE_APPROACH],
            forces[:, columns.TIRE_SLOPE], forces[:, columns.TIRE_SHEAR :],
        )  # fmt: skip

    def _publish(self, sample: int, fields: tuple[FieldRecord | None, FieldRecord | None], record: BlockRecord) -> None:
        """Take the elastic fields of an instant with the loss of their contacts."""
        tire, seat = fields
        forces = record.forces[sample]
        if tire is not None:
            approach, rate = float(forces[columns.TIRE_APPROACH]), float(forces[columns.TIRE_RATE])
            record.tire_fields.append((sample, self._coupling.tire.with_loss(tire, approach, rate)))
        if seat is not None:
            approach, rate = float(forces[columns.SEAT_APPROACH]), float(forces[columns.SEAT_RATE])
            record.seat_fields.append((sample, self._coupling.seat.with_loss(seat, approach, rate)))

    def _map_seat(self, record: BlockRecord) -> None:
        """Pressure maps of the seat's force, so many times a block."""
        seat_map, samples = self.model.seat_map, self.model.timing.samples
        if seat_map is None:
            return
        for number in range(seat_map.fields):
            sample = number * samples // seat_map.fields
            force, approach = (float(record.forces[sample, k]) for k in (columns.SEAT_NORMAL, columns.SEAT_APPROACH))
            record.seat_maps.append((sample, seat_map.pressure(approach, force)))
