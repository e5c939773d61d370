"""Rules that tie keys of the roller rig together."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import islice, pairwise

from contact_sim_pkg.rigs.roller.schema import (
    RollerElastic,
    RollerProgramme,
    RollerRig,
    ShaftBending,
    Subsurface,
    TrackWaves,
)
from contact_sim_pkg.scene.errors import Breach
from contact_sim_pkg.scene.schema.catalog import show, show_below
from contact_sim_pkg.scene.schema.clock import clock_breaches, exact, snapped
from contact_sim_pkg.scene.schema.scene import Scene
from contact_sim_pkg.scene.schema.suggested import allows

RADII = ("profile_radius", "rolling_radius", "shaft_radius", "shaft_profile_radius")
MOST_TURNS = 21
"""In a block that is suggested, less one."""
COLUMNS = ("load", "bending_load", *RADII)


def roller_breaches(scene: Scene) -> Iterator[Breach]:
    """Inertias that are none, columns of unequal length, turns that do not fit a block, instants
    outside the run.
    """
    roller, law, waves = scene.section(RollerRig), _law(scene), scene.effect("roller", TrackWaves)
    # The inertia tensor is positive definite.
    if not roller.inertia_product**2 < roller.inertia_tilt * roller.inertia_yaw:
        most = show_below(math.sqrt(roller.inertia_tilt * roller.inertia_yaw), 6)
        sentence = (
            f"{show(roller.inertia_product)} kg m^2 is too large: its square must be below I_y I_z, give one from "
            f"-{most} to {most} kg m^2"
        )
        yield Breach("roller.inertia_product", sentence, ("roller.inertia_tilt", "roller.inertia_yaw"))
    if law.split == "parallel" and scene.effect("roller", ShaftBending) is None:
        sentence = "parallel takes part of the load through a bent shaft; add shaft_bending, or take series"
        yield Breach("effects.roller.normal_elastic.split", sentence, ("effects.roller.shaft_bending",))
    # Each effect has rules of its own.
    if roller.programme is not None:
        yield from _programme(roller.programme)
        loads, usual = roller.programme.load, RollerRig.model_fields["load"].default
        if loads is not None and roller.load not in (usual, loads[0]):
            sentence = (
                f"{show(roller.load)} N acts on nothing, since the programme gives the load over time; leave one out"
            )
            yield Breach("roller.load", sentence, ("roller.programme.load",))
        if roller.programme.bending_load is not None and scene.effect("roller", ShaftBending) is None:
            sentence = "bends a shaft that is not bent; add the effect shaft_bending, or leave it out"
            yield Breach("roller.programme.bending_load", sentence, ("effects.roller.shaft_bending",))
    if waves is not None:
        yield from _track(scene, roller, waves)
    elif scene.road is not None:
        sentence = "the roller rides no heights; add the effect track_waves, or leave the road out"
        yield Breach("road", sentence, ("effects.roller",))
    below = scene.effect("roller", Subsurface)
    if below is not None:
        for index, instant in enumerate(below.instants):
            if instant >= scene.duration:
                sentence = f"{show(instant)} s is not before the end of the run, {show(scene.duration)} s; "
                sentence += "leave it out or take a longer duration"
                yield Breach(f"effects.roller.subsurface.instants.{index}", sentence, ("duration",))


def _law(scene: Scene) -> RollerElastic:
    """Its elastic law, or its defaults where the scene names none, which is a fault of its own."""
    return scene.effect("roller", RollerElastic) or RollerElastic()


def _programme(programme: RollerProgramme) -> Iterator[Breach]:
    where = "roller.programme"
    for index, (before, after) in enumerate(pairwise(programme.time), start=1):
        if not after > before:
            yield Breach(
                f"{where}.time.{index}",
                f"{show(after)} s does not come after {show(before)} s; times must rise, change it or leave it out",
            )
    rows = len(programme.time)
    for name in COLUMNS:
        column = getattr(programme, name)
        if column is not None and len(column) != rows:
            sentence = f"has {len(column)} numbers, time has {rows}; give one for each time"
            yield Breach(f"{where}.{name}", sentence, (f"{where}.time",))


def _track(scene: Scene, roller: RollerRig, waves: TrackWaves) -> Iterator[Breach]:
    """A block holds whole turns of the shaft; over the heights of the track only the loads may
    change.
    """
    if roller.speed == 0.0:
        yield Breach(
            "roller.speed",
            "is 0 1/s: a roller that stands does not ride over the track; give a speed above 0 or leave track_waves out",
        )
        return
    if _law(scene).split == "parallel":
        sentence = (
            "parallel is for a contact at rest; over the heights of the track the load goes in series; take series, or "
        )
        sentence += "leave track_waves out"
        yield Breach("effects.roller.normal_elastic.split", sentence, ("effects.roller.track_waves",))
    yield from list(_radii(scene)) or _whole_turns(scene)
    # The heave over heights has one contact: only loads may change.
    programme = roller.programme
    for name in RADII:
        if programme is not None and getattr(programme, name) is not None:
            sentence = "changes the radii while the roller rides over heights; leave it out, or the effect track_waves"
            yield Breach(f"roller.programme.{name}", sentence, ("effects.roller.track_waves",))


def _radii(scene: Scene) -> Iterator[Breach]:
    """Where both bodies have a track, the radius of the larger is a whole multiple of the other."""
    roller, waves = scene.section(RollerRig), scene.effect("roller", TrackWaves)
    if waves is None or waves.track != "both":
        return
    radii = {"roller.radius": exact(roller.radius), "roller.shaft_radius": exact(roller.shaft_radius)}
    key = max(radii, key=lambda name: radii[name])
    less = min(radii.values())
    ratio = snapped(radii[key] / less)
    if ratio.denominator != 1:
        larger = float(round(ratio) * less)
        cure = f", take {show(larger)} m for the larger" if allows(scene, key, float(show(larger)), _radii) else ""
        sentence = (
            f"the radii of roller and shaft are as {float(ratio):.6g} to 1; with a track on both it must be a whole "
            f"number{cure}"
        )
        yield Breach("roller.radius", sentence, ("roller.shaft_radius", "effects.roller.track_waves.track"))


def _whole_turns(scene: Scene) -> Iterator[Breach]:
    """A block holds whole turns of the track, or of the larger body where both have one."""
    roller, waves = scene.section(RollerRig), scene.effect("roller", TrackWaves)
    if waves is None or roller.speed == 0.0:
        return
    radii = {"shaft": exact(roller.shaft_radius), "roller": exact(roller.radius)}
    body = max(radii, key=lambda name: radii[name]) if waves.track == "both" else waves.track
    block = exact(scene.block_length)
    rate = exact(roller.radius) / radii[body]  # turns of the body for one of the roller
    turns = snapped(exact(roller.speed) * rate * block)
    if turns.denominator == 1 and turns > 0:
        return
    speeds = (float(show(float(count / rate / block))) for count in (max(1, round(turns)),))
    cures = [f"take {show(speed)} 1/s" for speed in speeds if allows(scene, "roller.speed", speed, _whole_turns)]
    # the shortest blocks that hold whole turns and samples
    turn = float(1 / (exact(roller.speed) * rate))
    blocks = (float(show(count * turn)) for count in range(1, MOST_TURNS))
    fit = (each for each in blocks if allows(scene, "block_length", each, _whole_turns, clock_breaches))
    cures += [f"a block_length of {show(each)} s" for each in islice(fit, 1)]
    sentence = (
        f"{show(roller.speed)} 1/s turns the {body} {float(turns):.6g} times in a block of {show(scene.block_length)} s; with "
        f"track_waves it must be a whole number{': ' if cures else ''}{', or '.join(cures)}"
    )
    yield Breach("roller.speed", sentence, ("block_length", "roller.radius", "roller.shaft_radius"))
