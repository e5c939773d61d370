"""`bench effects SCENE`: each effect of a scene left out or added, what that changes and saves, and
whether the scene calls for it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from contact_sim_pkg.compare.columns import judged_topics
from contact_sim_pkg.compare.span import Notify
from contact_sim_pkg.records.contact import Contact
from contact_sim_pkg.records.effect import Effect
from contact_sim_pkg.run.errors import RunError
from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.resolve import load_resolved
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.studies.effects import verdicts
from contact_sim_pkg.studies.effects.alternatives import Alternative, effects_of, is_on, with_effect, without_effects
from contact_sim_pkg.studies.effects.event_runs import Base, base_of
from contact_sim_pkg.studies.effects.of_metrics import MetricBase, metric_base
from contact_sim_pkg.studies.effects.verdicts import Change

__all__ = ["EffectRow", "Study", "observes", "study", "study_of"]


class EffectRow(NamedTuple):
    """One effect of one contact."""

    contact: Contact
    effect: Effect
    on: bool
    verdict: str
    changes: tuple[Change, ...]  # largest first; empty where nothing was measured, or is judged
    other: float | None  # [ms] of CPU per simulated second of the scene without it, or with it
    why: str  # what calls for it, what is different beside it, or why nothing was measured
    added: tuple[str, ...] = ()  # effects that come with one that is off: its changes are theirs too

    @property
    def name(self) -> str:
        """Name of the effect and of those that come with it."""
        return f"{self.effect.name} with {' and '.join(self.added)}" if self.added else self.effect.name

    @property
    def largest(self) -> Change | None:
        """Largest change; None where there is none."""
        most = verdicts.largest(self.changes)
        return most if most is not None and most.size > 0.0 else None


class Study(NamedTuple):
    """All effects of a scene."""

    base: Base | MetricBase
    rows: tuple[EffectRow, ...]

    def with_verdict(self, verdict: str, *, on: bool = True) -> list[EffectRow]:
        """Rows of one verdict, dearest first."""
        found = [row for row in self.rows if row.on is on and row.verdict == verdict]
        return sorted(found, key=lambda row: self.cost_of(row) or 0.0, reverse=True)

    def cost_of(self, row: EffectRow) -> float | None:
        """CPU time [ms] per simulated second that an effect takes, or would take."""
        if row.other is None:
            return None
        return self.cost - row.other if row.on else row.other - self.cost

    @property
    def cost(self) -> float:
        """CPU time [ms] per simulated second of the scene."""
        return self.base.cost


def study(scene_name: str, notify: Notify, values: Sequence[str] = ()) -> Study:
    """Study of a scene by name or path, with ``values`` as of `--set`.

    Raises SceneError where the scene is wrong, RunError where it ends.
    """
    return study_of(load_resolved(scene_name, *values), notify)


def study_of(
    scene: ResolvedScene, notify: Notify, only: str = "", *, off: bool = True, metrics: Sequence[str] = ()
) -> Study:
    """Study of a resolved scene, or of ``only`` one effect of it, ``CONTACT.EFFECT``; of those that
    are ``off`` where these are of interest. With ``metrics``, by key or name, of these over the whole run, else of all
    that accuracy judges over the events of the scene.

    Raises RunError where its run ends, BagError where it has no such metric.
    """
    notify(f"{scene.name}: kernels of each combination of effects are compiled once, some seconds for each")
    if metrics:
        notify(f"{scene.name}: the whole run as it stands")
    else:
        notify(f"{scene.name}: the scene as it stands, and one level finer")
    base = metric_base(scene, metrics, notify) if metrics else base_of(scene, notify)
    notify(f"  {base.compared}")
    rows = []
    for contact, effect in effects_of(scene):
        on = is_on(scene, contact, effect)
        if only not in ("", f"{contact.name}.{effect.name}") or not (on or off):
            continue
        notify(f"{contact.name}: {'without' if on else 'with'} {effect.name}")
        rows.append(_row_on(base, contact, effect, notify) if on else _row_off(base, contact, effect, notify))
    return Study(base, tuple(rows))


def observes(contact: Contact, effect: Effect) -> bool:
    """Whether an effect only adds to what is seen: its own topic, and what accuracy does not judge."""
    others = [f"{contact.name}/{name}" for name in effect.feeds if name != effect.publishes]
    return not effect.carries and not judged_topics(others)


def _row_on(base: Base | MetricBase, contact: Contact, effect: Effect, notify: Notify) -> EffectRow:
    if effect.carries:
        return EffectRow(contact, effect, True, verdicts.CARRIES, (), None, "without it the contact carries no load")
    other = without_effects(base.scene, effect)
    beside = f"with it {' and '.join(other.beside)}" if other.beside else ""
    try:
        changes, cost = base.measured(other.scene, notify, effect.not_below)
    except (SceneError, RunError) as error:
        return EffectRow(contact, effect, True, verdicts.NEEDED, (), None, f"without it {_reason(error)}")
    if isinstance(base, Base) and observes(contact, effect) and not any(each.size > 0.0 for each in changes):
        verdict = verdicts.OBSERVES
    else:
        verdict = verdicts.verdict_on(changes, base.request)
    return EffectRow(contact, effect, True, verdict, changes, cost, effect.called_for(base.scene) or beside)


def _row_off(base: Base | MetricBase, contact: Contact, effect: Effect, notify: Notify) -> EffectRow:
    try:
        other = with_effect(base.scene, contact, effect)
        changes, cost = base.measured(other.scene, notify, effect.not_below)
    except (SceneError, RunError) as error:
        return EffectRow(contact, effect, False, verdicts.UNAVAILABLE, (), None, f"with it {_reason(error)}")
    called_for = "" if other.replaced or other.removed else effect.called_for(base.scene)
    verdict = verdicts.verdict_off(changes, base.request, called_for)
    if observes(contact, effect) and (other.beside or not any(each.size > 0.0 for each in changes)):
        verdict = verdicts.WOULD_OBSERVE
    return EffectRow(contact, effect, False, verdict, changes, cost, called_for or _different(other), other.beside)


def _different(other: Alternative) -> str:
    parts = (("in place of", other.replaced), ("with", other.beside), ("without", other.removed))
    return ", ".join(f"{word} {' and '.join(names)}" for word, names in parts if names)


def _reason(error: SceneError | RunError) -> str:
    if isinstance(error, RunError):
        return f"the run ends: {error}"
    fault = error.faults[0]
    return f"the scene is refused: {fault.where}: {fault.sentence}"
