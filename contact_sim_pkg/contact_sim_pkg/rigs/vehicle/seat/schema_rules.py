"""Rules that tie keys of the occupant together."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from contact_sim_pkg.rigs.vehicle.seat.schema import (
    OWN,
    OccupantSection,
    SeatCushion,
    SeatSection,
    SofteningSection,
    segment_range,
)
from contact_sim_pkg.scene.errors import Breach
from contact_sim_pkg.scene.schema.catalog import show
from contact_sim_pkg.scene.schema.law_rules import unused
from contact_sim_pkg.scene.schema.scene import Scene

LIGHTEST = 0.1  # [kg] of a frame that is not massless: a lighter one swings faster than the rest by far
FOAM_KEYS = (
    "thickness", "modulus", "plateau", "densification", "densification_exponent", "hardness", "curve", "shear_share", "cover",
)  # fmt: skip
VALUES = ("frame_mass", "masses", "links", "stiffness", "damping", "head")


def occupant_breaches(scene: Scene) -> Iterator[Breach]:
    """Values of an occupant that do not belong together."""
    section = scene.section(SeatSection).occupant
    if scene.section(SeatSection).pan_tilt is not None and scene.rig != "occupant":
        yield Breach("seat.pan_tilt", "acts where a seat back holds the occupant on it, in the rig occupant", ("rig",))
    found = list(_choice_breaches(section)) or list(_link_breaches(section)) or list(_frame_breaches(section))
    yield from found
    softening = scene.effect("seat", SofteningSection)
    if not found and not section.model_of().links:
        yield from _linkless_breaches(section, softening)
    if softening is not None and softening.least >= softening.most:
        sentence = f"{show(softening.least)} m/s^2 is not below most ({show(softening.most)} m/s^2)"
        yield Breach("effects.seat.softening.least", sentence)


def cushion_breaches(scene: Scene) -> Iterator[Breach]:
    """Values of the half-space beside a cushion, which has a foam and a body of its own; values of a
    cushion that nothing uses.
    """
    cushion = scene.effect("seat", SeatCushion)
    if cushion is None:
        return
    yield from _carrier_breaches(cushion)
    seat, uses = scene.section(SeatSection), ("effects.seat.cushion",)
    sentence = "acts in half_space_field; the cushion has a foam and a body of its own; remove it"
    yield from unused("seat.body", seat.body, sentence, uses)
    for name in ("cushion_modulus", "cushion_poisson"):
        if getattr(seat, name) != SeatSection.model_fields[name].default:
            yield Breach(f"seat.{name}", sentence, uses)


def _carrier_breaches(cushion: SeatCushion) -> Iterator[Breach]:
    """A plate without tissue, foam on a plate, a depth of no tissue."""
    where = "effects.seat.cushion"
    if cushion.tissue is None and cushion.tissue_depth is not None:
        yield Breach(f"{where}.tissue_depth", "acts beside tissue, of which there is none", (f"{where}.tissue",))
    if cushion.carrier == "foam":
        return
    if cushion.tissue is None:
        sentence = "a rigid body touches a rigid plate at points; give the body tissue, 2000 by measured thickness"
        yield Breach(f"{where}.carrier", sentence, (f"{where}.tissue",))
    for name in FOAM_KEYS:
        if getattr(cushion, name) != SeatCushion.model_fields[name].default:
            yield Breach(f"{where}.{name}", "acts in foam, the carrier is a plate; remove it", (f"{where}.carrier",))


def response_breaches(scene: Scene) -> Iterator[Breach]:
    """A segment of the responses that is too short, or of more samples than memory has room for."""
    segment, rate = scene.section(SeatSection).response_segment, scene.outputs.force_rate
    shortest, longest = segment_range(rate)
    if segment and not shortest <= segment <= longest:
        sentence = (
            f"{show(segment)} s is outside {show(shortest)} to {show(longest)} s at {show(rate)} Hz; 0 leaves it out"
        )
        yield Breach("seat.response_segment", sentence, ("outputs.force_rate",))


def _choice_breaches(section: OccupantSection) -> Iterator[Breach]:
    """A model of one's own that lacks values; two masses; values beside a scaling that gives
    others.
    """
    given = {name: value for name in VALUES if (value := getattr(section, name)) is not None}
    scalings = [name for name in ("percentile", "mass") if getattr(section, name) is not None]
    scalings += ["posture"] if section.posture != 1.0 else []
    if section.percentile is not None and section.mass is not None:
        yield Breach(
            "seat.occupant.mass", "percentile gives the mass too; leave one out", ("seat.occupant.percentile",)
        )
    elif section.model == OWN:
        missing = [name for name in ("frame_mass", "masses", "stiffness", "damping") if name not in given]
        if missing:
            yield Breach("seat.occupant.model", f"{OWN} needs {' and '.join(missing)} beside it")
        for name in scalings:
            yield Breach(
                f"seat.occupant.{name}", f"scales a model by name; model: {OWN} is none", ("seat.occupant.model",)
            )
    elif scalings:
        follows = section.following()
        for name, value in given.items():
            if value != follows.get(name):
                sentence = f"follows from {scalings[0]} as {_shown(follows.get(name))}; leave one of them out"
                yield Breach(f"seat.occupant.{name}", sentence, (f"seat.occupant.{scalings[0]}",))


def _linkless_breaches(section: OccupantSection, softening: SofteningSection | None) -> Iterator[Breach]:
    """What acts on links, where the occupant has none."""
    if section.posture != 1.0:
        yield Breach("seat.occupant.posture", f"stiffens links, and {section.model} has none; remove it")
    if softening is not None:
        sentence = f"softens links, and the occupant ({section.model}) has none; remove it"
        yield Breach("effects.seat.softening", sentence, ("seat.occupant",))


def _link_breaches(section: OccupantSection) -> Iterator[Breach]:
    """Springs and dampers that do not belong to a link, links that do not lead anywhere."""
    values: dict[str, Any] = {**section.following(), **section.model_dump(exclude_none=True)}
    count, links = len(values["masses"]), values.get("links")
    # Without links each mass hangs on the frame by its own.
    thing, many = ("mass", count) if links is None else ("link", len(links))
    for name in ("stiffness", "damping"):
        if len(values[name]) != many:
            counted = "masses" if links is None else "links"
            sentence = f"has {len(values[name])} values, {counted} has {many}; each {thing} needs one"
            yield Breach(f"seat.occupant.{name}", sentence, (f"seat.occupant.{counted}",))
    if links is not None:
        yield from _end_breaches(links, count)
    if values.get("head", 0) > count:
        yield Breach("seat.occupant.head", f"is mass {values['head']}, masses has {count}", ("seat.occupant.masses",))


def _end_breaches(links: list[list[int]], count: int) -> Iterator[Breach]:
    """Links that lead from a mass to itself or to none, and masses that no link leads to."""
    reached = {0}
    for _each in range(count):
        reached |= {end for pair in links if reached & set(pair) for end in pair}
    for number, (lower, upper) in enumerate(links):
        where = f"seat.occupant.links.{number}"
        if max(lower, upper) > count:
            yield Breach(where, f"names mass {max(lower, upper)}, masses has {count}", ("seat.occupant.masses",))
            return
        if lower == upper:
            yield Breach(where, f"leads from {lower} to itself; a link joins two masses")
            return
    for number in sorted(set(range(1, count + 1)) - reached):
        yield Breach("seat.occupant.links", f"mass {number} hangs on nothing; lead links from it to the frame")


def _frame_breaches(section: OccupantSection) -> Iterator[Breach]:
    """A frame so light that it would swing by itself, and a massless one that nothing slows."""
    occupant = section.model_of()
    frame = occupant.masses[0]
    if 0.0 < frame < LIGHTEST:
        sentence = f"{show(frame)} kg is below {show(LIGHTEST)} kg; write 0 for a massless frame"
        yield Breach("seat.occupant.frame_mass", sentence)
    if frame == 0.0 and not any(link.damping > 0.0 for link in occupant.links if 0 in link[:2]):
        sentence = "a massless frame needs a damper in a link to it: nothing else slows it"
        yield Breach("seat.occupant.frame_mass", sentence, ("seat.occupant.damping",))


def _shown(value: Any) -> str:
    return str(value) if isinstance(value, list) else show(value)
