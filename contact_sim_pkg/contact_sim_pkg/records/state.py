"""What of an object changes in a run: declared beside the class, so that a run can be saved and gone on with."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["State", "state_of"]


class State(NamedTuple):
    """Names of attributes, dotted for a part of one: ``work.step``. All else of the object is constant or scratch.

    A class has its own as ``STATE``. A value is a number, text or array, a named tuple or dataclass of the bench, an object
    that declares a state itself, or a list, tuple or dict of these. An array that is an attribute is filled in place.
    """

    physics: tuple[str, ...]
    """what the motion goes on from"""
    solver: tuple[str, ...] = ()
    """warm starts, step control and estimates: what it takes beside that to go on with the same bits"""
    held: tuple[str, ...] = ()
    """those of both that are named tuples of buffers, which compiled code holds: filled in place"""

    @property
    def names(self) -> tuple[str, ...]:
        """All."""
        return self.physics + self.solver


def state_of(thing: object) -> State | None:
    """What the class of a thing declares; None where it declares nothing."""
    found = getattr(type(thing), "STATE", None)
    return found if isinstance(found, State) else None
