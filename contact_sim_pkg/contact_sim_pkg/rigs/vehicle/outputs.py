"""Outputs of the rigs tire, seat and car: samples of one block, and columns of its messages."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from math import isnan

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.records.messages import (
    AxleForce,
    BodyMotion,
    ContactForce,
    ContactPatch,
    ContactShear,
    EnergyLedger,
    TireStanding,
    TireWork,
)
from contact_sim_pkg.rigs.vehicle.field.contact_field import FieldGrids
from contact_sim_pkg.rigs.vehicle.field.driver import FieldRecord
from contact_sim_pkg.rigs.vehicle.model import Model
from contact_sim_pkg.rigs.vehicle.motion import columns
from contact_sim_pkg.rigs.vehicle.motion.spring import spring_force
from contact_sim_pkg.rigs.vehicle.tire.brush.rolling_shear import Sheared, Works
from contact_sim_pkg.rigs.vehicle.tire.rolling_formula import Followed
from contact_sim_pkg.rigs.vehicle.tire.standing import TireAtRest
from contact_sim_pkg.run.contact_patch import contact_patch
from contact_sim_pkg.run.outputs import BlockStamps, Estimate, contact_outputs, energy_ledger, largest_of, solver_cost

Array = NDArray[numpy.float64]

ESTIMATED = (
    ("tire/force.normal", "tire/axle.longitudinal", "tire/patch.peak", "tire/patch.area", "bench/motion.velocity"),
    ("seat/force.normal", "", "seat/patch.peak", "seat/patch.area", ""),
)
"""Columns by the contacts and kinds of `run/coupling_check.py`."""


@dataclass
class BlockRecord:
    """Samples of one block, filled interval by interval."""

    block: int
    states: Array  # [samples, states]
    rates: Array  # [samples, states]
    forces: Array  # [samples, columns of rigs/vehicle/motion/columns.py]
    floor: Array  # [samples, 2], [m/s^2] floor acceleration x, z
    energy: Array = field(default_factory=lambda: numpy.zeros(5))
    start_energy: Array = field(default_factory=lambda: numpy.zeros(5))
    tire_fields: list[tuple[int, FieldRecord]] = field(default_factory=list)  # sample, field
    seat_fields: list[tuple[int, FieldRecord]] = field(default_factory=list)
    shears: list[tuple[int, FieldRecord, Sheared]] = field(
        default_factory=list
    )  # sample, field of the tire, shear under it
    followed: list[tuple[int, Followed]] = field(default_factory=list)  # sample, the Magic Formula there
    works: Works | None = None  # of a belt on its sidewalls, at the block's start
    standing: TireAtRest | None = None  # in the first block of a run
    seat_maps: list[tuple[int, Array]] = field(default_factory=list)  # sample, pressure [Pa] of the seat's map
    counters: Array = field(default_factory=lambda: numpy.zeros(3))
    field_iterations: int = 0
    field_residual: float = 0.0
    field_jump: float = 0.0
    coupling_steps: int = 0
    coupling_steps_repeated: int = 0
    coupling_error: float = 0.0  # over the standing load
    missed: Array | None = None  # [contacts, kinds] of `run/coupling_check.py`; None: not estimated

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

    def store_samples(
        self,
        interval: int,
        sampled: tuple[Array, Array, Array],
        energy: Array,
        start_energy: Array | None,
        a_x: Array,
        a_z: Array,
    ) -> int:
        """Store the samples of an interval; returns the index of the first, the instant of its
        fields.
        """
        count = sampled[0].shape[0]
        first = interval * count
        rows = slice(first, first + count)
        self.states[rows], self.rates[rows], self.forces[rows] = sampled
        # The drive has more points than samples.
        stride = (len(a_x) - 1) // count
        self.floor[rows, 0], self.floor[rows, 1] = a_x[:-1:stride], a_z[:-1:stride]
        if interval == 0:
            self.energy[:] = energy
            self.start_energy[:] = energy if start_energy is None else start_energy
        return first


def block_outputs(model: Model, record: BlockRecord, wall_time: float) -> list[Output]:
    """Outputs of a block, computed in ``wall_time`` [s]."""
    stamps, forces = BlockStamps(record.block, model.timing), record.forces
    outputs: list[Output] = []
    # contacts: force and wrenches of the resultant, and the fields under it
    if model.quarter is not None:
        shear = forces[:, columns.TIRE_SHEAR : columns.TIRE_SHEAR + 3]
        impulses = {} if model.asperities is None else {"impulses": forces[:, columns.TIRE_PUSH]}
        force = ContactForce(
            block=record.block, sample_period=stamps.period, normal=forces[:, columns.TIRE_NORMAL],
            tangential=shear[:, 0], approach=forces[:, columns.TIRE_APPROACH],
            effective_height=forces[:, columns.TIRE_HEIGHT], **impulses,
        )  # fmt: skip
        patches = _fields(stamps, model.tire_field, record.tire_fields)
        outputs += contact_outputs("tire", stamps, force, patches, lateral=shear[:, 1:])
        outputs.append(Output("tire/axle", stamps.start, _axle_force(model, stamps, record)))
        outputs += _shears(stamps, model.tire_field, record)
        outputs += _shears_of_formula(stamps, record)
        if record.works is not None:
            outputs.append(Output("tire/work", stamps.start, TireWork(block=record.block, **record.works._asdict())))
        if record.standing is not None:
            standing = TireStanding(block=record.block, **record.standing._asdict())
            outputs.append(Output("tire/standing", stamps.start, standing))
    if model.rig.seat_contact is not None:
        force = ContactForce(
            block=record.block, sample_period=stamps.period, normal=forces[:, columns.SEAT_NORMAL],
            tangential=forces[:, columns.SEAT_TANGENTIAL], approach=forces[:, columns.SEAT_APPROACH],
            effective_height=forces[:, columns.SEAT_HEIGHT],
        )  # fmt: skip
        patches = _fields(stamps, model.seat_field, record.seat_fields) or _maps(model, stamps, record)
        outputs += contact_outputs("seat", stamps, force, patches)
    # the rig as a whole
    motion = BodyMotion(
        block=record.block, sample_period=stamps.period, bodies=model.bodies, **_motion_rows(model, record)
    )
    outputs += [
        Output("bench/motion", stamps.start, motion), Output("bench/energy", stamps.start, _ledger(record)),
    ]  # fmt: skip
    steps, rejected, events = (int(value) for value in record.counters)
    cost = solver_cost(
        stamps, wall_time, _estimates(outputs, record.missed, model.bodies, stamps.period),
        steps=steps, rejected_steps=rejected, events=events,
        field_iterations=record.field_iterations, field_residual=record.field_residual, field_jump=record.field_jump,
        coupling_steps=record.coupling_steps, coupling_steps_repeated=record.coupling_steps_repeated,
        coupling_error=record.coupling_error,
    )  # fmt: skip
    return [*outputs, Output("bench/cost", stamps.start, cost)]


def _estimates(outputs: list[Output], missed: Array | None, bodies: tuple[str, ...], period: float) -> list[Estimate]:
    """Estimated errors of the outputs of a block with samples each ``period`` [s]: those that are known."""
    if missed is None:
        return []
    touches = "belt_z" if "belt_z" in bodies else bodies[0]
    found = []
    for names, errors in zip(ESTIMATED, missed.tolist(), strict=True):
        for name, error in zip(names, errors, strict=True):
            if name and not isnan(error):
                moves = name.startswith("bench/motion")
                column = f"{name} of {touches}" if moves else name
                # A wheel that stands has no speed to err by a part of: free fall during a sample
                least = GRAVITY * period if moves else 0.0
                found.append(Estimate(column, error, max(least, largest_of(outputs, column))))
    return found


def _axle_force(model: Model, stamps: BlockStamps, record: BlockRecord) -> AxleForce:
    """Force of the tire on the axle: across the rigid ring, where there is one."""
    forces, sidewalls = record.forces, None if model.quarter is None else model.quarter.sidewalls
    vertical = forces[:, columns.TIRE_NORMAL] + forces[:, columns.TIRE_PUSH]
    if sidewalls is not None:
        vertical = spring_force(sidewalls, record.states.T)
    on_axle = {"longitudinal": -forces[:, columns.TIRE_SLOPE] * forces[:, columns.TIRE_NORMAL]}
    if model.rolling_friction is not None or model.magic_formula is not None:
        names = ("longitudinal", "lateral", "moment_y", "moment_z", "spin")
        on_axle = dict(zip(names, forces[:, columns.TIRE_SHEAR + 3 :].T, strict=True))
    return AxleForce(block=record.block, sample_period=stamps.period, vertical=vertical, **on_axle)


def _fields(
    stamps: BlockStamps, grids: FieldGrids | None, fields: list[tuple[int, FieldRecord]]
) -> list[tuple[int, ContactPatch]]:
    """Sample and pressure field of a contact."""
    found = []
    for sample, field_ in fields:
        grid = (*_cells(grids), field_.origin_x, field_.origin_y)
        found.append((sample, contact_patch(stamps.block, grid, field_.approach, field_.pressure)))
    return found


def _maps(model: Model, stamps: BlockStamps, record: BlockRecord) -> list[tuple[int, ContactPatch]]:
    """Sample and pressure map of the seat."""
    found = []
    for sample, pressure in record.seat_maps:
        assert model.seat_map is not None
        approach = float(record.forces[sample, columns.SEAT_APPROACH])
        found.append((sample, contact_patch(stamps.block, model.seat_map.cells, approach, pressure)))
    return found


def _shears(stamps: BlockStamps, grids: FieldGrids | None, record: BlockRecord) -> Iterator[Output]:
    """The shear under the fields of the tire."""
    for sample, found, rolled in record.shears:
        (cell_x, cell_y), result = _cells(grids), rolled.result
        shear = ContactShear(
            block=stamps.block, cell_x=cell_x, cell_y=cell_y, origin_x=found.origin_x, origin_y=found.origin_y,
            slip=rolled.slip, slip_angle=rolled.slip_angle, force_x=result.force_x, force_y=result.force_y,
            moment_z=result.moment_z, sliding_share=result.sliding_share, dissipated=result.dissipated + result.released,
            shear_x=rolled.shear_x.astype(numpy.float32), shear_y=rolled.shear_y.astype(numpy.float32), state=rolled.state,
        )  # fmt: skip
        yield Output("tire/shear", stamps.at(sample), shear)


def _shears_of_formula(stamps: BlockStamps, record: BlockRecord) -> Iterator[Output]:
    """The forces of the Magic Formula, which knows no cells."""
    none, state = numpy.zeros((0, 0), dtype=numpy.float32), numpy.zeros((0, 0), dtype=numpy.uint8)
    for sample, found in record.followed:
        shear = ContactShear(
            block=stamps.block, cell_x=0.0, cell_y=0.0, origin_x=0.0, origin_y=0.0, slip=found.slip,
            slip_angle=found.slip_angle, force_x=found.force_x, force_y=found.force_y, moment_z=found.moment_z,
            sliding_share=0.0, dissipated=found.dissipated, shear_x=none, shear_y=none, state=state,
        )  # fmt: skip
        yield Output("tire/shear", stamps.at(sample), shear)


def _cells(grids: FieldGrids | None) -> tuple[float, float]:
    """Sizes of a cell [m] along x and y, the same on the usual and on the wide grid."""
    assert grids is not None
    return grids.usual.settings.cell_x, grids.usual.settings.cell_y


def _ledger(record: BlockRecord) -> EnergyLedger:
    """The energy ledger at the block's start."""
    kinetic, potential, stored, supplied, dissipated = (float(v) for v in record.energy - record.start_energy)
    return energy_ledger(
        record.block, kinetic=kinetic, potential=potential, stored=stored, dissipated=dissipated, supplied=supplied
    )


def _motion_rows(model: Model, record: BlockRecord) -> dict[str, Array]:
    """Rows of ``bench/motion`` in the order of ``model.bodies``: position, velocity,
    acceleration.
    """
    state, rate, moving = record.states, record.rates, model.coordinates
    position = numpy.array([state[:, each.place] for each in moving])
    velocity = numpy.array([state[:, each.speed] for each in moving])
    acceleration = numpy.array([rate[:, each.speed] for each in moving])
    still, forward, upward = numpy.zeros(len(state)), record.floor[:, 0], record.floor[:, 1]
    vertical = numpy.array([each.is_vertical for each in moving])
    acceleration[~vertical] += forward
    if model.quarter is None:  # beside the floor that they move on
        acceleration[vertical] += upward
        position, velocity = numpy.vstack([still, position]), numpy.vstack([still, velocity])
        acceleration = numpy.vstack([upward, acceleration])
    if model.rig.back is not None:
        position, velocity = numpy.insert(position, -1, still, axis=0), numpy.insert(velocity, -1, still, axis=0)
        acceleration = numpy.insert(acceleration, -1, forward, axis=0)
    return {"position": position, "velocity": velocity, "acceleration": acceleration}
