"""Rules that tie several keys of a scene together; a contradiction is a fault, never corrected."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain, pairwise

from contact_sim_pkg.records.breach import Breach, one_of, show
from contact_sim_pkg.records.registry import refused_sections, rigs
from contact_sim_pkg.records.rig import load
from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.schema.clock import clock_breaches
from contact_sim_pkg.scene.schema.law_rules import law_breaches
from contact_sim_pkg.scene.schema.scene import Scene
from contact_sim_pkg.scene.schema.travel import points_of


def breaches(scene: Scene) -> Iterator[Breach]:
    """All breaches of rules between keys, those of rig and contacts included; rules between effects are
    in `effect_rules`.
    """
    rig = rigs()[scene.rig]
    of_rig = [*rig.rules, *(rule for contact in rig.contacts for rule in contact.rules)]
    return chain(
        _sections(scene),
        clock_breaches(scene),
        _travel(scene),
        *(load(rule)(scene) for rule in of_rig),
        *(kind.breaches(scene.duration) for kind in (scene.road, scene.vibration) if kind is not None),
        law_breaches(scene),
        _expect(scene),
    )


def _sections(scene: Scene) -> Iterator[Breach]:
    for name in rigs()[scene.rig].needs:
        if getattr(scene, name) is None and not (name == "travel" and _has_programme(scene)):
            yield Breach(name, f"is missing; the rig {scene.rig} needs it", ("rig",))
    for name in refused_sections(scene.rig):
        if getattr(scene, name) is not None:
            yield Breach(name, f"the rig {scene.rig} has no {name}; remove it or choose another rig", ("rig",))


def _expect(scene: Scene) -> Iterator[Breach]:
    expect, regimes = scene.expect, [regime.name for regime in rigs()[scene.rig].regimes]
    if expect is None:
        return
    if expect.regime not in regimes:
        known = f"it has {', '.join(regimes)}" if regimes else "it has none; leave expect out"
        yield Breach("expect.regime", f"the rig {scene.rig} has no regime {expect.regime}; {known}", ("rig",))
    if expect.at_least is not None and expect.at_most is not None and expect.at_least > expect.at_most:
        sentence = (
            f"{show(expect.at_least)} is above at_most ({show(expect.at_most)}): no figure lies between; swap them"
        )
        yield Breach("expect.at_least", sentence, ("expect.at_most",))


def _has_programme(scene: Scene) -> bool:
    """Of the speed."""
    try:
        return points_of(scene, "speed") is not None
    except SceneError:  # said of its file
        return True


def _travel(scene: Scene) -> Iterator[Breach]:
    travel = scene.travel
    if travel is None:
        return
    if not _has_programme(scene):
        yield from one_of("travel", "speed", travel.speed is not None, "points", travel.points is not None)
    points = travel.points or []
    if points and points[0][0] != 0.0:
        yield Breach("travel.points.0.0", f"the first time is {show(points[0][0])} s; it must be 0", ("travel.points",))
    for index, (before, after) in enumerate(pairwise(points), start=1):
        if not after[0] > before[0]:
            sentence = f"time {show(after[0])} s does not come after {show(before[0])} s; times must increase"
            yield Breach(f"travel.points.{index}.0", sentence, ("travel.points",))
    for index, (time, speed) in enumerate(points):
        if not 0.0 <= time <= 3600.0:
            yield Breach(f"travel.points.{index}.0", f"{show(time)} s is outside 0 to 3600 s", ("travel.points",))
        if not 0.0 <= speed <= 100.0:
            yield Breach(f"travel.points.{index}.1", f"{show(speed)} m/s is outside 0 to 100 m/s", ("travel.points",))
