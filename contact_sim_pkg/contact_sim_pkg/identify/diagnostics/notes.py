"""Findings about single contacts, and their sentences."""

from __future__ import annotations

import enum
from collections.abc import Mapping
from typing import NamedTuple

__all__ = ["FREE_MOTION_MISSING", "SENTENCES", "ContactNote", "NoteKind", "cure_without_flights"]


class NoteKind(enum.Enum):
    """Why a contact is not used, or what a lasting one does."""

    NO_FLIGHT_BESIDE = enum.auto()
    FLIGHT_TOO_SHORT = enum.auto()
    NOTHING_TOUCHED = enum.auto()
    SEVERAL_CORNERS = enum.auto()
    FLIGHTS_MISS = enum.auto()
    DOUBLE_IMPACT = enum.auto()
    CONTRADICTS = enum.auto()
    LASTING = enum.auto()
    PRESSED_IN = enum.auto()
    BELOW_GROUND = enum.auto()
    ABOVE_GROUND = enum.auto()


SENTENCES = {
    NoteKind.NO_FLIGHT_BESIDE: "no flight of {samples} samples before or after it",
    NoteKind.FLIGHT_TOO_SHORT: "the flight before does not come down: too short to locate the contact",
    NoteKind.NOTHING_TOUCHED: "touches no known surface: the lowest point is {gap:.3g} m above the ground there",
    NoteKind.SEVERAL_CORNERS: "touches with {corners} corners at once: where its impulse acts is not known",
    NoteKind.FLIGHTS_MISS: "the flights before and after miss each other by {miss:.2g} m, and between them more than "
    "one corner touches, or one more than once",
    NoteKind.DOUBLE_IMPACT: "the flights before and after miss each other: more than one impact in between",
    NoteKind.CONTRADICTS: "contradicts the other contacts by more than noise explains: more than one impact in between?",
    NoteKind.LASTING: "lasting contact{depth}, {motion}",
    NoteKind.PRESSED_IN: "lasting contact, presses into the ground",
    NoteKind.BELOW_GROUND: "no free motion, {depth:.3g} m below the ground: check the shape, its axes, and the ground",
    NoteKind.ABOVE_GROUND: "no free motion, up to {height:.3g} m above the ground: check gravity, wrench, axes of the "
    "twist, and shape",
}
FREE_MOTION_MISSING = (NoteKind.BELOW_GROUND, NoteKind.ABOVE_GROUND)  # of what cannot be a contact


class ContactNote(NamedTuple):
    """One finding, with the values of its sentence."""

    kind: NoteKind
    values: Mapping[str, str | int | float] = {}

    @property
    def sentence(self) -> str:
        """The finding in words."""
        return SENTENCES[self.kind].format(**self.values)


def cure_without_flights(*, no_friction: bool, no_force: bool) -> str:
    """What to change where neither a flight nor a slide identifies anything.

    Args:
        no_friction: the friction coefficient of a slide is not known.
        no_force: the force during a slide is not known.
    """
    record = "record faster, or a motion that leaves the ground"
    unknown = [
        name for name, lacks in (("the friction coefficient", no_friction), ("the known force", no_force)) if lacks
    ]
    if unknown:
        return f"{record}, or give {' and '.join(unknown)} of a slide"
    return f"{record}; no slide of the body on the given ground was found either: check the shape, its axes, and the ground"
