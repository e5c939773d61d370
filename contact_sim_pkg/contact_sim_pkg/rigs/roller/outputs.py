"""Outputs of the roller: samples of one block, and columns of its messages."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.records.messages import (
    BodyMotion,
    ContactForce,
    RollerContact,
    RollerStability,
    RollerTrack,
    RollerVolumes,
)
from contact_sim_pkg.rigs.roller.energy import Energies
from contact_sim_pkg.rigs.roller.model import RollerModel
from contact_sim_pkg.rigs.roller.ride import Checked, TrackRide
from contact_sim_pkg.rigs.roller.theory.ellipse import RollingContact
from contact_sim_pkg.rigs.roller.theory.volumes import Volumes
from contact_sim_pkg.rigs.roller.wear import BodyTrack
from contact_sim_pkg.run.outputs import BlockStamps, energy_ledger, solver_cost

Matrix = NDArray[numpy.float64]

BODIES = ("roller_z", "roller_tilt", "roller_yaw")


class RollerMeasurement(NamedTuple):
    """Dangerous volumes at an instant."""

    time: float  # [s]
    contact: RollingContact
    limits: tuple[float, float]  # [Pa] normal, shear
    working: float  # [m^3]
    own: Volumes
    bent: Volumes | None


@dataclass
class RollerRecord:
    """Samples of one block."""

    block: int
    period: float  # [s]
    load: Vector  # [samples] [N] on the contact
    heave: Matrix  # [2, samples] and its speed
    angles: Matrix  # [samples, 4] tilt, yaw and their rates
    acceleration: Matrix  # [3, samples] of heave, tilt, yaw
    contacts: Matrix  # [samples, 6], columns as `RollingContact`
    steps: int
    energy: Energies  # at the start
    stability: RollerStability | None = None
    volumes: list[RollerMeasurement] = field(default_factory=list)
    track: TrackRide | None = None
    checked: Checked | None = None


def block_outputs(model: RollerModel, record: RollerRecord, wall_time: float) -> list[Output]:
    """Outputs of a block, computed in ``wall_time`` [s]."""
    stamps = BlockStamps(record.block, model.timing)
    tracks = [] if record.track is None else [_track(model, record, record.track, each) for each in record.track.tracks]
    records: list[tuple[str, Any]] = [
        ("roller/force", _force(record)), ("roller/contact", _contact(record)),
        *(("roller/stability", each) for each in [record.stability] if each is not None),
        *(("roller/track", track) for track in tracks),
        *(("roller/volumes", _volumes(record.block, measured)) for measured in record.volumes),
        ("bench/motion", _motion(record)), ("bench/energy", energy_ledger(record.block, **record.energy._asdict())),
        ("bench/cost", solver_cost(stamps, wall_time, steps=record.steps)),
    ]  # fmt: skip
    return [Output(topic, stamps.start, each) for topic, each in records]


def _force(record: RollerRecord) -> ContactForce:
    zeros = numpy.zeros_like(record.load)
    return ContactForce(
        block=record.block, sample_period=record.period, normal=record.load, tangential=zeros,
        approach=_columns(record)["approach"], effective_height=zeros,
    )  # fmt: skip


def _contact(record: RollerRecord) -> RollerContact:
    columns = _columns(record) | {"load": record.load}
    return RollerContact(
        block=record.block, period=record.period, tilt=record.angles[:, 0], yaw=record.angles[:, 1], heave=record.heave[0],
        **columns,
    )  # fmt: skip


def _columns(record: RollerRecord) -> dict[str, Vector]:
    """The contacts of all samples by the names of `RollingContact`."""
    return dict(zip(RollingContact._fields, record.contacts.T, strict=True))


def _track(model: RollerModel, record: RollerRecord, ride: TrackRide, track: BodyTrack) -> RollerTrack:
    checked = record.checked or Checked(0, math.nan)
    return RollerTrack(
        block=record.block, body=track.body, turns=float(track.turned), cycles=track.turned * model.acceleration,
        turn_time=track.turn_time, radius=track.radius, height=track.heights.copy(), load=track.loads.copy(),
        axial=track.axial.copy(), lowered=track.lowered, range=track.range, free=ride.free,
        checked=float(checked.intervals * track.turns),
        check_error=checked.error,
    )  # fmt: skip


def _volumes(block: int, measured: RollerMeasurement) -> RollerVolumes:
    contact = measured.contact
    bent = numpy.zeros(0) if measured.bent is None else numpy.array(measured.bent)
    return RollerVolumes(
        block=block, time=measured.time, load=contact.load, along_x=contact.along_x, along_y=contact.along_y,
        angle=contact.angle, peak_pressure=contact.peak_pressure, approach=contact.approach,
        normal_limit=measured.limits[0], shear_limit=measured.limits[1], working_volume=measured.working,
        volume=numpy.array(measured.own), with_bending=bent,
    )  # fmt: skip


def _motion(record: RollerRecord) -> BodyMotion:
    return BodyMotion(
        block=record.block, sample_period=record.period, bodies=BODIES,
        position=numpy.vstack([record.heave[0], record.angles[:, 0], record.angles[:, 1]]),
        velocity=numpy.vstack([record.heave[1], record.angles[:, 2], record.angles[:, 3]]),
        acceleration=record.acceleration,
    )  # fmt: skip
