"""Bands of metrics from the product's data file `bands.yaml`, chosen by the conditions of a run."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from typing import NamedTuple

from contact_sim_pkg.records.metric import Band

__all__ = ["Conditions", "FoundBand", "band_of", "published_range"]

MOST_NAMED = 3
"""Conditions that a sentence names."""
Conditions = Mapping[str, "float | str"]
"""What a run is, by the names of the data file: `load_kN`, `speed_m_s`, `road`."""


class FoundBand(NamedTuple):
    """The band of a quantity in a run."""

    band: Band | None
    reason: str
    """why there is none; empty where there is one"""
    words: tuple[tuple[float, float, str], ...]
    """scale: from, to, word"""

    def word(self, value: float) -> str:
        """The words whose range holds a value, in the order of the scale."""
        return " to ".join(word for low, high, word in self.words if low <= value < high)


class _Entry(NamedTuple):
    band: Band
    unit: str
    conditions: dict[str, tuple[float, float] | str]
    words: tuple[tuple[float, float, str], ...]


def band_of(quantity: str, conditions: Conditions) -> FoundBand:
    """The first band of a quantity whose conditions a run meets."""
    entries = _entries().get(quantity, [])
    for entry in entries:
        if all(_met(wanted, conditions.get(name)) for name, wanted in entry.conditions.items()):
            return FoundBand(entry.band, "", entry.words)
    # of the texts of a run, such as its road, those that fit
    fitting = [each for each in entries if all(
        _met(wanted, conditions.get(name)) for name, wanted in each.conditions.items() if isinstance(wanted, str)
    )]  # fmt: skip
    published = [entry.band.conditions for entry in fitting or entries]
    named = ", ".join(published[:MOST_NAMED]) + (" and others" if len(published) > MOST_NAMED else "")
    reason = f"no band here: published for {named}" if published else "no band"
    return FoundBand(None, reason, ())


def published_range(quantity: str) -> tuple[float, float]:
    """Ends of the one band of a quantity, in its unit in the data file."""
    (entry,) = _entries()[quantity]
    return entry.band.low, entry.band.high


def _met(wanted: tuple[float, float] | str, found: float | str | None) -> bool:
    if isinstance(wanted, str):
        return found == wanted
    return isinstance(found, (int, float)) and wanted[0] <= found <= wanted[1]


@cache
def _entries() -> dict[str, list[_Entry]]:
    from ruamel.yaml import YAML

    text = (files(__package__) / "bands.yaml").read_text(encoding="utf-8")
    return {quantity: [_entry(each) for each in rows] for quantity, rows in YAML(typ="safe").load(text).items()}


def _entry(row: dict[str, object]) -> _Entry:
    low, high = (_number(row.get(name, end)) for name, end in (("low", -math.inf), ("high", math.inf)))
    band = Band(low, high, str(row["kind"]), str(row["source"]), str(row.get("published", "")))
    given = row.get("conditions", {})
    assert isinstance(given, dict)
    conditions: dict[str, tuple[float, float] | str] = {
        name: wanted if isinstance(wanted, str) else (_number(wanted[0]), _number(wanted[1]))
        for name, wanted in given.items()
    }
    words = row.get("words", [])
    assert isinstance(words, list)
    scale = tuple((_number(low), _number(high), str(word)) for low, high, word in words)
    return _Entry(band, str(row["unit"]), conditions, scale)


def _number(value: object) -> float:
    assert isinstance(value, (int, float))
    return float(value)
