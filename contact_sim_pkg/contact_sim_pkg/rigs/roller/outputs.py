"""What one block of the roller rig says, as encoded messages in canonical order."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.bag.messages import (
    ROLLER_FRAME,
    ContactForceBlock,
    Cost,
    Energy,
    MotionBlock,
    RollerContact,
    RollerStability,
    RollerTrack,
    RollerVolumes,
    encode_contact_force,
    encode_cost,
    encode_energy,
    encode_motion,
    encode_roller,
)
from contact_sim_pkg.bag.topics import TOPICS
from contact_sim_pkg.compiled.arrays import Vector
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
        messages.append(("roller/stability", stamp, encode_roller(record.stability, stamp)))
    if record.track is not None:
        for track in record.track.tracks:
            messages.append(("roller/track", stamp, encode_roller(_track(model, record, record.track, track), stamp)))
    for measured in record.volumes:
        messages.append(("roller/volumes", stamp, encode_roller(_volumes(record.block, measured), stamp)))
    messages += _bench(model, record, stamp, wall_time)
    messages.sort(key=lambda message: (message[1], TOPICS[message[0]].rank))
    return messages


def _contact(record: RollerRecord, stamp: int) -> Messages:
    columns = record.contacts.T.copy()
    along_x, along_y, angle, peak, approach = columns[:5]
    zeros = numpy.zeros_like(record.load)
    force = ContactForceBlock(record.block, record.period, record.load, zeros, approach, zeros)
    value = RollerContact(
        record.block, record.period, record.load, along_x, along_y, angle, peak, approach, record.angles[:, 0].copy(),
        record.angles[:, 1].copy(), record.heave[0].copy(),
    )  # fmt: skip
    return [
        ("roller/force", stamp, encode_contact_force(force, stamp, ROLLER_FRAME)),
        ("roller/contact", stamp, encode_roller(value, stamp)),
    ]


def _track(model: RollerModel, record: RollerRecord, ride: TrackRide, track: BodyTrack) -> RollerTrack:
    checked = record.checked or Checked(0, math.nan)
    return RollerTrack(
        record.block, track.body, float(track.turned), track.turned * model.acceleration, track.turn_time, track.radius,
        track.heights.copy(), track.loads.copy(), track.lowered, track.range, ride.free, float(checked.intervals * track.turns),
        checked.error,
    )  # fmt: skip


def _volumes(block: int, measured: Measured) -> RollerVolumes:
    contact = measured.contact
    bent = numpy.zeros(0) if measured.bent is None else numpy.array(measured.bent)
    return RollerVolumes(
        block, measured.time, contact.load, contact.along_x, contact.along_y, contact.angle, contact.peak_pressure,
        contact.approach, *measured.limits, measured.working, numpy.array(measured.own), bent,
    )  # fmt: skip


def _bench(model: RollerModel, record: RollerRecord, stamp: int, wall_time: float) -> Messages:
    position = numpy.vstack([record.heave[0], record.angles[:, 0], record.angles[:, 1]])
    velocity = numpy.vstack([record.heave[1], record.angles[:, 2], record.angles[:, 3]])
    motion = MotionBlock(record.block, record.period, BODIES, position, velocity, record.acceleration)
    factor = model.timing.block_length / wall_time
    cost = Cost(record.block, wall_time, factor, record.steps, 0, 0, 0, 0.0, 0.0, 0, 0, 0.0)
    ledger = Energy(record.block, *record.energy, record.energy.residual)
    return [
        ("bench/motion", stamp, encode_motion(motion, stamp)), ("bench/energy", stamp, encode_energy(ledger, stamp)),
        ("bench/cost", stamp, encode_cost(cost, stamp)),
    ]  # fmt: skip
