"""Rules of a test machine: keys of its mount, and columns of its programme."""

from __future__ import annotations

from collections.abc import Iterator

from contact_sim_pkg.records.breach import Breach, show
from contact_sim_pkg.records.registry import rigs
from contact_sim_pkg.rigs.vehicle.tire.mount_section import MountSection
from contact_sim_pkg.rigs.vehicle.tire.programme import COLUMNS, PROGRAMME, row_breaches
from contact_sim_pkg.rigs.vehicle.tire.schema import Inflation, TireSection
from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.schema.scene import Scene

__all__ = ["mount_breaches", "programme_breaches"]


def mount_breaches(scene: Scene) -> Iterator[Breach]:
    """Keys that the mount of a tire does not have, a rig or an effect that needs the quarter car."""
    tire = scene.section(TireSection)
    mount, where = tire.mount, "tire.mount"
    if mount is None or mount.kind == "quarter_car":
        for name in () if mount is None else ("control", "load", "deflection", "radius", "slide_damping"):
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
    if mount.slide_damping is not None and control == "height":
        yield Breach(
            f"{where}.slide_damping", "an axle held in height does not slide; leave it out", (f"{where}.control",)
        )
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


def programme_breaches(scene: Scene) -> Iterator[Breach]:
    """Columns that do not fit each other, the mount, or what the scene gives beside them."""
    tire = scene.section(TireSection)
    programme = tire.programme
    if programme is None:
        return
    if programme.file is None and programme.time is None:
        yield Breach(f"{PROGRAMME}.time", "is missing; give it with the columns, or a file", (f"{PROGRAMME}.file",))
        return
    if programme.time is None and (beside := [name for name in COLUMNS if getattr(programme, name) is not None]):
        yield Breach(
            f"{PROGRAMME}.{beside[0]}", "has no time; give the column time, or all by the file", (f"{PROGRAMME}.time",)
        )
        return
    try:
        found = programme.columns(scene)
    except SceneError:  # said of the file
        return
    if programme.time is not None:  # of a file it is said with it
        yield from row_breaches(found)
    if len(found) == 1:
        yield Breach(f"{PROGRAMME}.time", f"has no quantity beside it; give {', '.join(COLUMNS)}")
    yield from _kept(found, tire.mount, scene)
    points = {"travel": programme.pairs(scene, "speed"), "slip": programme.pairs(scene, "slip", "slip_angle")}
    for section, rows in points.items():
        given = getattr(scene, section)
        values = () if given is None else [(key, value) for key, value in given if value is not None]
        if rows is not None and (stands := [key for key, value in values if value != rows]):
            yield Breach(
                f"{section}.{stands[0]}", "the programme of the tire gives it too; keep one of them", (PROGRAMME,)
            )


def _kept(columns: dict[str, list[float]], mount: MountSection | None, scene: Scene) -> Iterator[Breach]:
    """A load or a deflection that the mount does not keep."""
    machine = mount is not None and mount.kind != "quarter_car"
    kept = (mount.control or mount.open_values(scene)["control"]) if mount is not None and machine else ""
    for name, needed in (("load", "load"), ("deflection", "height")):
        if name not in columns or kept == needed:
            continue
        where, beside = f"{PROGRAMME}.{name}", ("tire.mount.control",)
        if not machine:
            sentence = "acts on a test machine, the tire carries a quarter car; add tire.mount: {kind: flat_track}"
            yield Breach(where, sentence, ("tire.mount",))
        else:
            yield Breach(where, f"the mount keeps the {kept}; take control: {needed}, or leave the column out", beside)
