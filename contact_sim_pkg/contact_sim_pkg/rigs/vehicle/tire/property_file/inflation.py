"""The inflation that a tire property file states, in the words of its format."""

from __future__ import annotations

from contact_sim_pkg.rigs.vehicle.tire.property_file.errors import PropertyFileError
from contact_sim_pkg.rigs.vehicle.tire.property_file.fit import allowed
from contact_sim_pkg.rigs.vehicle.tire.property_file.keys import IP_FIRST, NOMINAL, OPERATING
from contact_sim_pkg.rigs.vehicle.tire.property_file.reading import PropertyFile, Value
from contact_sim_pkg.rigs.vehicle.tire.schema import Inflation

__all__ = ["BeyondInflationError", "stated_inflation"]

SAME = 0.01  # relative: two statements of one inflation


class BeyondInflationError(PropertyFileError):
    """An inflation that no scene takes."""

    def __init__(self, sentence: str, nearest: float, stated: float, nominal: float) -> None:
        """With the ``nearest`` that a scene takes, the ``stated`` one and that at which the coefficients hold [Pa]."""
        super().__init__(sentence)
        self.nearest, self.stated, self.nominal = nearest, stated, nominal


def stated_inflation(tire: PropertyFile, notes: list[str]) -> tuple[float, float]:
    """Inflation of the scene, and that at which the coefficients hold [Pa].

    The first counts of: a word for the operating inflation, one for the nominal, a comment, the usual
    inflation, with a note for all but the first.

    Raises BeyondInflationError, with its line, for one that a scene does not take.
    """
    operating, nominal = _stated(tire, OPERATING, "IP", notes), _stated(tire, NOMINAL, "IP_NOM", notes)
    if operating is not None and nominal is not None and not _same(operating[1], nominal[1]):
        notes.append(f"{_said(*operating)} is the inflation; the coefficients hold at {_said(*nominal)}")
    if operating is None and nominal is not None:
        notes.append(f"no operating inflation; {_said(*nominal)} counts")
    if operating is None and nominal is None and tire.commented is not None:
        operating = "a comment", tire.commented
        notes.append(f"the inflation {tire.commented.value:g} Pa is that of the comment in line {tire.commented.line}")
    chosen = operating or nominal
    if chosen is None:
        usual = Inflation().pressure
        notes.append(f"no INFLPRES, IP or other inflation; {usual:g} Pa is assumed, in the stiffnesses too")
        return usual, usual
    pressure, factor = chosen[1].value, tire.get("LIP") or 1.0
    low, high = allowed("pressure")
    holds = pressure if nominal is None else nominal[1].value
    if not low <= factor * pressure <= high:
        times = "" if factor == 1.0 else f" times LIP {factor:g}"
        raise BeyondInflationError(
            f"{tire.file}, line {chosen[1].line}: the inflation of {chosen[0]} is {pressure:g} Pa{times}; the inflated tire "
            f"of a scene takes {low:g} to {high:g} Pa, so give a file of this tire at such an inflation",
            min(max(factor * pressure, low), high), factor * pressure, holds,
        )  # fmt: skip
    return factor * pressure, holds


def _stated(tire: PropertyFile, words: tuple[str, ...], own: str, notes: list[str]) -> tuple[str, Value] | None:
    """The word that counts and its value; own: that of the formats of `IP_FIRST`."""
    if tire.format.startswith(IP_FIRST):
        words = (own, *words)
    have = [(word, tire.values[word]) for word in dict.fromkeys(words) if word in tire.values]
    for other in have[1:]:
        if not _same(have[0][1], other[1]):
            notes.append(f"{_said(*have[0])} counts, not {_said(*other)}")
    return have[0] if have else None


def _same(one: Value, other: Value) -> bool:
    return abs(one.value / other.value - 1.0) <= SAME


def _said(word: str, value: Value) -> str:
    return f"{word} {value.value:g} Pa (line {value.line})"
