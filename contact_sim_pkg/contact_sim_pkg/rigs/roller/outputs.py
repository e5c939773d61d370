"""What one block of the roller rig says, as encoded messages in canonical order."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.bag.topics import TOPICS
from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.records.messages import (
    BodyMotion,
    ContactForce,
    EnergyLedger,
    RollerContact,
    RollerStability,
    RollerTrack,
    RollerVolumes,
    SolverCost,
)
from contact_sim_pkg.rigs.roller.energy import Energies
from contact_sim_pkg.rigs.roller.model import RollerModel
from contact_sim_pkg.rigs.roller.ride import Checked, TrackRide
from contact_sim_pkg.rigs.roller.theory.ellipse import RollingContact
from contact_sim_pkg.rigs.roller.theory.volumes import Volumes
from contact_sim_pkg.rigs.roller.wear import BodyTrack

Matrix = NDArray[numpy.float64]
Messages = list[tuple[str, int, bytes]]

NANOSECONDS = 1_000_000_000
BODIES = ("roller_z", "roller_tilt", "roller_yaw")


class Measured(NamedTuple):
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
    volumes: list[Measured] = field(default_factory=list)
    track: TrackRide | None = None
    checked: Checked | None = None


def encode_block(model: RollerModel, record: RollerRecord, wall_time: float) -> Messages:
    """Messages of a block in canonical order."""
    stamp = record.block * round(model.timing.block_length * NANOSECONDS)
    messages = _contact(record, stamp)
    if record.stability is not None:
        messages.append(("roller/stability", stamp, encode(record.stability, stamp, "roller_contact")))
    if record.track is not None:
        for track in record.track.tracks:
            messages.append(
                ("roller/track", stamp, encode(_track(model, record, record.track, track), stamp, "roller_contact"))
            )
    for measured in record.volumes:
        messages.append(("roller/volumes", stamp, encode(_volumes(record.block, measured), stamp, "roller_contact")))
    messages += _bench(model, record, stamp, wall_time)
    messages.sort(key=lambda message: (message[1], TOPICS[message[0]].rank))
    return messages


def _contact(record: RollerRecord, stamp: int) -> Messages:
    columns = record.contacts.T.copy()
    along_x, along_y, angle, peak, approach = columns[:5]
    zeros = numpy.zeros_like(record.load)
    force = ContactForce(
        block=record.block,
        sample_period=record.period,
        normal=record.load,
        tangential=zeros,
        approach=approach,
        effective_height=zeros,
    )
    value = RollerContact(
        block=record.block, period=record.period, load=record.load, along_x=along_x, along_y=along_y, angle=angle,
        peak_pressure=peak, approach=approach, tilt=record.angles[:, 0].copy(), yaw=record.angles[:, 1].copy(),
        heave=record.heave[0].copy(),
    )  # fmt: skip
    return [
        ("roller/force", stamp, encode(force, stamp, "roller_contact")),
        ("roller/contact", stamp, encode(value, stamp, "roller_contact")),
    ]


def _track(model: RollerModel, record: RollerRecord, ride: TrackRide, track: BodyTrack) -> RollerTrack:
    checked = record.checked or Checked(0, math.nan)
    return RollerTrack(
        block=record.block, body=track.body, turns=float(track.turned), cycles=track.turned * model.acceleration,
        turn_time=track.turn_time, radius=track.radius, height=track.heights.copy(), load=track.loads.copy(),
        lowered=track.lowered, range=track.range, free=ride.free, checked=float(checked.intervals * track.turns),
        check_error=checked.error,
    )  # fmt: skip


def _volumes(block: int, measured: Measured) -> RollerVolumes:
    contact = measured.contact
    bent = numpy.zeros(0) if measured.bent is None else numpy.array(measured.bent)
    return RollerVolumes(
        block=block, time=measured.time, load=contact.load, along_x=contact.along_x, along_y=contact.along_y,
        angle=contact.angle, peak_pressure=contact.peak_pressure, approach=contact.approach,
        normal_limit=measured.limits[0], shear_limit=measured.limits[1], working_volume=measured.working,
        volume=numpy.array(measured.own), with_bending=bent,
    )  # fmt: skip


def _bench(model: RollerModel, record: RollerRecord, stamp: int, wall_time: float) -> Messages:
    position = numpy.vstack([record.heave[0], record.angles[:, 0], record.angles[:, 1]])
    velocity = numpy.vstack([record.heave[1], record.angles[:, 2], record.angles[:, 3]])
    motion = BodyMotion(
        block=record.block,
        sample_period=record.period,
        bodies=BODIES,
        position=position,
        velocity=velocity,
        acceleration=record.acceleration,
    )
    factor = model.timing.block_length / wall_time
    cost = SolverCost(
        block=record.block,
        wall_time=wall_time,
        real_time_factor=factor,
        steps=record.steps,
    )
    ledger = EnergyLedger(block=record.block, **record.energy._asdict(), residual=record.energy.residual)
    return [
        ("bench/motion", stamp, encode(motion, stamp)), ("bench/energy", stamp, encode(ledger, stamp)),
        ("bench/cost", stamp, encode(cost, stamp)),
    ]  # fmt: skip
