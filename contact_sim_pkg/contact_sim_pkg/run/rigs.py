"""Simulation, topics and forecast of the rig of a scene."""

from __future__ import annotations

from typing import Any, NamedTuple

from contact_sim_pkg.records.registry import rigs
from contact_sim_pkg.records.rig import load
from contact_sim_pkg.run.block_simulation import BlockSimulation
from contact_sim_pkg.run.observers import observed
from contact_sim_pkg.scene.resolved_scene import ResolvedScene


def make_simulation(scene: ResolvedScene) -> BlockSimulation:
    """The simulation of a resolved scene's rig, with the observers that it calls for. Raises what its
    parts raise on a scene that cannot run.
    """
    simulation: BlockSimulation = load(rigs()[scene.rig].simulation)(scene)
    return observed(scene, simulation)


def result_topics(scene: ResolvedScene) -> list[str]:
    """Recorded topics that the simulator publishes for the scene."""
    own = [topic for contact in rigs()[scene.rig].contacts for topic in contact.published(scene.data)]
    return [*own, *rigs()[scene.rig].bench_topics, "bench/motion", "bench/energy", "bench/cost"]


class Forecast(NamedTuple):
    """Known facts of a run before it, and a sentence about them."""

    facts: dict[str, Any]
    sentence: str


def forecast_of(scene: ResolvedScene) -> Forecast | None:
    """The forecast of the rig; None where it reports nothing. Raises RunError where the
    scene cannot run.
    """
    name = rigs()[scene.rig].forecast
    if not name:
        return None
    module = load(name)
    facts = module.facts_before_run(scene)
    return Forecast(facts, module.sentence_before_run(facts)) if facts else None
