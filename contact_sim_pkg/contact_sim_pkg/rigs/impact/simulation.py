"""The simulation of an impact scene, block by block. It takes no excitation: the machine releases
the sphere by its programme.
"""

from __future__ import annotations

import contextlib
import dataclasses
import math
import time

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.records.state import State
from contact_sim_pkg.rigs.impact.model import build_impact
from contact_sim_pkg.rigs.impact.motion import FinishedImpact, ImpactMotion
from contact_sim_pkg.rigs.impact.outputs import block_outputs
from contact_sim_pkg.rigs.impact.theory.contact import sample, touch
from contact_sim_pkg.rigs.impact.theory.viscoelastic.creep import maxwell
from contact_sim_pkg.rigs.impact.theory.viscoelastic.hereditary import hereditary_integral
from contact_sim_pkg.run.block_simulation import BlockResult, InputBlock, refuse_out_of_turn
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.scene.errors import Fault, SceneError
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.schema.catalog import show


class ImpactSimulation:
    """Owns the state of a run: a ``BlockSimulation`` (run/block_simulation.py)."""

    inputs: tuple[str, ...] = ()
    STATE = State(("motion", "_next_block"))

    def __init__(self, scene: ResolvedScene) -> None:
        """Build the model of a resolved scene; raises SceneError where a release is outside it, or
        its period too short.
        """
        self.scene = scene
        self.model = build_impact(scene)
        self.blocks = self.model.timing.blocks
        self._refuse_short_period()
        self.reset()

    def _refuse_short_period(self) -> None:
        """SceneError for a period in which a release does not fall, strike and part; fewer bounces
        than requested are a warning.
        """
        model = self.model
        if len(model.releases) < 2:
            return
        period = model.releases[1].time
        needed, speed = 0.0, 0.0
        for release in {(each.speed, each.temperature): each for each in model.releases}.values():
            alone = dataclasses.replace(model, releases=(release._replace(time=0.0),))
            with contextlib.suppress(RunError):  # the run itself reports it
                needed, speed = max((needed, speed), (ImpactMotion(alone).time_of(1), release.speed))
        if period <= needed:
            sentence = (
                f"{show(period)} s from one release to the next; a release at {show(speed)} m/s needs {needed:.6g} s until "
                f"its impact is over; make the period {_above(needed)} s or longer"
            )
            raise SceneError([Fault("scene", 0, 0, "impact.period", sentence)])

    def reset(self) -> None:
        """Before the first block."""
        self.motion = ImpactMotion(self.model)
        self._next_block = 0

    def prepare(self) -> None:
        """Compile or load the kernels of a contact and its effects."""
        release, few = self.motion.release, numpy.linspace(0.0, 1.0e-9, 3, dtype=numpy.float64)
        first = touch(self.model.touch(release.speed, release.temperature).law, release.speed)
        sample(first, few)
        hereditary_integral(maxwell(1.0, 1.0), few, few)
        self.reset()

    def advance(self, block: int, inputs: dict[str, InputBlock]) -> BlockResult:
        """Advance block number ``block``; see ``BlockSimulation``."""
        began = time.perf_counter()
        refuse_out_of_turn(block, self._next_block)
        timing = self.model.timing
        period = timing.block_length / timing.samples
        times: Vector = (block * timing.samples + numpy.arange(timing.samples, dtype=numpy.float64)) * period
        made = self.motion.made
        state = self.motion.state(times)
        ended = self.motion.pop_ended((block + 1) * timing.block_length)
        self._next_block = block + 1
        outputs = block_outputs(self.model, block, state, ended, self.motion.made - made, began)
        self.motion.drop_before((block + 1) * timing.block_length)
        largest = [float((state.elastic + state.viscous).max()), *(_peak(impact) for impact in ended)]
        return BlockResult(outputs, max(largest), 0.0, time.perf_counter() - began)


def _peak(impact: FinishedImpact) -> float:
    turns = impact.phases[0].turns
    return 0.0 if turns is None else turns.peak_force


def _above(value: float) -> str:
    """The next number above ``value`` > 0 of four digits."""
    unit = 10.0 ** (math.floor(math.log10(value)) - 3)
    return f"{(math.floor(value / unit) + 1) * unit:.4g}"
