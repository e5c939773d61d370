"""Parts of a rigid body over the ground for the drawing of the rig."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from contact_sim_pkg.report.sketch import Part, at, ball, ground, listed, mass, pushed


def block_parts(scene: Mapping[str, Any]) -> list[Part]:
    """Ground, body and gravity."""
    given = scene.get("block") or {}
    contact = listed(
        at(scene, "effects.block.rigid_contact.friction", "friction {:g}"),
        at(scene, "effects.block.rigid_contact.restitution", "restitution {:g}"),
        at(scene, "block.ground.slope", "slope {:.3g}°", 57.29578) if (given.get("ground") or {}).get("slope") else "",
    )
    shape = str(given.get("shape", "body"))
    sides = " × ".join(f"{1e3 * side:g}" for side in given.get("sides") or ())
    size = at(scene, "block.radius", "radius {:g} mm", 1e3) if shape == "sphere" else f"{sides} mm" if sides else ""
    height = (given.get("position") or [0.0])[-1]
    return [
        Part("ground", contact, ground),
        Part(shape, listed(at(scene, "block.mass", "{:g} kg"), size), ball if shape == "sphere" else mass),
        Part("centre of mass", f"{height:.3g} m high at first", pushed),
    ]
