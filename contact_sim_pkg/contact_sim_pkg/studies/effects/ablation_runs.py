"""Pairs of runs of `bench effects`: a scene with an effect and without it, by turns, as long as the
time for them allows.

Both runs of all pairs hold the same blocks: up to `DURATION`, fewer where the slower scene would
take more than its part of `SECONDS`. What a block costs is the median over the blocks; where the
work falls into few of them (an impact, a check), the median says nothing: each run is then made up
to `RUNS_OF_BURSTS` times, and the mean of each block's least time counts.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy

from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.records.effect import Observed
from contact_sim_pkg.records.messages import ContactForce
from contact_sim_pkg.run.block_simulation import BlockSimulation
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

Messages = list[tuple[str, int, bytes]]


class AblationRun(NamedTuple):
    """One run: cost, the normal force of each contact [N], what the rules look at, and all that it
    said.
    """

    cost: float  # [ms] per simulated second
    forces: dict[str, Vector]
    observed: Observed
    messages: Messages


class Pair(NamedTuple):
    """A run with and one without the effect, each with the median of its costs; costs of each pair
    apart.
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
    """Both scenes by turns. Compiled first: nearly all the time of a first study goes there, and it
    tells so.
    """
    began = time.perf_counter()
    for name, scene in (("with", first), ("without", second)):
        notify(f"  kernels {name} it: compiled, or from the disk")
        _prepared(scene)
    plan, length = _plan(first, second), float(first.data["block_length"])
    often = "" if plan.repeats == 1 else f", each {plan.repeats} times"
    what = f"{PAIRS} runs of {plan.blocks * length:.3g} s of both by turns{often}"
    notify(f"  {what}, behind {time.perf_counter() - began:.0f} s of preparation")
    pairs = [(_run(first, plan), _run(second, plan)) for _ in range(PAIRS)]
    costs = [statistics.median(pair[place].cost for pair in pairs) for place in (0, 1)]
    differences = [one.cost - other.cost for one, other in pairs]
    with_it, without_it = (run._replace(cost=cost) for run, cost in zip(pairs[0], costs, strict=True))
    return Pair(with_it, without_it, differences, plan.blocks * length)


def _plan(first: ResolvedScene, second: ResolvedScene) -> _Plan:
    """As many blocks as both get through in their part of the time; a try of each tells."""
    part = SECONDS / (2 * PAIRS)
    tries = [_walls(scene, _most_blocks(scene), part)[0] for scene in (first, second)]
    bursts = any(numpy.mean(walls) > BURST * numpy.median(walls) for walls in tries)
    blocks = min(len(walls) for walls in tries)
    fitting = int(part / max(sum(walls[:blocks]) for walls in tries))
    return _Plan(blocks, min(RUNS_OF_BURSTS, max(1, fitting)) if bursts else 1, bursts)


def _run(scene: ResolvedScene, plan: _Plan) -> AblationRun:
    """Without bag; the cost is that of the simulation alone."""
    walls, messages, inputs = _walls(scene, plan.blocks)
    cost = float(numpy.median(walls))
    if plan.bursts:
        again = [_walls(scene, plan.blocks)[0] for _ in range(plan.repeats - 1)]
        cost = float(numpy.min([walls, *again], axis=0).mean())
    observed = _observed(messages, inputs)
    return AblationRun(1e3 * cost / float(scene.data["block_length"]), observed.forces, observed, messages)


def _walls(
    scene: ResolvedScene, blocks: int, most_time: float = numpy.inf
) -> tuple[list[float], Messages, list[dict[str, Any]]]:
    """Wall time of each block [s], all messages, all inputs; up to the block in which `most_time`
    [s] ends.
    """
    sources, simulation = make_sources(scene), _prepared(scene)
    walls: list[float] = []
    messages: Messages = []
    inputs: list[dict[str, Any]] = []
    for block in range(blocks):
        given = {topic: source.block(block) for topic, source in sources.items()}
        result = simulation.advance(block, given)
        walls.append(result.wall_time)
        messages += result.messages
        inputs.append(given)
        if sum(walls) > most_time:
            break
    return walls, messages, inputs


def _most_blocks(scene: ResolvedScene) -> int:
    length = float(scene.data["block_length"])
    return max(1, round(min(DURATION, float(scene.data["duration"])) / length))


def _prepared(scene: ResolvedScene) -> BlockSimulation:
    simulation = make_simulation(scene)
    simulation.prepare()
    return simulation


def _observed(messages: Messages, inputs: list[dict[str, Any]]) -> Observed:
    """Read a run's messages and its input blocks."""
    parts: dict[str, list[Vector]] = {}
    for topic, _stamp, data in messages:
        contact, _, kind = topic.partition("/")
        if kind == "force":
            parts.setdefault(contact, []).append(decode(ContactForce, data).normal)
    forces = {contact: numpy.concatenate(found) for contact, found in parts.items()}
    shaken = [
        numpy.abs(given["platform/vibration"].acceleration_x).max() for given in inputs if "platform/vibration" in given
    ]
    opens = {contact: bool((force <= 0.0).any()) for contact, force in forces.items()}
    return Observed(forces, opens, float(max(shaken, default=0.0)))
