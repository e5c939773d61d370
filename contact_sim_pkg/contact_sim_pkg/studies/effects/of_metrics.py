"""What metrics need of the effects of a scene: its whole run, and the whole run without each effect."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from contact_sim_pkg.compare.span import Notify
from contact_sim_pkg.records.metric import SELF_CHECK, Metric
from contact_sim_pkg.report.metrics.listing import all_metrics, metrics_of
from contact_sim_pkg.report.metrics.requirements import places_of
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.schema.accuracy import requested
from contact_sim_pkg.studies.effects.verdicts import ROUNDING, Change
from contact_sim_pkg.studies.whole_run import whole_run

__all__ = ["ALL", "MetricBase", "metric_base"]

ALL = "all"
"""In place of a name: the list that a run ends with, less what it checks itself by."""


class MetricBase(NamedTuple):
    """The run that others are compared with by its metrics."""

    scene: ResolvedScene
    metrics: tuple[Metric, ...]
    cost: float  # [ms] of CPU per simulated second

    @property
    def request(self) -> float:
        """Requested accuracy: that part of its value may a metric change by."""
        return requested(self.scene.accuracy)

    def measured(
        self, scene: ResolvedScene, notify: Notify, not_below: Mapping[str, float] | None = None
    ) -> tuple[tuple[Change, ...], float]:
        """Relative change of each metric in another scene, largest first, and its cost [ms] per simulated second.

        A metric that it does not have changes without bound. What the run says of the numerical error of both, and
        no less than ``not_below`` (by kind, what is different has at every accuracy), is the error of a change; chance
        is not, for both have the same excitation. Raises RunError where the run ends.
        """
        other = whole_run(scene, notify)
        found = {each.key: each for each in all_metrics(other.recording)}
        least = max((not_below or {}).values(), default=0.0)
        changes = [_change(each, found.get(each.key), least) for each in self.metrics]
        return tuple(sorted(changes, key=lambda each: (each.resolved, each.size), reverse=True)), other.cost

    @property
    def compared(self) -> str:
        """What is compared, in words."""
        return (
            f"metrics of the whole run of {self.scene.duration:g} s: "
            f"{', '.join(f'{each.name} {each.value:.4g} {each.unit}'.rstrip() for each in self.metrics)}; "
            "changes over the metric's own value"
        )

    def facts(self) -> dict[str, Any]:
        """The same as plain values."""
        return {"metrics": {each.key: each.value for each in self.metrics}}


def metric_base(scene: ResolvedScene, names: Sequence[str], notify: Notify) -> MetricBase:
    """The run of a scene and those of its metrics that are asked for, by key, name or `all`.

    Raises RunError where it ends, BagError where it has no such metric.
    """
    run = whole_run(scene, notify)
    every, chosen = all_metrics(run.recording), dict[str, Metric]()
    for name in names:
        listed = [each for each in metrics_of(run.recording) if each.basis != SELF_CHECK] if name == ALL else [
            every[place] for place in places_of(every, name, "--metric")
        ]  # fmt: skip
        chosen |= {each.key: each for each in listed if math.isfinite(each.value)}
    return MetricBase(scene, tuple(chosen.values()), run.cost)


def _change(metric: Metric, other: Metric | None, least: float) -> Change:
    """Of a metric, over its value; zero where both are zero."""
    if other is None or not math.isfinite(other.value):
        return Change(metric.key, metric.name, math.inf, 0.0, "", math.nan)
    scale = abs(metric.value) or abs(other.value)
    difference = abs(other.value - metric.value)
    size = difference / scale if difference > ROUNDING * scale else 0.0
    errors = [each.error for each in (metric, other) if math.isfinite(each.error)]
    error = max(math.hypot(*errors) / scale if scale and errors else 0.0, least)
    return Change(metric.key, metric.name, size, error, "", math.nan)
