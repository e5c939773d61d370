"""A curve that somebody published, point by point with its uncertainty, the table that it stands in, and the judge of
what the bench has beside it.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple

__all__ = [
    "FORMULA",
    "HELD",
    "MEASURED",
    "PublishedCurve",
    "PublishedTable",
    "curves_of",
    "points_inside",
    "read_published",
]

MEASURED, FORMULA = "measured", "formula"
"""Kinds: points that somebody measured; a formula that was fitted to measurements."""
HELD = 0.7
"""Share of its points that lie inside in a curve that holds."""


@dataclass(frozen=True, kw_only=True)
class PublishedCurve:
    """Points of one curve beside that of the bench. Values in the units of the labels.

    Attributes:
        picture: heading of the picture that it stands in.
        name: what distinguishes it there: `166 kPa`.
        across: label of the axis across, with its unit: `load, N`.
        up: label of the other one.
        kind: `MEASURED` or `FORMULA`.
        blind: whether no constant of the bench was chosen by it.
        x: places across.
        y: published values there.
        error: uncertainty of each, as published or as its scatter shows.
        own: relative uncertainty of the value of the bench.
        ours: computes what the bench has at the places, in the same order; None where a run brings that.
        source: author, title, year, and where the curve is.
        note: why it misses, and other remarks.
    """

    picture: str
    name: str
    across: str
    up: str
    kind: str
    blind: bool
    x: tuple[float, ...]
    y: tuple[float, ...]
    error: tuple[float, ...]
    own: float
    ours: Callable[[Sequence[float]], Sequence[float]] | None
    source: str
    note: str = ""


def points_inside(curve: PublishedCurve, ours: Sequence[float]) -> list[bool | None]:
    """Whether each value of ours [points] lies as near to the published one as both uncertainties together allow,
    \\|ours - y\\| <= error + own \\|ours\\|; None where the bench has no value.
    """
    return [
        abs(value - y) <= error + curve.own * abs(value) if math.isfinite(value) else None
        for value, y, error in zip(ours, curve.y, curve.error, strict=True)
    ]


class PublishedTable(NamedTuple):
    """A file of published numbers."""

    notes: dict[str, str]
    """lines `# key: text` before the header: kind, source, licence, and what was measured"""
    labels: dict[str, str]
    """by the name of a column: `load, N`"""
    rows: list[dict[str, str]]
    """texts by the name of the column; empty where nothing is known"""


def read_published(path: Path) -> PublishedTable:
    """Read a table of ours: comments `# key: text`, a header `name (unit)`, rows."""
    lines = path.read_text(encoding="utf-8").splitlines()
    notes = dict(line[2:].split(": ", 1) for line in lines if line.startswith("# "))
    header, *rows = csv.reader(line for line in lines if not line.startswith("#"))
    names = [each.split(" (")[0] for each in header]
    labels = {name: each.replace(" (", ", ").rstrip(")") for name, each in zip(names, header, strict=True)}
    return PublishedTable(notes, labels, [dict(zip(names, row, strict=True)) for row in rows])


def curves_of(
    table: PublishedTable,
    picture: str,
    up: str,
    across: str,
    along: str,
    *,
    error: tuple[float, float] | str,
    own: float,
    at: Mapping[str, Any] = MappingProxyType({}),
    measure: Callable[[Mapping[str, Any]], float] | None = None,
    fitted: Sequence[float] = (),
    note: str = "",
) -> Iterator[PublishedCurve]:
    """The columns ``across`` and ``up`` of a table as curves, one for each value of the column ``along``.

    Args:
        table: published.
        picture: that they stand in.
        up, across, along: names of columns.
        error: uncertainty of a published value: in its unit, and as part of it, added; or the column that has its
            standard deviation, which counts twice.
        own: relative uncertainty of the bench's value.
        at: values that other columns have in the rows of these curves.
        measure: conditions by column -> value of the bench; without it the curves have none of ours.
        fitted: values of ``along`` at which a constant of the bench was chosen by the curve.
        note: of all these curves.
    """
    chosen = [
        row for row in table.rows
        if row[up] and row[across] and all(_value(row[name]) == value for name, value in at.items())
    ]  # fmt: skip
    unit = table.labels[along].partition(", ")[2]
    for text in dict.fromkeys(row[along] for row in chosen):
        rows = [row for row in chosen if row[along] == text]
        place, values = _value(text), [float(row[up]) for row in rows]
        held = {**at, along: place}

        def ours(places: Sequence[float], held: Mapping[str, Any] = held) -> list[float]:
            assert measure is not None
            return [measure({**held, across: each}) for each in places]

        yield PublishedCurve(
            picture=picture, name=f"{place if isinstance(place, str) else f'{place:g}'} {unit}".rstrip(),
            across=table.labels[across], up=table.labels[up], kind=table.notes["kind"], blind=place not in fitted,
            x=tuple(float(row[across]) for row in rows), y=tuple(values),
            error=tuple(
                2.0 * float(row[error]) if isinstance(error, str) else error[0] + error[1] * abs(value)
                for row, value in zip(rows, values, strict=True)
            ),
            own=own, ours=ours if measure is not None else None,
            source=f"{table.notes['source']}. Licence: {table.notes['licence']}", note=note,
        )  # fmt: skip


def _value(text: str) -> float | str:
    """A field as a number where it is one."""
    try:
        return float(text)
    except ValueError:
        return text
