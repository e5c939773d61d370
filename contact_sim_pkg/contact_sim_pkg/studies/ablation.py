"""`bench effects SCENE`: each effect on or off, its measured cost, the outputs it feeds, and whether the scene calls for it.

Each effect of the scene's contacts is taken out (or put in, where it is absent and can be) and the scene run again, the two
kinds of run by turns, so that what else the machine does hits both alike; the median of the pairs counts.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy

from contact_sim_pkg.core.parameters import Vector
from contact_sim_pkg.run.block_simulation import BlockSimulation
from contact_sim_pkg.run.rigs import make_simulation
from contact_sim_pkg.run.sources import make_sources
from contact_sim_pkg.scene.overrides import set_value
from contact_sim_pkg.scene.resolve import ResolvedScene, read_explicit
from contact_sim_pkg.scene.rigs import RIGS
from contact_sim_pkg.scene.schema_effect_rules import EFFECT_RULES, carrier_of
from contact_sim_pkg.studies.ablation_rules import Observed, is_needed, observe
from contact_sim_pkg.studies.scene_drive import load_resolved, without
from contact_sim_pkg.studies.section import Section

__all__ = ["FEEDS", "sections", "study"]

DURATION = 1.0  # [s] simulated a run
PAIRS = 3
RUNS_OF_BURSTS = 5
"""Runs of a rig without excitation: its work falls into the few blocks with an impact, so each block's least time counts."""
FEEDS: dict[str, tuple[str, ...]] = {
    "normal_elastic": ("force", "wrench"),
    "normal_dissipative": ("force", "wrench", "patch"),
    "foam": ("force", "wrench"),
    "foam_hysteresis": ("force", "wrench"),
    "general_dissipative": ("force", "wrench", "patch"),
    "friction": ("force", "wrench"),
    "contact_field": ("patch", "force", "wrench"),
    "pressure_mat": ("patch",),
    "shell_modes": ("force", "wrench", "patch", "points"),
    "contact_search": ("force", "wrench", "patch", "points"),
    "carcass": ("force", "wrench", "patch"),
    "envelopment": ("patch", "force", "wrench"),
    "tread_viscoelasticity": ("patch", "force", "wrench"),
    "brush": ("shear", "force", "wrench"),
    "asperity_impulses": ("force", "wrench"),
    "shift": ("force", "wrench", "events"),
    "contact_stress": ("stress",),
    "surface_waves": ("wave",),
    "micro_front": ("front",),
    "thermal_volume": ("position",),
    "history": ("history",),
    "gauge_noise": ("events",),
    "rigid_contact": ("force", "wrench", "points"),
    "compliant_contact": ("force", "wrench", "points"),
    "tilt_yaw": ("contact", "stability"),
    "gyroscope": ("contact", "stability"),
    "rolling_friction": ("contact", "stability"),
    "shaft_bending": ("contact", "force"),
    "track_waves": ("track", "contact", "force"),
    "subsurface": ("volumes",),
    "damage": ("track", "contact", "force"),
}
"""Topics of the contact that an effect feeds; every effect also feeds `bench/motion` and `bench/energy`."""
BENCH_TOPICS = ("bench/motion", "bench/energy")
MEASURES = (
    "cost_with", "cost_without", "cost", "cost_noise", "cost_share", "load_mean_change", "load_rms_change",
)  # fmt: skip


class Run(NamedTuple):
    """One run: cost, the normal force of each contact [N], and what the rules look at."""

    cost: float  # [ms] per simulated second
    forces: dict[str, Vector]
    observed: Observed


def study(scene_name: str, progress: Callable[[str], None] | None = None) -> list[dict[str, Any]]:
    """One row a contact and effect: contact, effect, on, topics, cost with and without, changes, called for.

    `cost_with`, `cost_without` [ms per simulated second], `cost` (median difference of the pairs), `cost_noise` (half the range
    of these differences: a cost below it is none that was seen), `cost_share` (`cost` over `cost_with`), `load_mean_change`
    and `load_rms_change` (relative, of the normal force), `called_for` (`needed`, `not needed` or `no rule`), `verdict`
    (`as it should be`, `on but not needed`, `off but needed`, `not available`, `carries the load`) and `why`. Raises what a
    bad scene raises.
    """
    tell = progress or (lambda text: None)
    scene = load_resolved(scene_name)
    rows = []
    for contact in RIGS[scene.data["rig"]].contacts:
        for effect, rule in EFFECT_RULES.items():
            if contact not in rule.contacts:
                continue
            tell(f"{contact}: {effect}")
            rows.append(_row(scene_name, scene, contact, effect, tell))
    return rows


def sections(rows: list[dict[str, Any]]) -> list[Section]:
    """The same rows as a person reads them."""
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
    return [
        Section(
            "cost, and change of the normal force by the effect", cost, "with, without, cost ±: ms per simulated second"
        ),
        Section("called for by the scene?", reasons),
        Section("outputs that the effect feeds", feeds, f"and each of them {' and '.join(BENCH_TOPICS)}"),
    ]


def _percent(change: float | None) -> str:
    return "-" if change is None else f"{100.0 * change:+.2f} %"


def _row(
    scene_name: str, scene: ResolvedScene, contact: str, effect: str, tell: Callable[[str], None]
) -> dict[str, Any]:
    on = (scene.data["effects"].get(contact) or {}).get(effect) is not None
    topics = [f"{contact}/{name}" for name in FEEDS[effect]] + list(BENCH_TOPICS)
    row: dict[str, Any] = {"contact": contact, "effect": effect, "on": on, "topics": topics}
    if effect == carrier_of(contact):
        why = "without it the contact carries no load"
        return {
            **row,
            **dict.fromkeys(MEASURES),
            "called_for": "needed",
            "verdict": "carries the load",
            "why": why,
        }
    missing = _missing(scene, contact, effect)
    if missing:
        why = f"needs {missing}, which the scene does not name"
        nothing = dict.fromkeys(MEASURES)
        return {**row, **nothing, "called_for": "no rule", "verdict": "not available", "why": why}
    present = scene if on else _with(scene, scene_name, contact, effect)
    absent = without(present, (contact, effect))
    with_it, without_it, differences = _paired(present, absent, tell)
    needed, why = is_needed(effect, contact, present, with_it.observed)
    called_for = "no rule" if needed is None else "needed" if needed else "not needed"
    verdict = "as it should be"
    if needed is not None and needed != on:
        verdict = "on but not needed" if on else "off but needed"
    measures = _measures(with_it, without_it, differences, contact)
    return {**row, **measures, "called_for": called_for, "verdict": verdict, "why": why}


def _with(scene: ResolvedScene, scene_name: str, contact: str, effect: str) -> ResolvedScene:
    """The scene with one more effect, all its defaults, in place of those that it excludes."""
    excluded = [
        name for name, rule in EFFECT_RULES.items() if name in EFFECT_RULES[effect].excludes or effect in rule.excludes
    ]
    bare = without(scene, *((contact, name) for name in excluded))
    asked = set_value(f"effects.{contact}.{effect}={{}}")
    return ResolvedScene(read_explicit(bare.to_yaml(), scene_name, [asked]), scene.files)


def _missing(scene: ResolvedScene, contact: str, effect: str) -> str:
    """What the effect needs and the scene does not name; empty where nothing is missing."""
    named = scene.data["effects"].get(contact) or {}
    return " and ".join(name for name in EFFECT_RULES[effect].needs if named.get(name) is None)


def _measures(with_it: Run, without_it: Run, differences: list[float], contact: str) -> dict[str, float]:
    force, bare = with_it.forces[contact], without_it.forces[contact]
    spread, bare_spread = float(force.std()), float(bare.std())
    cost = statistics.median(differences)
    values = (
        with_it.cost, without_it.cost, cost, 0.5 * (max(differences) - min(differences)), cost / with_it.cost,
        float(force.mean() / bare.mean() - 1.0), spread / bare_spread - 1.0 if bare_spread > 0.0 else 0.0,
    )  # fmt: skip
    return dict(zip(MEASURES, values, strict=True))


def _paired(first: ResolvedScene, second: ResolvedScene, tell: Callable[[str], None]) -> tuple[Run, Run, list[float]]:
    """Both scenes by turns: a run of each with the median of its costs, and the differences of the costs of each pair.

    Compiled first: nearly all the time of a first study goes there, and it tells so.
    """
    began = time.process_time()
    for name, scene in (("with", first), ("without", second)):
        tell(f"  kernels {name} it: compiled, or from the disk")
        _prepared(scene)
    tell(f"  {PAIRS} runs of both by turns, behind {time.process_time() - began:.0f} s of preparation")
    pairs = [(run_once(first, DURATION), run_once(second, DURATION)) for _ in range(PAIRS)]
    costs = [statistics.median(pair[place].cost for pair in pairs) for place in (0, 1)]
    differences = [one.cost - other.cost for one, other in pairs]
    return pairs[0][0]._replace(cost=costs[0]), pairs[0][1]._replace(cost=costs[1]), differences


def _prepared(scene: ResolvedScene) -> BlockSimulation:
    simulation = make_simulation(scene)
    simulation.prepare()
    return simulation


def run_once(scene: ResolvedScene, duration: float) -> Run:
    """One run of `duration` [s] without bag; the cost is that of the simulation alone."""
    walls, messages, inputs = _walls(scene, duration)
    cost = float(numpy.median(walls))
    if not inputs[0]:
        again = [_walls(scene, duration)[0] for _ in range(RUNS_OF_BURSTS - 1)]
        cost = float(numpy.min([walls, *again], axis=0).mean())
    observed = observe(messages, inputs)
    return Run(1e3 * cost / float(scene.data["block_length"]), observed.forces, observed)


def _walls(
    scene: ResolvedScene, duration: float
) -> tuple[list[float], list[tuple[str, int, bytes]], list[dict[str, Any]]]:
    """Wall time of each block [s], all messages, all inputs."""
    sources, simulation = make_sources(scene), _prepared(scene)
    length = float(scene.data["block_length"])
    walls, messages, inputs = [], [], []
    for block in range(min(simulation.blocks, round(duration / length))):
        given = {topic: source.block(block) for topic, source in sources.items()}
        result = simulation.advance(block, given)
        walls.append(result.wall_time)
        messages += result.messages
        inputs.append(given)
    return walls, messages, inputs
