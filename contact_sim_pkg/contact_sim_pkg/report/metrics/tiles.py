"""The list of metrics as the tiles of the page."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from contact_sim_pkg.records.metric import Metric
from contact_sim_pkg.report.metrics.views import rests_on, verdict_text
from contact_sim_pkg.report.rows import SUPERSCRIPT, number


class Tile(NamedTuple):
    """One metric as texts."""

    label: str
    value: str
    unit: str
    spread: str
    verdict: str
    tone: str
    """class of its colour"""
    rests: str
    """what it is a number of, and its numerical error"""
    band: str
    remark: str
    doubtful: bool
    """whether an assumption does not hold, which stands above the tiles"""
    footnote: int
    """number of the source of its band, from 1; 0: none"""


def sources_of(metrics: Sequence[Metric]) -> list[str]:
    """Sources of the bands, each once: the footnotes of the tiles."""
    return list(dict.fromkeys(each.band.source for each in metrics if each.band is not None))


def doubts_of(metrics: Sequence[Metric]) -> list[str]:
    """Assumptions that do not hold, each with the metrics that it is one of."""
    names: dict[str, list[str]] = {}
    for metric in metrics:
        for text in metric.broken:
            names.setdefault(text, []).append(metric.name)
    return [f"{text} ({', '.join(of)})" for text, of in names.items()]


def tiles_of(metrics: Sequence[Metric]) -> list[Tile]:
    """A tile a metric."""
    sources = sources_of(metrics)
    return [_tile(each, 0 if each.band is None else sources.index(each.band.source) + 1) for each in metrics]


def _tile(metric: Metric, footnote: int) -> Tile:
    band = metric.band
    defined = math.isfinite(metric.value)
    return Tile(
        label=metric.name, value=number(metric.value) if defined else "–", unit=_printed(metric.unit) if defined else "",
        spread=number(metric.spread) if math.isfinite(metric.spread) else "",
        verdict=verdict_text(metric), tone=metric.verdict.replace(" ", "-"), rests=rests_on(metric),
        band="" if band is None else f"{band.text} {_printed(metric.unit)}".rstrip(), remark=metric.remark,
        doubtful=bool(metric.broken), footnote=footnote,
    )  # fmt: skip


def _printed(unit: str) -> str:
    """`m/s^1.75` -> `m/s¹·⁷⁵`."""
    base, _, power = unit.partition("^")
    return base + power.translate(SUPERSCRIPT).replace(".", "·")
