"""Parts of a tire under its quarter car for the drawing of the rig."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from contact_sim_pkg.report.sketch import Part, at, drum, listed, mass, road_parts, spring_and_damper, tire
from contact_sim_pkg.rigs.vehicle.tire.report.numbers import standing_load_of


def tire_parts(scene: Mapping[str, Any]) -> list[Part]:
    """Road, tire, suspension and body of a scene."""
    size = at(scene, "effects.tire.inflation.size")
    pressure = at(scene, "effects.tire.inflation.pressure", "{:.0f} kPa", 1e-3)
    load = standing_load_of(dict(scene))
    suspension = listed(
        at(scene, "tire.suspension_stiffness", "{:g} kN/m", 1e-3), at(scene, "tire.suspension_damping", "{:g} N s/m")
    )
    kind = at(scene, "tire.mount.kind")
    road = road_parts(scene)
    if kind == "drum":
        road = [each._replace(glyph=drum) if each.glyph is not None else each for each in road]
    parts = [
        *road,
        Part("tire", listed(size, pressure, at(scene, "tire.wheel_mass", "wheel {:g} kg")), tire),
        *([] if load is None else [Part("load", f"{1e-3 * load:.3g} kN")]),
    ]
    if kind not in ("", "quarter_car"):
        keeps = f"{kind.replace('_', ' ')}, keeps the {at(scene, 'tire.mount.control')}"
        return [*parts, Part("mount", listed(keeps, at(scene, "tire.mount.radius", "radius {:g} m")), mass)]
    return [
        *parts,
        Part("suspension", suspension, spring_and_damper),
        Part("body", at(scene, "tire.body_mass", "{:g} kg"), mass),
    ]
