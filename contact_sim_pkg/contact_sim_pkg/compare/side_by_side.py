"""Metrics of several runs side by side: how far each moved, and whether that is within a tolerance."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from fnmatch import fnmatchcase
from operator import itemgetter
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.texts import table_of_file
from contact_sim_pkg.records.metric import LIMIT, OUTSIDE, REQUIRED, SELF_CHECK, STATIONARY, Band, Metric

__all__ = [
    "Compared",
    "ComparedMetric",
    "Curve",
    "Miss",
    "Tolerance",
    "misses",
    "read_tolerances",
    "side_by_side",
    "undecided",
]

KEYS = ("absolute", "relative", "from", "to")
ROUNDING = 1e-12
"""relative change that is rounding"""
FloatArray = NDArray[np.float64]


class ComparedMetric(NamedTuple):
    """One metric in every run."""

    key: str
    name: str
    unit: str
    values: tuple[float, ...]
    """nan where a run lacks it"""
    verdicts: tuple[str, ...]
    broken_of: tuple[tuple[str, ...], ...]
    """assumptions that do not hold, of each run; empty where all hold in all"""
    basis: str = ""
    """event, stationary, state or self-check"""
    errors: tuple[float, ...] = ()
    """numerical error in each run, in `unit`; nan where it is not known"""
    spreads: tuple[float, ...] = ()
    """half the 95 % interval in each run, in `unit`; nan where it is not known"""
    limit: Band | None = None
    """limit of the first run that has one: which way is better"""
    instants: tuple[str, ...] = ()
    """`at 0.990 s`, where a run says when its event was, else empty"""

    @property
    def uncertainty(self) -> float:
        """Of the change of two runs, in `unit`: root of the sum of the squares of all spreads and errors; nan where none
        is known.
        """
        known = [each for each in (*self.errors, *self.spreads) if math.isfinite(each)]
        return math.hypot(*known) if known else math.nan

    @property
    def comparison(self) -> str:
        """Of two runs: whether the last is better or worse than the first by a limit with one end, or differs by no more
        than the uncertainty; empty where neither can be said, and what keeps it from being said where that is known.
        """
        if not math.isfinite(self.change):
            return ""
        if self.change == 0.0 or abs(self.change) <= self.uncertainty:
            return "no difference beyond ±" if self.change else "the same"
        ends = (-math.inf, math.inf) if self.limit is None else (self.limit.low, self.limit.high)
        if math.isinf(ends[0]) == math.isinf(ends[1]):
            return ""
        if self.basis == STATIONARY and not (self.spreads and all(map(math.isfinite, self.spreads))):
            return "spread not known"
        return "better" if (self.change < 0.0) == math.isinf(ends[0]) else "worse"

    def against_first(self, place: int) -> ComparedMetric:
        """The metric in the first run and in that at a ``place`` from 1 on: two runs, whose `change` is theirs."""
        two = itemgetter(0, place)
        return self._replace(
            values=two(self.values), verdicts=two(self.verdicts),
            broken_of=two(self.broken_of) if self.broken_of else (), errors=two(self.errors) if self.errors else (),
            spreads=two(self.spreads) if self.spreads else (),
        )  # fmt: skip

    @property
    def broken(self) -> tuple[str, ...]:
        """Assumptions that do not hold in some run."""
        return tuple(dict.fromkeys(text for each in self.broken_of for text in each))

    @property
    def change(self) -> float:
        """Last value less the first; 0 where that is rounding."""
        first, last = self.values[0], self.values[-1]
        return 0.0 if math.isclose(first, last, rel_tol=ROUNDING) else last - first

    @property
    def relative(self) -> float:
        """Change over the first value; infinite from 0, nan where a run lacks it."""
        if not math.isfinite(self.change):
            return math.nan
        if self.values[0] == 0.0:
            return 0.0 if self.change == 0.0 else math.inf
        return self.change / abs(self.values[0])

    @property
    def moved(self) -> float:
        """Largest difference from the first run over the largest magnitude, 0 to 2; -1 where a run lacks it."""
        if not all(map(math.isfinite, self.values)):
            return -1.0
        size = max(map(abs, self.values))
        return max(abs(each - self.values[0]) for each in self.values) / size if size else 0.0

    @property
    def verdict(self) -> str:
        """`good`, or `good → OUTSIDE` where it changes."""
        texts = [each.upper() if each == OUTSIDE else each for each in self.verdicts]
        return texts[0] if len(set(texts)) == 1 else " → ".join(texts)


class Curve(NamedTuple):
    """A curve of a run, such as a transmissibility over frequency."""

    unit_x: str
    x: FloatArray
    """[points] ascending"""
    y: FloatArray
    """[points], nan where it is not known"""
    spread: FloatArray | None = None
    """[points] standard deviation of y by chance, over y; None where nothing says it"""


class Compared(NamedTuple):
    """A run as it is compared."""

    name: str
    metrics: Sequence[Metric]
    curves: Mapping[str, Curve]
    warnings: Sequence[str] = ()
    """how it ended early, and excitation that is not its scene's"""
    leading: Sequence[str] = ()
    """keys of metrics that the page of a comparison always shows first"""


class Tolerance(NamedTuple):
    """Of one metric or curve: it may differ by `absolute` + `relative` times the reference."""

    pattern: str
    """key, with * for any part"""
    absolute: float
    relative: float
    start: float
    end: float
    """of a curve, in its x"""


class Miss(NamedTuple):
    """A difference beyond its tolerance, or a metric that a run lacks."""

    key: str
    run: str
    sentence: str


def side_by_side(runs: Sequence[Compared]) -> list[ComparedMetric]:
    """Every metric that some run has, what moved most first; self-checks behind."""
    keys = dict.fromkeys(each.key for run in runs for each in run.metrics)
    by_run = [{each.key: each for each in run.metrics} for run in runs]
    found = [_side([metrics.get(key) for metrics in by_run]) for key in keys]
    return sorted(found, key=lambda each: (each.basis == SELF_CHECK, -each.moved))


def _side(runs: Sequence[Metric | None]) -> ComparedMetric:
    first = next(each for each in runs if each is not None)
    broken = tuple(() if each is None else tuple(each.broken) for each in runs)
    return ComparedMetric(
        first.key, first.name, first.unit, tuple(math.nan if each is None else each.value for each in runs),
        tuple("absent" if each is None else each.verdict for each in runs), broken if any(broken) else (), first.basis,
        tuple(math.nan if each is None else each.error for each in runs),
        tuple(math.nan if each is None else each.spread for each in runs),
        next((each.band for each in runs if each and each.band and each.band.kind in (LIMIT, REQUIRED)), None),
        tuple("" if each is None else each.instant for each in runs),
    )  # fmt: skip


def read_tolerances(path: Path) -> list[Tolerance]:
    """The tolerances of a YAML file: `seat.factor: {absolute: 2}`, `tire.*: {relative: 0.05}`, of a curve with its
    range, `seat.transmissibility: {relative: 0.1, from: 1, to: 20}`.

    Raises:
        BagError: the file is no such table. FileRefusedError: it cannot be read.
    """
    given = table_of_file(path, "tolerances", "write lines such as `seat.factor: {absolute: 2}`")
    return [_tolerance(path, key, values) for key, values in given.items()]


def _tolerance(path: Path, key: str, values: object) -> Tolerance:
    if not isinstance(values, dict) or not set(values) <= set(KEYS) or not set(values) & set(KEYS[:2]):
        raise BagError(f"{path}: {key} needs absolute or relative, and takes {', '.join(KEYS)}; found {values!r:.60}")
    numbers = {}
    for name, default in zip(KEYS, (0.0, 0.0, -math.inf, math.inf), strict=True):
        value = values.get(name, default)
        if isinstance(value, bool) or not isinstance(value, (int, float)) or math.isnan(value):
            raise BagError(f"{path}: {key}.{name} is {value!r:.40}, it must be a number")
        if name in KEYS[:2] and value < 0.0:
            raise BagError(f"{path}: {key}.{name} is {value:g}, it must be 0 or more")
        numbers[name] = float(value)
    return Tolerance(key, *(numbers[name] for name in KEYS))


def misses(runs: Sequence[Compared], tolerances: Sequence[Tolerance]) -> list[tuple[Tolerance, list[Miss]]]:
    """What of each tolerance is missed by a run against the first one.

    Raises:
        BagError: a tolerance names nothing that the first run has.
    """
    return [(each, _missed(runs[0], runs[1:], each)) for each in tolerances]


def undecided(runs: Sequence[Compared], tolerances: Sequence[Tolerance]) -> list[Miss]:
    """Metrics that a tolerance is of and that are defined in no run, so that nothing can be judged."""
    return [
        Miss(each.key, runs[0].name, f"{each.name} is defined in no run")
        for each in side_by_side(runs)
        if all(map(math.isnan, each.values)) and any(fnmatchcase(each.key, wanted.pattern) for wanted in tolerances)
    ]


def _missed(reference: Compared, others: Sequence[Compared], tolerance: Tolerance) -> list[Miss]:
    metrics = [each for each in reference.metrics if fnmatchcase(each.key, tolerance.pattern)]
    curves = [key for key in reference.curves if fnmatchcase(key, tolerance.pattern)]
    if not metrics and not curves:
        known = ", ".join([*(each.key for each in reference.metrics), *reference.curves])
        raise BagError(f"tolerance {tolerance.pattern}: {reference.name} has no such metric or curve; it has {known}")
    found: list[Miss] = []
    for run in others:
        by_key = {each.key: each for each in run.metrics}
        found += [miss for each in metrics if (miss := _of_metric(each, by_key.get(each.key), run.name, tolerance))]
        found += [
            miss for key in curves
            if (miss := _of_curve(key, reference.curves[key], run.curves.get(key), run.name, tolerance))
        ]  # fmt: skip
    return found


def _of_metric(first: Metric, other: Metric | None, run: str, tolerance: Tolerance) -> Miss | None:
    if other is None or math.isnan(other.value) != math.isnan(first.value):
        return Miss(first.key, run, f"{first.key} is not defined in both runs")
    allowed = tolerance.absolute + tolerance.relative * abs(first.value)
    difference = abs(other.value - first.value)
    if math.isnan(difference) or difference <= allowed:
        return None
    value = f"{other.value:.5g} {first.unit}".rstrip()
    sentence = f"{first.name} is {value}, {difference:.3g} from {first.value:.5g}; {allowed:.3g} allowed"
    return Miss(first.key, run, sentence)


def _of_curve(key: str, first: Curve, other: Curve | None, run: str, tolerance: Tolerance) -> Miss | None:
    """The largest miss of a curve, on the points of the reference inside its range."""
    if other is None:
        return Miss(key, run, f"{key} is not in both runs")
    inside = (
        (first.x >= max(tolerance.start, other.x[0]))
        & (first.x <= min(tolerance.end, other.x[-1]))
        & np.isfinite(first.y)
    )
    if not inside.any():
        return Miss(key, run, f"{key} has no common points in its range")
    x, y = first.x[inside], first.y[inside]
    known = np.isfinite(other.y)
    values = np.interp(x, other.x[known], other.y[known]) if known.any() else np.full(x.size, np.inf)
    beyond = np.abs(values - y) - (tolerance.absolute + tolerance.relative * np.abs(y))
    place = int(beyond.argmax())
    if beyond[place] <= 0.0:
        return None
    allowed = tolerance.absolute + tolerance.relative * abs(y[place])
    return Miss(
        key, run,
        f"{key} is {values[place]:.4g} at {x[place]:.4g} {first.unit_x}, {abs(values[place] - y[place]):.3g} from {y[place]:.4g}; "
        f"{allowed:.3g} allowed ({int((beyond > 0.0).sum())} of {x.size} points outside)",
    )  # fmt: skip
