"""Keys of what holds the axle of a tire on a test machine."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar, Literal

from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.records.fields import Section, choice, number

if TYPE_CHECKING:
    from contact_sim_pkg.scene.schema.scene import Scene

__all__ = ["DRUM", "MountSection"]

DRUM = 0.85
"""[m] radius of the drum of 1.7 m, the least of ISO 28580"""
LOADED = ("flat_track", "drum")
"""Machines that press the axle down by a load unless they are to hold it in height."""


class MountSection(Section):
    """What the axle is mounted on: the quarter car, or a test machine without body and suspension."""

    fixed: ClassVar[str] = "the run is made of what the axle is mounted on"

    kind: Literal["quarter_car", "held", "flat_track", "plate", "drum"] = choice(
        "quarter car; axle held over the road; level belt; plate that stands; drum", default="quarter_car"
    )
    control: Literal["height", "load"] | None = choice(
        "what the machine keeps: the axle in height, or its load by a servo; load by default of flat_track, drum and of a "
        "programme of the load, else height", default=None,
    )  # fmt: skip
    load: float | None = number(
        0.0, 1e6, "N", "load on the road: the servo's, or that under which a held axle stands at the start; by default the "
        "weight of wheel and body, or the largest of the programme", default=None, above=True,
    )  # fmt: skip
    deflection: float | None = number(
        -0.1, 0.1, "m", "of the tire, by which a held axle is lowered from where it touches; below 0: lifted off; by "
        "default that of the load", default=None,
    )  # fmt: skip
    radius: float | None = number(
        0.1, 1e4, "m", f"of the drum, {DRUM:g} by default", default=None,
    )  # fmt: skip
    slide_damping: float | None = number(
        0.0, 1e6, "N s/m", "of the slide that a loaded axle moves on; 2000 by default", default=None
    )

    def open_values(self, scene: Scene) -> dict[str, Any]:
        if self.kind == "quarter_car":
            return {}
        tire, control = scene.tire, self.control  # type: ignore[attr-defined]
        programme = {} if tire.programme is None else tire.programme.columns(scene)
        if control is None:
            control = (
                "load"
                if "load" in programme or (self.kind in LOADED and not self._keeps_height(programme))
                else "height"
            )
        load = max(programme["load"]) if "load" in programme else (tire.wheel_mass + tire.body_mass) * GRAVITY
        found: dict[str, Any] = {"control": control, "load": load}
        if self.kind == "drum":
            found["radius"] = DRUM
        if control == "load":
            found["slide_damping"] = 2000.0
        return found

    def _keeps_height(self, programme: dict[str, list[float]]) -> bool:
        return self.deflection is not None or "deflection" in programme
