"""The simulation of a backrest scene, block by block."""

from __future__ import annotations

import time
from collections.abc import Mapping

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.results import DONE, SENTENCES
from contact_sim_pkg.integrate.dormand_prince import make_workspace
from contact_sim_pkg.pressure.mat import spread_force
from contact_sim_pkg.records.messages import VibrationBlock
from contact_sim_pkg.records.state import State
from contact_sim_pkg.rigs.backrest import entries
from contact_sim_pkg.rigs.backrest.model import build_backrest
from contact_sim_pkg.rigs.backrest.motion import event_count
from contact_sim_pkg.rigs.backrest.outputs import BackrestRecord, block_outputs
from contact_sim_pkg.rigs.backrest.parameters import ENDED, MOST_EPISODES, BackrestSamples, Shaking, make_mode
from contact_sim_pkg.run.block_simulation import BlockResult, InputBlock, refuse_out_of_turn
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.run.outputs import largest, open_energy
from contact_sim_pkg.run.saved_state import carry_state
from contact_sim_pkg.run.vibration_drive import VIBRATION, accelerations
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

Array = NDArray[numpy.float64]


class BackrestSimulation:
    """Owns the state of a run: a ``BlockSimulation`` (run/block_simulation.py)."""

    inputs: tuple[str, ...] = (VIBRATION,)
    STATE = State(
        ("state", "_mode", "_peak_force", "_next_block"),
        ("_work.event_direction", "_work.step", "_work.last_event"),
        ("_mode",),
    )

    def __init__(self, scene: ResolvedScene) -> None:
        """Build the parameters of a resolved scene; the back rests under its preload."""
        self.scene = scene
        self.model = build_backrest(scene)
        self.blocks = self.model.timing.blocks
        self.reset()

    def reset(self) -> None:
        """Before the first block."""
        states, points = len(self.model.start), len(self.model.rig.gaps)
        self.state: Vector = self.model.start.copy()
        self._mode = make_mode(points)
        self._work = make_workspace(states, event_count(points))
        self._peak_force = numpy.zeros(points + 1)
        self._next_block = 0
        entries.start(self.model.rig, self._mode, self.state, self._work)
        self._start_energy = self._energies(0.0)

    def prepare(self) -> None:
        """Compile or load every kernel that the scene needs, by one block at rest."""
        timing = self.model.timing
        samples = timing.intervals * timing.segments // timing.vibration_stride + 1
        still = numpy.zeros(samples)
        period = timing.segment_length * timing.vibration_stride
        self.advance(
            0, {VIBRATION: VibrationBlock(block=0, sample_period=period, acceleration_x=still, acceleration_z=still)}
        )
        self.reset()

    def take_over(self, before: BackrestSimulation, block: int, inputs: Mapping[str, InputBlock]) -> None:
        """See `Steerable`."""
        now = block * self.model.timing.block_length
        carry_state(before, self, "the backrest")
        self._work.event_direction[:], self._work.step[:] = before._work.event_direction, before._work.step
        self._work.last_event[:], self._start_energy = before._work.last_event, before._start_energy
        self.state[-2] += open_energy(before._energies(now)) - open_energy(self._energies(now))

    def advance(self, block: int, inputs: dict[str, InputBlock]) -> BlockResult:
        """Advance block number ``block``; see ``BlockSimulation``."""
        began = time.perf_counter()
        refuse_out_of_turn(block, self._next_block)
        model, timing = self.model, self.model.timing
        forward, _upward = accelerations(timing, block, inputs.get(VIBRATION))
        start = block * timing.block_length
        record = BackrestRecord.empty(model, block, forward[: -1 : timing.sample_every])
        # Energies at the start of the block; the ledger counts from them.
        record.energy[:] = self._energies(start)
        record.start_energy[:] = self._start_energy
        self._work.counters[:] = 0.0
        self._mode.counts[ENDED] = 0
        shaking = Shaking(start, timing.segment_length, forward)
        samples = BackrestSamples(timing.sample_every, record.states, record.rates, record.forces, record.points)
        status = entries.advance(model.rig, self._mode, self.state, model.scale, self._work, shaking, samples)
        if status != DONE:
            raise RunError(f"block {block}, {start:.6g} s: {SENTENCES[status]}")
        # More episodes than the buffers hold cannot be reported.
        ended = int(self._mode.counts[ENDED])
        if ended > MOST_EPISODES:
            raise RunError(f"block {block}, {start:.6g} s: {ended} contact episodes ended in it, limit {MOST_EPISODES}")
        record.counters[:] = self._work.counters
        record.store_episodes(model, self._mode, self._peak_force)
        # Outputs of the block.
        self._next_block = block + 1
        record.maps = [(sample, self._pressure(record, sample)) for sample in self._field_samples()]
        outputs = block_outputs(model, record, time.perf_counter() - began)
        load, peak = largest(outputs, "force", "normal"), largest(outputs, "patch", "peak")
        return BlockResult(outputs, load, peak, time.perf_counter() - began)

    def _field_samples(self) -> list[int]:
        """Samples of a block at which its pressure map is given."""
        timing = self.model.timing
        return [interval * timing.segments // timing.sample_every for interval in range(timing.intervals)]

    def _pressure(self, record: BackrestRecord, sample: int) -> Array:
        """Pressure on the cells of the mat [rows, cols] [Pa]: that of its points, of a
        cushion, or the force of the one contact spread.
        """
        mat, model = self.model.mat, self.model
        if mat.by_points:
            normal = record.points[sample, :, entries.POINT_NORMAL]
            return numpy.ascontiguousarray(normal.reshape(mat.gap.shape)) / (mat.cell_x * mat.cell_y)
        force, approach = (float(record.forces[sample, k]) for k in (entries.NORMAL, entries.APPROACH))
        if model.cushion is not None:
            return model.cushion.pressure(approach, force)
        gap = mat.gap
        if mat.bent is not None:  # the approach is that of the nearest point: over it the gap is none
            gap = gap - (mat.bent @ record.states[sample, : len(model.rig.mass)]).reshape(gap.shape) + approach
        return spread_force(force, approach, model.rig.contact.elastic, gap, mat.cell_x * mat.cell_y)

    def _energies(self, at: float) -> Vector:
        return numpy.array(entries.energies(self.model.rig, self._mode, at, self.state))
