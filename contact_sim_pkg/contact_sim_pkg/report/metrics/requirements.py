"""Limits of one's own: what a person requires of the metrics of a run, from a file or the command line."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from difflib import get_close_matches
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any, NamedTuple

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.texts import table_of_file
from contact_sim_pkg.records.metric import NO_BAND, OUTSIDE, REQUIRED, UNDECIDED, Band, Metric, exit_status, judged
from contact_sim_pkg.report.metrics.curve_bands import CurveBand, read_curve_band

__all__ = ["Requirement", "bands_of", "exit_code", "places_of", "read_requirements", "required", "requirements_of"]

SENTENCE = re.compile(
    r"\s*(?P<metric>[^<>=]+?)\s*(?P<sign><=|>=|<|>)\s*(?P<limit>[-+.\deE]+)\s*(?P<unit>[^\s\d]\S*)?\s*"
)
"""`SEAT < 60 %`"""
MOST_SHOWN = 20
"""metrics in a sentence"""
KEYS = ("min", "max", "unit", "when")
WITHIN = "within"
FORM = 'write `SEAT < 60 %`, or a line `seat.factor: {max: 60, unit: "%"}` of a YAML file'


class Requirement(NamedTuple):
    """What a metric must be."""

    metric: str
    """key, * for any part of it, or name as it is printed"""
    low: float
    high: float
    """in `unit`; -inf or inf where open"""
    unit: str | None
    """None: that of the metric"""
    when: Mapping[str, tuple[float, float]]
    """metric -> lowest and highest value of the runs that this is required of; empty: of all"""
    source: str
    """file or text that it stands in"""
    of_file: bool = False
    """a file may serve runs of several rigs, so not each has its metric"""
    curve: CurveBand | None = None
    """that a curve must stay within; `metric` says how far it is beyond"""

    @property
    def band(self) -> Band:
        """As a band of the metric."""
        return Band(self.low, self.high, REQUIRED, self.source)


def read_requirements(given: Sequence[str]) -> list[Requirement]:
    """The requirements of texts such as `SEAT < 60 %` and of YAML files, whose names end in .yaml or .yml.

    Raises:
        BagError: a text or a file holds no requirement. FileRefusedError: a file cannot be read.
    """
    found: list[Requirement] = []
    for each in given:
        found += _of_file(Path(each)) if each.endswith((".yaml", ".yml")) else [_of_text(each)]
    return found


def _of_text(text: str) -> Requirement:
    parts = SENTENCE.fullmatch(text)
    if parts is None:
        raise BagError(f"{text!r:.80} is no requirement: {FORM}")
    limit = _finite(parts["limit"], text)
    low, high = (-math.inf, limit) if parts["sign"].startswith("<") else (limit, math.inf)
    return Requirement(parts["metric"], low, high, parts["unit"], {}, text.strip())


def _of_file(path: Path) -> list[Requirement]:
    return requirements_of(table_of_file(path, "requirements", FORM), path)


def requirements_of(given: Mapping[str, object], path: Path) -> list[Requirement]:
    """The requirements of a table that stands in the file ``path``. Raises BagError for a line that is none."""
    return [_of_line(path, key, values) for key, values in given.items()]


def _of_line(path: Path, key: str, values: object) -> Requirement:
    where = f"{path}: {key}"
    if isinstance(values, dict) and isinstance(values.get(WITHIN), str) and len(values) == 1:
        band = read_curve_band(key, path.parent / values[WITHIN])
        return Requirement(band.metric, -math.inf, 0.0, None, {}, path.name, of_file=True, curve=band)
    if not isinstance(values, dict) or not set(values) <= set(KEYS) or not set(values) & {"min", "max"}:
        raise BagError(
            f"{where} needs min or max, and takes {', '.join(KEYS)}; a curve takes {WITHIN}: FILE.csv; found {values!r:.60}"
        )
    low, high = _ends(values, where, "min", "max")
    when = values.get("when", {})
    if not isinstance(when, dict) or not all(isinstance(ends, list) and len(ends) == 2 for ends in when.values()):
        raise BagError(f"{where}.when is {when!r:.60}; write `when: {{seat.a_w: [0.2, 1.0]}}`")
    ranges = {str(name): (_finite(ends[0], where), _finite(ends[1], where)) for name, ends in when.items()}
    unit = values.get("unit")
    return Requirement(key, low, high, None if unit is None else str(unit), ranges, path.name, of_file=True)


def _ends(values: dict[str, Any], where: str, lowest: str, highest: str) -> tuple[float, float]:
    low = _finite(values[lowest], where) if lowest in values else -math.inf
    high = _finite(values[highest], where) if highest in values else math.inf
    if low > high:
        raise BagError(f"{where}: {lowest} {low:g} is above {highest} {high:g}")
    return low, high


def _finite(value: object, where: str) -> float:
    try:
        number = math.nan if isinstance(value, bool) else float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        number = math.nan
    if not math.isfinite(number):
        raise BagError(f"{where}: {value!r:.40} is no number")
    return number


def bands_of(requirements: Sequence[Requirement]) -> tuple[CurveBand, ...]:
    """The bands round curves among them."""
    return tuple(each.curve for each in requirements if each.curve is not None)


def required(metrics: Sequence[Metric], requirements: Sequence[Requirement]) -> list[Metric]:
    """The metrics, those that something is required of judged by that alone.

    A metric whose spread and numerical error reach over the limit is undecided. One that a file requires and the run
    does not have stands behind the others without a value, unless it is required of other runs only.

    Raises:
        BagError: a text requires a metric that the run does not have, or a requirement is in another unit.
    """
    found = list(metrics)
    for each in requirements:
        outside = _not_of_this_run(metrics, each)
        try:
            places = places_of(metrics, each.metric)
        except BagError:
            if not each.of_file:
                raise
            if not outside:
                found.append(Metric(each.metric, each.metric, math.nan, each.unit or "", NO_BAND, each.band,
                                    remark="yours; the run has no such metric"))  # fmt: skip
            continue
        for place in places:
            metric = metrics[place]
            if each.unit is not None and each.unit not in (metric.unit, metric.unit.replace("²", "^2")):
                raise BagError(
                    f"{each.source}: {each.metric} is required in {each.unit}, the metric is in {metric.unit or '1'}"
                )
            if outside:
                said = "; ".join(filter(None, (found[place].remark, f"{each.source} not required here: {outside}")))
                found[place] = found[place]._replace(remark=said)
            else:
                found[place] = _judged(found[place], each)
    return found


def _not_of_this_run(metrics: Sequence[Metric], requirement: Requirement) -> str:
    """Why a requirement is not of the run that has the ``metrics``; empty where it is."""
    for name, (low, high) in requirement.when.items():
        try:
            values = [metrics[place].value for place in places_of(metrics, name)]
        except BagError:
            return f"the run has no {name}"
        if not all(low <= value <= high for value in values):
            return f"{name} is {', '.join(f'{value:.4g}' for value in values)}, not {low:g} to {high:g}"
    return ""


def places_of(metrics: Sequence[Metric], named: str, asked: str = "requirement of") -> list[int]:
    """Of the metrics that a key, a pattern or a name as it is printed means; BagError, with what ``asked``, for none."""
    places = [place for place, each in enumerate(metrics) if fnmatchcase(each.key, named)]
    places = places or [place for place, each in enumerate(metrics) if each.name.casefold() == named.casefold()]
    # Where several contacts share a list, their names stand before those of their metrics
    places = places or [
        place for place, each in enumerate(metrics) if each.name.rpartition(": ")[2].casefold() == named.casefold()
    ]
    if not places:
        known = [f"{each.key} ({each.name})" for each in metrics]
        near = get_close_matches(named.casefold(), [each.casefold() for each in known], 3, 0.3)
        shown = [each for each in known if each.casefold() in near] or known
        more = f"; of {len(known)} the nearest are" if len(known) > MOST_SHOWN else "; it has"
        listed = shown if len(known) > MOST_SHOWN else known
        raise BagError(
            f"{asked} {named}: the list has no such metric{more} {', '.join(listed[:MOST_SHOWN]) or 'none'}; --all lists more"
        )
    return places


def _judged(metric: Metric, requirement: Requirement) -> Metric:
    """A metric with its band replaced; of several requirements that which it holds least stays, a miss before all."""
    band, value = requirement.band, metric.value
    unsure = sum(each for each in (metric.spread, metric.error) if math.isfinite(each))
    verdict = judged(value, band)
    ends = [end for end in (band.low, band.high) if math.isfinite(end)]
    if math.isfinite(value) and any(abs(value - end) < unsure for end in ends):
        verdict = UNDECIDED
    again = metric.band is not None and metric.band.kind == REQUIRED
    if again and (metric.verdict == OUTSIDE or (metric.verdict == UNDECIDED and verdict != OUTSIDE)):
        return metric
    remark = metric.remark if again else "; ".join(filter(None, ("yours", metric.remark)))
    return metric._replace(band=band, verdict=verdict, remark=remark)


def exit_code(metrics: Sequence[Metric]) -> int:
    """1 where a metric is outside its band, 3 where what is required could not be judged, else 0."""
    own = [each for each in metrics if each.band is not None and each.band.kind == REQUIRED]
    return exit_status(
        missed=any(each.verdict == OUTSIDE for each in metrics),
        unjudged=any(each.verdict in (UNDECIDED, NO_BAND) or each.broken for each in own),
    )
