"""Sphere that strikes a viscoelastic sample: drop tower and pendulum. Rig impact."""

from typing import Any

from contact_sim_pkg.records.rig import Rig

__all__ = ["RIGS"]

_EFFECT_TOPICS = {
    "contact_stress": "stress", "surface_waves": "wave", "micro_front": "front", "thermal_volume": "position",
    "history": "history",
}  # fmt: skip
"""Effects that publish something, and their topics."""


def _topics(scene: dict[str, Any]) -> list[str]:
    effects = scene["effects"]["impact"]
    names = ["force", "wrench", "events"] + (["course"] if scene["impact"]["course_samples"] else [])
    names += [topic for effect, topic in _EFFECT_TOPICS.items() if effects.get(effect) is not None]
    return [f"impact/{name}" for name in names]


RIGS = (
    Rig(
        name="impact",
        contacts=("impact",),
        takes=("impact",),
        simulation=f"{__name__}.simulation:ImpactSimulation",
        topics=_topics,
        report=(f"{__name__}.report:IMPACT_REPORT",),
    ),
)
