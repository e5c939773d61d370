"""Parts of a seat for the drawing of its rig."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from contact_sim_pkg.report.sketch import (
    AXIS,
    Part,
    Sketch,
    at,
    floor_part,
    foam,
    leaning,
    listed,
    sitter,
    spring_and_damper,
)


def seat_parts(scene: Mapping[str, Any]) -> list[Part]:
    """Floor, cushion and occupant of a scene."""
    occupant = (scene.get("seat") or {}).get("occupant") or {}
    masses = [
        float(occupant.get("frame_mass") or 0.0),
        *(occupant.get("masses") or ()),
        float(occupant.get("mass") or 0.0),
    ]
    model = str(occupant.get("model", "")).replace("_", " ")
    return [
        *floor_part(scene),
        *_suspension(scene),
        _carrier(scene),
        Part("occupant", listed(f"{sum(masses):.3g} kg" if any(masses) else "", model),
             leaning if "backrest" in scene else sitter),
    ]  # fmt: skip


def _carrier(scene: Mapping[str, Any]) -> Part:
    """Foam, or the plate in its place."""
    if at(scene, "effects.seat.cushion.carrier", "{}") == "plate":
        return Part("plate", "", _plate)
    return Part("foam", at(scene, "effects.seat.cushion.thickness", "{:.0f} mm", 1e3), foam)


def _plate(sketch: Sketch, y: float) -> float:
    sketch.box(AXIS - 44.0, y, AXIS + 44.0, y + 6.0, "fill")
    return y + 6.0


def _suspension(scene: Mapping[str, Any]) -> list[Part]:
    """Below the cushion; none without one."""
    keys = "effects.seat.suspension"
    value = listed(
        at(scene, f"{keys}.stiffness", "{:g} kN/m", 1e-3), at(scene, f"{keys}.damping", "{:g} N s/m"),
        at(scene, f"{keys}.travel", "travel {:g} mm", 1e3),
    )  # fmt: skip
    return [Part("seat suspension", value, spring_and_damper)] if value else []
