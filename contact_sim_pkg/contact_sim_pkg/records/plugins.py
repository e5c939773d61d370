"""Packages of others that bring rigs, effects, and commands: found through their entry points.

An entry point of the group `contact_sim_pkg.rigs` names a module, or a package, whose `RIGS` holds
`records.rig.Rig`; its folder `scenes` holds their scenes. One of `contact_sim_pkg.effects` names
``module:mapping`` of contact -> `records.effect.Effect`s that act there. One of
`contact_sim_pkg.studies` is for the laboratory. Those of the other groups are known by the name of
the entry point: `contact_sim_pkg.commands` of `bench`, `.roads` and `.vibrations` of a scene,
`.metrics` of a recording, `.exports` of a table. `docs/extend.md` shows each.

`CONTACT_BENCH_PLUGINS` chooses: unset, all that are installed; `off`, none; else the names of
packages, separated by commas, as the nodes of a run get it from its supervisor.
"""

from __future__ import annotations

import logging
import os
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from importlib.metadata import Distribution, EntryPoint, distributions
from typing import Any, NamedTuple, TypeVar

from contact_sim_pkg.files import printable
from contact_sim_pkg.records.effect import Effect
from contact_sim_pkg.records.guests import LONGEST_IMPORT, GuestError, guest
from contact_sim_pkg.records.plugin_check import (
    KINDS,
    fault_of_place,
    faults_of_effects,
    faults_of_kind,
    faults_of_rig,
    places_of_effects,
    places_of_rig,
)  # fmt: skip
from contact_sim_pkg.records.rig import BRINGERS, PluginError, Rig, load
from contact_sim_pkg.requirements import canonical

NAMED = {"commands": "command", "roads": "KIND", "vibrations": "KIND", "metrics": "metrics", "exports": "export"}
"""Groups whose entries are known by their name, and the object of the module that counts where none is named."""

__all__ = ["CURE", "OFF", "VARIABLE", "Plugin", "plugins"]

VARIABLE, OFF = "CONTACT_BENCH_PLUGINS", "off"
GROUP = "contact_sim_pkg."
CURE = f"rename one, or set {VARIABLE} to the plug-ins that are wanted, or to {OFF}"

_log = logging.getLogger(__name__)
Record = TypeVar("Record")


class Plugin(NamedTuple):
    """A package that brings something."""

    name: str  # of the distribution
    version: str
    rigs: dict[str, tuple[Rig, ...]]  # by the module that exports them
    effects: dict[str, tuple[Effect, ...]]  # by contact
    named: dict[str, dict[str, str]]  # module:object by its name, in each group of `NAMED`
    studies: list[str]  # module:object

    def __str__(self) -> str:
        """Name and version, as a resolved scene states them."""
        return f"{self.name} {self.version}"


_loading: list[Plugin] = []  # the one whose modules are being imported, if any


@cache
def plugins() -> tuple[Plugin, ...]:
    """The installed ones that `CONTACT_BENCH_PLUGINS` lets in, by name. One that fails to load, or
    names what is not there or not free, is reported in a line and left out.

    Raises:
        PluginError: a plug-in that is being loaded needs the rigs, which are being found.
    """
    wanted = os.environ.get(VARIABLE)
    if wanted == OFF:
        return ()
    if _loading:
        raise PluginError("its module needs the rigs while they are being found; import that where it is used")
    names = None if not wanted else {canonical(name.strip()): name.strip() for name in wanted.split(",")}
    found: dict[str, Plugin | None] = {}
    for distribution in distributions():
        try:
            entries = [each for each in distribution.entry_points if each.group.startswith(GROUP)]
            name = str(distribution.metadata["Name"]) if entries else ""
        except Exception as error:  # noqa: BLE001 - whatever importlib makes of a description that is none
            place = getattr(distribution, "_path", distribution)  # it has no name that can be read
            _leave_out(f"the package described in {place}", f"its description is damaged ({_of(error)}); reinstall it")
            continue
        key = canonical(name)
        if entries and key not in found and (names is None or key in names):
            found[key] = _loaded(distribution, name, entries)
    for key in sorted(set(names or ()) - set(found)):
        _log.warning(
            "%s names %s: no package of that name, as pip lists it, brings anything", VARIABLE, (names or {})[key]
        )
    return tuple(plugin for _key, plugin in sorted(found.items()) if plugin is not None)


def _loaded(distribution: Distribution, name: str, entries: Iterable[EntryPoint]) -> Plugin | None:
    """A package that announces something, checked; None, with a line on standard error, where it
    does not load.
    """
    plugin = Plugin(name, distribution.version, {}, {}, {group: {} for group in NAMED}, [])
    _loading.append(plugin)
    try:
        with guest(LONGEST_IMPORT) as printed:
            fault = next(_faults(plugin, entries), "")
        if said := printed.getvalue():
            fault = fault or f"it prints where answers of commands are printed, while it is imported: {said!r}"
    except GuestError as error:
        fault = f"it does not load ({error})"
    except Exception as error:  # noqa: BLE001 - whatever a stranger's record does
        fault = f"its record cannot be read ({_of(error)})"
    finally:
        _loading.pop()
    if fault:
        _leave_out(f"plug-in {plugin}", fault)
        return None
    for package in _packages(plugin, entries):
        BRINGERS.setdefault(package, str(plugin))
    return plugin


def _leave_out(what: str, fault: str) -> None:
    _log.warning("%s", printable(f"{what} is left out: {fault}", 1000))


def _of(error: BaseException) -> str:
    return f"{type(error).__name__}: {error}"


def _packages(plugin: Plugin, entries: Iterable[EntryPoint]) -> set[str]:
    """Outermost packages that a plug-in names, ours left out."""
    rigs = (place for brought in plugin.rigs.values() for rig in brought for place in places_of_rig(rig))
    effects = (place for brought in plugin.effects.values() for place in places_of_effects(brought))
    named = (*(entry.value for entry in entries), *rigs, *effects)
    return {place.partition(":")[0].partition(".")[0].strip() for place in named} - {__name__.partition(".")[0]}


def _faults(plugin: Plugin, entries: Iterable[EntryPoint]) -> Iterator[str]:
    """Add what the entry points name to a plug-in; what is wrong with it, a phrase each."""
    for entry in entries:
        try:
            _add(plugin, entry)
        except (Exception, SystemExit) as error:  # noqa: BLE001 - whatever a stranger's module raises
            yield f"{entry.value} does not load ({_of(error)})"
    for package, brought in plugin.rigs.items():
        for rig in brought:
            yield from faults_of_rig(package, rig)
    for contact, effects in plugin.effects.items():
        yield from faults_of_effects(f"contact {contact}", effects)
    for section, group in KINDS.items():
        for name, place in plugin.named[group].items():
            yield from faults_of_kind(section, name, place)
    named = (
        (f"{group.removesuffix('s')} {name}", place) for group in NAMED for name, place in plugin.named[group].items()
    )
    for where, place in (*named, *(("studies", place) for place in plugin.studies)):
        if fault := fault_of_place(place):
            yield f"{where}: {fault}"


def _add(plugin: Plugin, entry: EntryPoint) -> None:
    """Add what an entry point names; what it takes long to load is named there and loaded on use."""
    module, _, attribute = entry.value.partition(":")
    kind = entry.group.removeprefix(GROUP)
    if kind == "rigs":
        plugin.rigs[module] = _all_of(Rig, load(f"{module}:{attribute or 'RIGS'}"))
    elif kind == "effects":
        named: Mapping[str, Iterable[Effect]] = load(f"{module}:{attribute or 'EFFECTS'}")
        for contact, effects in named.items():
            plugin.effects[contact] = (*plugin.effects.get(contact, ()), *_all_of(Effect, effects))
    elif kind in NAMED:
        plugin.named[kind][entry.name] = f"{module}:{attribute or NAMED[kind]}"
    elif kind == "studies":
        plugin.studies.append(f"{module}:{attribute or 'STUDIES'}")


def _all_of(kind: type[Record], records: Iterable[Any]) -> tuple[Record, ...]:
    found = tuple(records)
    for each in found:
        if not isinstance(each, kind):
            raise TypeError(f"{each!r:.60} is no {kind.__name__}")
    return found
