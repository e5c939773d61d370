"""The study of a scene's effects in words: its answer, one table, details behind it."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

from contact_sim_pkg.records.table import Section, number_of
from contact_sim_pkg.studies.effects import verdicts
from contact_sim_pkg.studies.effects.effects_study import EffectRow, Study
from contact_sim_pkg.studies.effects.of_metrics import MetricBase
from contact_sim_pkg.studies.effects.reduced import Reduced

__all__ = ["answer", "facts_of", "facts_of_reduced", "parts", "table"]

LEAST_SHARE = 0.005
"""Of the time: what an effect takes below it is not resolved."""


def answer(study: Study) -> str:
    """The answer in one line."""
    groups = (
        ("on but not needed", study.with_verdict(verdicts.NOT_NEEDED), _saving),
        ("on, but within the accuracy", study.with_verdict(verdicts.WITHIN), _saving),
        ("off but needed", study.with_verdict(verdicts.OFF_NEEDED, on=False), _change),
        ("only observing", study.with_verdict(verdicts.OBSERVES), _price),
        (verdicts.NUMBERS, study.with_verdict(verdicts.NUMBERS), _change),
    )
    found = [f"{title}: {', '.join(each(study, row) for row in rows)}" for title, rows, each in groups if rows]
    on = sum(bool(rows) for _title, rows, _each in groups[:2])
    if not groups[2][1] and not all(row.on for row in study.rows):
        found.insert(on, f"its data call for none that is off{_yet(study)}")
    if not on and not groups[4][1]:
        found.insert(0, "every effect that acts is needed")
    return f"{study.base.scene.name} at {number_of(study.base.request)}{_asked(study)}: {'; '.join(found)}"


def _asked(study: Study) -> str:
    """Names of the metrics that a study is of."""
    return f", {', '.join(each.name for each in study.base.metrics)}" if isinstance(study.base, MetricBase) else ""


def _yet(study: Study) -> str:
    """Which effect that is off would change most, where that is more than requested."""
    changing = [row for row in study.rows if not row.on and row.largest is not None and row.largest.resolved
                and row.largest.size > study.base.request]  # fmt: skip
    if not changing:
        return ""
    most = max(changing, key=lambda row: row.largest.size if row.largest else 0.0)
    return f", though {_name(study, most)} would change {verdicts.shown(most.largest)}" if most.largest else ""


def table(study: Study) -> list[Section]:
    """One line an effect."""
    rows = [
        {
            "effect": f"{row.contact.name} {row.name}",
            "is": "on" if row.on else "off",
            "verdict": row.verdict,
            "largest change": "-" if row.largest is None else f"{verdicts.shown(row.largest)}, {_where(row.largest)}",
            "ms/s": "-" if (cost := study.cost_of(row)) is None else f"{cost:+.3g}",
        }
        for row in study.rows
    ]
    note = (
        f"{study.base.compared}; ms/s: CPU time per simulated second that the effect takes or would take, of "
        f"{study.cost:.3g} in all"
    )
    return [Section("", rows, note)]


def parts(study: Study) -> list[Section]:
    """Every change by contact or body and kind; reasons; outputs."""
    changes = [
        {
            "effect": f"{row.contact.name} {row.name}", "at": each.place, "kind": each.kind,
            "change": number_of(each.size), "error of it": number_of(each.error), "where": _where(each),
        }
        for row in study.rows for each in row.changes if each.size > 0.0
    ]  # fmt: skip
    reasons = [
        {"effect": f"{row.contact.name} {row.effect.name}", "verdict": row.verdict, "why": row.why}
        for row in study.rows if row.why
    ]  # fmt: skip
    feeds = [
        {
            "effect": f"{row.contact.name} {row.effect.name}",
            "outputs": [f"{row.contact.name}/{t}" for t in row.effect.feeds],
        }
        for row in study.rows
    ]
    return [
        Section("changes over the scale of their kind", changes),
        Section("called for, or different beside it", reasons),
        Section("outputs that the effect feeds", feeds, "and each of them bench/motion and bench/energy"),
    ]


def facts_of(study: Study) -> dict[str, Any]:
    """The study as plain values."""
    return {
        "scene": study.base.scene.name, "answer": answer(study), "requested": study.base.request,
        **study.base.facts(), "cost_ms_per_s": study.cost,
        "rows": [_facts(study, row) for row in study.rows],
    }  # fmt: skip


def _facts(study: Study, row: EffectRow) -> dict[str, Any]:
    cost = study.cost_of(row)
    return {
        "contact": row.contact.name,
        "effect": row.effect.name,
        "on": row.on,
        "verdict": row.verdict,
        "changes": [each._asdict() for each in row.changes],
        "cost_ms_per_s": cost,
        "cost_share": None if cost is None else cost / study.cost,
        "why": row.why,
        "added": list(row.added),
        "topics": [f"{row.contact.name}/{topic}" for topic in row.effect.feeds],
    }


def _where(change: verdicts.Change) -> str:
    name = f"{change.place} {change.column}".strip()
    return name if math.isnan(change.time) else f"{name} at {change.time:.4g} s"


def _saving(study: Study, row: EffectRow) -> str:
    share = (study.cost_of(row) or 0.0) / study.cost
    return f"{_name(study, row)} (saves {100.0 * share:.0f} %)" if share > LEAST_SHARE else _name(study, row)


def _price(study: Study, row: EffectRow) -> str:
    return f"{_name(study, row)} {100.0 * max(0.0, study.cost_of(row) or 0.0) / study.cost:.0f} %"


def _change(study: Study, row: EffectRow) -> str:
    return f"{_name(study, row)} ({verdicts.shown(row.largest)})" if row.largest else _name(study, row)


def _name(study: Study, row: EffectRow) -> str:
    """Name of the effect, and of those that come with it, behind that of its contact where two contacts have it."""
    several = sum(each.effect.name == row.effect.name for each in study.rows) > 1
    return f"{row.contact.name} {row.name}" if several else row.name


def facts_of_reduced(found: Reduced, path: Path) -> dict[str, Any]:
    """A written scene as plain values, and as a sentence."""
    largest = verdicts.largest(found.changes)
    names = ", ".join(f"{row.contact.name} {row.effect.name}" for row in found.left_out)
    changed = "nothing" if largest is None else verdicts.shown(largest)
    sentence = (
        f"without {names}: changes {changed}, saves {100.0 * found.saving:.0f} %"
        if names
        else "nothing can be left out"
    )
    return {
        "file": str(path),
        "sentence": sentence,
        "left_out": [f"{row.contact.name}.{row.effect.name}" for row in found.left_out],
        "put_back": [f"{row.contact.name}.{row.effect.name}" for row in found.put_back],
        "changes": [each._asdict() for each in found.changes],
        "cost_ms_per_s": found.cost,
        "full_cost_ms_per_s": found.full_cost,
        "saving": found.saving,
    }
