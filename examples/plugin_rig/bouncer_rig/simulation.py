"""The rig, block by block: a `BlockSimulation` of the bench."""

import math
import time

import numpy

from bouncer_rig.pad import GRAVITY, Pad, advance
from bouncer_rig.schema import FootSection, PadSection
from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.records.messages import BodyMotion, ContactForce
from contact_sim_pkg.run.block_simulation import BlockResult, InputBlock, refuse_out_of_turn
from contact_sim_pkg.run.outputs import BlockStamps, contact_outputs, energy_ledger, solver_cost
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.timing import make_timing

STEPS = 2000  # of a period of mass and spring, at a tolerance of 1e-4; the error falls with their square


class BouncerSimulation:
    """A mass that bounces on a pad; no excitation."""

    inputs: tuple[str, ...] = ()

    def __init__(self, scene: ResolvedScene) -> None:
        foot, pad = scene.section(FootSection), scene.effect("foot", PadSection)
        assert pad is not None  # it carries the load
        self._pad = Pad(foot.mass, pad.stiffness, pad.damping)
        self._timing = make_timing(scene, with_field=False)
        self.blocks, self._height, self._due = self._timing.blocks, foot.height, 0
        period = 2.0 * math.pi * math.sqrt(foot.mass / pad.stiffness)
        self._step = period / STEPS * math.sqrt(scene.integrator.relative_tolerance / 1e-4)
        self._state = numpy.array([foot.height, 0.0, 0.0])

    def prepare(self) -> None:
        """Compile the kernel; nothing is compiled in a run."""
        advance(self._pad, self._state.copy(), self._step, 1)

    def advance(self, block: int, inputs: dict[str, InputBlock]) -> BlockResult:
        """The samples of a block, each at the end of the steps before it."""
        began = time.perf_counter()
        refuse_out_of_turn(block, self._due)
        self._due, stamps, timing = block + 1, BlockStamps(block, self._timing), self._timing
        period = timing.block_length / timing.samples
        steps = max(1, math.ceil(period / self._step))
        rows = numpy.empty((timing.samples, 4))
        for sample in range(timing.samples):
            rows[sample, 3] = advance(self._pad, self._state, period / steps, 0)
            rows[sample, :3] = self._state
            advance(self._pad, self._state, period / steps, steps)
        outputs = [*self._outputs(stamps, rows), self._cost(stamps, began, steps * timing.samples)]
        return BlockResult(outputs, float(rows[:, 3].max()), 0.0, time.perf_counter() - began)

    def _outputs(self, stamps: BlockStamps, rows: numpy.ndarray) -> list[Output]:
        height, speed, heat, normal = rows.T
        still, mass = numpy.zeros(len(height)), self._pad.mass
        force = ContactForce(
            block=stamps.block, sample_period=stamps.period, normal=normal, tangential=still, approach=-height,
            effective_height=still,
        )  # fmt: skip
        motion = BodyMotion(
            block=stamps.block, sample_period=stamps.period, bodies=("mass_z",), position=height[None, :],
            velocity=speed[None, :], acceleration=(normal / mass - GRAVITY)[None, :],
        )  # fmt: skip
        ledger = energy_ledger(
            stamps.block, kinetic=0.5 * mass * speed[0] ** 2, potential=mass * GRAVITY * (height[0] - self._height),
            stored=0.5 * self._pad.stiffness * min(0.0, height[0]) ** 2, dissipated=heat[0], supplied=0.0,
        )  # fmt: skip
        return [
            *contact_outputs("foot", stamps, force),
            Output("bench/motion", stamps.start, motion),
            Output("bench/energy", stamps.start, ledger),
        ]

    @staticmethod
    def _cost(stamps: BlockStamps, began: float, steps: int) -> Output:
        return Output("bench/cost", stamps.start, solver_cost(stamps, time.perf_counter() - began, steps=steps))
