"""What one block of the simulation says, as encoded messages in canonical order."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.bag.topics import TOPICS
from contact_sim_pkg.laws.normal_force import pressure_factor
from contact_sim_pkg.laws.parameters import ElasticLaw
from contact_sim_pkg.pressure.closed_form.lame import fit_patch
from contact_sim_pkg.pressure.field.patch import summarise
from contact_sim_pkg.pressure.mat import spread_force
from contact_sim_pkg.records.messages import (
    BodyMotion,
    ContactForce,
    ContactPatch,
    ContactShear,
    EnergyLedger,
    SolverCost,
)
from contact_sim_pkg.rigs.vehicle import entries as columns
from contact_sim_pkg.rigs.vehicle.contact_model import FieldGrids
from contact_sim_pkg.rigs.vehicle.model import Model
from contact_sim_pkg.rigs.vehicle.seat.mat import PanMat
from contact_sim_pkg.rigs.vehicle.tire.rolling_shear import RollingShear
from contact_sim_pkg.run.mat_field import mat_field
from contact_sim_pkg.run.wrench import wrench_of

Array = NDArray[numpy.float64]
NANOSECONDS = 1_000_000_000


class FieldRecord(NamedTuple):
    """A pressure field at one instant, before the loss factor."""

    pressure: Array  # [rows, cols], [Pa], elastic
    origin_x: float  # [m] of the centre of cell (0, 0)
    origin_y: float  # [m]
    approach: float  # [m]
    load: float  # [N], elastic
    travel: float  # [m] of the contact along the road


@dataclass
class BlockRecord:
    """Samples of one block, filled interval by interval."""

    block: int
    states: Array  # [samples, states]
    rates: Array  # [samples, states]
    forces: Array  # [samples, columns of rigs/vehicle/entries.py]
    floor: Array  # [samples, 2], [m/s^2] floor acceleration x, z
    energy: Array = field(default_factory=lambda: numpy.zeros(5))
    start_energy: Array = field(default_factory=lambda: numpy.zeros(5))
    fields: list[tuple[int, FieldRecord | None, FieldRecord | None]] = field(default_factory=list)
    counters: Array = field(default_factory=lambda: numpy.zeros(3))
    field_iterations: int = 0
    field_residual: float = 0.0
    field_jump: float = 0.0
    stretches: int = 0
    stretches_repeated: int = 0
    coupling_error: float = 0.0  # over the standing load

    @classmethod
    def empty(cls, model: Model, block: int) -> BlockRecord:
        """Room for one block of ``model``."""
        samples = model.timing.samples
        return cls(
            block,
            numpy.zeros((samples, model.states)),
            numpy.zeros((samples, model.states)),
            numpy.zeros((samples, columns.FORCES)),
            numpy.zeros((samples, 2)),
        )

    def take(
        self,
        interval: int,
        sampled: tuple[Array, Array, Array],
        energy: Array,
        start_energy: Array | None,
        a_x: Array,
        a_z: Array,
        fields: tuple[FieldRecord | None, FieldRecord | None],
    ) -> None:
        """Take the samples of interval number ``interval``, and the fields at its start."""
        count = sampled[0].shape[0]
        first = interval * count
        rows = slice(first, first + count)
        self.states[rows], self.rates[rows], self.forces[rows] = sampled
        stride = (len(a_x) - 1) // count
        self.floor[rows, 0], self.floor[rows, 1] = a_x[:-1:stride], a_z[:-1:stride]
        if interval == 0:
            self.energy[:] = energy
            self.start_energy[:] = energy if start_energy is None else start_energy
        self.fields.append((first, *fields))


def encode_block(
    model: Model, record: BlockRecord, shear: RollingShear | None, wall_time: float
) -> tuple[list[tuple[str, int, bytes]], float, float]:
    """Messages of a block in canonical order, largest normal force in [N] and largest pressure in [Pa]."""
    encoder = _Encoder(model, record, shear)
    encoder.contacts()
    encoder.motion()
    encoder.ledger()
    encoder.cost(wall_time)
    encoder.messages.sort(key=lambda message: (message[1], TOPICS[message[0]].rank))
    return encoder.messages, encoder.load, encoder.peak


class _Encoder:
    def __init__(self, model: Model, record: BlockRecord, shear: RollingShear | None) -> None:
        self.model, self.record, self.shear = model, record, shear
        self.friction = numpy.zeros((len(record.forces), 3))  # Fx [N], Fy [N], Mz [N m] of the tire
        self.block_ns = round(model.timing.block_length * NANOSECONDS)
        self.stamp = record.block * self.block_ns
        self.period = model.timing.block_length / model.timing.samples
        self.messages: list[tuple[str, int, bytes]] = []
        self.load = 0.0
        self.peak = 0.0

    def _stamp_of(self, sample: int) -> int:
        return self.stamp + sample * self.block_ns // self.model.timing.samples

    def contacts(self) -> None:
        """Fields of each contact, its forces and wrenches."""
        rig, force = self.model.rig, self.record.forces
        for sample, tire, seat in self.record.fields:
            if tire is not None:
                pressure = self._field("tire", "tire_contact", sample, tire, (columns.TIRE_APPROACH, columns.TIRE_RATE))
                if self.shear is not None:
                    self._sheared(self.shear, sample, tire, pressure)
            if seat is not None:
                self._field("seat", "seat_contact", sample, seat, (columns.SEAT_APPROACH, columns.SEAT_RATE))
        if rig.tire_contact is not None:
            chosen = (columns.TIRE_NORMAL, columns.TIRE_APPROACH, columns.TIRE_HEIGHT)
            impulses = numpy.empty(0) if self.model.asperities is None else force[:, columns.TIRE_PUSH]
            self._contact("tire", "tire_contact", self.friction, force[:, chosen], impulses)
        if rig.seat_contact is not None:
            chosen = (columns.SEAT_NORMAL, columns.SEAT_APPROACH, columns.SEAT_HEIGHT)
            friction = numpy.zeros((len(force), 3))
            friction[:, 0] = force[:, columns.SEAT_TANGENTIAL]
            self._contact("seat", "seat_contact", friction, force[:, chosen], numpy.empty(0))
            if self.model.seat_mat is not None:
                self._mat(self.model.seat_mat, rig.seat_contact.elastic)

    def _mat(self, mat: PanMat, elastic: ElasticLaw) -> None:
        """Pressure maps of the seat's point contact."""
        for i in range(mat.fields):
            sample = i * self.model.timing.samples // mat.fields
            force, approach = (
                float(self.record.forces[sample, k]) for k in (columns.SEAT_NORMAL, columns.SEAT_APPROACH)
            )
            pressure = spread_force(force, approach, elastic, mat.gap, mat.cell_x * mat.cell_y)
            found = mat_field(self.record.block, mat[:4], approach, pressure)
            self.peak, stamp = max(self.peak, found.peak), self._stamp_of(sample)
            self.messages.append(("seat/patch", stamp, encode(found, stamp, "seat_contact")))

    def _contact(self, name: str, frame: str, friction: Array, samples: Array, impulses: Array) -> None:
        """Force and wrenches of a contact; ``samples``: normal force [N], approach and height [m]."""
        normal, approach, height = samples.T
        self.load = max(self.load, float(normal.max()))
        value = ContactForce(
            block=self.record.block,
            sample_period=self.period,
            normal=normal,
            tangential=friction[:, 0],
            approach=approach,
            effective_height=height,
            impulses=impulses,
        )
        self.messages.append((f"{name}/force", self.stamp, encode(value, self.stamp, frame)))
        displays = self.model.timing.displays
        for i in range(displays):
            sample = i * self.model.timing.samples // displays
            force_x, force_y, moment_z = (float(part) for part in friction[sample])
            vertical = float(normal[sample]) + (float(impulses[sample]) if len(impulses) else 0.0)
            wrench = wrench_of((force_x, force_y, vertical), (0.0, 0.0, moment_z))
            stamp = self._stamp_of(sample)
            self.messages.append((f"{name}/wrench", stamp, encode(wrench, stamp, frame)))

    def _sheared(self, shear: RollingShear, sample: int, found: FieldRecord, pressure: Array) -> None:
        """The shear under a field; its resultants hold until the next."""
        stamp, settings = self._stamp_of(sample), self._grids("tire").usual.settings
        place = (found.origin_x, found.origin_y)
        rolled = shear.advance(pressure, *place, found.travel, stamp / NANOSECONDS)
        result = rolled.result
        self.friction[sample:] = (result.force_x, result.force_y, result.moment_z)
        value = ContactShear(
            block=self.record.block, cell_x=settings.cell_x, cell_y=settings.cell_y, origin_x=place[0],
            origin_y=place[1], slip=rolled.slip, slip_angle=rolled.slip_angle, force_x=result.force_x,
            force_y=result.force_y, moment_z=result.moment_z, sliding_share=result.sliding_share,
            dissipated=result.dissipated + result.released, shear_x=rolled.shear_x.astype(numpy.float32),
            shear_y=rolled.shear_y.astype(numpy.float32), state=rolled.state,
        )  # fmt: skip
        self.messages.append(("tire/shear", stamp, encode(value, stamp, "tire_contact")))

    def _grids(self, name: str) -> FieldGrids:
        grids = self.model.tire_field if name == "tire" else self.model.seat_field
        assert grids is not None
        return grids

    def _field(self, name: str, frame: str, sample: int, found: FieldRecord, motion: tuple[int, int]) -> Array:
        """The field with its loss, whose integral is the force at its instant; returns the pressure."""
        grids = self._grids(name)
        contact = self.model.rig.tire_contact if name == "tire" else self.model.rig.seat_contact
        assert contact is not None
        settings = grids.usual.settings  # the wide grid has the same cells
        origin_x, origin_y = found.origin_x, found.origin_y
        approach, rate = (float(self.record.forces[sample, column]) for column in motion)
        pressure = found.pressure * pressure_factor(contact.elastic, contact.dissipative, approach, rate, 1.0)
        total = summarise(pressure, settings.cell_x, settings.cell_y, origin_x, origin_y)
        shape = fit_patch(pressure, settings.cell_x, settings.cell_y, origin_x, origin_y)
        self.peak = max(self.peak, total.peak)
        touching = total.load > 0.0
        value = ContactPatch(
            block=self.record.block, cell_x=settings.cell_x, cell_y=settings.cell_y,
            origin_x=origin_x, origin_y=origin_y, load=total.load, peak=total.peak, mean=total.mean,
            area=total.area, centre_x=total.centre_x if touching else 0.0,
            centre_y=total.centre_y if touching else 0.0, approach=found.approach,
            lame_a=shape.a, lame_b=shape.b, lame_n=shape.exponent, pressure=pressure.astype(numpy.float32),
        )  # fmt: skip
        stamp = self._stamp_of(sample)
        self.messages.append((f"{name}/patch", stamp, encode(value, stamp, frame)))
        return pressure

    def motion(self) -> None:
        """Positions, velocities and accelerations of all bodies."""
        value = BodyMotion(
            block=self.record.block,
            sample_period=self.period,
            bodies=self.model.bodies,
            **_motion_rows(self.model, self.record),
        )
        self.messages.append(("bench/motion", self.stamp, encode(value, self.stamp)))

    def ledger(self) -> None:
        """The energy ledger at the block's start."""
        kinetic, potential, stored, supplied, dissipated = self.record.energy - self.record.start_energy
        residual = supplied - kinetic - potential - stored - dissipated
        value = EnergyLedger(
            block=self.record.block,
            kinetic=float(kinetic),
            potential=float(potential),
            stored=float(stored),
            dissipated=float(dissipated),
            supplied=float(supplied),
            residual=float(residual),
        )
        self.messages.append(("bench/energy", self.stamp, encode(value, self.stamp)))

    def cost(self, wall_time: float) -> None:
        """What the block cost."""
        record = self.record
        steps, rejected, events = (int(value) for value in record.counters)
        value = SolverCost(
            block=record.block, wall_time=wall_time, real_time_factor=self.model.timing.block_length / wall_time,
            steps=steps, rejected_steps=rejected, events=events, field_iterations=record.field_iterations,
            field_residual=record.field_residual, field_jump=record.field_jump, stretches=record.stretches,
            stretches_repeated=record.stretches_repeated, coupling_error=record.coupling_error,
        )  # fmt: skip
        self.messages.append(("bench/cost", self.stamp, encode(value, self.stamp)))


def _motion_rows(model: Model, record: BlockRecord) -> dict[str, Array]:
    """Rows of ``bench/motion`` in the order of ``model.bodies``: position, velocity, acceleration."""
    rig, state, rate = model.rig, record.states, record.rates
    indices: list[tuple[int, int]] = []
    if rig.tire is not None:
        indices += [(0, 2), (1, 3)]
    if rig.carcass is not None:
        indices.append((rig.carcass.offset, rig.carcass.offset + 1))
    if rig.seat is not None:
        count = 1 + len(rig.seat.masses)
        indices += [(rig.seat.offset + i, rig.seat.offset + count + i) for i in range(count)]
        if "occupant_x" in model.bodies:
            indices.append((rig.seat.offset + 2 * count, rig.seat.offset + 2 * count + 1))
    position = numpy.array([state[:, p] for p, _ in indices])
    velocity = numpy.array([state[:, v] for _, v in indices])
    acceleration = numpy.array([rate[:, v] for _, v in indices])
    if "occupant_x" in model.bodies:
        acceleration[-1] += record.floor[:, 0]
    if rig.tire is None:
        vertical = slice(None, -1 if "occupant_x" in model.bodies else None)
        acceleration[vertical] += record.floor[:, 1]
        still = numpy.zeros((1, len(state)))
        position, velocity = numpy.vstack([still, position]), numpy.vstack([still, velocity])
        acceleration = numpy.vstack([record.floor[:, 1][None, :], acceleration])
    return {"position": position, "velocity": velocity, "acceleration": acceleration}
