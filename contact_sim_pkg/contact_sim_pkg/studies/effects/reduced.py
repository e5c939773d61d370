"""The scene with only what it calls for: `bench effects SCENE --write FILE`.

What can be left out alone is left out together, dearest first, and compared once more with the full
scene; where their sum changes more than requested, the last one goes back, until it does not. The
file names its effects; a measurement never decides what a scene computes.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

from contact_sim_pkg.compare.span import Notify
from contact_sim_pkg.records.effect import Effect
from contact_sim_pkg.records.registry import rigs
from contact_sim_pkg.records.table import number_of
from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.load import load_scene
from contact_sim_pkg.scene.overrides import set_value
from contact_sim_pkg.scene.resolved_scene import ResolvedScene, drop_inputs
from contact_sim_pkg.studies.effects import verdicts
from contact_sim_pkg.studies.effects.alternatives import effects_of, is_on, with_effect, without_effects
from contact_sim_pkg.studies.effects.effects_study import EffectRow, Study, observes
from contact_sim_pkg.studies.effects.verdicts import Change

__all__ = ["Reduced", "all_together", "reduced", "text_of"]

SMALL = (verdicts.NOT_NEEDED, verdicts.WITHIN)
"""Verdicts of effects that change less than requested."""


class Reduced(NamedTuple):
    """A scene less what it does not call for."""

    scene: ResolvedScene
    left_out: tuple[EffectRow, ...]  # dearest first
    put_back: tuple[EffectRow, ...]  # which change too much together
    changes: tuple[Change, ...]  # from the full scene, largest first
    cost: float  # [ms] of CPU per simulated second
    full_cost: float

    @property
    def saving(self) -> float:
        """Part of the time [1] that is saved; 0 where none is."""
        return max(0.0, 1.0 - self.cost / self.full_cost)


def reduced(study: Study, notify: Notify, *, observers: bool = True) -> Reduced:
    """What a scene calls for, of what is on; without its ``observers`` where those may go.

    Raises RunError where the reduced scene ends.
    """
    base = study.base
    left_out = sorted(_candidates(study, observers=observers), key=lambda row: study.cost_of(row) or 0.0, reverse=True)
    put_back: list[EffectRow] = []
    while left_out:
        notify(f"{base.scene.name}: without {', '.join(row.effect.name for row in left_out)}")
        scene = without_effects(base.scene, *(row.effect for row in left_out)).scene
        changes, cost = base.measured(scene, notify)
        if verdicts.verdict_on(changes, base.request) in SMALL:
            return Reduced(scene, tuple(left_out), tuple(put_back), changes, cost, study.cost)
        put_back.append(left_out.pop())
    return Reduced(base.scene, (), tuple(put_back), (), study.cost, study.cost)


def _candidates(study: Study, *, observers: bool) -> list[EffectRow]:
    """Effects that can be left out alone; where observers stay, none that one of them needs."""
    watching = {row.effect.name for row in study.rows if row.on and observes(row.contact, row.effect)}
    found = []
    for row in study.rows:
        if not row.on or row.effect.carries:
            continue
        with_it = without_effects(study.base.scene, row.effect).beside
        if observers and watching & {row.effect.name, *with_it}:
            continue
        if row.verdict in SMALL or row.verdict == verdicts.OBSERVES:
            found.append(row)
    return found


def all_together(scene: ResolvedScene) -> ResolvedScene:
    """The scene with every effect that can act beside what is on: none that replaces another, that only
    observes, that builds another machine, or that the scene does not take.
    """
    for contact, effect in effects_of(scene):
        if is_on(scene, contact, effect) or effect.carries or effect.elements or observes(contact, effect):
            continue
        try:
            other = with_effect(scene, contact, effect)
        except SceneError:
            continue
        if not other.replaced and not other.removed:
            scene = other.scene
    return scene


def text_of(name: str, values: Sequence[str], found: Reduced, request: float, *, of_metrics: bool = False) -> str:
    """The scene as YAML: the keys that ``name`` gives, with the effects that are left. One that has only metrics in
    common with the full scene, ``of_metrics``, expects no regime: it may lack what shows that."""
    scene = load_scene(name, [set_value(value) for value in values])
    data: dict[str, Any] = scene.model_dump(exclude_unset=True, exclude_none=True)
    data.pop("name", None)  # that of the file
    if of_metrics:
        data.pop("expect", None)
    gone: list[Effect] = []
    for contact in rigs()[scene.rig].contacts:
        given = data["effects"].get(contact.name) or {}
        named = [each.name for each in contact.effects if is_on(found.scene, contact, each)]
        gone += [each for each in contact.effects if each.name in given and each.name not in named]
        data["effects"][contact.name] = {each: given.get(each, {}) for each in named}
    drop_inputs(data, gone)
    for where, path in found.scene.files.items():
        *sections, key = where.split(".")
        section = data
        for each in sections:
            section = section[each]
        if Path(section[key]).is_absolute() or (Path(scene.file).parent / section[key]).is_file():
            section[key] = str(path.absolute())
    return "".join(f"# {line}\n" for line in _comment(name, found, request)) + ResolvedScene(data).to_yaml()


def _comment(name: str, found: Reduced, request: float) -> list[str]:
    largest = verdicts.largest(found.changes)
    lines = [f"{name} with what it calls for at an accuracy of {number_of(request)}, by measurement."]
    lines += [f"Left out: {_reason(row)}" for row in found.left_out]
    lines += [f"Kept, for it changes too much beside the others: {row.effect.name}" for row in found.put_back]
    if largest is not None:
        lines.append(
            f"All together: changes {verdicts.shown(largest)}, saves {100.0 * found.saving:.0f} % of the time."
        )
    return lines


def _reason(row: EffectRow) -> str:
    said = row.verdict if row.largest is None else f"changes {verdicts.shown(row.largest)}"
    return f"{row.contact.name} {row.effect.name}: {said}"
