"""What one block of the backrest simulation says, as encoded messages in canonical order."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.bag.topics import TOPICS
from contact_sim_pkg.pressure.mat import spread_force
from contact_sim_pkg.records.messages import (
    BodyMotion,
    ContactEpisodes,
    ContactForce,
    ContactPatch,
    ContactPoints,
    EnergyLedger,
    SolverCost,
)
from contact_sim_pkg.rigs.backrest import entries as columns
from contact_sim_pkg.rigs.backrest import parameters as episode
from contact_sim_pkg.rigs.backrest.model import BackrestModel
from contact_sim_pkg.rigs.backrest.parameters import BackrestMode
from contact_sim_pkg.run.mat_field import mat_field
from contact_sim_pkg.run.wrench import wrench_of

Array = NDArray[numpy.float64]
NANOSECONDS = 1_000_000_000


@dataclass
class BackrestRecord:
    """Samples of one block, and the episodes that ended in it."""

    block: int
    states: Array  # [samples, states]
    rates: Array  # [samples, states]
    forces: Array  # [samples, columns.FORCES]
    points: Array  # [samples, points, columns.POINT_COLUMNS]
    forward: Array  # [samples] [m/s^2] acceleration of the seat back
    energy: Array = field(default_factory=lambda: numpy.zeros(5))
    start_energy: Array = field(default_factory=lambda: numpy.zeros(5))
    counters: Array = field(default_factory=lambda: numpy.zeros(3))
    ended: Array = field(default_factory=lambda: numpy.zeros((0, episode.ENDED_COLUMNS)))
    peak_force: Array = field(default_factory=lambda: numpy.zeros(0))  # [episodes] [N]

    @classmethod
    def empty(cls, model: BackrestModel, block: int, forward: Array) -> BackrestRecord:
        """Room for one block of ``model``."""
        samples, states, points = model.timing.samples, len(model.start), len(model.rig.gaps)
        return cls(
            block, numpy.zeros((samples, states)), numpy.zeros((samples, states)),
            numpy.zeros((samples, columns.FORCES)), numpy.zeros((samples, points, columns.POINT_COLUMNS)), forward,
        )  # fmt: skip

    def take_episodes(self, model: BackrestModel, mode: BackrestMode, peak: Array) -> None:
        """Take the episodes that ended; ``peak`` [points + 1] [N] carries the largest force of those that last."""
        timing = model.timing
        times = self.block * timing.block_length + numpy.arange(timing.samples) * timing.block_length / timing.samples
        forces = numpy.column_stack([self.points[:, :, columns.POINT_NORMAL], self.forces[:, columns.NORMAL]])
        ended = mode.ended[: int(mode.counts[episode.ENDED])]
        one_point = self.points.shape[1] == 1  # which then is the whole contact
        self.ended = ended[ended[:, episode.PLACE] > 0.0] if one_point else ended.copy()
        self.peak_force = numpy.zeros(len(self.ended))
        for number, row in enumerate(self.ended):
            place = int(row[episode.PLACE])
            inside = (times >= row[episode.START]) & (times <= row[episode.CARRIED])
            self.peak_force[number] = max(forces[inside, place].max(initial=0.0), peak[place])
            peak[place] = 0.0
        lasting = times[:, None] >= mode.lasting[None, :, episode.START]
        numpy.maximum(peak, numpy.where(lasting, forces, 0.0).max(axis=0), out=peak)


def encode_backrest(
    model: BackrestModel, record: BackrestRecord, wall_time: float
) -> tuple[list[tuple[str, int, bytes]], float, float]:
    """Messages of a block in canonical order, largest normal force in [N] and largest pressure in [Pa]."""
    encoder = _Encoder(model, record)
    encoder.force()
    encoder.fields()
    encoder.episodes()
    encoder.bench(wall_time)
    encoder.messages.sort(key=lambda message: (message[1], TOPICS[message[0]].rank))
    return encoder.messages, float(record.forces[:, columns.NORMAL].max()), encoder.peak


class _Encoder:
    def __init__(self, model: BackrestModel, record: BackrestRecord) -> None:
        self.model, self.record, timing = model, record, model.timing
        self.block_ns = round(timing.block_length * NANOSECONDS)
        self.stamp = record.block * self.block_ns
        self.period = timing.block_length / timing.samples
        self.messages: list[tuple[str, int, bytes]] = []
        self.peak = 0.0

    def _stamp_of(self, sample: int) -> int:
        return self.stamp + sample * self.block_ns // self.model.timing.samples

    def force(self) -> None:
        """The resultant at the full rate, and wrenches at the display rate."""
        normal, tangential, approach = self.record.forces.T
        value = ContactForce(
            block=self.record.block,
            sample_period=self.period,
            normal=normal,
            tangential=tangential,
            approach=approach,
            effective_height=numpy.zeros_like(normal),
        )
        self.messages.append(("backrest/force", self.stamp, encode(value, self.stamp, "backrest_contact")))
        displays = self.model.timing.displays
        for i in range(displays):
            sample = i * self.model.timing.samples // displays
            stamp = self._stamp_of(sample)
            wrench = wrench_of((float(tangential[sample]), 0.0, float(normal[sample])), (0.0, 0.0, 0.0))
            self.messages.append(("backrest/wrench", stamp, encode(wrench, stamp, "backrest_contact")))

    def fields(self) -> None:
        """Pressure map and contact points at the field rate."""
        timing = self.model.timing
        for interval in range(timing.intervals):
            sample = interval * timing.segments // timing.sample_every
            stamp = self._stamp_of(sample)
            field_bytes = encode(self._patch(sample), stamp, "backrest_contact")
            self.messages.append(("backrest/patch", stamp, field_bytes))
            point_bytes = encode(self._points(sample), stamp, "backrest_contact")
            self.messages.append(("backrest/points", stamp, point_bytes))

    def _pressure(self, sample: int) -> Array:
        mat, model = self.model.mat, self.model
        if mat.by_points:
            normal = self.record.points[sample, :, columns.POINT_NORMAL]
            return numpy.ascontiguousarray(normal.reshape(mat.gap.shape)) / (mat.cell_x * mat.cell_y)
        force, approach = (float(self.record.forces[sample, k]) for k in (columns.NORMAL, columns.APPROACH))
        gap = mat.gap
        if mat.bent is not None:  # the approach is that of the nearest point: over it the gap is none
            gap = gap - (mat.bent @ self.record.states[sample, : len(model.rig.mass)]).reshape(gap.shape) + approach
        return spread_force(force, approach, model.rig.contact.elastic, gap, mat.cell_x * mat.cell_y)

    def _patch(self, sample: int) -> ContactPatch:
        mat, pressure = self.model.mat, self._pressure(sample)
        grid = (mat.cell_x, mat.cell_y, float(mat.x[0]), float(mat.y[0]))
        found = mat_field(self.record.block, grid, float(self.record.forces[sample, columns.APPROACH]), pressure)
        self.peak = max(self.peak, found.peak)
        return found

    def _points(self, sample: int) -> ContactPoints:
        rows = self.record.points[sample]
        return ContactPoints(
            block=self.record.block, x=self.model.point_x + rows[:, columns.POINT_UP],
            y=self.model.point_y + rows[:, columns.POINT_ACROSS], approach=rows[:, columns.POINT_APPROACH],
            normal=rows[:, columns.POINT_NORMAL], tangential=rows[:, columns.POINT_TANGENTIAL],
            displacement=rows[:, columns.POINT_DISPLACEMENT], state=rows[:, columns.POINT_STATE].astype(numpy.uint8),
        )  # fmt: skip

    def episodes(self) -> None:
        """The contact episodes that ended; nothing where none did."""
        rows = self.record.ended
        if len(rows) == 0:
            return
        place = rows[:, episode.PLACE].astype(numpy.int32)
        place[place == len(self.model.rig.gaps)] = ContactEpisodes.WHOLE_CONTACT
        closing, opening = rows[:, episode.CLOSING_WORK], rows[:, episode.OPENING_WORK]
        ratio = numpy.divide(opening, closing, out=numpy.zeros_like(closing), where=closing > 0.0)
        value = ContactEpisodes(
            block=self.record.block, point=place, touched=rows[:, episode.TOUCHED].astype(numpy.uint8),
            start=rows[:, episode.START], end=rows[:, episode.CARRIED], compression_work=-closing,
            restitution_work=opening, restitution=numpy.sqrt(numpy.maximum(ratio, 0.0)),
            peak_force=self.record.peak_force, largest_approach=rows[:, episode.DEEPEST],
        )  # fmt: skip
        self.messages.append(("bench/episodes", self.stamp, encode(value, self.stamp)))

    def bench(self, wall_time: float) -> None:
        """Motion, energy ledger at the block's start, and cost."""
        record = self.record
        motion = BodyMotion(block=record.block, sample_period=self.period, **_motion(self.model, record))
        self.messages.append(("bench/motion", self.stamp, encode(motion, self.stamp)))
        kinetic, potential, stored, supplied, dissipated = (float(v) for v in record.energy - record.start_energy)
        residual = supplied - kinetic - potential - stored - dissipated
        ledger = EnergyLedger(
            block=record.block,
            kinetic=kinetic,
            potential=potential,
            stored=stored,
            dissipated=dissipated,
            supplied=supplied,
            residual=residual,
        )
        self.messages.append(("bench/energy", self.stamp, encode(ledger, self.stamp)))
        steps, rejected, events = (int(value) for value in record.counters)
        factor = self.model.timing.block_length / wall_time
        cost = SolverCost(
            block=record.block,
            wall_time=wall_time,
            real_time_factor=factor,
            steps=steps,
            rejected_steps=rejected,
            events=events,
        )
        self.messages.append(("bench/cost", self.stamp, encode(cost, self.stamp)))


def _motion(model: BackrestModel, record: BackrestRecord) -> dict[str, Any]:
    """Names, positions, velocities and accelerations of ``bench/motion``; positions relative to the seat back.

    Modal coordinates are relative in their acceleration as well; that of the seat back is added to the others'.
    """
    modes = len(model.rig.mass)
    position = model.motion @ record.states[:, :modes].T
    velocity = model.motion @ record.states[:, modes : 2 * modes].T
    acceleration = model.motion @ record.rates[:, modes : 2 * modes].T
    acceleration[0] += record.forward
    still = numpy.zeros((1, len(record.states)))
    return {
        "bodies": ("seat_back_x", *model.coordinates),
        "position": numpy.vstack([still, position]),
        "velocity": numpy.vstack([still, velocity]),
        "acceleration": numpy.vstack([record.forward[None, :], acceleration]),
    }
