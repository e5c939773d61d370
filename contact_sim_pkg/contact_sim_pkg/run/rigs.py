"""The rigs as a run knows them: which simulation drives each, and which topics it publishes. A new rig is a row here.

Simulations are named, not imported: a node that only records or only shakes starts without a compiler.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any, NamedTuple

from contact_sim_pkg.run.block_simulation import BlockSimulation
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.rigs import RIGS, RigName

FIELD_TOPICS = {"contact_field": "patch", "pressure_mat": "patch", "brush": "shear"}
"""Effects of a vehicle's contacts that publish a field, and their topics."""


class RigRun(NamedTuple):
    """How a run treats one rig."""

    simulation: str  # "module:class" of a BlockSimulation that takes a resolved scene
    topics: Callable[[dict[str, Any]], list[str]]  # resolved scene -> topics of its contacts; those of `bench/` follow


def _vehicle_topics(scene: dict[str, Any], contacts: tuple[str, ...] = ()) -> list[str]:
    names = []
    for contact in contacts or RIGS[scene["rig"]].contacts:
        effects = scene["effects"].get(contact) or {}
        names += [f"{contact}/force", f"{contact}/wrench"]
        names += [f"{contact}/{topic}" for effect, topic in FIELD_TOPICS.items() if effects.get(effect) is not None]
    return names


def _backrest_topics(scene: dict[str, Any]) -> list[str]:
    return [*(f"backrest/{name}" for name in ("force", "wrench", "patch", "points")), "bench/episodes"]


IMPACT_TOPICS = {
    "contact_stress": "stress", "surface_waves": "wave", "micro_front": "front", "thermal_volume": "position",
    "history": "history",
}  # fmt: skip
"""Effects of the impact rig that publish something, and their topics."""


def _impact_topics(scene: dict[str, Any]) -> list[str]:
    effects = scene["effects"]["impact"]
    names = ["force", "wrench", "events"] + (["course"] if scene["impact"]["course_samples"] else [])
    return [
        f"impact/{name}"
        for name in (*names, *(topic for effect, topic in IMPACT_TOPICS.items() if effects.get(effect) is not None))
    ]


def _block_topics(scene: dict[str, Any]) -> list[str]:
    return [f"block/{name}" for name in ("force", "wrench", "points")]


def _occupant_topics(scene: dict[str, Any]) -> list[str]:
    return [*_vehicle_topics(scene, ("seat",)), *_backrest_topics(scene)]


_VEHICLE = RigRun("contact_sim_pkg.run.simulation:Simulation", _vehicle_topics)

RIG_RUNS: dict[RigName, RigRun] = {
    "tire": _VEHICLE,
    "seat": _VEHICLE,
    "car": _VEHICLE,
    "block": RigRun("contact_sim_pkg.run.block:BlockBodySimulation", _block_topics),
    "backrest": RigRun("contact_sim_pkg.run.backrest:BackrestSimulation", _backrest_topics),
    "impact": RigRun("contact_sim_pkg.run.impact:ImpactSimulation", _impact_topics),
    "occupant": RigRun("contact_sim_pkg.run.occupant:OccupantSimulation", _occupant_topics),
}


def make_simulation(scene: ResolvedScene) -> BlockSimulation:
    """The simulation of a resolved scene's rig. Raises what its parts raise on a scene that cannot run."""
    module, _, name = RIG_RUNS[scene.data["rig"]].simulation.partition(":")
    simulation: BlockSimulation = getattr(import_module(module), name)(scene)
    return simulation


def result_topics(scene: ResolvedScene) -> list[str]:
    """Recorded topics that the simulator publishes for the scene."""
    return [*RIG_RUNS[scene.data["rig"]].topics(scene.data), "bench/motion", "bench/energy", "bench/cost"]
