"""Pairs of runs of `bench effects`: a scene with an effect and without it, alternating.

Both runs of all pairs hold the same blocks: up to `DURATION`, fewer where the slower scene would
need more than its part of `SECONDS`. The cost of a block is the median over the blocks. Where the
work falls into few of them (an impact, a check), the median says nothing: each run is then made up
to `RUNS_OF_BURSTS` times, and the mean of each block's least time counts.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from typing import NamedTuple

import numpy

from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.records.effect import Observed
from contact_sim_pkg.records.messages import ContactForce, VibrationBlock
from contact_sim_pkg.run.block_simulation import BlockSimulation, InputBlock
from contact_sim_pkg.run.rigs import make_simulation
from contact_sim_pkg.run.sources import make_sources
from contact_sim_pkg.scene.resolve import ResolvedScene

__all__ = ["AblationRun", "Pair", "paired"]

DURATION = 1.0  # [s] simulated a run, at most
SECONDS = 15.0  # of wall time for the blocks of all runs with and without one effect, about
PAIRS = 3
RUNS_OF_BURSTS = 5
BURST = 2.0
"""Mean over median time of a block from which the work comes in bursts."""


class AblationRun(NamedTuple):
    """One run: its cost, what the rules of effects see of it, and all its outputs."""

    cost: float  # [ms] per simulated second
    observed: Observed
    outputs: list[Output]


class Pair(NamedTuple):
    """A run with and one without the effect, each with its median cost; cost differences of the
    pairs.
    """

    with_it: AblationRun
    without_it: AblationRun
    differences: list[float]  # [ms] per simulated second
    duration: float  # [s] simulated


class _Plan(NamedTuple):
    blocks: int
    repeats: int
    bursts: bool


def paired(first: ResolvedScene, second: ResolvedScene, notify: Callable[[str], None]) -> Pair:
    """Pairs of runs of two scenes, alternating; costs in [ms] per simulated second.

    `notify` receives each phase as a sentence. Raises RunError where a run fails.
    """
    # Compile first: nearly all the time of a first study goes there.
    began = time.perf_counter()
    for name, scene in (("with", first), ("without", second)):
        notify(f"  kernels {name} it: compiled, or from the disk")
        _prepared(scene)
    plan, length = _plan(first, second), first.block_length
    often = "" if plan.repeats == 1 else f", each {plan.repeats} times"
    what = f"{PAIRS} runs of {plan.blocks * length:.3g} s of both by turns{often}"
    notify(f"  {what}, behind {time.perf_counter() - began:.0f} s of preparation")
    pairs = [(_run(first, plan), _run(second, plan)) for _ in range(PAIRS)]
    # The first pair stands for all, with the median of the costs.
    costs = [statistics.median(pair[place].cost for pair in pairs) for place in (0, 1)]
    differences = [one.cost - other.cost for one, other in pairs]
    with_it, without_it = (run._replace(cost=cost) for run, cost in zip(pairs[0], costs, strict=True))
    return Pair(with_it, without_it, differences, plan.blocks * length)


def _plan(first: ResolvedScene, second: ResolvedScene) -> _Plan:
    """Number of blocks that both scenes simulate in their part of the time, from a trial of
    each.
    """
    part = SECONDS / (2 * PAIRS)
    trials = [_walls(scene, _most_blocks(scene), part)[0] for scene in (first, second)]
    bursts = any(numpy.mean(walls) > BURST * numpy.median(walls) for walls in trials)
    blocks = min(len(walls) for walls in trials)
    fitting = int(part / max(sum(walls[:blocks]) for walls in trials))
    return _Plan(blocks, min(RUNS_OF_BURSTS, max(1, fitting)) if bursts else 1, bursts)


def _run(scene: ResolvedScene, plan: _Plan) -> AblationRun:
    """One run without a bag; the cost is that of the simulation alone."""
    walls, outputs, inputs = _walls(scene, plan.blocks)
    cost = float(numpy.median(walls))
    if plan.bursts:
        again = [_walls(scene, plan.blocks)[0] for _ in range(plan.repeats - 1)]
        cost = float(numpy.min([walls, *again], axis=0).mean())
    return AblationRun(1e3 * cost / scene.block_length, _observed(outputs, inputs), outputs)


def _walls(
    scene: ResolvedScene, blocks: int, most_time: float = numpy.inf
) -> tuple[list[float], list[Output], list[InputBlock]]:
    """Wall time of each block [s], all outputs, all inputs, up to the block that exceeds
    `most_time` [s].
    """
    sources, simulation = make_sources(scene), _prepared(scene)
    walls: list[float] = []
    outputs: list[Output] = []
    inputs: list[InputBlock] = []
    for block in range(blocks):
        driving = {topic: source.block(block) for topic, source in sources.items()}
        result = simulation.advance(block, driving)
        walls.append(result.wall_time)
        outputs += result.outputs
        inputs += driving.values()
        if sum(walls) > most_time:
            break
    return walls, outputs, inputs


def _most_blocks(scene: ResolvedScene) -> int:
    return max(1, round(min(DURATION, scene.duration) / scene.block_length))


def _prepared(scene: ResolvedScene) -> BlockSimulation:
    simulation = make_simulation(scene)
    simulation.prepare()
    return simulation


def _observed(outputs: list[Output], inputs: list[InputBlock]) -> Observed:
    """What the rules of effects see of a run: its normal forces and its fore-aft excitation."""
    parts: dict[str, list[Vector]] = {}
    for topic, _stamp, record, _frame in outputs:
        if isinstance(record, ContactForce):
            parts.setdefault(topic.partition("/")[0], []).append(record.normal)
    forces = {contact: numpy.concatenate(found) for contact, found in parts.items()}
    opens = {contact: bool((force <= 0.0).any()) for contact, force in forces.items()}
    shaken = [numpy.abs(block.acceleration_x).max() for block in inputs if isinstance(block, VibrationBlock)]
    return Observed(forces, opens, float(max(shaken, default=0.0)))
