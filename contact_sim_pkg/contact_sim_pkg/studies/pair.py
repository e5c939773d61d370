"""Numerical error of any metric by a pair of runs on half the cells.

The error is |finer steps - same steps| on half the cells, and the change that half the cells make to the run itself:
what the steps do hardly depends on the grid, so both cost little.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from contact_sim_pkg.compare.companion import companion_of, halved
from contact_sim_pkg.compare.span import Notify
from contact_sim_pkg.records.metric import SELF_CHECK, Metric
from contact_sim_pkg.report.metrics.listing import all_metrics
from contact_sim_pkg.report.metrics.numerical import not_resolved
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.studies.whole_run import whole_run

__all__ = ["with_errors_of_pair"]

TIMES = ("ms", "s")
"""Units of durations, which are known to a sample at best."""


def with_errors_of_pair(scene: ResolvedScene, metrics: Sequence[Metric], notify: Notify) -> list[Metric]:
    """The ``metrics`` of a run of a scene with their `error` by the pair.

    One that a run of the pair does not have, and a closed form that the run checks itself by, keeps the error that it
    has. An error above a tenth of the value is marked as not resolved. Raises RunError where a run of the pair ends.
    """
    half = halved(scene)
    pair = []
    for said, each in (("half the cells", half), ("half the cells, finer steps", companion_of(half, grid=False).scene)):
        notify(f"{scene.name}: {said}")
        pair.append({metric.key: metric.value for metric in all_metrics(whole_run(each, notify).recording)})
    return [_with_error(each, *(found.get(each.key, math.nan) for found in pair)) for each in metrics]


def _with_error(metric: Metric, coarse: float, finer: float) -> Metric:
    error = abs(finer - coarse) + abs(coarse - metric.value)
    if not math.isfinite(error) or metric.basis == SELF_CHECK:
        return metric
    if metric.unit in TIMES:  # a crossing lies between two samples
        error = max(error, metric.error if math.isfinite(metric.error) else 0.0)
    others = tuple(each for each in metric.broken if not each.startswith("not resolved"))
    return metric._replace(error=error, broken=(*others, *not_resolved(metric.value, error)))
