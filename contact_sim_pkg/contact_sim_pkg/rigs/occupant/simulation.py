"""The simulation of an occupant on a seat and against its back, block by block.

Pan and back are two rigs under one floor, and one bag: upwards the occupant of the rig ``seat`` on
the cushion, forward the moving mass or shell of the rig ``backrest``. To first order the two
directions do not act on each other: friction at one contact does not hold the motion at the other.
Motions stand side by side, energies and costs add up.
"""

from __future__ import annotations

import time

from contact_sim_pkg.rigs.backrest.simulation import BackrestSimulation
from contact_sim_pkg.rigs.occupant.outputs import combined
from contact_sim_pkg.rigs.vehicle.simulation import Simulation
from contact_sim_pkg.run.block_simulation import BlockResult, InputBlock
from contact_sim_pkg.run.vibration_drive import VIBRATION
from contact_sim_pkg.scene.resolved_scene import ResolvedScene


class OccupantSimulation:
    """Owns the state of a run: a ``BlockSimulation`` (run/block_simulation.py) made of two."""

    inputs: tuple[str, ...] = (VIBRATION,)

    def __init__(self, scene: ResolvedScene) -> None:
        """Build both rigs of a resolved scene."""
        self.scene = scene
        self.parts = (Simulation(scene), BackrestSimulation(scene))
        self.blocks = self.parts[0].blocks

    def prepare(self) -> None:
        """Compile or load every kernel that the scene needs."""
        for part in self.parts:
            part.prepare()

    def advance(self, block: int, inputs: dict[str, InputBlock]) -> BlockResult:
        """Advance block number ``block``; see ``BlockSimulation``."""
        began = time.perf_counter()
        results = [part.advance(block, inputs) for part in self.parts]
        outputs = combined([result.outputs for result in results])
        load, peak = max(r.load for r in results), max(r.peak_pressure for r in results)
        return BlockResult(outputs, load, peak, time.perf_counter() - began)
