"""Rules of the rig occupant: what a seat back under one trunk does not have, and what holds him to it."""

from __future__ import annotations

from collections.abc import Iterator
from math import tan

from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.records.fields import Section
from contact_sim_pkg.rigs.backrest.schema import (
    ANGLE,
    BackFriction,
    BackrestSection,
    ContactSearchSection,
    ShellModesSection,
)
from contact_sim_pkg.rigs.vehicle.seat.schema import PAN_TILT, SeatSection
from contact_sim_pkg.rigs.vehicle.seat.schema_rules import occupant_breaches
from contact_sim_pkg.scene.errors import Breach
from contact_sim_pkg.scene.schema.catalog import show
from contact_sim_pkg.scene.schema.laws import FrictionSection
from contact_sim_pkg.scene.schema.scene import Scene

ELSEWHERE: dict[str, type[Section]] = {
    "friction": BackFriction, "shell_modes": ShellModesSection, "contact_search": ContactSearchSection,
}  # fmt: skip


def leaning_breaches(scene: Scene) -> Iterator[Breach]:
    """A trunk of its own for the back, effects of such a trunk, nothing that presses the occupant
    against the seat back, or so much that he leaves the pan.
    """
    seat, back = scene.section(SeatSection), scene.section(BackrestSection)
    if back.mass is not None:
        sentence = (
            "the trunk of seat.occupant leans on the seat back, with its own mass; remove it (backrest.mass=null)"
        )
        yield Breach("backrest.mass", sentence, ("rig",))
    for name, kind in ELSEWHERE.items():
        if scene.effect("backrest", kind) is not None:
            yield Breach(f"effects.backrest.{name}", "acts on a back by itself, in the rig backrest", ("rig",))
    tilt = PAN_TILT if seat.pan_tilt is None else seat.pan_tilt
    angle, preload = ANGLE if back.angle is None else back.angle, back.preload or 0.0
    if tilt == 0.0 and preload == 0.0:
        sentence = (
            "on a level pan nothing presses the occupant against the seat back; tilt it, or give backrest.preload"
        )
        yield Breach("seat.pan_tilt", sentence, ("backrest.preload",))
    if list(occupant_breaches(scene)):
        return
    occupant = seat.occupant.model_of()
    if preload * tan(angle) >= occupant.mass * GRAVITY:
        sentence = f"{show(preload)} N lift the occupant from the pan, along a seat back at {show(angle)} rad"
        yield Breach("backrest.preload", sentence, ("backrest.angle", "seat.occupant"))
    if occupant.masses[0] == 0.0 and scene.effect("seat", FrictionSection) is not None:
        sentence = "on a tilted pan acts on the mass of the frame, and seat.occupant has none"
        yield Breach("effects.seat.friction", sentence, ("seat.occupant",))
