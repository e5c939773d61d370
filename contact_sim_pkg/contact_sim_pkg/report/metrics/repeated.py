"""Repeated runs of one test: mean and spread of each metric, and whether they agree by ISO 10326-1."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.records.metric import Metric, judged
from contact_sim_pkg.report.signal.confidence import half_interval
from contact_sim_pkg.scene.resolved_scene import leaves_of

__all__ = ["repeated"]

LARGEST_DEVIATION = 0.05
"""of a run's SEAT from the mean of the runs (ISO 10326-1)"""
UNESSENTIAL = ("name", "description", "pace", "limits")
REPEATED = ("seed", "vibration.start", "road.start")
"""Keys in which repeated runs of one scene differ."""
MOST_NAMED = 3


def repeated(
    names: Sequence[str], scenes: Sequence[Mapping[str, Any]], lists: Sequence[Sequence[Metric]]
) -> list[Metric]:
    """Mean of each metric that all runs have, with half its 95 % interval (Student's t) as spread.

    names, scenes, lists: of the runs, at least two; a bag of anybody has an empty scene.

    Raises:
        BagError: two runs are the same simulation, of parts of one recording that overlap, or of different scenes; or no
            metric is in all of them.
    """
    refuse_equal(names, scenes)
    by_key = [{each.key: each for each in metrics} for metrics in lists]
    common = [key for key in by_key[0] if all(key in each for each in by_key)]
    if not common:
        raise BagError(f"{', '.join(names)} have no metric in common: repeated runs are of one scene")
    _refuse_overlap(names, scenes)
    _refuse_equal_numbers(names, by_key, common)
    return [_mean([each[key] for each in by_key], names) for key in common]


def refuse_equal(names: Sequence[str], scenes: Sequence[Mapping[str, Any]]) -> None:
    """BagError where two runs have equal scenes, seed included: they hold the same bits and show no spread; and where
    runs are of different scenes.
    """
    seen: dict[str, str] = {}
    first: dict[str, str] | None = None
    for name, scene in zip(names, scenes, strict=True):
        if not scene:
            continue
        keys = {".".join(key): repr(value) for key, value in leaves_of(scene) if key[0] not in UNESSENTIAL}
        other = seen.setdefault(repr(sorted(keys.items())), name)
        if other != name or names.count(name) > 1:
            raise _same_run(other, name)
        common = {key: value for key, value in keys.items() if key not in REPEATED}
        first = common if first is None else first
        differing = sorted(key for key in {*first, *common} if first.get(key) != common.get(key))
        if differing:
            raise BagError(
                f"{names[0]} and {name} are runs of different scenes ({', '.join(differing[:MOST_NAMED])}): a mean over them "
                "says nothing; `bench compare` puts them side by side"
            )


def _refuse_overlap(names: Sequence[str], scenes: Sequence[Mapping[str, Any]]) -> None:
    """BagError where two runs are driven by parts of one recording that share samples: they are no repeats."""
    parts = sorted(
        (str(vibration["file"]), float(vibration.get("start") or 0.0), float(scene["duration"]), name)
        for name, scene in zip(names, scenes, strict=True)
        if isinstance(vibration := scene.get("vibration"), Mapping) and vibration.get("file")
    )
    for (file, start, length, name), (other_file, other_start, _length, other) in pairwise(parts):
        shared = start + length - other_start
        if file == other_file and shared > 1e-9 * length:
            raise BagError(
                f"{name} and {other} share {shared:.4g} s of {Path(file).name}: repeats of a test have no part in common; "
                f"begin the second at vibration.start={start + length:.6g} or later, or judge one run of all of it"
            )


def _refuse_equal_numbers(names: Sequence[str], runs: Sequence[Mapping[str, Metric]], common: Sequence[str]) -> None:
    """BagError where two runs have the same numbers: their seed acts on nothing."""
    seen: dict[tuple[str, ...], str] = {}
    for name, metrics in zip(names, runs, strict=True):
        numbers = tuple(f"{metrics[key].value:.9e}" for key in common)
        if seen.setdefault(numbers, name) != name:
            raise _same_run(seen[numbers], name)


def _same_run(one: str, other: str) -> BagError:
    return BagError(
        f"{one} and {other} are the same run: their spread is 0 and says nothing; repeat a run with another seed where "
        "its road or vibration is random, else with another part of a recording (vibration.start)"
    )


def _mean(runs: Sequence[Metric], names: Sequence[str]) -> Metric:
    values = [each.value for each in runs]
    mean = sum(values) / len(values)
    worst = max(range(len(values)), key=lambda place: abs(values[place] - mean))
    off = abs(values[worst] - mean) / abs(mean) if mean else 0.0
    broken = list(dict.fromkeys(text for each in runs for text in each.broken))
    if runs[0].unit == "%" and runs[0].name.startswith("SEAT"):
        if off > LARGEST_DEVIATION:
            broken.append(f"not valid by ISO 10326-1: {names[worst]} is {100.0 * off:.3g} % from the mean, above 5 %")
        if len(runs) < 3:
            broken.append(f"not valid by ISO 10326-1: {len(runs)} runs, 3 needed")
    said = f"{len(runs)} runs, largest deviation {100.0 * off:.3g} %" if math.isfinite(mean) else f"{len(runs)} runs"
    return runs[0]._replace(
        value=mean,
        verdict=judged(mean, runs[0].band),
        spread=half_interval(values),
        error=max(each.error for each in runs),
        size=len(runs),
        broken=tuple(broken),
        remark=said,
    )
