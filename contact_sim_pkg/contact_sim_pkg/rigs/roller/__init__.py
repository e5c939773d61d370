"""Roller on a rotating shaft: rolling vibro-impact, tilt and yaw, damage, corrugation. Rig roller."""

from typing import Any

from contact_sim_pkg.records.rig import Rig

__all__ = ["RIGS"]

_EFFECT_TOPICS = {"tilt_yaw": "stability", "track_waves": "track", "subsurface": "volumes"}
"""Effects that publish something, and their topics."""


def _topics(scene: dict[str, Any]) -> list[str]:
    effects = scene["effects"]["roller"]
    named = [topic for effect, topic in _EFFECT_TOPICS.items() if effects.get(effect) is not None]
    return [f"roller/{name}" for name in ("force", "contact", *named)]


RIGS = (
    Rig(
        name="roller",
        contacts=("roller",),
        takes=("roller", "road"),
        simulation=f"{__name__}.simulation:RollerSimulation",
        topics=_topics,
        report=(f"{__name__}.report:ROLLER_REPORT",),
        forecast=f"{__name__}.forecast",
    ),
)
