"""Parts of an impact for the drawing of the rig."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from contact_sim_pkg.report.sketch import Part, at, ball, ground, listed, pushed


def impact_parts(scene: Mapping[str, Any]) -> list[Part]:
    """Sample, sphere and its speed."""
    sample = listed(
        at(scene, "impact.sample.material"), at(scene, "impact.sample.storage_modulus", "E′ {:g} MPa", 1e-6),
        at(scene, "impact.sample.loss_tangent", "tan β {:g}"),
    )  # fmt: skip
    sphere = listed(at(scene, "impact.mass", "{:g} g", 1e3), at(scene, "impact.radius", "radius {:g} mm", 1e3))
    given = scene.get("impact") or {}
    parts = [Part("sample", sample, ground), Part("sphere", listed(sphere, at(scene, "impact.machine")), ball)]
    for name, key, unit, glyph in (("speed", "speeds", "m/s", pushed), ("temperature", "temperatures", "K", None)):
        values = given.get(key) or []
        if values:
            low, high = min(values), max(values)
            parts.append(Part(name, f"{low:g} {unit}" if low == high else f"{low:g} to {high:g} {unit}", glyph))
    return parts
