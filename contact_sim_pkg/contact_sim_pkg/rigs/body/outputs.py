"""Outputs of a rigid body: samples of one block, and columns of its messages."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.records.messages import BodyMotion, ContactForce, ContactPoints
from contact_sim_pkg.rigid.bodies.body import Motion, contact_count
from contact_sim_pkg.rigid.problem import PLANE
from contact_sim_pkg.rigs.body.geometry import contact_arms, gaps, in_ground_axes
from contact_sim_pkg.rigs.body.model import BlockModel
from contact_sim_pkg.rigs.body.resultant import resultant
from contact_sim_pkg.run.outputs import BlockStamps, energy_ledger, solver_cost, wrench_of

Array = NDArray[numpy.float64]
PLANE_NAMES = ("block_x", "block_z", "block_pitch")
SPACE_NAMES = ("block_x", "block_y", "block_z", "block_rotation_x", "block_rotation_y", "block_rotation_z")


@dataclass
class BodyRecord:
    """Samples of one block: states at the starts of the samples and at its end, forces as means
    over each sample.
    """

    block: int
    position: Array  # [samples + 1, width]
    angle: Array  # [samples + 1]
    rotation: Array  # [samples + 1, width, width]
    velocity: Array  # [samples + 1, coordinates]
    gap: Array  # [samples], of the lowest contact
    force: Array  # [samples, contacts, width], normal, then tangents
    states: NDArray[numpy.int64]  # [samples, contacts]
    # kinetic, potential, stored, dissipated, supplied
    energy: Array = field(default_factory=lambda: numpy.zeros(5))
    residual: float = 0.0
    events: int = 0
    steps: int = 0

    @classmethod
    def empty(cls, model: BlockModel, block: int) -> BodyRecord:
        """Room for one block of ``model``."""
        samples, width, contacts = model.timing.samples, model.body.width, contact_count(model.body, model.ground)
        zeros, ends = numpy.zeros, samples + 1
        return cls(
            block, position=zeros((ends, width)), angle=zeros(ends), rotation=zeros((ends, width, width)),
            velocity=zeros((ends, len(model.body.load))), gap=zeros(samples), force=zeros((samples, contacts, width)),
            states=zeros((samples, contacts), numpy.int64),
        )  # fmt: skip

    def take_start(self, motion: Motion) -> None:
        """State at the start of the block."""
        self.take_state(0, motion)

    def take_state(self, sample: int, motion: Motion) -> None:
        """State at the start of a sample."""
        self.position[sample], self.angle[sample] = motion.position, motion.angle[0]
        self.rotation[sample], self.velocity[sample] = motion.rotation, motion.velocity

    def take_impulses(self, model: BlockModel, force: Array, sticking: NDArray[numpy.bool_]) -> None:
        """Mean forces over all samples, [samples, rows] in [N], and which contacts stick, [samples,
        contacts].
        """
        self.force[:] = force.reshape(self.force.shape)
        self.states[:] = numpy.where(
            self.force[:, :, 0] > 0.0, numpy.where(sticking, ContactPoints.STICKS, ContactPoints.SLIPS), 0
        )

    def look(self, model: BlockModel) -> None:
        """Gaps of the states that were taken."""
        self.gap[:] = gaps(model, self.position[:-1], self.rotation[:-1])


def block_outputs(model: BlockModel, record: BodyRecord, wall_time: float) -> list[Output]:
    """The outputs of a block that took ``wall_time`` [s]."""
    stamps = BlockStamps(record.block, model.timing)
    normal, tangential = record.force[:, :, 0].sum(axis=1), record.force[:, :, 1].sum(axis=1)
    force = ContactForce(
        block=record.block, sample_period=stamps.period, normal=normal, tangential=tangential, approach=-record.gap,
        effective_height=numpy.zeros_like(normal),
    )  # fmt: skip
    names, position, velocity = _coordinates(model, record)
    motion = BodyMotion(
        block=record.block, sample_period=stamps.period, bodies=names, position=position[:, :-1],
        velocity=velocity[:, :-1], acceleration=numpy.diff(velocity, axis=1) / stamps.period,
    )  # fmt: skip
    kinetic, potential, stored, dissipated, supplied = (float(value) for value in record.energy)
    ledger = energy_ledger(
        record.block, kinetic=kinetic, potential=potential, stored=stored, dissipated=dissipated, supplied=supplied
    )
    cost = solver_cost(stamps, wall_time, steps=record.steps, events=record.events, field_residual=record.residual)
    return [
        Output("block/force", stamps.start, force), *_wrenches(model, record, stamps), *_points(model, record, stamps),
        Output("bench/motion", stamps.start, motion), Output("bench/energy", stamps.start, ledger),
        Output("bench/cost", stamps.start, cost),
    ]  # fmt: skip


def _wrenches(model: BlockModel, record: BodyRecord, stamps: BlockStamps) -> Iterator[Output]:
    """Mean wrench on the body about its centre of mass over a display period.

    In the axes of a plane ground; in those of the world over heights.
    """
    uneven = len(model.ground.profile.nodes) > 0
    starts = [*stamps.displayed(), model.timing.samples]
    for first, last in itertools.pairwise(starts):
        wrench = wrench_of(*(_over_heights if uneven else _on_a_plane)(model, record, first, last))
        yield Output("block/wrench", stamps.at(first), wrench, "bench" if uneven else "")


def _on_a_plane(model: BlockModel, record: BodyRecord, first: int, last: int) -> tuple[list[float], list[float]]:
    """Force (along, across, normal) and torque of the samples from first to last, of the forces and
    where they act.
    """
    force = record.force[first:last].mean(axis=0)  # [contacts, width]
    arms = in_ground_axes(model, _in_space(contact_arms(model, record.position[first], record.rotation[first])))
    across = float(force[:, 2].sum()) if model.body.width != PLANE else 0.0
    torque = numpy.cross(arms, _forces_in_space(force)).sum(axis=0)
    return [float(force[:, 1].sum()), across, float(force[:, 0].sum())], torque.tolist()


def _over_heights(model: BlockModel, record: BodyRecord, first: int, last: int) -> tuple[list[float], list[float]]:
    """Force and torque of the samples from first to last: each face has axes of its own, which
    momentum does not need.
    """
    ends, time = [first, last], (last - first) * model.timing.block_length / model.timing.samples
    force, torque = resultant(model.body, record.rotation[ends], record.velocity[ends], time)
    return force.tolist(), torque.tolist()


def _in_space(arms: Array) -> Array:
    return arms if arms.shape[1] == 3 else numpy.column_stack([arms[:, 0], numpy.zeros(len(arms)), arms[:, 1]])


def _forces_in_space(force: Array) -> Array:
    """Rows (along, across, normal) of forces (normal, tangents) in the axes of the ground."""
    across = force[:, 2] if force.shape[1] == 3 else numpy.zeros(len(force))
    return numpy.column_stack([force[:, 1], across, force[:, 0]])


def _points(model: BlockModel, record: BodyRecord, stamps: BlockStamps) -> Iterator[Output]:
    """The candidate contacts at the field rate, forces as means from one field to the next."""
    timing = model.timing
    for interval in range(timing.intervals):
        first, last = (place * timing.samples // timing.intervals for place in (interval, interval + 1))
        arms = _in_space(contact_arms(model, record.position[first], record.rotation[first]))
        force = record.force[first:last].mean(axis=0)
        points = ContactPoints(
            block=record.block, x=arms[:, 0], y=arms[:, 1], approach=numpy.zeros(len(arms)), normal=force[:, 0],
            tangential=force[:, 1], displacement=numpy.full(len(arms), record.position[first, 0]) + arms[:, 0],
            state=record.states[first:last].max(axis=0).astype(numpy.uint8),
        )  # fmt: skip
        yield Output("block/points", stamps.at(first), points)


def _coordinates(model: BlockModel, record: BodyRecord) -> tuple[tuple[str, ...], Array, Array]:
    """Names, positions and velocities [coordinates, samples + 1]; pitch is positive from z to x, as
    a rotation about y.
    """
    if model.body.width == PLANE:
        position = numpy.vstack([record.position.T, -record.angle])
        return PLANE_NAMES, position, record.velocity.T * numpy.array([[1.0], [1.0], [-1.0]])
    turns = numpy.array([rotation_vector(turn @ model.axes.T) for turn in record.rotation])
    return SPACE_NAMES, numpy.vstack([record.position.T, turns.T]), record.velocity.T


def rotation_vector(rotation: Array) -> Array:
    """Rotation vector in [rad], of length 0 to pi, of a rotation matrix; by its quaternion, exact
    near 0 and pi.
    """
    m = rotation
    trace = float(numpy.trace(m))
    # from the largest component of the quaternion, which loses no digits
    squares = numpy.array([1.0 + trace, *(1.0 - trace + 2.0 * m[i, i] for i in range(3))])
    greatest = int(squares.argmax())
    if greatest == 0:
        quaternion = numpy.array([squares[0], m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]])
    else:
        i, j, k = greatest - 1, greatest % 3, (greatest + 1) % 3
        quaternion = numpy.zeros(4)
        quaternion[0] = m[k, j] - m[j, k]
        quaternion[1 + i], quaternion[1 + j], quaternion[1 + k] = (
            squares[greatest],
            m[j, i] + m[i, j],
            m[k, i] + m[i, k],
        )
    # of both signs the one with an angle up to pi
    quaternion /= numpy.linalg.norm(quaternion)
    if quaternion[0] < 0.0:
        quaternion = -quaternion
    sine = float(numpy.linalg.norm(quaternion[1:]))
    if sine == 0.0:
        return numpy.zeros(3)
    return numpy.asarray(2.0 * numpy.arctan2(sine, quaternion[0]) / sine * quaternion[1:])
