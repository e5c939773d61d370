"""The simulation of a rigid body over the ground, block by block."""

from __future__ import annotations

import time
from collections.abc import Mapping
from typing import TypeAlias

import numpy
import scipy  # its parts are imported on use: they take 0.1 to 0.3 s
from numpy.typing import NDArray

from contact_sim_pkg.records.state import State
from contact_sim_pkg.rigid.bodies.body import Motion, rise_to_ground
from contact_sim_pkg.rigid.bodies.motion import ACTIVE
from contact_sim_pkg.rigid.motion.compliant import CompliantMotion, sentence_of
from contact_sim_pkg.rigid.motion.located import LocatedBody
from contact_sim_pkg.rigid.problem import PLANE
from contact_sim_pkg.rigid.results import SENTENCES, SOLVED, STICK
from contact_sim_pkg.rigs.body.geometry import contact_arms
from contact_sim_pkg.rigs.body.model import BlockModel, build_block
from contact_sim_pkg.rigs.body.outputs import BodyRecord, block_outputs
from contact_sim_pkg.run.block_simulation import BlockResult, InputBlock, refuse_out_of_turn
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.run.outputs import largest
from contact_sim_pkg.run.saved_state import carry_state
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

Body: TypeAlias = LocatedBody | CompliantMotion
WARM_UP_IMPACT = 1e-4  # [m] above the ground, from which the warm-up drops the body


class BlockBodySimulation:
    """Owns the state of a run: a ``BlockSimulation`` (run/block_simulation.py). Nothing drives it
    but gravity and known forces.
    """

    inputs: tuple[str, ...] = ()
    STATE = State(("body", "_next_block", "_supplied"))

    def __init__(self, scene: ResolvedScene) -> None:
        """Build the parameters of a resolved scene."""
        self.scene = scene
        self.model = build_block(scene)
        self.blocks = self.model.timing.blocks
        self.reset()

    def reset(self) -> None:
        """Before the first block."""
        self.body: Body = body_of(self.model, _copy(self.model.start))
        self._next_block = 0
        self._start = self._kinetic_potential()
        self._supplied = 0.0

    def prepare(self) -> None:
        """Compile or load every kernel that the scene needs, by a drop onto all points at once."""
        model = self.model
        start = _copy(model.start)
        for state in (_above(model, start, WARM_UP_IMPACT), _above(model, start, 0.0)):
            body = body_of(model, state)
            state.velocity[:] = 0.0
            state.velocity[model.body.width - 1] = -0.1
            for _ in range(3):
                status_after(body, model, 1e-3)  # however it ends: the run has another start
        if model.contact is None:
            _warm_up(model)
        contact_arms(model, model.start.position, model.start.rotation)

    def take_over(self, before: BlockBodySimulation, block: int, inputs: Mapping[str, InputBlock]) -> None:
        """See `Steerable`: friction and restitution hold no energy."""
        carry_state(before, self, "the body")
        self._start = before._start

    def advance(self, block: int, inputs: dict[str, InputBlock]) -> BlockResult:
        """Advance block number ``block``; see ``BlockSimulation``."""
        began = time.perf_counter()
        refuse_out_of_turn(block, self._next_block)
        timing = self.model.timing
        record = BodyRecord.empty(self.model, block)
        self._ledger(record)
        events, solves = getattr(self.body, "events", 0), getattr(self.body, "solves", 0)
        if isinstance(self.body, LocatedBody):
            self._run_located(self.body, record, block)
        else:
            self._run_samples(record, block)
        record.look(self.model)
        self._supplied += self._known_work(record)
        record.events = getattr(self.body, "events", 0) - events
        record.steps = getattr(self.body, "solves", 0) - solves or timing.samples
        self._next_block = block + 1
        outputs = block_outputs(self.model, record, time.perf_counter() - began)
        return BlockResult(outputs, largest(outputs, "force", "normal"), 0.0, time.perf_counter() - began)

    def _run_located(self, body: LocatedBody, record: BodyRecord, block: int) -> None:
        """All samples of a block in one call."""
        timing = self.model.timing
        interval = timing.block_length / timing.samples
        record.take_start(body.motion)
        status, track = body.advance_over(interval, timing.samples)
        if status != SOLVED:
            at = block * timing.block_length + body.reached
            raise RunError(f"block {block}, {at:.6g} s: {SENTENCES[status]}")
        record.position[1:], record.angle[1:], record.rotation[1:] = track.position, track.angle, track.rotation
        record.velocity[1:], record.residual = track.velocity, body.residual
        sticking = track.sticks > 0.0
        for impact in body.impacts:
            sample = min(int(impact.time / interval), timing.samples - 1)
            sticking[sample, list(impact.points)] |= numpy.array(impact.modes) == STICK
        record.take_impulses(self.model, track.impulse / interval, sticking)

    def _run_samples(self, record: BodyRecord, block: int) -> None:
        """One call a sample."""
        timing = self.model.timing
        interval = timing.block_length / timing.samples
        rows = len(self.body.impulse)
        force, sticking = (
            numpy.zeros((timing.samples, rows)),
            numpy.zeros((timing.samples, rows // self.model.body.width), bool),
        )
        record.take_start(self.body.motion)
        for sample in range(timing.samples):
            at = block * timing.block_length + sample * interval
            move(self.body, self.model, interval, f"block {block}, {at:.6g} s")
            record.take_state(sample + 1, self.body.motion)
            force[sample], sticking[sample] = self.body.impulse / interval, self._sticks()
            record.residual = max(record.residual, getattr(self.body, "residual", 0.0))
        record.take_impulses(self.model, force, sticking)

    def _sticks(self) -> NDArray[numpy.bool_]:
        if isinstance(self.body, CompliantMotion):
            return self.body.sticks()
        work, width = self.body.work, self.model.body.width
        velocity = (work.J @ self.body.motion.velocity).reshape(-1, width)
        scale = max(float(numpy.abs(self.body.motion.velocity).max()), 1e-9)
        slow: NDArray[numpy.bool_] = (numpy.abs(velocity[:, 1:]).max(axis=1) <= 1e-9 * scale) & (work.flags >= ACTIVE)
        return slow

    def _known_work(self, record: BodyRecord) -> float:
        """Of the known force and torque over a block in [J]; the turn in space is the sum of those
        from sample to sample.
        """
        model, moved = self.model, record.position[-1] - record.position[0]
        if model.body.width == PLANE:
            turned = float(record.angle[-1] - record.angle[0])
            return float(model.force[0] * moved[0] + model.force[2] * moved[1] - model.torque[1] * turned)
        if not model.torque.any():
            return float(model.force @ moved)
        turns = scipy.spatial.transform.Rotation.from_matrix(
            record.rotation[1:] @ record.rotation[:-1].transpose(0, 2, 1)
        ).as_rotvec()
        return float(model.force @ moved + model.torque @ turns.sum(axis=0))

    def _kinetic_potential(self) -> tuple[float, float]:
        motion, body = self.body.motion, self.model.body
        spin = motion.velocity[2:] if body.width == PLANE else motion.rotation.T @ motion.velocity[3:]
        speed = motion.velocity[: body.width]
        kinetic = 0.5 * body.mass * float(speed @ speed) + 0.5 * float(body.inertia @ spin**2)
        return kinetic, body.mass * self.model.gravity * float(motion.position[-1])

    def _ledger(self, record: BodyRecord) -> None:
        kinetic, potential = self._kinetic_potential()
        changes = (kinetic - self._start[0], potential - self._start[1])
        record.energy[:] = (*changes, getattr(self.body, "stored", 0.0), self.body.dissipated, self._supplied)


def move(body: Body, model: BlockModel, interval: float, where: str = "block") -> None:
    """Move ``body`` by ``interval`` [s]. Raises RunError, which begins with ``where``, if it cannot
    be done.
    """
    status = status_after(body, model, interval)
    if status != SOLVED:
        why = sentence_of(status) if isinstance(body, CompliantMotion) else SENTENCES[status]
        raise RunError(f"{where}: {why}")


def status_after(body: Body, model: BlockModel, interval: float) -> int:
    """Move ``body`` by ``interval`` [s]; returns a status."""
    return body.advance(interval)


def body_of(model: BlockModel, motion: Motion) -> Body:
    """The body of a scene at ``motion``, which changes in place, under the contact of
    ``model``.
    """
    if model.contact is not None:
        return CompliantMotion(model.body, model.ground, motion, model.contact, model.tolerance)
    return LocatedBody(model.body, model.ground, motion, model.rule, model.facets, model.tolerance)


def _copy(motion: Motion) -> Motion:
    return Motion(*(numpy.array(part) for part in motion))


def _above(model: BlockModel, motion: Motion, height: float) -> Motion:
    """The body raised or lowered along z until it is ``height`` [m] over the ground."""
    state = _copy(motion)
    state.position[-1] += height + rise_to_ground(model.body, model.ground, state)
    return state


def _warm_up(model: BlockModel) -> None:
    """Load the solvers that the drop did not call."""
    body = LocatedBody(model.body, model.ground, _above(model, model.start, 0.0), model.rule, model.facets)
    body.warm_up()


def warm_up_solvers(scene: ResolvedScene) -> None:
    """Compile, in a second process, what the drop of `prepare` comes to last."""
    model = build_block(scene)
    if model.contact is None:
        _warm_up(model)
