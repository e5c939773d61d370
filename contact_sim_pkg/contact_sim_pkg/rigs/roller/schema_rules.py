"""Rules that tie keys of the roller rig together."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise

from contact_sim_pkg.rigs.roller.schema import (
    RollerElastic,
    RollerProgramme,
    RollerRig,
    ShaftBending,
    Subsurface,
    TrackWaves,
)
from contact_sim_pkg.scene.errors import Breach
from contact_sim_pkg.scene.schema.catalog import show
from contact_sim_pkg.scene.schema.clock import exact
from contact_sim_pkg.scene.schema.scene import Scene

RADII = ("profile_radius", "rolling_radius", "shaft_radius", "shaft_profile_radius")
COLUMNS = ("load", "bending_load", *RADII)


def roller_breaches(scene: Scene) -> Iterator[Breach]:
    """Inertias that are none, columns of unequal length, turns that do not fit a block, instants
    outside the run.
    """
    roller, law, waves = scene.section(RollerRig), _law(scene), scene.effect("roller", TrackWaves)
    # The inertia tensor is positive definite.
    if not roller.inertia_product**2 < roller.inertia_tilt * roller.inertia_yaw:
        most = math.sqrt(roller.inertia_tilt * roller.inertia_yaw)
        sentence = (
            f"{show(roller.inertia_product)} kg m^2 is too large: its square must be below I_y I_z, give one between "
            f"-{most:.6g} and {most:.6g} kg m^2"
        )
        yield Breach("roller.inertia_product", sentence, ("roller.inertia_tilt", "roller.inertia_yaw"))
    if law.split == "parallel" and scene.effect("roller", ShaftBending) is None:
        sentence = "parallel takes part of the load through a bent shaft; add shaft_bending, or take series"
        yield Breach("effects.roller.normal_elastic.split", sentence, ("effects.roller.shaft_bending",))
    # Each effect has rules of its own.
    if roller.programme is not None:
        yield from _programme(roller.programme)
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
    yield from _whole_turns(scene, roller, waves.track)
    # The heave over heights has one contact: only loads may change.
    programme = roller.programme
    for name in RADII:
        if programme is not None and getattr(programme, name) is not None:
            sentence = "changes the radii while the roller rides over heights; leave it out, or the effect track_waves"
            yield Breach(f"roller.programme.{name}", sentence, ("effects.roller.track_waves",))


def _whole_turns(scene: Scene, roller: RollerRig, track: str) -> Iterator[Breach]:
    """Of the track, or of the larger body where both have one; that one is then a whole multiple of
    the other.
    """
    radii = {"shaft": exact(roller.shaft_radius), "roller": exact(roller.radius)}
    # A turn of both bodies is one of the larger.
    if track == "both":
        ratio = max(radii.values()) / min(radii.values())
        if ratio.denominator != 1:
            sentence = (
                f"the radii of roller and shaft are as {float(ratio):.6g} to 1; with a track on both it must be a whole number, "
                f"take {show(float(round(ratio) * min(radii.values())))} m for the larger"
            )
            yield Breach("roller.radius", sentence, ("roller.shaft_radius", "effects.roller.track_waves.track"))
            return
    # In exact fractions, so that a whole number is one.
    body = max(radii, key=lambda name: radii[name]) if track == "both" else track
    rate = exact(roller.radius) / radii[body] * exact(scene.block_length)
    turns = exact(roller.speed) * rate
    if turns.denominator != 1:
        speed = max(1, round(turns)) / rate
        sentence = (
            f"{show(roller.speed)} 1/s turns the {body} {float(turns):.6g} times in a block of {show(scene.block_length)} s; with "
            f"track_waves it must be a whole number: take {float(speed):.10g} 1/s, or a block_length that is a multiple of "
            f"{float(exact(scene.block_length) / turns.numerator * turns.denominator):.10g} s"
        )
        yield Breach("roller.speed", sentence, ("block_length", "roller.radius", "roller.shaft_radius"))
