"""Packages of others that bring rigs, effects, and commands: found through their entry points.

An entry point of the group `contact_sim_pkg.rigs` names a module, or a package, whose `RIGS` holds
`records.rig.Rig`; its folder `scenes` holds their scenes. One of `contact_sim_pkg.effects` names
``module:mapping`` of contact -> `records.effect.Effect`s that act there. One of
`contact_sim_pkg.commands` is a command of `bench` by its name. One of `contact_sim_pkg.studies` is
for the laboratory. `docs/extend.md` shows each.

`CONTACT_BENCH_PLUGINS` chooses: unset, all that are installed; `off`, none; else the names of
packages, separated by commas, as the nodes of a run get it from its supervisor.
"""

from __future__ import annotations

import logging
import os
from collections.abc import Iterable, Mapping
from functools import cache
from importlib.metadata import Distribution, EntryPoint, distributions
from typing import Any, NamedTuple, TypeVar

from contact_sim_pkg.files import RefusedError
from contact_sim_pkg.records.effect import Effect
from contact_sim_pkg.records.rig import Rig, load

__all__ = ["CURE", "OFF", "VARIABLE", "Plugin", "PluginError", "plugins"]

VARIABLE, OFF = "CONTACT_BENCH_PLUGINS", "off"
GROUP = "contact_sim_pkg."
CURE = f"rename one, or set {VARIABLE} to the plug-ins that are wanted, or to {OFF}"

_log = logging.getLogger(__name__)
Record = TypeVar("Record")


class PluginError(RefusedError, ValueError):
    """Packages that cannot stand beside each other: a sentence."""


class Plugin(NamedTuple):
    """A package that brings something."""

    name: str  # of the distribution
    version: str
    rigs: dict[str, tuple[Rig, ...]]  # by the module that exports them
    effects: dict[str, tuple[Effect, ...]]  # by contact
    commands: dict[str, str]  # by name: module:object
    studies: list[str]  # module:object

    def __str__(self) -> str:
        """Name and version, as a resolved scene states them."""
        return f"{self.name} {self.version}"


@cache
def plugins() -> tuple[Plugin, ...]:
    """The installed ones that `CONTACT_BENCH_PLUGINS` lets in, by name. One that fails to load is
    reported in a line and left out.
    """
    wanted = os.environ.get(VARIABLE)
    if wanted == OFF:
        return ()
    names = None if not wanted else {name.strip() for name in wanted.split(",")}
    found: dict[str, Plugin] = {}
    for distribution in distributions():
        entries = [each for each in distribution.entry_points if each.group.startswith(GROUP)]
        name = str(distribution.metadata["Name"]) if entries else ""
        if entries and name not in found and (names is None or name in names):
            made = _loaded(distribution, name, entries)
            if made is not None:
                found[name] = made
    for name in sorted((names or set()) - set(found)):
        _log.warning("%s names %s: no package of that name, as pip lists it, brings anything", VARIABLE, name)
    return tuple(found[name] for name in sorted(found))


def _loaded(distribution: Distribution, name: str, entries: Iterable[EntryPoint]) -> Plugin | None:
    plugin = Plugin(name, distribution.version, {}, {}, {}, [])
    for entry in entries:
        try:
            _add(plugin, entry)
        except (Exception, SystemExit) as error:  # noqa: BLE001 - whatever a stranger's module raises
            _log.warning(
                "plug-in %s is left out: %s does not load (%s: %s)", plugin, entry.value, type(error).__name__, error
            )
            return None
    return plugin


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
    elif kind == "commands":
        plugin.commands[entry.name] = f"{module}:{attribute or 'command'}"
    elif kind == "studies":
        plugin.studies.append(f"{module}:{attribute or 'STUDIES'}")


def _all_of(kind: type[Record], records: Iterable[Any]) -> tuple[Record, ...]:
    found = tuple(records)
    for each in found:
        if not isinstance(each, kind):
            raise TypeError(f"{each!r:.60} is no {kind.__name__}")
    return found
