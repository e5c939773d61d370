"""Keys of what holds the axle of a tire on a test machine."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, ClassVar, Literal

from contact_sim_pkg.records.breach import Breach, show
from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.records.fields import Section, choice, number
from contact_sim_pkg.records.registry import rigs

if TYPE_CHECKING:
    from contact_sim_pkg.scene.schema.scene import Scene

__all__ = ["DRUM", "MountSection", "mount_breaches"]

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
    damping: float | None = number(
        0.0, 1e6, "N s/m", "of the slide that a loaded axle moves on; 2000 by default", default=None
    )

    def open_values(self, scene: Scene) -> dict[str, Any]:
        from contact_sim_pkg.rigs.vehicle.tire.schema import TireSection

        if self.kind == "quarter_car":
            return {}
        tire, control = scene.section(TireSection), self.control
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
            found["damping"] = 2000.0
        return found

    def _keeps_height(self, programme: dict[str, list[float]]) -> bool:
        return self.deflection is not None or "deflection" in programme


def mount_breaches(scene: Scene) -> Iterator[Breach]:
    """Keys that the mount of a tire does not have, a rig or an effect that needs the quarter car."""
    from contact_sim_pkg.rigs.vehicle.tire.schema import Inflation, TireSection

    tire = scene.section(TireSection)
    mount, where = tire.mount, "tire.mount"
    if mount is None or mount.kind == "quarter_car":
        for name in () if mount is None else ("control", "load", "deflection", "radius", "damping"):
            if getattr(mount, name) is not None:
                yield Breach(
                    f"{where}.{name}",
                    "is none of a quarter_car; take another kind, or leave it out",
                    (f"{where}.kind",),
                )
        return
    control = mount.open_values(scene)["control"] if mount.control is None else mount.control
    if scene.rig != "tire":
        yield Breach(f"{where}.kind", f"{mount.kind} carries no car; take the rig tire, or quarter_car", ("rig",))
    if mount.radius is not None and mount.kind != "drum":
        yield Breach(
            f"{where}.radius", f"is that of a drum, the mount is {mount.kind}; leave it out", (f"{where}.kind",)
        )
    if mount.kind == "drum" and scene.effect("tire", Inflation) is None:
        sentence = (
            "a drum takes an inflated tire, whose force table knows its curvature; add effects.tire.inflation: {}"
        )
        yield Breach(f"{where}.kind", sentence, ("effects.tire",))
    if mount.deflection is not None and control == "load":
        sentence = "the load is kept, the deflection follows from it; leave it out, or take control: height"
        yield Breach(f"{where}.deflection", sentence, (f"{where}.control",))
    if mount.damping is not None and control == "height":
        yield Breach(f"{where}.damping", "an axle held in height does not slide; leave it out", (f"{where}.control",))
    speeds = (
        [0.0] if scene.travel is None else [scene.travel.speed or 0.0, *(each[1] for each in scene.travel.points or ())]
    )
    if mount.kind == "plate" and max(speeds) > 0.0:
        sentence = f"a plate stands, the tire does not roll at {show(max(speeds))} m/s; take 0, or the mount flat_track"
        yield Breach(
            "travel.points" if scene.travel and scene.travel.points else "travel.speed", sentence, (f"{where}.kind",)
        )
    for effect in rigs()[scene.rig].contacts[0].effects:
        if effect.elements and getattr(scene.effects.tire, effect.name, None) is not None:  # type: ignore[attr-defined]
            sentence = (
                f"acts between wheel and body, {mount.kind} has none; leave it out, or take the mount quarter_car"
            )
            yield Breach(f"effects.tire.{effect.name}", sentence, (f"{where}.kind",))
