"""The rigs that a scene can name, found through the packages that export them, plug-ins included.

Every part of the bench goes over this registry; none depends on which rig it is.
"""

from __future__ import annotations

import logging
from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import cache
from operator import itemgetter
from pathlib import Path
from pkgutil import iter_modules
from typing import Any

from contact_sim_pkg.records.contact import Contact
from contact_sim_pkg.records.effect import Effect
from contact_sim_pkg.records.plugin_check import KINDS
from contact_sim_pkg.records.plugins import CURE, Plugin, plugins
from contact_sim_pkg.records.report import ContactReport
from contact_sim_pkg.records.rig import PluginError, Rig, load
from contact_sim_pkg.records.topic import COMMON, Topic, recorded_topic

__all__ = [
    "announced", "contact_reports", "contact_topics", "contacts", "effects", "kinds", "plugins_of", "refused_sections",
    "regime_names", "rig_names", "rigs", "shipped_scenes",
]  # fmt: skip

_log = logging.getLogger(__name__)
_PACKAGES = "contact_sim_pkg.rigs:PACKAGES"


@cache
def rigs() -> dict[str, Rig]:
    """Every rig by its name, in the order of the packages: ours, then those of plug-ins.

    Raises:
        PluginError: two packages export a rig, a contact or an effect of the same name.
    """
    found: dict[str, Rig] = {}
    origin: dict[str, str] = {}
    extended: dict[Contact, Contact] = {}  # rigs may share one
    for _package, rig, bringer in _exported():
        if rig.name in found:
            raise PluginError(
                f"two rigs are named {rig.name}: that of {origin[rig.name]} and that of {bringer}; {CURE}"
            )
        for contact in rig.contacts:
            extended.setdefault(contact, _extended(contact))
        found[rig.name] = replace(rig, contacts=tuple(extended[contact] for contact in rig.contacts))
        origin[rig.name] = bringer
    there = {contact.name for rig in found.values() for contact in rig.contacts}
    for plugin in plugins():
        for name in sorted(set(plugin.effects) - there):
            _log.warning("plug-in %s brings effects to %s, which no rig has; they are left out", plugin, name)
    return found


@cache
def _exported() -> tuple[tuple[str, Rig, str], ...]:
    """Package, rig, and who brings it."""
    ours = [(package, rig, package) for package in load(_PACKAGES) for rig in load(f"{package}:RIGS")]
    theirs = [
        (package, rig, f"plug-in {plugin}")
        for plugin in plugins()
        for package, brought in plugin.rigs.items()
        for rig in brought
    ]
    return (*ours, *theirs)


def _extended(contact: Contact) -> Contact:
    """A contact with the effects that plug-ins bring to it, and their topics."""
    origin = dict.fromkeys((effect.name for effect in contact.effects), "the bench's own")
    more: list[Effect] = []
    for plugin in plugins():
        for effect in plugin.effects.get(contact.name, ()):
            if effect.name in origin:
                raise PluginError(
                    f"two effects of {contact.name} are named {effect.name}: {origin[effect.name]} and that of plug-in "
                    f"{plugin}; {CURE}"
                )
            origin[effect.name] = f"that of plug-in {plugin}"
            more.append(effect)
    if not more:
        return contact
    topics = tuple(effect.topic for effect in more if effect.topic is not None)
    return replace(contact, effects=(*contact.effects, *more), topics=(*contact.topics, *topics))


def plugins_of(data: Mapping[str, Any]) -> list[Plugin]:
    """Plug-ins that bring the rig of a scene's plain data, one of its effects, its road or its vibration."""
    return [
        plugin
        for plugin in plugins()
        if any(each.name == data["rig"] for brought in plugin.rigs.values() for each in brought)
        or any(
            effect.name in (data["effects"].get(contact) or ())
            for contact, brought in plugin.effects.items()
            for effect in brought
        )
        or any((data.get(section) or {}).get("kind") in plugin.named[group] for section, group in KINDS.items())
    ]


@cache
def kinds(section: str) -> dict[str, str]:
    """Kinds of the section `road` or `vibration` of a scene by name, each a ``module:class`` below
    `excitation.kinds.Kind`: a module each of our folder, then those of plug-ins.

    Raises:
        PluginError: two have the same name.
    """
    folder = f"contact_sim_pkg.excitation.{KINDS[section]}"
    ours = {each.name: f"{folder}.{each.name}:KIND" for each in iter_modules(load(folder).__path__)}
    return {**ours, **announced(KINDS[section], ours)}


def announced(group: str, ours: Iterable[str] = ()) -> dict[str, str]:
    """What plug-ins announce in an entry-point group by name, each as ``module:object``.

    Raises:
        PluginError: two have the same name, or one has that of ``ours``.
    """
    found: dict[str, str] = {}
    origin = dict.fromkeys(ours, "the bench's own")
    for plugin in plugins():
        for name, place in plugin.named[group].items():
            if name in origin:
                raise PluginError(f"two {group} are named {name}: {origin[name]} and that of plug-in {plugin}; {CURE}")
            found[name], origin[name] = place, f"that of plug-in {plugin}"
    return found


def rig_names() -> tuple[str, ...]:
    """Names of all rigs."""
    return tuple(rigs())


def regime_names() -> tuple[str, ...]:
    """Names of the regimes of all rigs, each once."""
    return tuple(dict.fromkeys(regime.name for rig in rigs().values() for regime in rig.regimes))


@cache
def contacts() -> dict[str, Contact]:
    """Contacts of all rigs by name, in the order of the rigs.

    Raises:
        PluginError: two rigs have different contacts of the same name.
    """
    found: dict[str, Contact] = {}
    origin: dict[str, str] = {}
    bringers = {rig.name: f"the rig {rig.name} of {bringer}" for _package, rig, bringer in _exported()}
    for rig in rigs().values():
        for contact in rig.contacts:
            first = origin.setdefault(contact.name, bringers[rig.name])
            if found.setdefault(contact.name, contact) is not contact:
                raise PluginError(
                    f"two contacts are named {contact.name}: that of {first} and that of {bringers[rig.name]}; {CURE}"
                )
    return found


def contact_topics() -> tuple[Topic, ...]:
    """Topics of all contacts in canonical order: those of `COMMON`, each for all contacts, then the
    others, contact by contact.

    A further rig at the end of the packages leaves the order of the topics before it.
    """
    places = {topic.name: place for place, topic in enumerate(COMMON)}
    found = [
        (places.get(topic.name, len(places)), recorded_topic(f"{contact.name}/{topic.name}", topic.type, topic.rate))
        for contact in contacts().values()
        for topic in contact.topics
    ]
    return tuple(topic for _, topic in sorted(found, key=itemgetter(0)))


@cache
def effects() -> dict[str, dict[str, Effect]]:
    """Effects of all contacts: by the name of the effect, then by that of the contact."""
    found: dict[str, dict[str, Effect]] = {}
    for contact in contacts().values():
        for effect in contact.effects:
            found.setdefault(effect.name, {})[contact.name] = effect
    return found


@cache
def contact_reports() -> dict[str, ContactReport]:
    """Reports of the contacts of all rigs, by contact; where rigs share a contact, that of the
    first rig counts. One of a plug-in that does not load is a line on standard error, and left out.
    """
    found: dict[str, ContactReport] = {}
    for name in dict.fromkeys(name for rig in rigs().values() for name in rig.report):
        try:
            report: ContactReport = load(name)
        except PluginError as error:
            _log.warning("%s; its report is left out", error)
            continue
        found.setdefault(report.contact, report)
    return found


@cache
def shipped_scenes() -> dict[str, Path]:
    """Files of the scenes that lie in the folders `scenes` of the rigs' packages, by name.

    In the order of `Rig.scenes`, the smallest run first; those without a place there follow by
    name.

    Raises:
        PluginError: two scenes have the same name.
    """
    places = {name: place for rig in rigs().values() for name, place in rig.scenes.items()}
    found: dict[str, Path] = {}
    for package in dict.fromkeys(package for package, _rig, _bringer in _exported()):
        for path in sorted(Path(str(load(package).__file__)).parent.glob("scenes/*.yaml")):
            if path.stem in found:
                raise PluginError(f"two scenes are named {path.stem}: {found[path.stem]} and {path}; {CURE}")
            found[path.stem] = path
    return dict(sorted(found.items(), key=lambda item: (places.get(item[0], len(found)), item[0])))


def refused_sections(rig: str) -> tuple[str, ...]:
    """Sections of a scene that have no meaning for a rig."""
    known = [_sections(each) for each in (rigs()[rig], *rigs().values())]
    return tuple(dict.fromkeys(name for sections in known for name in sections if name not in known[0]))


def _sections(rig: Rig) -> tuple[str, ...]:
    return (*rig.needs, *rig.takes, *(contact.name for contact in rig.contacts))
