"""What a measured change says about an effect, in thirds of the requested accuracy.

An effect that is on is *needed* where leaving it out changes a judged quantity by more than the
request, *not needed* where none changes by a third of it, *within the accuracy* between. One that
is off is *off but needed* where the scene's own data call for it and it changes one by more; else
its change is a figure. One that only observes has a price and no verdict.

A change is measured between two runs at one level finer than requested; what it says is uncertain
by the error of their numbers, and where that could turn the verdict *the error of the numbers
decides*. What lies below `ROUNDING` is no change.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from contact_sim_pkg.compare.judgement import Judgement

__all__ = [
    "CARRIES",
    "NEEDED",
    "NOT_NEEDED",
    "NUMBERS",
    "OBSERVES",
    "OFF_NEEDED",
    "UNAVAILABLE",
    "WITHIN",
    "WOULD_OBSERVE",
    "Change",
    "changes_of",
    "largest",
    "shown",
    "verdict_off",
    "verdict_on",
]

NEEDED, WITHIN, NOT_NEEDED = "needed", "within the accuracy", "not needed"
OBSERVES, CARRIES = "observes", "carries the load"
OFF_NEEDED, UNAVAILABLE, WOULD_OBSERVE = "off but needed", "not available", "would observe"
NUMBERS = "the error of the numbers decides"
THIRD = 1.0 / 3.0
ROUNDING = 1e-12
"""Of the scale: what doubles that are summed in another order differ by."""


class Change(NamedTuple):
    """What an effect changes of one kind at one contact or body."""

    place: str
    kind: str
    size: float  # largest difference over the scale of the kind
    error: float  # of that number
    column: str
    time: float  # [s]

    @property
    def resolved(self) -> bool:
        """Whether it is more than the error of its numbers."""
        return self.size > self.error


def changes_of(
    judgements: Iterable[Judgement], errors: Mapping[tuple[str, str], float], not_below: Mapping[str, float]
) -> tuple[Change, ...]:
    """Changes by place and kind, largest first, with the ``errors`` of the numbers, which are
    ``not_below`` some of their kind.
    """
    found = [
        Change(
            each.place,
            each.kind,
            each.error if each.error > ROUNDING else 0.0,
            max(errors.get((each.place, each.kind), 0.0), not_below.get(each.kind, 0.0)),
            each.column,
            each.time,
        )
        for each in judgements
    ]
    return tuple(sorted(found, key=lambda each: (each.resolved, each.size), reverse=True))


def largest(changes: Sequence[Change]) -> Change | None:
    """The largest change that the numbers resolve, else the largest; None where nothing is judged."""
    return changes[0] if changes else None


def verdict_on(changes: Sequence[Change], request: float) -> str:
    """Verdict of an effect that acts in the scene."""
    if any(each.resolved and each.size > request for each in changes):
        return NEEDED
    if any(not each.resolved and each.size > THIRD * request for each in changes):
        return NUMBERS
    return NOT_NEEDED if all(each.size <= THIRD * request for each in changes) else WITHIN


def verdict_off(changes: Sequence[Change], request: float, called_for: str) -> str:
    """Verdict of an effect that the scene does not name; ``called_for`` is empty where nothing in
    its data calls for it.
    """
    most = largest(changes)
    if most is None or not most.size > 0.0:
        return "would change nothing"
    if called_for and most.resolved and most.size > request:
        return OFF_NEEDED
    if not most.resolved and most.size > THIRD * request:
        return NUMBERS
    return f"would change {shown(most)}"


def shown(change: Change) -> str:
    """Kind and size, as ``force 13 %``; ``nothing`` where there is none."""
    if not change.size > 0.0:
        return "nothing"
    if math.isinf(change.size):
        return f"leaves no {change.kind}"
    words = {"peak": "peak pressure", "area": "contact area"}
    percent = 100.0 * change.size
    return f"{words.get(change.kind, change.kind)} {percent:{'.0f' if percent >= 10.0 else '.2g'}} %"
