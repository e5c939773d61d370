"""A scene with one effect left out, or one more."""

from __future__ import annotations

import copy
from collections.abc import Iterator
from typing import Any, NamedTuple

from contact_sim_pkg.records.contact import Contact
from contact_sim_pkg.records.effect import Effect
from contact_sim_pkg.records.registry import rigs
from contact_sim_pkg.scene.resolve import read_explicit
from contact_sim_pkg.scene.resolved_scene import ResolvedScene, drop_inputs

__all__ = ["Alternative", "effects_of", "is_on", "with_effect", "without_effects"]


class Alternative(NamedTuple):
    """Another scene, and what is different in it beside the one effect."""

    scene: ResolvedScene
    beside: tuple[str, ...] = ()  # effects that are left out with it, or added for it
    replaced: tuple[str, ...] = ()  # effects that it excludes, which are on
    removed: tuple[str, ...] = ()  # effects that need one that is replaced


def effects_of(scene: ResolvedScene) -> Iterator[tuple[Contact, Effect]]:
    """Every effect of every contact of a scene's rig, on or off."""
    for contact in rigs()[scene.rig].contacts:
        for effect in contact.effects:
            yield contact, effect


def is_on(scene: ResolvedScene, contact: Contact, effect: Effect) -> bool:
    """Whether a scene names an effect."""
    return effect.name in _named(scene.data, contact)


def without_effects(scene: ResolvedScene, *effects: Effect) -> Alternative:
    """The scene less some effects and those that need them."""
    other = scene.without(*effects)
    left_out = {effect.name for effect in effects}
    before = {(contact.name, name) for contact in rigs()[scene.rig].contacts for name in _named(scene.data, contact)}
    after = {(contact.name, name) for contact in rigs()[scene.rig].contacts for name in _named(other.data, contact)}
    return Alternative(other, tuple(sorted({name for _, name in before - after} - left_out)))


def with_effect(scene: ResolvedScene, contact: Contact, effect: Effect) -> Alternative:
    """The scene with one more effect and those that it needs, at their defaults, in place of those
    that it excludes and of those that need these.

    Raises SceneError where the scene does not take it.
    """
    data = copy.deepcopy(scene.data)
    named = data["effects"].setdefault(contact.name, {})
    before = _named(data, contact)
    added = _needed(contact, effect, before)
    replaced = [other.name for other in contact.effects if other.name in before and _excluded(other, added)]
    for name in replaced:
        del named[name]
    if not set(contact.carriers) & {*named, *(each.name for each in added)}:
        added.insert(0, next(each for each in contact.effects if each.carries and not _excluded(each, added)))
    for each in added:
        named[each.name] = {}
    while gone := [other for other in contact.effects if other.name in named and contact.missing(other, named)]:
        for other in gone:
            del named[other.name]
    drop_inputs(data, [other for other in contact.effects if other.name in before and other.name not in named])
    made = ResolvedScene(read_explicit(ResolvedScene(data).to_yaml(), scene.name), scene.files)
    return Alternative(
        made,
        tuple(each.name for each in added if each is not effect),
        tuple(replaced),
        tuple(name for name in before if name not in named and name not in replaced),
    )


def _named(data: dict[str, Any], contact: Contact) -> list[str]:
    return [name for name, keys in (data["effects"].get(contact.name) or {}).items() if keys is not None]


def _needed(contact: Contact, effect: Effect, named: list[str]) -> list[Effect]:
    """The effect behind those that it needs and that are not there."""
    records = {each.name: each for each in contact.effects}
    found = [effect]
    while missing := [name for each in found for name in contact.missing(each, [*named, *(one.name for one in found)])]:
        found.insert(0, records[missing[0]])
    return found


def _excluded(other: Effect, added: list[Effect]) -> bool:
    """Whether an effect cannot act beside those that are added; one of two that carry the load goes."""
    return any(
        other.name in each.excludes or each.name in other.excludes or (other.carries and each.carries) for each in added
    )
