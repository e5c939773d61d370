"""The bodies of a vehicle rig in a run: their state, and how it moves between given heights of road
and cushion.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Modes, Vector
from contact_sim_pkg.compiled.held import hold
from contact_sim_pkg.compiled.results import DONE, SENTENCES
from contact_sim_pkg.integrate.dormand_prince import make_workspace
from contact_sim_pkg.laws.elastic_law import elastic_force
from contact_sim_pkg.records.state import State
from contact_sim_pkg.rigs.vehicle.model import Model, standing_state
from contact_sim_pkg.rigs.vehicle.motion import entries
from contact_sim_pkg.rigs.vehicle.motion.columns import FORCES
from contact_sim_pkg.rigs.vehicle.motion.ends import base_of
from contact_sim_pkg.rigs.vehicle.motion.vehicle import event_count
from contact_sim_pkg.rigs.vehicle.run.drive import BlockDrive
from contact_sim_pkg.run.errors import RunError

Sampled = tuple[Vector, Vector, Vector]  # states, rates, forces; [samples, ...] each
Corrections = tuple[float, float]  # [m] of tire and seat
LINEAR: Corrections = (0.0, 0.0)
"""Bends of corrections that are linear in time."""


class CouplingStep(NamedTuple):
    """A row of segments from one solution of the fields to the next."""

    block: int
    start: float  # [s]
    segment_length: float  # [s]
    drive: BlockDrive
    last: bool  # of its interval: its fields are published
    row: int  # of the next sample
    behind_sample: int  # segments since the last sample
    segments: int

    @property
    def duration(self) -> float:
        """In [s]."""
        return self.segments * self.segment_length

    @property
    def speed(self) -> float:
        """Mean one of the wheel, forward [m/s]."""
        return float(self.drive.travel[-1] - self.drive.travel[0]) / self.duration


class Saved(NamedTuple):
    """Everything that a coupling step changes."""

    state: Vector
    mode: Modes
    side: Vector
    step: Vector
    last_event: Vector


class Bodies:
    """State of the bodies of ``model``; heights are smooth heights and what the fields add
    to them.
    """

    STATE = State(("state", "mode"), ("work.event_direction", "work.step", "work.last_event"))

    def __init__(self, model: Model) -> None:
        """Make the buffers."""
        seat, self.model = model.rig.seat, model
        # States: height of what touches the road, and of who sits
        self._tread = None if model.quarter is None else model.quarter.tread.place
        self._seated = None if seat is None else seat.offset
        self._base = None if seat is None else base_of(seat.floor)
        self.reset()

    def reset(self) -> None:
        """The state before a start."""
        model, timing = self.model, self.model.timing
        self.state: Vector = numpy.zeros(model.states)
        self.mode: Modes = numpy.zeros(1 + model.acting.modes, dtype=numpy.int64)
        self.work = make_workspace(model.states, event_count(model.rig))
        points, samples = timing.segments + 1, timing.segments // timing.sample_every
        self.sampled: Sampled = (
            numpy.zeros((samples, model.states)), numpy.zeros((samples, model.states)), numpy.zeros((samples, FORCES))
        )  # fmt: skip
        height, height_rate, cushion, cushion_rate, level = numpy.zeros((5, points))
        self._moving = hold(
            entries.Moving(
                model.rig, self.mode, self.state, model.scale, self.work, height, height_rate, cushion, cushion_rate, level,
                *self.sampled,
            )
        )  # fmt: skip

    def stand(self, smooth: float, rate: float) -> None:
        """Set the rig in equilibrium on a road of height ``smooth`` [m] that rises at a ``rate`` [m/s], by
        its contact laws.
        """
        self.state[:] = standing_state(self.model, smooth, rate)

    def lift(self, height: float) -> None:
        """Move the whole rig up by ``height`` [m]."""
        self.state[[each.place for each in self.model.coordinates if each.is_vertical]] += height

    def weight(self, height: float) -> float:
        """Load [N] of the tire at rest, of an axle at a deflection that over a road of effective ``height`` [m]."""
        rig, machine, quarter = self.model.rig, self.model.machine, self.model.quarter
        if machine is not None and quarter is not None:
            if machine.deflection is None:
                return machine.start
            return float(elastic_force(quarter.contact.law.elastic, max(self.tire_approach(height), 0.0)))
        mass = sum(each.mass for each in rig.masses) + (0.0 if rig.seat is None else float(rig.seat.masses.sum()))
        return mass * rig.gravity

    def start(self, first: BlockDrive, corrections: Corrections) -> None:
        """Set the event directions at the start of a run, whose first segment is ``first``."""
        entries.start(
            self.model.rig, self.mode, self.state, self.work, self.model.timing.segment_length, first.smooth + corrections[0],
            numpy.full(2, corrections[1]), first.acceleration_x, first.acceleration_z, first.push,
            (first.rate, numpy.zeros(2)),
        )  # fmt: skip

    def save(self) -> Saved:
        """Copies of everything that a coupling step changes."""
        work = self.work
        return Saved(
            self.state.copy(), self.mode.copy(), work.event_direction.copy(), work.step.copy(), work.last_event.copy()
        )  # fmt: skip

    def restore(self, saved: Saved) -> None:
        """Go back to what was saved."""
        work = self.work
        self.state[:], self.mode[:], work.event_direction[:], work.step[:], work.last_event[:] = saved

    def move(
        self, step: CouplingStep, starts: Corrections, ends: Corrections, bends: Corrections = LINEAR, part: int = 0
    ) -> None:
        """Move over a coupling step, or over its first ``part`` segments, with corrections from
        ``starts`` to ``ends`` [m] that lie a quarter of ``bends`` [m] below straight lines in the
        middle.

        Raises RunError where the physics fails.
        """
        drive = step.drive
        course = entries.Course(
            step.start, step.segment_length, part or step.segments, self.model.timing.sample_every, step.behind_sample, step.row
        )  # fmt: skip
        status = entries.move(
            self._moving, course, drive.smooth, drive.rate, drive.acceleration_x, drive.acceleration_z, drive.push,
            (starts[0], ends[0], bends[0]), (starts[1], ends[1], bends[1]),
        )  # fmt: skip
        if status != DONE:
            raise RunError(f"block {step.block}, {step.start:.6g} s: {SENTENCES[status]}")

    def laid(self, point: int) -> Corrections:
        """Heights [m] of road and cushion at the end of segment ``point`` of the last coupling step, as
        the bodies were moved on them.
        """
        return float(self._moving.value.height[point]), float(self._moving.value.cushion[point])

    def energies(self, height: float, cushion: float) -> Vector:
        """Energies in [J] of the state over given heights in [m] (order of
        ``rigs/vehicle/motion/entries.energies``).
        """
        return numpy.array(entries.energies_of(self._moving, height, cushion))

    def supply(self, energy: float) -> None:
        """Count ``energy`` [J] as brought in from outside."""
        self.state[-2] += energy

    def tire_approach(self, height: float) -> float:
        """Approach in [m] of tire or belt to a road of ``height`` [m]; 0 without a tire."""
        return 0.0 if self._tread is None else height - self.state.item(self._tread)

    def tread_rate(self) -> float:
        """Vertical speed [m/s] of tire or belt; 0 without a tire."""
        return 0.0 if self._tread is None else self.state.item(self._tread + 1)

    def axle_deflection(self, approach: float) -> float:
        """Deflection [m] of the axle at an ``approach`` [m] of tire or belt."""
        sidewalls = None if self.model.quarter is None else self.model.quarter.sidewalls
        if sidewalls is None:
            return approach
        return approach + (self.state.item(sidewalls.first) - self.state.item(sidewalls.second))

    def seat_approach(self, cushion: float) -> float:
        """Approach in [m] of the occupant to a cushion of height ``cushion`` [m]; 0 without
        a seat.
        """
        if self._seated is None:
            return 0.0
        return (0.0 if self._base is None else self.state.item(self._base)) + cushion - self.state.item(self._seated)
