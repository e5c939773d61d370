"""The simulation of a roller on a shaft, block by block."""

from __future__ import annotations

import contextlib
import time

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.records.messages import RollerStability
from contact_sim_pkg.records.state import State
from contact_sim_pkg.rigs.roller.block_motion import Matrix, TiltYaw
from contact_sim_pkg.rigs.roller.energy import Energies
from contact_sim_pkg.rigs.roller.forecast import forecast
from contact_sim_pkg.rigs.roller.model import build_roller, refused
from contact_sim_pkg.rigs.roller.outputs import RollerMeasurement, RollerRecord, block_outputs
from contact_sim_pkg.rigs.roller.ride import Ridden, TrackRide, joined
from contact_sim_pkg.rigs.roller.settings import volume_settings
from contact_sim_pkg.rigs.roller.theory.ellipse import RollingContact, rolling_contacts
from contact_sim_pkg.rigs.roller.theory.motion import accelerations
from contact_sim_pkg.rigs.roller.theory.volumes import box_volume, dangerous_volumes
from contact_sim_pkg.run.block_simulation import BlockResult, InputBlock, refuse_out_of_turn
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.run.outputs import largest
from contact_sim_pkg.run.sources import make_surface
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

MOST_TRACKS = 200
"""Heights of the track that a run records, about: one at every so many blocks, and one at its end.
"""

ROAD_CELL = 1e-3
"""[m]: a road's texture holds waves down to two of them."""


class RollerSimulation:
    """Owns the state of a run: a ``BlockSimulation`` (run/block_simulation.py). Only the shaft
    drives it.
    """

    inputs: tuple[str, ...] = ()
    STATE = State(("_ride", "_angles", "_next_block"))

    def __init__(self, scene: ResolvedScene) -> None:
        """Build the model of a resolved scene."""
        self.scene = scene
        self.model = build_roller(scene)
        self.blocks = self.model.timing.blocks
        road = make_surface(scene, ROAD_CELL) if scene.road is not None else None
        self._first = None if self.model.track_waves is None else TrackRide(self.model, road)
        self.reset()
        self._refuse_too_fast()

    def _refuse_too_fast(self) -> None:
        """SceneError for a motion at the start that no step resolves."""
        timing = self.model.timing
        samples = self._ride.cells / self._ride.interval_time if self._ride else timing.samples / timing.block_length
        try:
            if self._ride is not None:
                self._ride.refuse_fast_heave()
            if self._angles is not None:
                self._angles.parts(0.0, 1.0 / samples)
        except RunError as error:
            raise refused(str(error)) from None

    def reset(self) -> None:
        """Before the first block."""
        model = self.model
        self._next_block = 0
        self._ride = None if self._first is None else self._first.copy()
        first = model.contact_load(float(model.programme.load[0]), model.programme.curvatures_at(0.0))
        self._angles = TiltYaw(model, first) if model.turns else None

    def prepare(self) -> None:
        """Compile or load every kernel that the scene needs, by a block."""
        with contextlib.suppress(RunError):  # the run itself reports it
            self._advance(0)
        if self.model.subsurface is not None:
            self._volumes(
                0.0, self.model.contact(1.0, self.model.held_yaw, self.model.programme.curvatures_at(0.0)), (2, 2, 2)
            )
        self.reset()

    def advance(self, block: int, inputs: dict[str, InputBlock]) -> BlockResult:
        """Advance block number ``block``; see ``BlockSimulation``."""
        began = time.perf_counter()
        refuse_out_of_turn(block, self._next_block)
        record = self._advance(block)
        self._next_block = block + 1
        record.stability = self._forecast(block)
        record.volumes = self._measured(block, record)
        if self._ride is not None and self._track_due(block):
            record.track = self._ride
            record.checked = self._ride.check() if self._check_due(block) else None
        outputs = block_outputs(self.model, record, time.perf_counter() - began)
        load, peak = largest(outputs, "force", "normal"), largest(outputs, "contact", "peak_pressure")
        return BlockResult(outputs, load, peak, time.perf_counter() - began)

    def _advance(self, block: int) -> RollerRecord:
        model, timing = self.model, self.model.timing
        start, samples = block * timing.block_length, timing.samples
        times: Vector = numpy.arange(samples + 1, dtype=numpy.float64) * (timing.block_length / samples)
        energy = self._energy()
        # Loads, heave and angles of a load pressed on, or of the ride.
        if self._ride is None:
            loads = self._pressed(start, times)
            heave: Matrix = numpy.zeros((2, len(times)))
            angles = self._fixed_angles(times) if self._angles is None else self._angles.advance(start, times, loads)
            steps = samples
        else:
            ridden, turned = self._rolled(start)
            loads = numpy.interp(times, ridden.time, ridden.load)
            heave = numpy.stack([numpy.interp(times, ridden.time, values) for values in (ridden.heave, ridden.speed)])
            angles = numpy.stack([numpy.interp(times, ridden.time, column) for column in turned.T], axis=1)
            steps = len(ridden.time) - 1
        # Contacts of the rollers at each sample.
        curvatures, contacts = model.programme.curvatures_over(start + times[:-1]), numpy.zeros((samples, 6))
        angles = numpy.ascontiguousarray(angles[:-1])
        rolling_contacts(curvatures, angles[:, 1].copy(), model.modulus, loads[:-1], model.kind, contacts)
        return RollerRecord(
            block=block,
            period=timing.block_length / samples,
            load=loads[:-1],
            heave=heave[:, :-1],
            angles=angles,
            acceleration=self._acceleration(start + times[:-1], curvatures, loads[:-1], angles, heave[1, :-1]),
            contacts=contacts,
            steps=steps,
            energy=energy,
        )

    def _energy(self) -> Energies:
        parts = [part.energies() for part in (self._ride, self._angles) if part is not None]
        return parts[0].plus(parts[1]) if len(parts) > 1 else parts[0] if parts else Energies()

    def _pressed(self, start: float, times: Vector) -> Vector:
        """Loads [times] on the contact at rest."""
        programme = self.model.programme
        pressed = programme.loads(start + times)
        if not self.model.shares_load:
            return pressed
        return numpy.array([
            self.model.contact_load(float(load), programme.curvatures_at(start + float(time)))
            for load, time in zip(pressed, times, strict=True)
        ])  # fmt: skip

    def _fixed_angles(self, times: Vector) -> Matrix:
        """Angles [times, 4] that do not move."""
        fixed = numpy.zeros((len(times), 4))
        fixed[:, :2] = self.model.start
        return fixed

    def _rolled(self, start: float) -> tuple[Ridden, Matrix]:
        """All intervals of a block, and tilt, yaw and their rates, [places, 4]; the load is
        constant over an interval.
        """
        ride = self._ride
        assert ride is not None
        parts, angles = [], []
        for number in range(ride.intervals_a_block):
            # The yaw at the start of the interval sets its contact.
            yaw = self.model.start[1] if self._angles is None else float(self._angles.state[1])
            at = number * ride.interval_time
            ride.press(float(self.model.programme.loads(numpy.array([start + at]))[0]), yaw)
            part = ride.advance()
            moved = (
                self._fixed_angles(part.time)
                if self._angles is None
                else self._angles.advance(start + at, part.time, part.load)
            )
            parts.append(part._replace(time=part.time + at))
            angles.append(moved)
        if self._angles is not None:
            # The axial wave of the last interval: a tilted roller touches R sin(tilt) further along the shaft.
            for track in ride.tracks:
                track.shift(self.model.roller.radius * numpy.sin(angles[-1][:-1, 0]))
        return joined(parts), numpy.vstack([angles[0], *(each[1:] for each in angles[1:])])

    def _acceleration(self, times: Vector, curvatures: Matrix, loads: Vector, angles: Matrix, speed: Vector) -> Matrix:
        """Of heave, tilt and yaw [3, samples] at `times` [s], from the equations of motion."""
        model, found = self.model, numpy.zeros((3, len(loads)))
        if self._ride is not None:
            drag = 2.0 * self._ride.zeta * self._ride.frequency
            found[0] = (loads - self._ride.heave.load) / model.mass - drag * speed
        if self._angles is not None:
            turned = numpy.zeros((len(loads), 2))
            # One call for all samples, or one for each where the bending load changes.
            length = 1 if model.programme.bends_shaft else len(loads)
            for place in range(0, len(loads), length):
                rows = slice(place, place + length)
                bending = model.bending_at(float(times[place]))
                accelerations(
                    model.roller, curvatures[rows], bending, model.modulus, loads[rows], angles[rows], turned[rows]
                )
            found[1:] = turned.T
        return found

    def _forecast(self, block: int) -> RollerStability | None:
        programme = self.model.programme
        if block > 0:
            ends = numpy.array([block - 1, block]) * self.model.timing.block_length
            bends = [programme.bending_load_at(float(end), 0.0) for end in ends]
            before, now = programme.loads(ends)
            if not programme.steps or (before == now and bends[0] == bends[1]):
                return None
        return forecast(self.model, block)

    def _measured(self, block: int, record: RollerRecord) -> list[RollerMeasurement]:
        below = self.model.subsurface
        if below is None:
            return []
        found = []
        for instant in below.instants:
            place = round(instant / record.period) - block * self.model.timing.samples
            if 0 <= place < len(record.load):
                contact = RollingContact(*(float(value) for value in record.contacts[place]))
                found.append(self._volumes(instant, contact))
        return found

    def _volumes(
        self, instant: float, contact: RollingContact, cells: tuple[int, int, int] | None = None
    ) -> RollerMeasurement:
        model = self.model
        limits, usual, _none, traction = volume_settings(model)
        cut = usual if cells is None else cells
        own = dangerous_volumes(contact, model.poisson_ratio, limits, cut, None, traction)
        bent = None
        bending = model.bending_at(instant)
        if bending is not None:
            bent = dangerous_volumes(contact, model.poisson_ratio, limits, cut, bending, traction)
        first = model.contact(float(model.programme.load[0]), model.held_yaw, model.programme.curvatures_at(0.0))
        return RollerMeasurement(instant, contact, limits, box_volume(first), own, bent)

    def _track_due(self, block: int) -> bool:
        return block % self._every == 0 or block == self.blocks - 1

    @property
    def _every(self) -> int:
        """Blocks from one recorded track to the next."""
        return max(1, self.blocks // MOST_TRACKS)

    def _check_due(self, block: int) -> bool:
        """Whether the time acceleration is looked at behind a block: at so many even places of the
        run.
        """
        checks = 0 if self.model.damage is None else self.model.damage.checks
        return block in {k * self.blocks // checks // self._every * self._every for k in range(checks)}
