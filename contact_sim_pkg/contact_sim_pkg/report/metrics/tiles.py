"""The list of metrics as the tiles of the page, and as its table."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from contact_sim_pkg.records.metric import CLOSED_FORM, REQUIRED, Metric
from contact_sim_pkg.report.metrics.views import verdict_text
from contact_sim_pkg.report.rows import SUPERSCRIPT, number
from contact_sim_pkg.report.tables import Table

__all__ = ["Tile", "doubts_of", "metric_table", "printed_unit", "published_table", "tiles_of"]


class Bar(NamedTuple):
    """A band and the value on one scale, in per cent of its length."""

    start: float
    width: float
    mark: float


class Tile(NamedTuple):
    """One metric as texts."""

    label: str
    value: str
    unit: str
    spread: str
    """± numerical, ± random, and the instant of an event"""
    verdict: str
    tone: str
    """class of its colour"""
    band: str
    bar: Bar | None
    """None without a band, and where the value is not defined"""


def doubts_of(metrics: Sequence[Metric]) -> list[str]:
    """Assumptions that do not hold, each with the metrics that it is one of."""
    names: dict[str, list[str]] = {}
    for metric in metrics:
        for text in metric.broken:
            names.setdefault(text, []).append(metric.name)
    return [f"{text} ({', '.join(of)})" for text, of in names.items()]


def tiles_of(metrics: Sequence[Metric]) -> list[Tile]:
    """A tile a metric."""
    return [_tile(each) for each in metrics]


def metric_table(metrics: Sequence[Metric]) -> Table:
    """A row a metric: all that its tile leaves out."""
    rows = [
        (
            metric.name, _text(metric.value), printed_unit(metric.unit), _text(metric.error), _text(metric.spread),
            verdict_text(metric), "" if metric.band is None else metric.band.text, metric.basis, metric.remark,
        )
        for metric in metrics
    ]  # fmt: skip
    header = ("metric", "value", "unit", "± numerical", "± random", "verdict", "band", "rests on", "remark")
    return Table("± random: half of the 95 % interval.", header, rows)


def published_table(metrics: Sequence[Metric]) -> Table | None:
    """Values beside the bands of their sources; None where no band applies to this run."""
    rows = [
        (metric.name, f"{_text(metric.value)} {printed_unit(metric.unit)}".rstrip(), metric.band.text, verdict_text(metric),
         metric.band.conditions or "always", metric.band.source)
        for metric in metrics if metric.band is not None and metric.band.kind not in (CLOSED_FORM, REQUIRED)
    ]  # fmt: skip
    header = ("metric", "this run", "band", "verdict", "holds for", "source")
    return Table("", header, rows) if rows else None


def _tile(metric: Metric) -> Tile:
    band = metric.band
    defined = math.isfinite(metric.value)
    spreads = {"numerical": metric.error, "random": metric.spread}
    space = "\N{NO-BREAK SPACE}"
    given = [f"±{space}{number(value)}{space}{name}" for name, value in spreads.items() if math.isfinite(value)]
    instant = [metric.instant.replace(" ", space)] if metric.instant else []
    return Tile(
        label=metric.name, value=number(metric.value) if defined else "–", unit=printed_unit(metric.unit) if defined else "",
        spread=", ".join([*given, *instant]) if defined else "", verdict=verdict_text(metric),
        tone="doubtful" if metric.broken else metric.verdict.replace(" ", "-"),
        band="" if band is None else band.text, bar=_bar(metric),
    )  # fmt: skip


def _bar(metric: Metric) -> Bar | None:
    """The scale reaches a third beyond the band, or to the value; an open band begins or ends with it."""
    band, value = metric.band, metric.value
    if band is None or not math.isfinite(value):
        return None
    low, high = band.low, band.high
    if math.isinf(low):
        low = min(0.0, value, high)
    if math.isinf(high):
        high = 2.0 * max(abs(low), abs(value), 1e-30)
    room = (high - low) / 3.0 or max(abs(high), 1.0) / 3.0
    start = min(low if math.isinf(band.low) else low - room, value)
    end = max(high if math.isinf(band.high) else high + room, value)
    scale = 100.0 / ((end - start) or 1.0)
    return Bar(round(scale * (low - start), 1), round(scale * (high - low), 1), round(scale * (value - start), 1))


def _text(value: float) -> str:
    return number(value) if math.isfinite(value) else ""


def printed_unit(unit: str) -> str:
    """`m/s^1.75` -> `m/s¹·⁷⁵`."""
    base, _, power = unit.partition("^")
    return base + power.translate(SUPERSCRIPT).replace(".", "·")
