"""A plan: sweeps of scenes in a file, and what is required of each of their cases."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple
from xml.etree import ElementTree

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.texts import table_of_file
from contact_sim_pkg.records.metric import OUTSIDE, REQUIRED, STATIONARY, UNDECIDED, Metric, exit_status
from contact_sim_pkg.report.metrics.repeated import repeated
from contact_sim_pkg.report.metrics.requirements import Requirement, bands_of, places_of, required, requirements_of
from contact_sim_pkg.report.metrics.views import metric_of, suite_of, value_text, xml_text
from contact_sim_pkg.sweep.case import FINISHED, Row
from contact_sim_pkg.sweep.kept import NONE, read_kept
from contact_sim_pkg.sweep.sweep import Notify, check_folder, sweep, try_ends
from contact_sim_pkg.sweep.table import SweepTable
from contact_sim_pkg.sweep.variation import SEED, SweepError, Values, Variation, read_variation, samples_of

__all__ = [
    "MISSED",
    "NOT_DECIDED",
    "PASSED",
    "Judged",
    "Outcome",
    "Plan",
    "judge",
    "judged_rows",
    "junit",
    "read_plan",
    "run_plan",
    "set_by",
    "shipped_plans",
    "status_of",
]

FORM = "write `sweeps: {NAME: {scene: tire_bump, vary: ['travel.speed=2:8:4'], require: {tire.load_largest: {max: 8000}}}}`"
PLAN_KEYS, SWEEP_KEYS = ("description", "sweeps"), ("scene", "vary", "sample", "seeds", "require")
PASSED, MISSED, NOT_DECIDED = "pass", "MISS", "undecided"


class PlannedSweep(NamedTuple):
    """One sweep of a plan."""

    name: str
    scene: str
    variations: list[Variation]
    values: list[Values]
    requirements: list[Requirement]


class Plan(NamedTuple):
    """Sweeps, and what is required of them."""

    name: str
    description: str
    sweeps: list[PlannedSweep]


class Outcome(NamedTuple):
    """A case of a plan, or several that differ in their seed only."""

    sweep: str
    scene: str
    values: Values
    metrics: list[Metric]
    """judged by what is required"""
    failure: str
    """sentence of a run that did not finish; empty where all did"""


class Judged(NamedTuple):
    """A requirement over all cases of a sweep."""

    sweep: str
    metric: str
    limit: str
    verdict: str
    """pass, MISS or undecided"""
    cases: int
    missed: int
    worst: str
    """value in the worst case"""
    margin: str
    """from there to the limit, negative beyond it"""
    case: str
    """what the worst case sets"""
    remark: str
    """what would decide it"""


def shipped_plans() -> dict[str, Path]:
    """Plans that come with the bench, by name."""
    return {path.stem: path for path in sorted((Path(__file__).parent / "plans").glob("*.yaml"))}


def read_plan(name: str) -> Plan:
    """A plan by the name of a shipped one, or the path of a file.

    Raises SweepError, BagError for a file that is no plan, FileRefusedError where it cannot be read.
    """
    shipped = shipped_plans()
    path = shipped.get(name, Path(name))
    if name not in shipped and not path.is_file():
        raise SweepError(f"{name}: there is no such plan (shipped are {', '.join(shipped)}; a file ends in .yaml)")
    given = table_of_file(path, "plan", FORM)
    _refuse_unknown(path, "", given, PLAN_KEYS)
    sweeps = given.get("sweeps")
    if not isinstance(sweeps, dict) or not sweeps:
        raise BagError(f"{path}: sweeps is {sweeps!r:.40}; {FORM}")
    found = [_read_sweep(path, str(each), facts) for each, facts in sweeps.items()]
    return Plan(path.stem, str(given.get("description", "")), found)


def _read_sweep(path: Path, name: str, given: object) -> PlannedSweep:
    where = f"{path}: sweeps.{name}"
    if not isinstance(given, dict) or not isinstance(given.get("scene"), str):
        raise BagError(f"{where} needs a scene; {FORM}")
    _refuse_unknown(path, f"sweeps.{name}.", given, SWEEP_KEYS)
    vary, seeds, require = given.get("vary", []), given.get("seeds", 0), given.get("require", {})
    if not isinstance(vary, list) or not all(isinstance(each, str) for each in vary):
        raise BagError(f"{where}.vary is {vary!r:.60}, not a list of texts such as 'travel.speed=2:8:4'")
    if not isinstance(seeds, int) or isinstance(seeds, bool) or seeds < 0:
        raise BagError(f"{where}.seeds is {seeds!r:.40}; write a number of replications, 2 or more")
    if not isinstance(require, dict):
        raise BagError(f"{where}.require is {require!r:.40}, not a mapping of metrics to min and max")
    try:
        variations = [read_variation(each) for each in vary]
        values = samples_of(variations, str(given.get("sample", "grid")), seeds, 1) if vary or seeds else [{}]
    except SweepError as error:
        raise SweepError(f"{where}: {error}") from None
    scene = given["scene"]
    beside = path.parent / scene
    return PlannedSweep(
        name, str(beside) if beside.is_file() else scene, variations, values,
        requirements_of({str(key): value for key, value in require.items()}, path),
    )  # fmt: skip


def _refuse_unknown(path: Path, before: str, given: Mapping[str, Any], keys: Sequence[str]) -> None:
    unknown = sorted(set(map(str, given)) - set(keys))
    if unknown:
        raise BagError(f"{path}: {before}{unknown[0]} is no key of a plan; there are {', '.join(keys)}")


def run_plan(
    plan: Plan, folder: Path, *, jobs: int | None, scheduler: str = "", keep_bags: str = NONE, notify: Notify
) -> tuple[list[Outcome], list[SweepTable]]:
    """Run all cases that have not run, each sweep in a folder of its name, and judge them; the table of each sweep too.
    ``scheduler`` and ``keep_bags`` are those of `sweep`.

    Raises what `sweep` does, before anything runs; BagError for a requirement of a metric that no case has.
    """
    read_kept(keep_bags)
    for each in plan.sweeps:
        notify(f"checking {each.name}", 0.0)
        check_folder(folder / each.name)
        try_ends(each.scene, each.variations, each.values)
    found: list[Outcome] = []
    tables = []
    for each in plan.sweeps:
        table = sweep(
            each.scene, each.values, folder / each.name, jobs=jobs, scheduler=scheduler, keep_bags=keep_bags,
            bands=bands_of(each.requirements),
            notify=lambda text, done, name=each.name: notify(f"{name}: {text}", done),  # type: ignore[misc]
        )  # fmt: skip
        _refuse_missing(each, table)
        found += judge(each, table.cases)
        tables.append(table)
    return found, tables


def _refuse_missing(planned: PlannedSweep, table: SweepTable) -> None:
    """Raise BagError for a requirement of a metric that no case has, where some have finished."""
    known = {each["key"]: metric_of(each) for _, row in table.cases for each in row["metrics"]}
    for each in planned.requirements if known else ():
        places_of([*known.values()], each.metric, f"{planned.name} requires")


def set_by(values: Values, others: Sequence[Values] = ()) -> str:
    """What a case sets beside its seed, `a=1 b=2`; of what all ``others`` set too, nothing, unless it is all."""
    own = {key: value for key, value in values.items() if key != SEED}
    differs = {key: value for key, value in own.items() if any(each.get(key) != value for each in others)}
    return " ".join(f"{key}={value}" for key, value in (differs or own).items())


def judge(planned: PlannedSweep, cases: Sequence[tuple[Values, Row]]) -> list[Outcome]:
    """The cases of a sweep judged by its requirements; those that differ in their seed only are one, of which the mean
    is judged with half its 95 % interval.
    """
    groups: dict[tuple[tuple[str, str], ...], list[tuple[Values, Row]]] = {}
    for values, row in cases:
        groups.setdefault(tuple((key, value) for key, value in values.items() if key != SEED), []).append((values, row))
    found = []
    for key, members in groups.items():
        failures = [row["sentence"] for _, row in members if row["outcome"] != FINISHED]
        lists = [[metric_of(each) for each in row["metrics"]] for _, row in members if row["outcome"] == FINISHED]
        metrics = [] if failures else lists[0]
        if len(lists) > 1 and not failures:
            names = [f"{planned.name}, seed {values[SEED]}" for values, _ in members]
            metrics = repeated(names, [{} for _ in lists], lists)
        judged = [_unless_unknown(each) for each in required(metrics, planned.requirements)] if metrics else []
        found.append(Outcome(planned.name, planned.scene, dict(key), judged, "; ".join(dict.fromkeys(failures))))
    return found


def _unless_unknown(metric: Metric) -> Metric:
    """A metric of which a limit is undecided where it has no value, or nobody knows what chance does to it."""
    if metric.band is None or metric.band.kind != REQUIRED or metric.verdict == OUTSIDE:
        return metric
    if not math.isfinite(metric.value):
        return metric._replace(verdict=UNDECIDED)
    if metric.basis == STATIONARY and not math.isfinite(metric.spread):
        return metric._replace(verdict=UNDECIDED, remark="yours; its spread is not known: give seeds")
    return metric


def judged_rows(outcomes: Sequence[Outcome]) -> list[Judged]:
    """Each requirement of each sweep over its cases: how many miss it, by how much the worst."""
    groups: dict[tuple[str, str], list[tuple[Outcome, Metric]]] = {}
    for outcome in outcomes:
        for metric in outcome.metrics:
            if metric.band is not None and metric.band.kind == REQUIRED:
                groups.setdefault((outcome.sweep, metric.key), []).append((outcome, metric))
    found = []
    for (name, key), members in groups.items():
        worst, metric = min(members, key=lambda each: _margin(each[1]))
        missed = sum(each.verdict == OUTSIDE for _, each in members)
        unsure = [
            each for _, each in members if each.verdict == UNDECIDED or not math.isfinite(each.value) or each.broken
        ]
        assert metric.band is not None
        case = set_by(worst.values, [each.values for each, _ in members])
        found.append(
            Judged(
                name, key, f"{metric.band.text} {metric.unit}".rstrip(),
                MISSED if missed else NOT_DECIDED if unsure else PASSED, len(members), missed, value_text(metric),
                f"{_margin(metric):.3g}", case, _cure(unsure[0]) if unsure and not missed else "",
            )
        )  # fmt: skip
    return found


def _margin(metric: Metric) -> float:
    """How far a metric lies inside its band, negative outside; -inf where it has no value."""
    assert metric.band is not None
    if not math.isfinite(metric.value):
        return -math.inf
    return min(metric.value - metric.band.low, metric.band.high - metric.value)


def _cure(metric: Metric) -> str:
    """What would decide a metric that is not."""
    if metric.broken:
        return "; ".join(metric.broken)
    if not math.isfinite(metric.value):
        return metric.remark or "the run has no such number"
    if not math.isfinite(metric.spread) and metric.basis == STATIONARY:
        return "its spread is not known: give seeds"
    unsure = {"spread": metric.spread, "numerical error": metric.error}
    known = {name: value for name, value in unsure.items() if math.isfinite(value)}
    largest = max(known, key=lambda name: known[name], default="spread")
    cure = "more seeds or a longer run" if largest == "spread" else "a smaller accuracy"
    return f"within its {largest} of {known.get(largest, math.nan):.3g}: {cure}"


def status_of(outcomes: Sequence[Outcome]) -> int:
    """Exit status: 1 on a miss or a run that failed, 3 where something could not be judged, 0 where all holds."""
    verdicts = {each.verdict for each in judged_rows(outcomes)}
    return exit_status(
        missed=MISSED in verdicts or any(each.failure for each in outcomes), unjudged=NOT_DECIDED in verdicts
    )


def junit(plan: Plan, outcomes: Sequence[Outcome]) -> str:
    """JUnit XML: a suite a case, in it a test of each metric that something is required of; a run that failed is an
    error.
    """
    root = ElementTree.Element("testsuites", name=plan.name)
    for outcome in outcomes:
        case = set_by(outcome.values)
        own = [each for each in outcome.metrics if each.band is not None and each.band.kind == REQUIRED]
        root.append(suite_of(f"{outcome.sweep} {case}".rstrip(), own, [outcome.failure] if outcome.failure else []))
    return xml_text(root)
