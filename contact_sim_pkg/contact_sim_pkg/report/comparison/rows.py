"""Metrics of several runs as rows for the terminal, JSON, CSV and JUnit."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Sequence
from fnmatch import fnmatchcase
from typing import Any
from xml.etree import ElementTree

from contact_sim_pkg.compare.side_by_side import ComparedMetric, Miss, Tolerance
from contact_sim_pkg.files import as_cell
from contact_sim_pkg.report.comparison.tables import metric_table
from contact_sim_pkg.report.metrics.views import junit_text

__all__ = ["csv_text", "junit_text_of", "rows_of", "table_rows"]


def rows_of(names: Sequence[str], sides: Sequence[ComparedMetric]) -> list[dict[str, Any]]:
    """A row a metric, a value a run under its name."""
    return [
        {
            "key": each.key, "name": each.name, "unit": each.unit, **dict(zip(names, each.values, strict=True)),
            "change": each.change, "relative": each.relative, "verdict": each.verdict, "broken": "; ".join(each.broken),
            "basis": each.basis, **_of_runs("spread", names, each.spreads), **_of_runs("error", names, each.errors),
        }
        for each in sides
    ]  # fmt: skip


def _of_runs(column: str, names: Sequence[str], values: Sequence[float]) -> dict[str, float | None]:
    return {
        f"{column} of {name}": value if math.isfinite(value) else None
        for name, value in zip(names, values or [math.nan] * len(names), strict=True)
    }


def csv_text(names: Sequence[str], sides: Sequence[ComparedMetric]) -> str:
    """`rows_of` with a header."""
    text = io.StringIO()
    rows = rows_of(names, sides)
    writer = csv.writer(text, lineterminator="\n")
    writer.writerows(map(as_cell, row) for row in (rows[0], *(row.values() for row in rows)))
    return text.getvalue()


def table_rows(names: Sequence[str], sides: Sequence[ComparedMetric]) -> list[dict[str, str]]:
    """The table of the page as rows for a terminal."""
    table = metric_table(names, sides)
    return [dict(zip(table.header, row, strict=True)) for row in table.rows]


def junit_text_of(
    names: Sequence[str], missed: Sequence[tuple[Tolerance, list[Miss]]], unsure: Sequence[Miss] = ()
) -> str:
    """A test case a tolerance; the misses of the runs are its failure, else what is undecided of it its error."""
    cases = []
    for tolerance, found in missed:
        case = ElementTree.Element("testcase", classname="tolerances", name=tolerance.pattern)
        undecided = [each for each in unsure if fnmatchcase(each.key, tolerance.pattern)]
        if found:
            text = "; ".join(f"{each.run}: {each.sentence}" for each in found)
            ElementTree.SubElement(case, "failure", message=text)
        elif undecided:
            ElementTree.SubElement(case, "error", message="; ".join(each.sentence for each in undecided))
        cases.append(case)
    return junit_text(" and ".join(names), cases)
