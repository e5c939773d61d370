"""Effects that the data of a scene call for and that it does not name: a line before the run."""

from __future__ import annotations

from collections.abc import Iterator

from contact_sim_pkg.records.contact import Contact
from contact_sim_pkg.records.effect import Effect
from contact_sim_pkg.records.registry import rigs
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["absent_effects", "sentence_of_absent"]


def absent_effects(scene: ResolvedScene) -> Iterator[tuple[Contact, Effect, str]]:
    """Effects that are off, could be added to what is on, and are called for, each with the reason."""
    for contact in rigs()[scene.rig].contacts:
        named = [name for name, keys in (scene.data["effects"].get(contact.name) or {}).items() if keys is not None]
        excluded = {name for each in contact.effects if each.name in named for name in each.excludes}
        for effect in contact.effects:
            beside = not excluded & {effect.name} and not set(effect.excludes) & set(named)
            possible = effect.name not in named and beside and not contact.missing(effect, named)
            if possible and (reason := effect.called_for(scene)):
                yield contact, effect, reason


def sentence_of_absent(scene: ResolvedScene) -> str:
    """One sentence about all of them; empty where there are none."""
    by_reason: dict[str, list[str]] = {}
    for _contact, effect, reason in absent_effects(scene):
        by_reason.setdefault(reason, []).append(effect.name)
    if not by_reason:
        return ""
    parts = [f"{reason}, without {' or '.join(names)}" for reason, names in by_reason.items()]
    return f"{'; '.join(parts)} (see `bench effects`)"
