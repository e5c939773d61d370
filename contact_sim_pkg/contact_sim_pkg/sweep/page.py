"""The page of a sweep or of a plan: what the metrics do, what they follow, and how to run a case again."""

from __future__ import annotations

import math
import shlex
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from contact_sim_pkg.files import new_file
from contact_sim_pkg.records.metric import OUTSIDE
from contact_sim_pkg.report.answer import Answer
from contact_sim_pkg.report.drawing import Picture, style
from contact_sim_pkg.report.page import rendered
from contact_sim_pkg.report.place import is_page
from contact_sim_pkg.report.rows import number
from contact_sim_pkg.report.tables import Table
from contact_sim_pkg.sweep.case import FINISHED
from contact_sim_pkg.sweep.correlations import column_of, correlation, numeric_keys, outliers, varying_metrics
from contact_sim_pkg.sweep.figures import main_effects, response_map, scatter_matrix
from contact_sim_pkg.sweep.plan import MISSED, NOT_DECIDED, PASSED, Judged, Outcome, Plan, judged_rows, set_by
from contact_sim_pkg.sweep.sensitivity import sobol_indices
from contact_sim_pkg.sweep.table import SweepTable
from contact_sim_pkg.sweep.variation import SEED, Values

__all__ = ["PAGES", "Call", "Part", "Swept", "page_of", "page_of_parts", "write_page", "write_plan_page"]

PAGES = {"sweep": "sweep.html", "plan": "plan.html", "fit": "fit.html"}
TEMPLATE = "sweep.html.j2"
MOST_ROWS, MOST_CALLS, MOST_OUTLIERS, MAPS = 200, 12, 5, 2
NONE = "–"


class Swept(NamedTuple):
    """A sweep that has run."""

    name: str
    scene: str
    table: SweepTable
    folder: Path
    first: Sequence[str] = ()
    """metrics that something is required of, which are drawn first"""
    worst: Mapping[int, str] = {}
    """numbers of cases and what they are the worst of"""
    points: int = 0
    """N of `--sample saltelli:N`; 0: drawn otherwise"""


class Call(NamedTuple):
    """How a case runs again."""

    case: str
    why: str
    lines: list[str]


class Part(NamedTuple):
    """What the page has of a sweep."""

    key: str
    title: str
    tables: list[Table]
    pictures: list[Picture]
    folded: list[Table]
    calls: list[Call]


def write_page(path: Path, kind: str, title: str, sweeps: Sequence[Swept], **named: Any) -> Path:
    """Write the page of `page_of` to a file, which may be one of an earlier call. Raises FileRefusedError for another."""
    page = page_of(kind, title, sweeps, **named)
    with new_file(path, ours=is_page) as file:
        file.write(page.encode())
    return path


def write_plan_page(path: Path, plan: Plan, outcomes: Sequence[Outcome], tables: Sequence[SweepTable]) -> Path:
    """Write the page of a plan whose sweeps gave the ``tables``, each in a folder of its name beside the page.

    Raises FileRefusedError where another file is in the way.
    """
    rows = judged_rows(outcomes)
    sweeps = []
    for planned, table in zip(plan.sweeps, tables, strict=True):
        own = [each for each in rows if each.sweep == planned.name]
        sweeps.append(
            Swept(
                planned.name, planned.scene, table, path.parent / planned.name, [each.metric for each in own],
                _worst(table, own),
            )
        )  # fmt: skip
    header = (
        "metric",
        "sweep",
        "limit",
        "verdict",
        "cases",
        "missed",
        "worst",
        "margin",
        "worst case",
        "what would decide it",
    )
    requirements = Table(
        "Margin: from the worst case to the limit, negative beyond it.", header,
        [(each.metric, each.sweep, each.limit, each.verdict, str(each.cases), str(each.missed), each.worst, each.margin,
          each.case, each.remark) for each in rows],
    )  # fmt: skip
    return write_page(
        path, "plan", plan.name, sweeps, answer=_answer_of_plan(rows, outcomes), requirements=requirements,
        description=plan.description,
    )  # fmt: skip


def _worst(table: SweepTable, rows: Sequence[Judged]) -> dict[int, str]:
    """The first case of what each requirement's worst one sets."""
    found: dict[int, list[str]] = {}
    for each in rows:
        for values, row in table.cases:
            if set_by(values, [given for given, _ in table.cases]) == each.case:
                text = f"{each.verdict}: worst of {each.metric} {each.limit}, {each.worst}"
                found.setdefault(row["number"], []).append(text)
                break
    return {case: "; ".join(texts) for case, texts in found.items()}


def _answer_of_plan(rows: Sequence[Judged], outcomes: Sequence[Outcome]) -> Answer:
    """The worst that holds of a plan, and which requirements it holds of."""
    failed = sum(bool(each.failure) for each in outcomes)
    missed = [f"{each.metric} {each.worst} ({each.limit}) at {each.case}" for each in rows if each.verdict == MISSED]
    unsure = [f"{each.metric}: {each.remark}" for each in rows if each.verdict == NOT_DECIDED]
    held = sum(each.verdict == PASSED for each in rows)
    said = f"{held} of {len(rows)} requirements hold in all cases"
    lost = [f"{failed} of {len(outcomes)} cases did not finish"] if failed else []
    if missed or failed:
        return Answer("outside", "Missed" if missed else "Failed cases", "; ".join([said, *lost, *missed]) + ".")
    if unsure:
        return Answer("doubtful", "Undecided", "; ".join([said, *unsure]) + ".")
    return Answer("good", "Pass", f"{said}.")


def page_of(
    kind: str, title: str, sweeps: Sequence[Swept], *, answer: Answer | None = None, requirements: Table | None = None,
    description: str = "",
) -> str:  # fmt: skip
    """The page as text; it loads nothing.

    Args:
        kind: sweep or plan.
        title: name of the scene or plan.
        sweeps: one, or those of the plan.
        answer: of a plan; a sweep says how many of its cases ended.
        requirements: of a plan, a row each.
        description: of a plan.
    """
    with style():
        parts = [_part(f"sweep-{place}", each) for place, each in enumerate(sweeps)]
    return page_of_parts(
        kind, title, sum(len(each.table) for each in sweeps), answer or _answer(sweeps), parts,
        requirements=requirements, description=description,
    )  # fmt: skip


def page_of_parts(
    kind: str, title: str, count: int, answer: Answer, parts: Sequence[Part], *, requirements: Table | None = None,
    description: str = "",
) -> str:  # fmt: skip
    """The page as text, of parts that are drawn; arguments as of `page_of`, ``count`` of cases."""
    return rendered(TEMPLATE, {
        "kind": kind, "title": title, "count": count, "description": description, "answer": answer,
        "requirements": requirements, "sweeps": parts,
    })  # fmt: skip


def _answer(sweeps: Sequence[Swept]) -> Answer:
    """How many cases ended, and how many of their metrics lie outside."""
    failed = sum(len(each.table.failed) for each in sweeps)
    count = sum(len(each.table) for each in sweeps)
    beyond = sum(
        any(metric["verdict"] == OUTSIDE for metric in row["metrics"]) for each in sweeps for _, row in each.table.cases
    )
    outside = f"; {beyond} with a metric outside its band" if beyond else "; no metric outside its band"
    word, tone = ("Failed cases", "outside") if failed else ("Complete", "doubtful" if beyond else "good")
    return Answer(tone, word, f"{count - failed} of {count} cases finished{outside}.")


def _part(key: str, swept: Swept) -> Part:
    table = swept.table
    metrics = varying_metrics(table, swept.first)
    drawn = [
        main_effects(table, metrics, f"{key}-effects"),
        scatter_matrix(table, metrics, f"{key}-matrix"),
        *(response_map(table, metric, f"{key}-map-{place}") for place, metric in enumerate(metrics[:MAPS])),
    ]
    tables = [_ranges(table)]
    if numeric_keys(table) and metrics:
        tables.append(_correlations(table, metrics))
    if swept.points:
        tables.append(_indices(swept, metrics))
    title = swept.name if swept.name == swept.scene else f"{swept.name}: {swept.scene}"
    return Part(
        key,
        title,
        tables,
        [each for each in drawn if each is not None],
        [_cases(table, metrics)],
        _calls(swept, metrics),
    )


def _ranges(table: SweepTable) -> Table:
    """Smallest and largest of each metric, and how its cases are judged."""
    rows = []
    for each in table.ranges():
        verdicts = [row[f"{each.metric} verdict"] for row in table if row["outcome"] == FINISHED]
        counts = ", ".join(f"{verdicts.count(word)} {word}" for word in dict.fromkeys(verdicts) if word)
        rows.append((
            f"{each.metric}, {each.unit}" if each.unit else each.metric, number(each.smallest), number(each.largest),
            f"{each.smallest_in}, {each.largest_in}", counts,
        ))  # fmt: skip
    return Table(
        "What each metric does over the cases.", ("metric", "smallest", "largest", "in cases", "verdicts"), rows
    )


def _correlations(table: SweepTable, metrics: Sequence[str]) -> Table:
    keys = numeric_keys(table)
    rows = []
    for metric in metrics:
        found = [correlation(column_of(table, key), column_of(table, metric)) for key in keys]
        rows.append(
            (metric, *(f"{each:+.2f} ({_probability(p)})" if math.isfinite(each) else NONE for each, p in found))
        )
    return Table("Spearman's rank correlation of metric and key, and its p value.", ("metric", *keys), rows)


def _indices(swept: Swept, metrics: Sequence[str]) -> Table:
    """A row a metric and key, the key with the largest total index first."""
    found = sobol_indices(swept.table, swept.points, metrics)
    rows = [
        (each.metric, each.key, *(f"{value:.2f} ({ends[0]:.2f} to {ends[1]:.2f})" for value, ends in
                                  ((each.first, each.first_ends), (each.total, each.total_ends))))
        for metric in metrics for each in sorted((each for each in found if each.metric == metric), key=lambda each: -each.total)
    ]  # fmt: skip
    caption = (
        "Sobol indices with their 95 % intervals: share of the metric's variance that the key has alone (first), and with "
        "any of the others (total)."
    )
    return Table(caption, ("metric", "key", "first", "total"), rows)


def _probability(p: float) -> str:
    return f"{p:.2f}" if p >= 0.01 else f"{p:.3f}" if p >= 0.001 else "< 0.001"


def _cases(table: SweepTable, metrics: Sequence[str]) -> Table:
    names = [next(name for name in table.columns if name == each or name.startswith(f"{each} [")) for each in metrics]
    rows = [
        (
            str(row["number"]),
            *(_cell(row[key]) for key in table.keys),
            row["outcome"],
            *(_cell(row[name]) for name in names),
        )
        for row in table[:MOST_ROWS]
    ]
    caption = f"The first {MOST_ROWS} of {len(table)} cases" if len(table) > MOST_ROWS else f"All {len(table)} cases"
    return Table(caption, ("case", *table.keys, "outcome", *names), rows)


def _cell(value: Any) -> str:
    if isinstance(value, str):
        return value
    return number(value) if math.isfinite(value) else NONE


def _calls(swept: Swept, metrics: Sequence[str]) -> list[Call]:
    """Commands of failed cases, outliers and the worst; of the ends of the first metric where nothing is required."""
    table = swept.table
    reasons: dict[int, list[str]] = {}
    for row in table.failed:
        reasons.setdefault(row["number"], []).append(f"{row['outcome']}: {row['sentence']}")
    for case, what in swept.worst.items():
        reasons.setdefault(case, []).append(what)
    for each in outliers(table, metrics)[:MOST_OUTLIERS]:
        text = f"{each.metric} {number(each.value)}, the others let expect {number(each.expected)}"
        reasons.setdefault(each.number, []).append(text)
    if not swept.worst:
        ends = {each.metric: each for each in table.ranges()}
        for metric in metrics[:1]:
            reasons.setdefault(ends[metric].largest_in, []).append(f"{metric} is largest")
            reasons.setdefault(ends[metric].smallest_in, []).append(f"{metric} is smallest")
    by_number = {row["number"]: (values, row) for values, row in table.cases}
    found = []
    for case, texts in list(reasons.items())[:MOST_CALLS]:
        values, row = by_number[case]
        bag = swept.folder / "bags" / row["case"] if row["case"] else None
        name = f"{Path(swept.scene).stem}_case_{case}"
        sets = " ".join(f"--set {shlex.quote(f'{key}={value}')}" for key, value in values.items())
        run = f"bench run {shlex.quote(swept.scene)} {sets} --offline --out {name}"
        kept = bag is not None and bag.is_dir()
        lines = [f"bench report {shlex.quote(str(bag))}"] if kept else [run, f"bench report {name}"]
        found.append(Call(_named(case, values, table), "; ".join(texts), lines))
    return found


def _named(case: int, values: Values, table: SweepTable) -> str:
    """`case 14, a=1 seed=2`."""
    seed = f" seed={values[SEED]}" if SEED in values else ""
    return f"case {case}, {set_by(values, [each for each, _ in table.cases])}{seed}"
