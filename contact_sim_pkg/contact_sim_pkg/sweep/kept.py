"""Which bags of a sweep stay."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.report.metrics.requirements import Requirement, places_of, read_requirements
from contact_sim_pkg.report.metrics.views import metric_of
from contact_sim_pkg.sweep.case import FINISHED, Row
from contact_sim_pkg.sweep.variation import SweepError

__all__ = ["Kept", "read_kept", "worst_cases"]

NONE, ALL, WORST = "none", "all", "worst"
FORM = "none, all, worst:N:METRIC (its largest values) or worst:N:'METRIC > LIMIT' (those that hold the limit least)"


class Kept(NamedTuple):
    """Bags that stay: all, or those of the ``number`` worst cases."""

    all: bool = False
    number: int = 0
    metric: str = ""
    """key or name"""
    requirement: Requirement | None = None
    """that the worst hold least; None: the largest values are the worst"""


def read_kept(text: str) -> Kept:
    """`none`, `all`, `worst:3:seat.factor`, `worst:3:tire.load_smallest > 300`. Raises SweepError for what is none of them."""
    if text in (NONE, ALL):
        return Kept(all=text == ALL)
    kind, _, rest = text.partition(":")
    number, _, metric = (part.strip() for part in rest.partition(":"))
    if kind != WORST or not number.isdecimal() or int(number) < 1 or not metric:
        raise SweepError(f"--keep-bags {text}: is none of {FORM}")
    if not set(metric) & set("<>="):
        return Kept(number=int(number), metric=metric)
    try:
        (requirement,) = read_requirements([metric])
    except BagError as error:
        raise SweepError(f"--keep-bags {text}: {error}") from None
    return Kept(number=int(number), metric=requirement.metric, requirement=requirement)


def worst_cases(kept: Kept, rows: Sequence[Row]) -> list[int]:
    """Numbers of the cases whose bags stay, the worst first; cases without the number are left out.

    Raises SweepError where no case has the metric, or it is in another unit.
    """
    margins: dict[int, float] = {}
    refusal = ""
    for row in rows:
        if row["outcome"] != FINISHED:
            continue
        metrics = [metric_of(each) for each in row["metrics"]]
        try:
            found = [metrics[place] for place in places_of(metrics, kept.metric, "worst of")]
        except BagError as error:
            refusal = refusal or str(error)
            continue
        limit = kept.requirement
        for metric in found:
            if limit is not None and limit.unit is not None and limit.unit != metric.unit:
                raise SweepError(
                    f"--keep-bags: {limit.source} is in {limit.unit}, the metric is in {metric.unit or '1'}"
                )
            margin = -metric.value if limit is None else min(metric.value - limit.low, limit.high - metric.value)
            if math.isfinite(margin):
                margins[row["number"]] = min(margin, margins.get(row["number"], math.inf))
    if not margins and refusal:
        raise SweepError(f"--keep-bags: {refusal}")
    return sorted(margins, key=lambda number: (margins[number], number))[: kept.number]
