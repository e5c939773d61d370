"""What is said of a contact that is not used."""

from __future__ import annotations

__all__ = ["DISAGREES", "DOUBLE", "SEVERAL", "TOUCHES", "TOUCHES_NOTHING", "UNSURE"]

TOUCHES = "touches"  # how a note begins on a contact that another round may use
SEVERAL = f"{TOUCHES} with"
TOUCHES_NOTHING = f"{TOUCHES} nothing known"
DOUBLE = "the flights before and after miss each other: more than one impact in between"
UNSURE = "the flight before does not come down: too short to tell where it touches"
DISAGREES = "contradicts the other contacts by more than noise explains: more than one impact in between?"
