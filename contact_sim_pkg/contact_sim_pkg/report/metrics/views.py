"""The one list of metrics as text, rows, CSV and JUnit."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Mapping, Sequence
from typing import Any
from xml.etree import ElementTree

from contact_sim_pkg.compare.estimated import Above
from contact_sim_pkg.files import as_cell
from contact_sim_pkg.records.metric import CLOSED_FORM, GOOD, MET, NO_BAND, OUTSIDE, UNDECIDED, USUAL, Band, Metric
from contact_sim_pkg.report.rows import number

__all__ = [
    "csv_of",
    "junit_of",
    "lines_of",
    "rests_on",
    "row_of",
    "rows_of",
    "suite_of",
    "value_text",
    "verdict_line",
    "verdict_text",
    "xml_text",
]

NOTHING = Above()
COLUMNS = (
    "key", "name", "value", "unit", "verdict", "low", "high", "kind", "source", "conditions", "remark", "broken", "spread", "error",
    "basis", "count", "topic", "window_start", "window_end",
)  # fmt: skip


def row_of(metric: Metric) -> dict[str, Any]:
    """A metric as one row; an open end of its band, and what is not known, are None."""
    band = metric.band
    return {
        "key": metric.key, "name": metric.name, "value": _finite(metric.value), "unit": metric.unit, "verdict": metric.verdict,
        "low": None if band is None else _finite(band.low), "high": None if band is None else _finite(band.high),
        "kind": "" if band is None else band.kind, "source": "" if band is None else band.source,
        "conditions": "" if band is None else band.conditions, "remark": metric.remark, "broken": list(metric.broken),
        "spread": _finite(metric.spread), "error": _finite(metric.error), "basis": metric.basis,
        "count": metric.size or None, "topic": metric.topic,
        "window_start": metric.window[0], "window_end": metric.window[1],
    }  # fmt: skip


def rows_of(metrics: Sequence[Metric]) -> list[dict[str, Any]]:
    """`row_of` of each."""
    return [row_of(each) for each in metrics]


def csv_of(metrics: Sequence[Metric]) -> str:
    """A header and a row a metric."""
    text = io.StringIO()
    writer = csv.DictWriter(text, COLUMNS, lineterminator="\n")
    writer.writeheader()
    for row in rows_of(metrics):
        row["broken"] = "; ".join(row["broken"])
        writer.writerow({key: as_cell(value) for key, value in row.items()})
    return text.getvalue()


def value_text(metric: Metric) -> str:
    """`57.3 ± 2.1 %`."""
    if not math.isfinite(metric.value):
        return "–"
    spread = "" if not math.isfinite(metric.spread) else f" ± {number(metric.spread)}"
    return f"{number(metric.value)}{spread} {metric.unit}".rstrip()


def rests_on(metric: Metric) -> str:
    """`stationary, error 0.012`: what it is a number of, and its numerical error in its unit where that is known."""
    error = f"error {number(metric.error)}" if math.isfinite(metric.error) and math.isfinite(metric.value) else ""
    return ", ".join(filter(None, (metric.basis, error)))


def verdict_text(metric: Metric) -> str:
    """`good`, `OUTSIDE`, and `good?` where an assumption does not hold."""
    verdict = metric.verdict.upper() if metric.verdict in (OUTSIDE, UNDECIDED) else metric.verdict
    return f"{verdict}?" if metric.broken and metric.verdict != NO_BAND else verdict


def lines_of(rows: Sequence[Mapping[str, Any]]) -> list[str]:
    """A line a metric: value and spread, verdict, what it is a number of, numerical error, band and remark; below it
    what of its assumptions does not hold.
    """
    metrics = [metric_of(row) for row in rows]
    width = max((len(each.name) for each in metrics), default=0)
    values = [value_text(each) for each in metrics]
    wide = max(map(len, values), default=0)
    rests = [rests_on(each) for each in metrics]
    reach = max(map(len, rests), default=0)
    found: list[str] = []
    before: tuple[str, ...] = ()
    for metric, value, rest in zip(metrics, values, rests, strict=True):
        verdict = verdict_text(metric)
        band = "" if metric.band is None else metric.band.text
        said = "; ".join(filter(None, (band, metric.remark)))
        found.append(f"{metric.name:<{width}}  {value:<{wide}}  {verdict:<8}  {rest:<{reach}}  {said}".rstrip())
        if metric.broken and metric.broken != before:
            found.append(f"{'':<{width}}  ! {'; '.join(metric.broken)}")
        before = metric.broken
    return found


def verdict_line(rows: Sequence[Mapping[str, Any]], above: Above = NOTHING) -> str:
    """The list in one sentence: what lies outside its band, what is doubtful, what errs by more than
    requested (``above``), else how many are good.
    """
    metrics = [metric_of(row) for row in rows]
    outside = [f"{each.name} {value_text(each)} ({_limit(each)})" for each in metrics if each.verdict == OUTSIDE]
    undecided = [f"{each.name} {value_text(each)} ({_limit(each)})" for each in metrics if each.verdict == UNDECIDED]
    doubtful = list(dict.fromkeys(text for each in metrics for text in each.broken))
    sure = [each.verdict for each in metrics if not each.broken]
    counts = {verdict: sure.count(verdict) for verdict in (GOOD, USUAL, NO_BAND)}
    checks = [each for each in metrics if each.band is not None and each.band.kind == CLOSED_FORM]
    met = sum(each.verdict == MET for each in checks)
    closed = [f"{met} of {len(checks)} closed forms met"] if checks else []
    rest = ", ".join([*(f"{count} {verdict}" for verdict, count in counts.items() if count), *closed])
    parts = [
        f"OUTSIDE: {', '.join(outside)}" if outside else "",
        f"UNDECIDED: {', '.join(undecided)}" if undecided else "",
        f"DOUBTFUL: {len(metrics) - len(sure)} of {len(metrics)} metrics, {'; '.join(doubtful)}" if doubtful else "",
        f"{'DOUBTFUL: ' if above.is_doubtful else ''}{above.text}" if above.text else "",
        f"{'the rest ' if outside or undecided or doubtful or above.is_doubtful else 'nothing outside its band: '}{rest}"
        if rest
        else "",
    ]
    return " | ".join(filter(None, parts))


def _limit(metric: Metric) -> str:
    return "" if metric.band is None else metric.band.text


def metric_of(row: Mapping[str, Any]) -> Metric:
    """The metric of a row."""
    band = None
    if row["kind"]:
        low, high = (end if row[name] is None else row[name] for name, end in (("low", -math.inf), ("high", math.inf)))
        band = Band(low, high, row["kind"], row["source"], row["conditions"])
    value, spread, error = (math.nan if row[name] is None else row[name] for name in ("value", "spread", "error"))
    return Metric(
        row["key"], row["name"], value, row["unit"], row["verdict"], band, remark=row["remark"],
        broken=tuple(row["broken"]), spread=spread, size=row["count"] or 0, topic=row["topic"],
        window=(row["window_start"], row["window_end"]), basis=row["basis"], error=error,
    )  # fmt: skip


def junit_of(name: str, metrics: Sequence[Metric], warnings: Sequence[str] = ()) -> str:
    """JUnit XML of the list of the bag ``name``; see `suite_of`."""
    return xml_text(suite_of(name, metrics, warnings))


def suite_of(name: str, metrics: Sequence[Metric], warnings: Sequence[str] = ()) -> ElementTree.Element:
    """The list of a run as a suite of tests; its ``warnings`` are an error of the first: outside its band is
    a failure, a broken assumption an error, as is a limit within the uncertainty, no band skipped. What a case rests
    on is its `system-out`.
    """
    cases = [ElementTree.Element("testcase", classname="run", name=name)] if warnings else []
    for case in cases:
        ElementTree.SubElement(case, "error", message="; ".join(warnings))
    return suite_of_cases(name, [*cases, *(_case(each) for each in metrics)])


def _case(metric: Metric) -> ElementTree.Element:
    case = ElementTree.Element("testcase", classname=metric.topic or metric.key, name=metric.key)
    said = f"{metric.name}: {value_text(metric)}; {_limit(metric)} {metric.remark}".strip()
    if metric.broken or metric.verdict == UNDECIDED:
        message = "; ".join(metric.broken) or "the limit lies within the uncertainty"
        ElementTree.SubElement(case, "error", message=message).text = said
    elif metric.verdict == OUTSIDE:
        ElementTree.SubElement(case, "failure", message=said)
    elif metric.verdict == NO_BAND:
        ElementTree.SubElement(case, "skipped", message=metric.remark or NO_BAND)
    ElementTree.SubElement(case, "system-out").text = "; ".join(filter(None, (value_text(metric), rests_on(metric))))
    return case


def junit_text(name: str, cases: Sequence[ElementTree.Element]) -> str:
    """One suite of test cases as XML."""
    return xml_text(suite_of_cases(name, cases))


def suite_of_cases(name: str, cases: Sequence[ElementTree.Element]) -> ElementTree.Element:
    """A suite of test cases, counted."""
    counts = {
        f"{kind}s" if kind != "skipped" else kind: str(sum(each.find(kind) is not None for each in cases))
        for kind in ("failure", "error", "skipped")
    }
    suite = ElementTree.Element("testsuite", {"name": name, "tests": str(len(cases)), **counts})
    suite.extend(cases)
    return suite


def xml_text(root: ElementTree.Element) -> str:
    """An element as a whole document."""
    ElementTree.indent(root)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + ElementTree.tostring(root, encoding="unicode") + "\n"


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None
