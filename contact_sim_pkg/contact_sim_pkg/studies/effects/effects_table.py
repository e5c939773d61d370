"""The study of a scene's effects in words: its answer, one table, details behind it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from contact_sim_pkg.records.table import Section, number_of
from contact_sim_pkg.studies.effects import verdicts
from contact_sim_pkg.studies.effects.effects_study import EffectRow, Study
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
        found.insert(on, "none that is off is needed")
    if not on and not groups[4][1]:
        found.insert(0, "every effect that acts is needed")
    return f"{study.base.scene.name} at {number_of(study.base.request)}: {'; '.join(found)}"


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
    length = study.base.scene.block_length
    spans = "; ".join(
        f"{each.span.shown * length:g} to {each.span.end * length:g} s ({each.reason})" for each in study.base.spans
    )
    note = (
        f"{spans}; ms/s: CPU time per simulated second that the effect takes or would take, of {study.cost:.3g} in all; "
        "changes by leaving it out or adding it, one level finer than requested, over the scales of the accuracy"
    )
    if study.base.agrees_until is not None:
        note += f"; compared until {study.base.agrees_until:.4g} s, where a finer run parts from the scene"
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
    length = study.base.scene.block_length
    return {
        "scene": study.base.scene.name,
        "answer": answer(study),
        "requested": study.base.request,
        "spans": [
            {
                "start_s": each.span.shown * length, "end_s": each.span.end * length, "event": each.reason,
                "blocks": [each.span.first, each.span.shown, each.span.end],
            }
            for each in study.base.spans
        ],
        "cost_ms_per_s": study.cost,
        "agrees_until_s": study.base.agrees_until,
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
    return f"{name} at {change.time:.4g} s"


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
