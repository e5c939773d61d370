"""`bench effects SCENE`: each effect on or off, its measured cost, the outputs it feeds, and whether the scene calls for it.

Each effect of the scene's contacts is taken out (or put in, where it is absent and can be) and the scene run again, the two
kinds of run by turns, so that what else the machine does hits both alike; the median of the pairs counts.
"""

from __future__ import annotations

import statistics
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy

from contact_sim_pkg.core.parameters import Vector
from contact_sim_pkg.run.simulation import Simulation
from contact_sim_pkg.run.sources import make_sources
from contact_sim_pkg.scene.resolve import ResolvedScene
from contact_sim_pkg.scene.schema_effect_rules import CONTACTS_OF_RIG, EFFECT_RULES
from contact_sim_pkg.studies.ablation_rules import Observed, is_needed, observe
from contact_sim_pkg.studies.scene_drive import load_resolved, without

__all__ = ["FEEDS", "study"]

DURATION = 1.0  # [s] simulated a run
PAIRS = 3
FEEDS: dict[str, tuple[str, ...]] = {
    "normal_elastic": ("force", "wrench"),
    "normal_dissipative": ("force", "wrench", "patch"),
    "friction": ("force", "wrench"),
    "contact_field": ("patch", "force", "wrench"),
}
"""Topics of the contact that an effect feeds; every effect also feeds `bench/motion` and `bench/energy`."""
BENCH_TOPICS = ("bench/motion", "bench/energy")
ALWAYS = "normal_elastic"


class Run(NamedTuple):
    """One run: cost, the normal force of each contact [N], and what the rules look at."""

    cost: float  # [ms] per simulated second
    forces: dict[str, Vector]
    observed: Observed


def study(scene_name: str, progress: Callable[[str], None] | None = None) -> list[dict[str, Any]]:
    """One row a contact and effect: contact, effect, on, topics, cost with and without, changes, called for.

    `cost_with`, `cost_without` [ms per simulated second], `cost_share` (their difference over `cost_with`), `load_mean_change`
    and `load_rms_change` (relative, of the normal force), `called_for` (`needed`, `not needed` or `no rule`), `verdict`
    (`as it should be`, `on but not needed`, `off but needed`, `carries the load`) and `why`. Raises what a bad scene raises.
    """
    tell = progress or (lambda text: None)
    scene = load_resolved(scene_name)
    rows = []
    for contact in CONTACTS_OF_RIG[scene.data["rig"]]:
        for effect, rule in EFFECT_RULES.items():
            if contact not in rule.contacts:
                continue
            tell(f"{contact}: {effect}")
            rows.append(_row(scene_name, scene, contact, effect))
    return rows


def _row(scene_name: str, scene: ResolvedScene, contact: str, effect: str) -> dict[str, Any]:
    on = (scene.data["effects"].get(contact) or {}).get(effect) is not None
    topics = [f"{contact}/{name}" for name in FEEDS[effect]] + list(BENCH_TOPICS)
    row: dict[str, Any] = {"contact": contact, "effect": effect, "on": on, "topics": topics}
    if effect == ALWAYS:
        why = "without it the contact carries no load"
        return {
            **row,
            **_measures(None, None, contact),
            "called_for": "needed",
            "verdict": "carries the load",
            "why": why,
        }
    absent = without(scene, (contact, effect))
    present = scene if on else load_resolved(scene_name, f"effects.{contact}.{effect}={{}}")
    with_it, without_it = _paired(present, absent)
    needed, why = is_needed(effect, contact, present, with_it.observed)
    called_for = "no rule" if needed is None else "needed" if needed else "not needed"
    verdict = "as it should be"
    if needed is not None and needed != on:
        verdict = "on but not needed" if on else "off but needed"
    return {**row, **_measures(with_it, without_it, contact), "called_for": called_for, "verdict": verdict, "why": why}


def _measures(with_it: Run | None, without_it: Run | None, contact: str) -> dict[str, float | None]:
    if with_it is None or without_it is None:
        names = ("cost_with", "cost_without", "cost_share", "load_mean_change", "load_rms_change")
        return dict.fromkeys(names)
    force, bare = with_it.forces[contact], without_it.forces[contact]
    spread, bare_spread = float(force.std()), float(bare.std())
    return {
        "cost_with": with_it.cost,
        "cost_without": without_it.cost,
        "cost_share": 1.0 - without_it.cost / with_it.cost,
        "load_mean_change": float(force.mean() / bare.mean() - 1.0),
        "load_rms_change": spread / bare_spread - 1.0 if bare_spread > 0.0 else 0.0,
    }


def _paired(first: ResolvedScene, second: ResolvedScene) -> tuple[Run, Run]:
    """Both scenes by turns; the median costs of the pairs."""
    runs: list[list[Run]] = [[], []]
    for _ in range(PAIRS):
        for place, scene in enumerate((first, second)):
            runs[place].append(run_once(scene, DURATION))
    costs = [statistics.median(run.cost for run in group) for group in runs]
    return runs[0][0]._replace(cost=costs[0]), runs[1][0]._replace(cost=costs[1])


def run_once(scene: ResolvedScene, duration: float) -> Run:
    """One run of `duration` [s] without bag; the cost is that of the simulation alone."""
    sources, simulation = make_sources(scene), Simulation(scene)
    simulation.prepare()
    length = simulation.model.timing.block_length
    walls, messages, inputs = [], [], []
    for block in range(min(simulation.blocks, round(duration / length))):
        given = {topic: source.block(block) for topic, source in sources.items()}
        result = simulation.advance(block, given)
        walls.append(result.wall_time)
        messages += result.messages
        inputs.append(given)
    observed = observe(messages, inputs)
    return Run(1e3 * float(numpy.median(walls)) / length, observed.forces, observed)
