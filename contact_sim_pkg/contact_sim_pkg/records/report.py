"""Additions of a rig to the report of a bag. Functions are named as ``module:name`` and loaded on
use.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

__all__ = ["ContactReport", "LedgerScope", "SeriesReader"]


class LedgerScope(NamedTuple):
    """What an energy ledger is of, where that is not the whole rig."""

    motion: str  # "vertical motion"
    outside: tuple[str, ...]  # what the run turns over beside it


@dataclass(frozen=True, kw_only=True)
class SeriesReader:
    """Reader of the messages of some types.

    Attributes:
        name: of the series in `Recording.series`.
        types: message types that it reads, `package/msg/Type`.
        reader: class without arguments. ``add(time, type, message)`` reads the messages in the
            order of the bag, `time` in [s]; ``finish()`` returns the series, or None.
        reduces: keeps numbers and a few of the messages, not all of them.
        open_fields: fields of the messages that may be NaN: where there was nothing to measure.
    """

    name: str
    types: tuple[str, ...]
    reader: str
    reduces: bool = False
    open_fields: tuple[str, ...] = ()


@dataclass(frozen=True, kw_only=True)
class ContactReport:
    """Report of one contact beside what every contact has. An empty name adds nothing.

    Attributes:
        contact: its name.
        series: readers of its own messages.
        sections: (number of the contact, recording) -> sections of the page, in place of the
            general one.
        closing_sections: (recording) -> sections that follow those of all contacts.
        metrics: (recording) -> its list of metrics, 8 to 14, the most important first.
        warnings: (recording) -> sentences that stand before the numbers.
        ledger: (recording) -> `LedgerScope` of its energy ledger, where that is not of the whole rig.
        drive_period: (scene) -> period [s] of a drive that is not the vibration, or None.
        lead: beginnings of the names of its pictures that stand on the first screen; `{contact}` is the key of
            its general section.
        parts: (scene) -> `report.sketch.Part`s of its drawing, from the ground upwards.
        answer: what the page says first, a phrase each: `SEAT {factor}` with a metric's key in braces, `{factor:remark}`
            for what is remarked of it; a phrase without its metric is left out.
        curves: (recording) -> `compare.side_by_side.Curve` by name, for tolerances.
        comparison: (key, contact, runs) -> pictures that compare several runs.
        compared: (recording) -> metrics that a comparison lists and shows first, beside the list of the run.
        weighted: (recording, weighting) -> metrics of what shakes a person, by that weighting.
        tables: (recording) -> `Section`s of `bench table`, by the kind of table.
    """

    contact: str
    series: tuple[SeriesReader, ...] = ()
    sections: str = ""
    closing_sections: str = ""
    metrics: str = ""
    warnings: str = ""
    ledger: str = ""
    drive_period: str = ""
    lead: tuple[str, ...] = ()
    parts: str = ""
    answer: tuple[str, ...] = ()
    curves: str = ""
    comparison: str = ""
    compared: str = ""
    weighted: str = ""
    tables: Mapping[str, str] = field(default_factory=dict)
