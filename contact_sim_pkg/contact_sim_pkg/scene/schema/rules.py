"""Rules that tie several keys of a scene together; a contradiction is a fault, never corrected."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain, pairwise

from contact_sim_pkg.files import BAG_ENDINGS
from contact_sim_pkg.records.registry import refused_sections, rigs
from contact_sim_pkg.records.rig import load
from contact_sim_pkg.scene.errors import Breach
from contact_sim_pkg.scene.schema.catalog import show
from contact_sim_pkg.scene.schema.clock import clock_breaches
from contact_sim_pkg.scene.schema.law_rules import law_breaches
from contact_sim_pkg.scene.schema.road import (
    BumpRoad,
    CleatRoad,
    Iso8608RoadSection,
    PotholeRoad,
    SelfAffineRoadSection,
)
from contact_sim_pkg.scene.schema.scene import Scene
from contact_sim_pkg.scene.schema.vibration import (
    HalfSineSection,
    NoiseSection,
    RecordedSection,
    SineSection,
    SweepSection,
)

SAMPLES_OF_A_SHOCK = 10
"""At least; straight lines between as many samples keep its change of speed to 1 %."""


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
        _road(scene),
        _vibration(scene),
        law_breaches(scene),
        _expect(scene),
    )


def _sections(scene: Scene) -> Iterator[Breach]:
    for name in rigs()[scene.rig].needs:
        if getattr(scene, name) is None:
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


def _one_of(where: str, first: str, first_given: bool, second: str, second_given: bool) -> Iterator[Breach]:
    if first_given and second_given:
        yield Breach(f"{where}.{second}", f"{first} and {second} are both given; keep one", (f"{where}.{first}",))
    elif not first_given and not second_given:
        yield Breach(f"{where}.{first}", f"is missing; give {first} or {second}", (f"{where}.{second}",))


def _travel(scene: Scene) -> Iterator[Breach]:
    travel = scene.travel
    if travel is None:
        return
    yield from _one_of("travel", "speed", travel.speed is not None, "points", travel.points is not None)
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


def _road(scene: Scene) -> Iterator[Breach]:
    road = scene.road
    if isinstance(road, Iso8608RoadSection):
        yield from _one_of(
            "road", "roughness_class", road.roughness_class is not None, "roughness", road.roughness is not None
        )
        yield from _rising(
            "road", "shortest_wavelength", road.shortest_wavelength, "longest_wavelength", road.longest_wavelength, "m"
        )
        yield from _rising("road", "shortest_wavelength", road.shortest_wavelength, "length", road.length, "m")
        # The texture continues the profile to shorter waves
        if road.texture is not None:
            shortest = road.texture.shortest_wavelength
            yield from _rising(
                "road", "texture.shortest_wavelength", shortest, "shortest_wavelength", road.shortest_wavelength, "m"
            )
    elif isinstance(road, SelfAffineRoadSection):
        yield from _rising(
            "road", "shortest_wavelength", road.shortest_wavelength, "longest_wavelength", road.longest_wavelength, "m"
        )
    elif isinstance(road, BumpRoad | CleatRoad | PotholeRoad):
        if road.period is not None and road.period < road.length:
            sentence = f"{show(road.period)} m is shorter than the obstacle's length of {show(road.length)} m"
            yield Breach("road.period", sentence, ("road.length",))
        if not isinstance(road, BumpRoad) and 2.0 * road.edge > road.length:
            sentence = (
                f"two edges of {show(road.edge)} m are longer than the obstacle's length of {show(road.length)} m"
            )
            yield Breach("road.edge", sentence, ("road.length",))


def _rising(where: str, low_key: str, low: float, high_key: str, high: float, unit: str) -> Iterator[Breach]:
    if not low < high:
        sentence = f"{show(low)} {unit} is not below {high_key} ({show(high)} {unit})"
        yield Breach(f"{where}.{low_key}", sentence, (f"{where}.{high_key}",))


def _vibration(scene: Scene) -> Iterator[Breach]:
    vibration = scene.vibration
    if isinstance(vibration, SineSection):
        yield from _below_half_rate(vibration.sample_rate, "frequency", vibration.frequency)
    elif isinstance(vibration, SweepSection):
        rate, duration = vibration.octaves_per_minute, vibration.duration
        yield from _one_of("vibration", "octaves_per_minute", rate is not None, "duration", duration is not None)
        yield from _below_half_rate(vibration.sample_rate, "start_frequency", vibration.start_frequency)
        yield from _below_half_rate(vibration.sample_rate, "end_frequency", vibration.end_frequency)
        if vibration.start_frequency == vibration.end_frequency:
            sentence = f"is equal to start_frequency ({show(vibration.start_frequency)} Hz); take kind: sine"
            yield Breach("vibration.end_frequency", sentence, ("vibration.start_frequency",))
    elif isinstance(vibration, NoiseSection):
        yield from _rising("vibration", "low", vibration.low, "high", vibration.high, "Hz")
        yield from _below_half_rate(vibration.sample_rate, "high", vibration.high)
    elif isinstance(vibration, HalfSineSection):
        if vibration.start >= scene.duration:
            sentence = (
                f"the shock at {show(vibration.start)} s lies behind the end of the run ({show(scene.duration)} s)"
            )
            yield Breach("vibration.start", sentence, ("duration",))
        # A shock of few samples would have another impulse than its formula
        if vibration.duration * vibration.sample_rate < SAMPLES_OF_A_SHOCK * (1.0 - 1e-9):
            sentence = (
                f"{show(vibration.duration)} s hold {vibration.duration * vibration.sample_rate:.3g} samples; a shock needs "
                f"{SAMPLES_OF_A_SHOCK}, so make it longer, or the sample rate {show(SAMPLES_OF_A_SHOCK / vibration.duration)} Hz"
            )
            yield Breach("vibration.duration", sentence, ("vibration.sample_rate",))
    elif isinstance(vibration, RecordedSection) and vibration.rate is None and vibration.time_column is None:
        if vibration.file.endswith(BAG_ENDINGS):  # whose messages have stamps
            return
        sentence = (
            "is missing; give the file's sampling rate in Hz, or its time_column where it has one (nothing is guessed)"
        )
        yield Breach("vibration.rate", sentence, ("vibration.time_column",))


def _below_half_rate(sample_rate: float, key: str, frequency: float) -> Iterator[Breach]:
    if not frequency < 0.5 * sample_rate:
        sentence = f"{show(frequency)} Hz is not below half the sample rate ({show(sample_rate)} Hz)"
        yield Breach(f"vibration.{key}", sentence, ("vibration.sample_rate",))
