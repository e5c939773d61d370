"""Parts of a back against its seat back for the drawing of the rig."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from contact_sim_pkg.report.sketch import Part, at, floor_part, leaning, listed


def backrest_parts(scene: Mapping[str, Any]) -> list[Part]:
    """Seat back and back of a scene; on a seat they are its sitter's."""
    foam = at(scene, "effects.backrest.cushion.thickness", "foam {:.0f} mm", 1e3)
    angle = at(scene, "backrest.angle", "{:.0f}° from the vertical", 57.29578)
    held = Part("seat back", listed(foam, angle))
    if "seat" in scene:
        return [held]
    carried = listed(at(scene, "backrest.mass", "{:g} kg"), at(scene, "backrest.preload", "pressed with {:.0f} N"))
    return [*floor_part(scene), Part("back", carried, leaning), *([held] if held.value else [])]
