"""`bench effects SCENE`: cost of each effect, its outputs, and whether the scene calls for it.

Each effect of the scene's contacts is removed, or added where it is absent and can act, and the
scene runs again. Runs with and without it alternate, so that other load of the machine slows both
alike; the median of the pairs counts.
"""

from __future__ import annotations

import statistics
from collections.abc import Callable
from typing import Any

from contact_sim_pkg.compare.changes import changes_of
from contact_sim_pkg.records.contact import Contact
from contact_sim_pkg.records.effect import Effect
from contact_sim_pkg.records.registry import rigs
from contact_sim_pkg.records.table import Section
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.overrides import set_value
from contact_sim_pkg.scene.resolve import ResolvedScene, load_resolved, read_explicit
from contact_sim_pkg.studies.effects.ablation_runs import Pair, paired

__all__ = ["sections", "study"]

BENCH_TOPICS = ("bench/motion", "bench/energy")
LEDGER = "bench/energy"
MEASURES = (
    "duration", "cost_with", "cost_without", "cost", "cost_noise", "cost_share", "load_mean_change", "load_rms_change",
)  # fmt: skip
STEADY = 1.0e-9  # of the largest force: a spread below it is rounding, which has no ratio
NOTHING: dict[str, Any] = {**dict.fromkeys(MEASURES), "changes": []}
"""Measures of an effect that is not measured."""


def study(scene_name: str, progress: Callable[[str], None] | None = None) -> list[dict[str, Any]]:
    """One row for each contact and effect: contact, effect, on, topics, costs, changes, verdict.

    `duration` [s] simulated in each run, `cost_with`, `cost_without` [ms per simulated second],
    `cost` (median difference of the pairs), `cost_noise` (half the range of these differences: a
    cost below it was not resolved), `cost_share` (`cost` over `cost_with`), `load_mean_change`
    and `load_rms_change` (relative, of the normal force), `changes` (of each output that the effect
    feeds, the field that changes most: `compare.changes`), `called_for` (`needed`, `not needed` or
    `no rule`), `verdict` (`as it should be`, `on but not needed`, `off but needed`, `not
    available`, `carries the load`) and `why`. `progress` receives each phase as a sentence. Raises
    SceneError where the scene is wrong.
    """
    notify = progress or (lambda text: None)
    scene = load_resolved(scene_name)
    # Every effect of every contact of the rig, on or off.
    rows = []
    for contact in rigs()[scene.data["rig"]].contacts:
        for effect in contact.effects:
            notify(f"{contact.name}: {effect.name}")
            rows.append(_row(scene_name, scene, contact, effect, notify))
    return rows


def sections(rows: list[dict[str, Any]]) -> list[Section]:
    """Tables of the rows: cost, changes, verdicts, outputs."""
    cost = [
        {
            "contact": row["contact"], "effect": row["effect"], "on": row["on"], "with": row["cost_with"],
            "without": row["cost_without"], "cost": row["cost"], "±": row["cost_noise"],
            "mean load": _percent(row["load_mean_change"]), "load rms": _percent(row["load_rms_change"]),
        }
        for row in rows
    ]  # fmt: skip
    reasons = [{name: row[name] for name in ("contact", "effect", "verdict", "why")} for row in rows]
    feeds = [
        {
            "contact": row["contact"],
            "effect": row["effect"],
            "outputs": [t for t in row["topics"] if t not in BENCH_TOPICS],
        }
        for row in rows
    ]
    changes = [
        {
            "contact": row["contact"], "effect": row["effect"], "output": change["topic"], "changes most": change["field"],
            "by": _change(change),
        }
        for row in rows
        for change in row["changes"]
    ]  # fmt: skip
    return [
        Section(
            "cost, and change of the normal force by the effect", cost, "with, without, cost ±: ms per simulated second"
        ),
        Section(
            "what the effect changes",
            changes,
            "of each output the field that changes most: rms of the difference over the larger rms; "
            "of what is 0 in one run the rms in the other",
        ),
        Section("called for by the scene?", reasons),
        Section("outputs that the effect feeds", feeds, f"and each of them {' and '.join(BENCH_TOPICS)}"),
    ]


def _change(change: dict[str, Any]) -> str:
    if change["size"] is not None:
        return f"{change['size']:.2g} {change['unit']} in one run, 0 in the other"
    return f"{100.0 * change['change']:.3g} %" if change["change"] else "-"


def _percent(change: float | None) -> str:
    return "-" if change is None else f"{100.0 * change:+.2f} %"


def _row(
    scene_name: str, scene: ResolvedScene, contact: Contact, effect: Effect, notify: Callable[[str], None]
) -> dict[str, Any]:
    named = scene.data["effects"].get(contact.name) or {}
    on = named.get(effect.name) is not None
    topics = [f"{contact.name}/{name}" for name in effect.feeds] + list(BENCH_TOPICS)
    row: dict[str, Any] = {"contact": contact.name, "effect": effect.name, "on": on, "topics": topics}
    # No pair of runs: the contact needs the effect, or the effect needs another, or a run fails.
    unmeasured = {**row, **NOTHING, "called_for": "no rule", "verdict": "not available"}
    acting = [name for name, keys in named.items() if keys is not None]
    if effect.carries and on:
        why = "without it the contact carries no load"
        return {**unmeasured, "called_for": "needed", "verdict": "carries the load", "why": why}
    if effect.carries:
        return {
            **unmeasured,
            "why": f"in its place {' and '.join(set(contact.carriers) & set(acting))} carries the load",
        }
    missing = " and ".join(contact.missing(effect, acting))
    if missing:
        return {**unmeasured, "why": f"needs {missing}, which the scene does not name"}
    try:
        present = scene if on else _with(scene, scene_name, contact, effect)
        pair = paired(present, present.without(effect), notify)
    except (SceneError, RunError) as error:
        return {**unmeasured, "why": _reason(error)}
    # An absent effect that replaces another is a choice of the model: no rule calls for it.
    replaced = [] if on else _excluded(scene, contact, effect)
    needed, why = (
        (None, f"a choice of the model in place of {' and '.join(each.name for each in replaced)}")
        if replaced
        else effect.called_for(present, pair.with_it.observed)
    )
    called_for = "no rule" if needed is None else "needed" if needed else "not needed"
    verdict = "as it should be"
    if needed is not None and needed != on:
        verdict = "on but not needed" if on else "off but needed"
    return {**row, **_measures(pair, contact.name, topics), "called_for": called_for, "verdict": verdict, "why": why}


def _reason(error: SceneError | RunError) -> str:
    """Why there is no pair of runs."""
    if isinstance(error, RunError):
        return f"a run with or without it ends: {error}"
    fault = error.faults[0]
    return f"the scene does not take it: {fault.where}: {fault.sentence}"


def _with(scene: ResolvedScene, scene_name: str, contact: Contact, effect: Effect) -> ResolvedScene:
    """The scene with one more effect, all its defaults, in place of those that it excludes."""
    bare = scene.without(*_excluded(scene, contact, effect))
    added = set_value(f"effects.{contact.name}.{effect.name}={{}}")
    return ResolvedScene(read_explicit(bare.to_yaml(), scene_name, [added]), scene.files)


def _excluded(scene: ResolvedScene, contact: Contact, effect: Effect) -> list[Effect]:
    """Effects of the scene that the effect excludes."""
    return [
        other for other, _keys in scene.effects_at(contact.name)
        if other.name in effect.excludes or effect.name in other.excludes
    ]  # fmt: skip


def _measures(pair: Pair, contact: str, topics: list[str]) -> dict[str, Any]:
    force, bare = pair.with_it.observed.forces[contact], pair.without_it.observed.forces[contact]
    spread, bare_spread = float(force.std()), float(bare.std())
    least = STEADY * float(abs(bare).max())
    cost = statistics.median(pair.differences)
    values = (
        pair.duration, pair.with_it.cost, pair.without_it.cost, cost,
        0.5 * (max(pair.differences) - min(pair.differences)), cost / pair.with_it.cost,
        float(force.mean() / bare.mean() - 1.0), spread / bare_spread - 1.0 if bare_spread > least else 0.0,
    )  # fmt: skip
    compared = [topic for topic in topics if topic != LEDGER]
    changes = changes_of(pair.with_it.outputs, pair.without_it.outputs, compared)
    return {**dict(zip(MEASURES, values, strict=True)), "changes": [change._asdict() for change in changes]}
