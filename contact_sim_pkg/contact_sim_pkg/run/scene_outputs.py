"""The outputs of a shipped scene, without a bag."""

from __future__ import annotations

from typing import Any

from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.run.block_simulation import BlockSimulation
from contact_sim_pkg.run.rigs import make_simulation
from contact_sim_pkg.run.sources import make_sources
from contact_sim_pkg.scene.load import load_scene
from contact_sim_pkg.scene.overrides import set_duration, set_value
from contact_sim_pkg.scene.resolve import resolve
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["outputs_of", "outputs_with", "records_of"]


def outputs_of(scene_name: str, duration: float, *values: str) -> list[Output]:
    """Outputs of a shipped scene over `duration` [s], `values` as of `--set`, without the wall
    times of `bench/cost`.
    """
    overrides = [set_duration(duration), *(set_value(value) for value in values)]
    scene = resolve(load_scene(scene_name, overrides))
    return outputs_with(scene, make_simulation(scene))


def outputs_with(scene: ResolvedScene, simulation: BlockSimulation, *, cost: bool = False) -> list[Output]:
    """The same of a `simulation` of a resolved scene, with ``cost`` that too."""
    sources = make_sources(scene)
    simulation.prepare()
    found: list[Output] = []
    for block in range(simulation.blocks):
        result = simulation.advance(block, {topic: source.block(block) for topic, source in sources.items()})
        found += [output for output in result.outputs if cost or output.topic != "bench/cost"]
    return found


def records_of(outputs: list[Output], topic: str) -> list[Any]:
    """The records of a topic, in order."""
    return [output.record for output in outputs if output.topic == topic]
