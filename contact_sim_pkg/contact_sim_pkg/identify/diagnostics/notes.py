"""What is said of a contact that is not used, and where there is nothing but contacts."""

from __future__ import annotations

__all__ = ["DISAGREES", "DOUBLE", "SEVERAL", "TOUCHES", "TOUCHES_NOTHING", "UNSURE", "cure_without_flights"]

TOUCHES = "touches"  # how a note begins on a contact that another round may use
SEVERAL = f"{TOUCHES} with"
TOUCHES_NOTHING = f"{TOUCHES} nothing known"
DOUBLE = "the flights before and after miss each other: more than one impact in between"
UNSURE = "the flight before does not come down: too short to tell where it touches"
DISAGREES = "contradicts the other contacts by more than noise explains: more than one impact in between?"


def cure_without_flights(*, no_friction: bool, no_force: bool) -> str:
    """What helps where no flight and no slide tells anything: what of a slide is not known, if that may be it."""
    record = "record faster, or a motion that leaves the ground"
    unknown = [
        name for name, lacks in (("the friction coefficient", no_friction), ("the known force", no_force)) if lacks
    ]
    if unknown:
        return f"{record}, or give {' and '.join(unknown)} of a slide"
    return f"{record}; no slide of the body on the ground as told was found either: check the shape, its axes, and the ground"
