"""The simulation of an occupant on a seat and against its back, block by block.

Pan and back are two rigs under one floor, and one bag: upwards the occupant of the rig ``seat`` on the cushion, forward the
moving mass or shell of the rig ``backrest``. To first order the two directions do not act on each other: friction at one contact
does not hold the motion at the other. Motions stand side by side, energies and costs add up.
"""

from __future__ import annotations

import time

import numpy

from contact_sim_pkg.bag.messages import decode, encode
from contact_sim_pkg.bag.topics import TOPICS
from contact_sim_pkg.records.messages import BodyMotion, EnergyLedger, SolverCost
from contact_sim_pkg.rigs.backrest.simulation import BackrestSimulation
from contact_sim_pkg.rigs.vehicle.simulation import Simulation
from contact_sim_pkg.run.block_simulation import BlockResult, InputBlock
from contact_sim_pkg.run.vibration_drive import VIBRATION
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

Message = tuple[str, int, bytes]
SHARED = ("bench/motion", "bench/energy", "bench/cost")
NANOSECONDS = 1_000_000_000


class OccupantSimulation:
    """Owns the state of a run: a ``BlockSimulation`` (run/block_simulation.py) made of two."""

    inputs: tuple[str, ...] = (VIBRATION,)

    def __init__(self, scene: ResolvedScene) -> None:
        """Build both rigs of a resolved scene."""
        self.scene = scene
        self.parts = (Simulation(scene), BackrestSimulation(scene))
        self.blocks = self.parts[0].blocks
        self._block_ns = round(float(scene.data["block_length"]) * NANOSECONDS)

    def prepare(self) -> None:
        """Compile or load every kernel that the scene needs."""
        for part in self.parts:
            part.prepare()

    def advance(self, block: int, inputs: dict[str, InputBlock]) -> BlockResult:
        """Advance block number ``block``; see ``BlockSimulation``."""
        began = time.perf_counter()
        results = [part.advance(block, inputs) for part in self.parts]
        messages = [message for result in results for message in result.messages if message[0] not in SHARED]
        messages += _together(results, block * self._block_ns)
        messages.sort(key=lambda message: (message[1], TOPICS[message[0]].rank))
        load, peak = max(r.load for r in results), max(r.peak_pressure for r in results)
        return BlockResult(messages, load, peak, time.perf_counter() - began)


def _together(results: list[BlockResult], stamp: int) -> list[Message]:
    """One message of motion, energy and cost, of those of both rigs."""
    found = [{topic: data for topic, _stamp, data in result.messages if topic in SHARED} for result in results]
    motions = [decode(BodyMotion, each["bench/motion"]) for each in found]
    energies = [decode(EnergyLedger, each["bench/energy"]) for each in found]
    costs = [decode(SolverCost, each["bench/cost"]) for each in found]
    return [
        ("bench/motion", stamp, encode(_motion(motions), stamp)),
        ("bench/energy", stamp, encode(_energy(energies), stamp)),
        ("bench/cost", stamp, encode(_cost(costs), stamp)),
    ]


def _motion(parts: list[BodyMotion]) -> BodyMotion:
    names = ("position", "velocity", "acceleration")
    rows = {name: numpy.vstack([getattr(part, name) for part in parts]) for name in names}
    bodies = tuple(body for part in parts for body in part.bodies)
    return BodyMotion(block=parts[0].block, sample_period=parts[0].sample_period, bodies=bodies, **rows)


def _energy(parts: list[EnergyLedger]) -> EnergyLedger:
    names = [name for name in EnergyLedger._fields if name != "block"]
    return EnergyLedger(block=parts[0].block, **{name: sum(getattr(part, name) for part in parts) for name in names})


def _cost(parts: list[SolverCost]) -> SolverCost:
    """Times and counts add up; of residuals, jumps and errors the largest counts."""
    block, wall = parts[0].block, sum(part.wall_time for part in parts)
    length = parts[0].real_time_factor * parts[0].wall_time
    steps, rejected, events, iterations, stretches, repeated = (
        sum(getattr(part, name) for part in parts)
        for name in ("steps", "rejected_steps", "events", "field_iterations", "stretches", "stretches_repeated")
    )
    residual, jump, error = (
        max(getattr(part, name) for part in parts) for name in ("field_residual", "field_jump", "coupling_error")
    )
    return SolverCost(
        block=block,
        wall_time=wall,
        real_time_factor=length / wall,
        steps=steps,
        rejected_steps=rejected,
        events=events,
        field_iterations=iterations,
        field_residual=residual,
        field_jump=jump,
        stretches=stretches,
        stretches_repeated=repeated,
        coupling_error=error,
    )
