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
    forecast: str = ""  # "module": what is told before the run, by its `facts_before_run` and `sentence_before_run`


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


def _roller_topics(scene: dict[str, Any]) -> list[str]:
    effects = scene["effects"]["roller"]
    topics = {"tilt_yaw": "stability", "track_waves": "track", "subsurface": "volumes"}
    named = [topic for effect, topic in topics.items() if effects.get(effect) is not None]
    return [f"roller/{name}" for name in ("force", "contact", *named)]


def _occupant_topics(scene: dict[str, Any]) -> list[str]:
    return [*_vehicle_topics(scene, ("seat",)), *_backrest_topics(scene)]


_VEHICLE = RigRun("contact_sim_pkg.rigs.vehicle.simulation:Simulation", _vehicle_topics)

RIG_RUNS: dict[RigName, RigRun] = {
    "tire": _VEHICLE,
    "seat": _VEHICLE,
    "car": _VEHICLE,
    "block": RigRun("contact_sim_pkg.rigs.body.simulation:BlockBodySimulation", _block_topics),
    "backrest": RigRun("contact_sim_pkg.rigs.backrest.simulation:BackrestSimulation", _backrest_topics),
    "impact": RigRun("contact_sim_pkg.rigs.impact.simulation:ImpactSimulation", _impact_topics),
    "roller": RigRun(
        "contact_sim_pkg.rigs.roller.simulation:RollerSimulation",
        _roller_topics,
        forecast="contact_sim_pkg.rigs.roller.forecast",
    ),
    "occupant": RigRun("contact_sim_pkg.rigs.occupant.simulation:OccupantSimulation", _occupant_topics),
}


def make_simulation(scene: ResolvedScene) -> BlockSimulation:
    """The simulation of a resolved scene's rig. Raises what its parts raise on a scene that cannot run."""
    module, _, name = RIG_RUNS[scene.data["rig"]].simulation.partition(":")
    simulation: BlockSimulation = getattr(import_module(module), name)(scene)
    return simulation


def result_topics(scene: ResolvedScene) -> list[str]:
    """Recorded topics that the simulator publishes for the scene."""
    rig = RIG_RUNS[scene.data["rig"]]
    return [*rig.topics(scene.data), "bench/motion", "bench/energy", "bench/cost"]


class Forecast(NamedTuple):
    """What is told before a run."""

    facts: dict[str, Any]
    sentence: str


def forecast_of(scene: ResolvedScene) -> Forecast | None:
    """What the rig tells of the run before it; None where it tells nothing. Raises RunError where the scene cannot run."""
    name = RIG_RUNS[scene.data["rig"]].forecast
    if not name:
        return None
    module = import_module(name)
    facts = module.facts_before_run(scene.data)
    return Forecast(facts, module.sentence_before_run(facts)) if facts else None
