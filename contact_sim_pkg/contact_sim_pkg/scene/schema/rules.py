"""Rules that tie several keys of a scene together; a contradiction is a fault, never mended."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain, pairwise

from contact_sim_pkg.records.registry import contacts, refused_sections, rigs
from contact_sim_pkg.rigs.backrest.schema_rules import backrest_breaches
from contact_sim_pkg.rigs.body.schema_rules import block_breaches
from contact_sim_pkg.rigs.impact.schema_rules import impact_breaches
from contact_sim_pkg.rigs.roller.schema_rules import roller_breaches
from contact_sim_pkg.rigs.vehicle.tire.schema_rules import slip_breaches, tire_effect_breaches
from contact_sim_pkg.scene.errors import Breach
from contact_sim_pkg.scene.schema.catalog import show
from contact_sim_pkg.scene.schema.clock import clock_breaches
from contact_sim_pkg.scene.schema.road import BumpRoad, CleatRoad, Iso8608Road, PotholeRoad
from contact_sim_pkg.scene.schema.scene import Scene
from contact_sim_pkg.scene.schema.vibration import HalfSine, Noise, Recorded, Sine, Sweep

SAMPLES_OF_A_SHOCK = 10
"""At least; straight lines between as many samples keep its change of speed to 1 %."""


def breaches(scene: Scene) -> Iterator[Breach]:
    """All breaches of rules between keys; the rules of effects are in `scene/schema/effect_rules.py`."""
    return chain(
        _sections(scene),
        clock_breaches(scene),
        _travel(scene),
        slip_breaches(scene),
        tire_effect_breaches(scene),
        backrest_breaches(scene),
        impact_breaches(scene),
        block_breaches(scene),
        roller_breaches(scene),
        _road(scene),
        _vibration(scene),
        _occupant(scene),
        _contacts(scene),
    )


def _sections(scene: Scene) -> Iterator[Breach]:
    for name in rigs()[scene.rig].needs:
        if getattr(scene, name) is None:
            yield Breach(name, f"is missing; the rig {scene.rig} needs it", ("rig",))
    for name in refused_sections(scene.rig):
        if getattr(scene, name) is not None:
            yield Breach(name, f"the rig {scene.rig} has no {name}; remove it or choose another rig", ("rig",))


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
    if isinstance(road, Iso8608Road):
        yield from _one_of(
            "road", "roughness_class", road.roughness_class is not None, "roughness", road.roughness is not None
        )
        yield from _rising(
            "road", "shortest_wavelength", road.shortest_wavelength, "longest_wavelength", road.longest_wavelength, "m"
        )
        yield from _rising("road", "shortest_wavelength", road.shortest_wavelength, "length", road.length, "m")
        if road.texture is not None:
            shortest = road.texture.shortest_wavelength
            yield from _rising(
                "road", "texture.shortest_wavelength", shortest, "shortest_wavelength", road.shortest_wavelength, "m"
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
    if isinstance(vibration, Sine):
        yield from _below_half_rate(vibration.sample_rate, "frequency", vibration.frequency)
    elif isinstance(vibration, Sweep):
        rate, duration = vibration.octaves_per_minute, vibration.duration
        yield from _one_of("vibration", "octaves_per_minute", rate is not None, "duration", duration is not None)
        yield from _below_half_rate(vibration.sample_rate, "start_frequency", vibration.start_frequency)
        yield from _below_half_rate(vibration.sample_rate, "end_frequency", vibration.end_frequency)
        if vibration.start_frequency == vibration.end_frequency:
            sentence = f"is equal to start_frequency ({show(vibration.start_frequency)} Hz); take kind: sine"
            yield Breach("vibration.end_frequency", sentence, ("vibration.start_frequency",))
    elif isinstance(vibration, Noise):
        yield from _rising("vibration", "low", vibration.low, "high", vibration.high, "Hz")
        yield from _below_half_rate(vibration.sample_rate, "high", vibration.high)
    elif isinstance(vibration, HalfSine):
        if vibration.start >= scene.duration:
            sentence = (
                f"the shock at {show(vibration.start)} s lies behind the end of the run ({show(scene.duration)} s)"
            )
            yield Breach("vibration.start", sentence, ("duration",))
        if vibration.duration * vibration.sample_rate < SAMPLES_OF_A_SHOCK * (1.0 - 1e-9):
            sentence = (
                f"{show(vibration.duration)} s hold {vibration.duration * vibration.sample_rate:.3g} samples; a shock needs "
                f"{SAMPLES_OF_A_SHOCK}, so make it longer, or the sample rate {show(SAMPLES_OF_A_SHOCK / vibration.duration)} Hz"
            )
            yield Breach("vibration.duration", sentence, ("vibration.sample_rate",))
    elif isinstance(vibration, Recorded) and vibration.rate is None and vibration.time_column is None:
        sentence = (
            "is missing; give the file's sampling rate in Hz, or its time_column where it has one (nothing is guessed)"
        )
        yield Breach("vibration.rate", sentence, ("vibration.time_column",))


def _below_half_rate(sample_rate: float, key: str, frequency: float) -> Iterator[Breach]:
    if not frequency < 0.5 * sample_rate:
        sentence = f"{show(frequency)} Hz is not below half the sample rate ({show(sample_rate)} Hz)"
        yield Breach(f"vibration.{key}", sentence, ("vibration.sample_rate",))


def _occupant(scene: Scene) -> Iterator[Breach]:
    if scene.seat is None:
        return
    occupant = scene.seat.occupant
    for name, values in (("stiffness", occupant.stiffness), ("damping", occupant.damping)):
        if len(values) != len(occupant.masses):
            sentence = f"has {len(values)} values, masses has {len(occupant.masses)}; each mass needs one"
            yield Breach(f"seat.occupant.{name}", sentence, ("seat.occupant.masses",))


def _contacts(scene: Scene) -> Iterator[Breach]:
    for contact in contacts():
        effects, where = getattr(scene.effects, contact), f"effects.{contact}"
        loss = getattr(effects, "normal_dissipative", None)
        if loss is not None and hasattr(loss, "damping"):
            yield from _loss(f"{where}.normal_dissipative", loss.damping, loss.restitution, loss.reference_speed)
        yield from _general(where, effects)
        yield from _foam(where, effects)
        friction = getattr(effects, "friction", None)
        if friction is not None and friction.coefficient_kinetic > friction.coefficient_static:
            kinetic, static = show(friction.coefficient_kinetic), show(friction.coefficient_static)
            sentence = f"{kinetic} is above coefficient_static ({static})"
            yield Breach(f"{where}.friction.coefficient_kinetic", sentence, (f"{where}.friction.coefficient_static",))


def _loss(where: str, damping: float | None, restitution: float | None, speed: float | None) -> Iterator[Breach]:
    if damping is not None and restitution is not None:
        yield Breach(f"{where}.restitution", "damping and restitution are both given; keep one", (f"{where}.damping",))
    if restitution is not None and speed is None:
        yield Breach(
            f"{where}.reference_speed", "is missing; restitution holds at one impact speed", (f"{where}.restitution",)
        )
    if restitution is None and speed is not None:
        yield Breach(
            f"{where}.reference_speed", "has no meaning without restitution; remove it", (f"{where}.restitution",)
        )


def _general(where: str, effects: object) -> Iterator[Breach]:
    """The general law takes a coefficient or a restitution, and may pull only where nothing rubs."""
    general, place = getattr(effects, "general_dissipative", None), f"{where}.general_dissipative"
    if general is None:
        return
    if general.coefficient is not None and general.restitution is not None:
        sentence = "coefficient and restitution are both given; keep one"
        yield Breach(f"{place}.restitution", sentence, (f"{place}.coefficient",))
    if general.restitution is not None and general.reference_speed is None:
        sentence = "is missing; restitution holds at one impact speed"
        yield Breach(f"{place}.reference_speed", sentence, (f"{place}.restitution",))
    if general.restitution is None and general.reference_speed is not None and general.rate_exponent >= 1.0:
        sentence = "has no meaning without restitution or a rate_exponent below 1; remove it"
        yield Breach(f"{place}.reference_speed", sentence, (f"{place}.restitution", f"{place}.rate_exponent"))
    if general.end == "gap" and getattr(effects, "friction", None) is not None:
        sentence = "a contact that pulls has no Coulomb limit; take end: force or remove friction"
        yield Breach(f"{place}.end", sentence, (f"{where}.friction",))


def _foam(where: str, effects: object) -> Iterator[Breach]:
    """Foam begins stiffer than its plateau; the general law's restitution is known for power laws only."""
    foam, general = (getattr(effects, name, None) for name in ("foam", "general_dissipative"))
    if foam is None:
        return
    if not foam.modulus > foam.plateau:
        sentence = f"{show(foam.modulus)} Pa is not above plateau ({show(foam.plateau)} Pa)"
        yield Breach(f"{where}.foam.modulus", sentence, (f"{where}.foam.plateau",))
    if general is not None and general.restitution is not None:
        sentence = "holds for a power law, not for foam; give a coefficient, or take normal_dissipative"
        yield Breach(f"{where}.general_dissipative.restitution", sentence, (f"{where}.foam",))
