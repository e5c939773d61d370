"""Outputs of the backrest: samples of one block, and columns of its messages."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.records.messages import BodyMotion, ContactEpisodes, ContactForce, ContactPoints, EnergyLedger
from contact_sim_pkg.rigs.backrest import entries as columns
from contact_sim_pkg.rigs.backrest import parameters as episode
from contact_sim_pkg.rigs.backrest.model import BackrestModel
from contact_sim_pkg.rigs.backrest.parameters import BackrestMode
from contact_sim_pkg.run.contact_patch import contact_patch
from contact_sim_pkg.run.outputs import BlockStamps, Centre, contact_outputs, energy_ledger, solver_cost

Array = NDArray[numpy.float64]


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
    maps: list[tuple[int, Array]] = field(default_factory=list)  # sample, pressure [rows, cols] [Pa] on the mat

    @classmethod
    def empty(cls, model: BackrestModel, block: int, forward: Array) -> BackrestRecord:
        """Room for one block of ``model``."""
        samples, states, points = model.timing.samples, len(model.start), len(model.rig.gaps)
        return cls(
            block, numpy.zeros((samples, states)), numpy.zeros((samples, states)),
            numpy.zeros((samples, columns.FORCES)), numpy.zeros((samples, points, columns.POINT_COLUMNS)), forward,
        )  # fmt: skip

    def store_episodes(self, model: BackrestModel, mode: BackrestMode, peak: Array) -> None:
        """Store the episodes that ended; ``peak`` [points + 1] [N] carries the largest force of
        those that last.
        """
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


def block_outputs(model: BackrestModel, record: BackrestRecord, wall_time: float) -> list[Output]:
    """Outputs of a block, computed in ``wall_time`` [s]."""
    stamps = BlockStamps(record.block, model.timing)
    normal, tangential, approach = record.forces.T
    force = ContactForce(
        block=record.block, sample_period=stamps.period, normal=normal, tangential=tangential, approach=approach,
        effective_height=numpy.zeros_like(normal),
    )  # fmt: skip
    motion = BodyMotion(block=record.block, sample_period=stamps.period, **_motion(model, record))
    steps, rejected, events = (int(value) for value in record.counters)
    cost = solver_cost(stamps, wall_time, steps=steps, rejected_steps=rejected, events=events)
    episodes = [Output("bench/episodes", stamps.start, _episodes(model, record))] if len(record.ended) else []
    return [
        *_contact(model, record, stamps, force), *episodes,
        Output("bench/motion", stamps.start, motion), Output("bench/energy", stamps.start, _ledger(record)),
        Output("bench/cost", stamps.start, cost),
    ]  # fmt: skip


def _contact(
    model: BackrestModel, record: BackrestRecord, stamps: BlockStamps, force: ContactForce
) -> Iterator[Output]:
    """Force and wrench; pressure map and contact points at the field rate."""
    mat, patches = model.mat, []
    grid = (mat.cell_x, mat.cell_y, float(mat.x[0]), float(mat.y[0]))
    if model.cushion is not None:
        grid = model.cushion.cells
    for sample, pressure in record.maps:
        patch = contact_patch(record.block, grid, float(record.forces[sample, columns.APPROACH]), pressure)
        patches.append((sample, patch))
        yield Output("backrest/points", stamps.at(sample), _points(model, record, sample))
    if record.points.shape[1] == 1:  # the whole contact in one point: its map tells where it acts
        yield from contact_outputs("backrest", stamps, force, patches)
        return
    x, y, normal = (record.points[:, :, k] for k in (columns.POINT_UP, columns.POINT_ACROSS, columns.POINT_NORMAL))
    x, y = model.point_x + x, model.point_y + y
    total = numpy.where(normal.sum(axis=1) > 0.0, normal.sum(axis=1), 1.0)
    at = (x * normal).sum(axis=1) / total, (y * normal).sum(axis=1) / total
    centres = [Centre(sample, float(at[0][sample]), float(at[1][sample])) for sample in stamps.displayed()]
    # friction acts up the back
    turning = -(y * record.points[:, :, columns.POINT_TANGENTIAL]).sum(axis=1)
    lateral = numpy.column_stack([numpy.zeros_like(turning), turning])
    yield from contact_outputs("backrest", stamps, force, patches, centres=centres, lateral=lateral)


def _points(model: BackrestModel, record: BackrestRecord, sample: int) -> ContactPoints:
    rows = record.points[sample]
    return ContactPoints(
        block=record.block, x=model.point_x + rows[:, columns.POINT_UP], y=model.point_y + rows[:, columns.POINT_ACROSS],
        approach=rows[:, columns.POINT_APPROACH], normal=rows[:, columns.POINT_NORMAL],
        tangential=rows[:, columns.POINT_TANGENTIAL], displacement=rows[:, columns.POINT_DISPLACEMENT],
        state=rows[:, columns.POINT_STATE].astype(numpy.uint8),
    )  # fmt: skip


def _episodes(model: BackrestModel, record: BackrestRecord) -> ContactEpisodes:
    """The contact episodes that ended."""
    rows = record.ended
    place = rows[:, episode.PLACE].astype(numpy.int32)
    place[place == len(model.rig.gaps)] = ContactEpisodes.WHOLE_CONTACT
    closing, opening = rows[:, episode.CLOSING_WORK], rows[:, episode.OPENING_WORK]
    ratio = numpy.divide(opening, closing, out=numpy.zeros_like(closing), where=closing > 0.0)
    return ContactEpisodes(
        block=record.block, point=place, touched=rows[:, episode.TOUCHED].astype(numpy.uint8),
        start=rows[:, episode.START], end=rows[:, episode.CARRIED], compression_work=-closing,
        restitution_work=opening, restitution=numpy.sqrt(numpy.maximum(ratio, 0.0)),
        peak_force=record.peak_force, largest_approach=rows[:, episode.DEEPEST],
    )  # fmt: skip


def _ledger(record: BackrestRecord) -> EnergyLedger:
    """The energy ledger at the block's start."""
    kinetic, potential, stored, supplied, dissipated = (float(v) for v in record.energy - record.start_energy)
    return energy_ledger(
        record.block, kinetic=kinetic, potential=potential, stored=stored, dissipated=dissipated, supplied=supplied
    )


def _motion(model: BackrestModel, record: BackrestRecord) -> dict[str, Any]:
    """Names, positions, velocities and accelerations of ``bench/motion``; positions relative to the
    seat back.

    Modal coordinates are relative in their acceleration as well; that of the seat back is added to
    the others'.
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
