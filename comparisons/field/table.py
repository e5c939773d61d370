"""The result as text tables."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from comparisons.field.agreement import Agreement
from comparisons.field.measure import Row, SetUp
from comparisons.field.readings import Reading, Verdict
from comparisons.field.solver import OURS

__all__ = ["agreement_lines", "reading_lines", "row_lines", "set_up_lines", "verdict_lines"]


def reading_lines(found: list[Reading]) -> list[str]:
    """Times at equal error."""
    return _table(("problem", "error", "solver", "ms", "95 %", "largest error", "theirs / ours"), found)


def verdict_lines(found: list[Verdict]) -> list[str]:
    """What was aimed at."""
    heads = ("problem", "error", "what", "measured", "study", "reached", "goal", "reached")
    return _table(
        heads,
        (
            (
                one.aim.task,
                one.aim.error,
                "our ms, at most" if one.aim.solver == OURS else f"{one.aim.solver} / ours, at least",
                one.measured,
                one.aim.study,
                _word(one.study_reached),
                one.aim.goal,
                _word(one.goal_reached),
            )
            for one in found
        ),
    )


def set_up_lines(found: list[SetUp]) -> list[str]:
    """Set-up."""
    heads = ("problem", "solver", "plans and tables, ms", "first solve, ms")
    return _table(heads, found)


def agreement_lines(found: list[Agreement]) -> list[str]:
    """Same discrete problem."""
    return _table(("problem", "solver", "difference at its tolerance 1e-10"), found)


def row_lines(found: list[Row]) -> list[str]:
    """Everything measured."""
    heads = tuple(name.replace("_", " ") for name in Row._fields)
    return _table(heads, found)


def _table(heads: tuple[str, ...], rows: Iterable[tuple[Any, ...]]) -> list[str]:
    """A Markdown table, padded to be read as it is; no lines where there are no rows."""
    lines = [heads, *(tuple(_text(value) for value in row) for row in rows)]
    if len(lines) == 1:
        return []
    widths = [max(len(line[column]) for line in lines) for column in range(len(heads))]
    return list(_padded(lines, widths))


def _padded(lines: list[tuple[str, ...]], widths: list[int]) -> Iterator[str]:
    for number, line in enumerate(lines):
        yield "| " + " | ".join(text.ljust(width) for text, width in zip(line, widths, strict=True)) + " |"
        if number == 0:
            yield "|" + "|".join("-" * (width + 2) for width in widths) + "|"


def _text(value: Any) -> str:
    if value is None:
        return "–"
    return f"{value:.3g}" if isinstance(value, float) else str(value)


def _word(reached: bool | None) -> str:
    return "–" if reached is None else "yes" if reached else "no"
