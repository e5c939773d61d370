"""Lines of a table of errors: one a method, its quantities side by side, its time last."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import cache
from typing import Any

from contact_sim_lab.cases import modules_of_rigs, objects
from contact_sim_lab.records.accuracy import AccuracyPart

__all__ = ["Row", "against", "error_lines", "parts_of_rigs"]

Row = dict[str, Any]


@cache
def parts_of_rigs() -> tuple[AccuracyPart, ...]:
    """Parts of the accuracy studies of all rigs, each once."""
    studies = objects(modules_of_rigs("accuracy"), "ACCURACY")
    return tuple(dict.fromkeys(part for study in studies for part in study.parts))


def error_lines(
    rows: Iterable[Row], head: dict[str, str], key: tuple[str, ...], errors: Callable[[Row], Row], cost: tuple[str, str]
) -> list[Row]:
    """Rows of equal key as one line.

    Args:
        rows: of a study.
        head: column of a row -> heading of the line's first columns; a column without a value is
            left out.
        key: columns in which the rows of a line agree.
        errors: of a row, by their headings.
        cost: column of the time, and its heading.
    """
    lines: dict[tuple[Any, ...], Row] = {}
    times: dict[tuple[Any, ...], Row] = {}
    for row in rows:
        place = tuple(row[name] for name in key)
        first = {heading: row[name] for name, heading in head.items() if row[name] is not None or name in key}
        # Rows of one key meet in a line; its time is that of the last
        lines.setdefault(place, first).update(errors(row))
        times[place] = {cost[1]: row[cost[0]]}
    return [{**line, **times[place]} for place, line in lines.items()]


def against(rows: list[Row]) -> str:
    """What the errors are against; where not all are against the same, which are."""
    quantities: dict[str, list[str]] = {}
    for row in rows:
        named = quantities.setdefault(row["reference"], [])
        named += [row["quantity"]] if row["quantity"] not in named else []
    if len(quantities) < 2:
        return f"against: {rows[0]['reference']}" if rows else ""
    return "against: " + "; ".join(f"{reference} ({', '.join(named)})" for reference, named in quantities.items())
