"""A rule between keys of a scene that does not hold, and the rules that several sections share."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

__all__ = ["Breach", "one_of", "rising", "show"]


@dataclass(frozen=True, slots=True)
class Breach:
    """A rule that ties several keys together and does not hold; becomes a `Fault` when its place is
    looked up.

    Attributes:
        where: dotted path of the key that the fault is shown at.
        sentence: what is wrong, the values, what is allowed.
        uses: further keys that the rule looked at; a breach is not reported where one of them has a
            fault of its own.
    """

    where: str
    sentence: str
    uses: tuple[str, ...] = ()


def show(value: Any) -> str:
    """A number as a person would write it."""
    return f"{value:.12g}" if isinstance(value, float) else str(value)


def one_of(where: str, first: str, first_given: bool, second: str, second_given: bool) -> Iterator[Breach]:
    """A breach where both of two keys of a section are given, or neither is."""
    if first_given and second_given:
        yield Breach(f"{where}.{second}", f"{first} and {second} are both given; keep one", (f"{where}.{first}",))
    elif not first_given and not second_given:
        yield Breach(f"{where}.{first}", f"is missing; give {first} or {second}", (f"{where}.{second}",))


def rising(where: str, low_key: str, low: float, high_key: str, high: float, unit: str) -> Iterator[Breach]:
    """A breach where the value of a key is not below that of another, both in ``unit``."""
    if not low < high:
        sentence = f"{show(low)} {unit} is not below {high_key} ({show(high)} {unit})"
        yield Breach(f"{where}.{low_key}", sentence, (f"{where}.{high_key}",))
