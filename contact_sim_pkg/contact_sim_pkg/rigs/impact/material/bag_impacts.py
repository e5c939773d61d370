"""Impacts from a bag of the impact rig: what its gauges measured, and the rules that its scene was
run with.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy

from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.bag.texts import scene_of_text
from contact_sim_pkg.rigs.impact.material.errors import MaterialError
from contact_sim_pkg.rigs.impact.material.reading import Impacts

__all__ = ["EVENTS", "impacts_of_bag", "is_bag", "rules_of_bag"]

EVENTS = "contact_msgs_defs/msg/ImpactEvents"
COLUMNS = (
    "number", "mass", "radius", "measured_speed", "measured_duration", "measured_restitution", "temperature", "gravity",
)  # fmt: skip
LAST_SUFFIX = ".mcap"


def is_bag(path: Path) -> bool:
    """Whether ``path`` is meant as a bag: a directory, or an MCAP file."""
    return path.is_dir() or path.suffix == LAST_SUFFIX


def impacts_of_bag(path: Path) -> Impacts:
    """The measured impacts of a bag, in the order in which they ended; `line` is the number of the
    impact.

    Raises BagError where it is none, MaterialError where no impact ended in it.
    """
    bag = open_bag(path)
    # Topic of the impact events, with at least one.
    topic = next((name for name, row in bag.topics.items() if row.type == EVENTS), None)
    if topic is None or bag.count(topic) == 0:
        what = "has no impact events; the rig impact records them" if topic is None else "holds no impact that ended"
        raise MaterialError(f"{path}: the bag {what}")
    columns = bag.columns(topic, COLUMNS)

    def column(name: str) -> Any:
        return numpy.concatenate([*columns[name]]).astype(numpy.float64)

    # Columns of all messages; without gravity none is handed on.
    gravity = column("gravity")
    return Impacts(
        file=str(path),
        line=column("number").astype(numpy.int64),
        mass=column("mass"),
        radius=column("radius"),
        speed=column("measured_speed"),
        duration=column("measured_duration"),
        restitution=column("measured_restitution"),
        temperature=column("temperature"),
        notes=(),
        gravity=gravity if gravity.any() else None,
    )


def rules_of_bag(path: Path) -> tuple[str, str]:
    """End rule and shape factor of the bag's scene; the usual ones where it does not say."""
    scene = scene_of_text(open_bag(path).scene, f"scene of {path}")
    loss, impact = _section(scene, "effects", "impact", "normal_dissipative"), _section(scene, "impact")
    return str(loss.get("end", "force")), str(impact.get("shape_factor", "small"))


def _section(scene: Any, *keys: str) -> dict[str, Any]:
    """The mapping under these keys; empty where there is none."""
    for key in keys:
        scene = scene.get(key) if isinstance(scene, dict) else None
    return scene if isinstance(scene, dict) else {}
