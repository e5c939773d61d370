"""Parts of a roller on its shaft for the drawing of the rig."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from contact_sim_pkg.report.sketch import AXIS, Part, Sketch, at, listed, pushed


def roller_parts(scene: Mapping[str, Any]) -> list[Part]:
    """Shaft, roller and its load."""
    roller = listed(
        at(scene, "roller.radius", "radius {:g} mm", 1e3), _over_time(scene, "profile_radius", "profile {} mm", 1e3)
    )
    return [
        Part("shaft", listed(_over_time(scene, "shaft_radius", "radius {} mm", 1e3),
                             at(scene, "roller.young_modulus", "E {:g} GPa", 1e-9)), _shaft),
        Part("roller", listed(roller, at(scene, "roller.mass", "{:g} kg")), _roller),
        Part("load", _over_time(scene, "load", "{} N"), pushed),
        Part("speed", at(scene, "roller.speed", "{:g} turns/s")),
    ]  # fmt: skip


def _over_time(scene: Mapping[str, Any], key: str, text: str, scale: float = 1.0) -> str:
    """A value of the roller as ``text``; where its programme gives one over time, the least and the largest."""
    programme = scene.get("roller", {}).get("programme")
    column = programme.get(key) if isinstance(programme, Mapping) else None
    if not isinstance(column, list) or not column:
        return at(scene, f"roller.{key}", text.format("{:g}"), scale)
    return text.format(" to ".join(f"{scale * end:.4g}" for end in dict.fromkeys((min(column), max(column)))))


def _shaft(sketch: Sketch, y: float) -> float:
    """A shaft from the side."""
    sketch.box(AXIS - 50.0, y, AXIS + 50.0, y + 18.0, "soft")
    sketch.path([(AXIS - 58.0, y + 9.0), (AXIS + 58.0, y + 9.0)])
    return y + 18.0


def _roller(sketch: Sketch, y: float) -> float:
    """A crowned roller, seen along the shaft's side."""
    crown = [(-24.0, 7.0), (-16.0, 3.0), (-8.0, 1.0), (0.0, 0.0), (8.0, 1.0), (16.0, 3.0), (24.0, 7.0)]
    sketch.path([(AXIS + x, y + low) for x, low in crown] + [(AXIS - x, y + 76.0 - low) for x, low in crown], closed=True,
                kind="fill")  # fmt: skip
    sketch.path([(AXIS - 34.0, y + 38.0), (AXIS + 34.0, y + 38.0)])
    return y + 76.0
