"""A document against the schema and its rules: every fault, each at its place."""

from __future__ import annotations

import copy
import logging
from collections.abc import Callable, Iterable, Iterator
from functools import cache
from typing import Any

from pydantic import ValidationError

from contact_sim_pkg.files import printable
from contact_sim_pkg.records.fields import TOO_NEAR_ZERO
from contact_sim_pkg.records.plugins import plugins
from contact_sim_pkg.requirements import canonical
from contact_sim_pkg.scene.errors import Breach, Fault, SceneError
from contact_sim_pkg.scene.renamed_keys import use_new_names
from contact_sim_pkg.scene.schema.catalog import Entry, catalog, entry_of, key_of_word, place_of, without_kinds
from contact_sim_pkg.scene.schema.effect_rules import effect_breaches, unavailable_effect
from contact_sim_pkg.scene.schema.rules import breaches
from contact_sim_pkg.scene.schema.scene import Scene
from contact_sim_pkg.scene.schema.sentences import bad_value, missing, suggestion, too_near_zero, unknown_key
from contact_sim_pkg.scene.yaml.nodes import ListNode, MappingNode, Mark, Node, ScalarNode, to_plain

_log = logging.getLogger(__name__)
Path = tuple[str | int, ...]
Rule = Callable[[Scene], Iterable[Breach]]

RULES: tuple[Rule, ...] = (breaches, effect_breaches)
"""Rules that hold for every scene, wherever it is read."""
MOST_ROUNDS = 5
"""Mending a key can bring further faults to light; the schema's depth bounds how often."""


def validate(root: MappingNode, file: str, known: Iterable[Fault] = (), rules: Iterable[Rule] = RULES) -> Scene:
    """The scene that a document describes.

    Args:
        root: the document.
        file: path of the file, from whose folder relative file names start.
        known: faults found earlier; they are raised with the others.
        rules: what must hold between keys.

    Raises:
        SceneError: with all faults. A key with a fault of its own takes no part in the rules. A key
            that was renamed or removed is one of them; a renamed one's value is checked under the new name.
    """
    missing_plugins = list(_missing_plugins(root))
    if missing_plugins:  # without them its rig or its effects would be refused as unknown
        raise SceneError([*known, *missing_plugins])
    validator = _Validator(root, [*known, *use_new_names(root)])
    scene = validator.types()
    # Rules between keys need all types to be right
    if scene is not None:
        scene._file = file
        for rule in rules:
            validator.add_breaches(rule(scene))
    if validator.faults or scene is None:
        raise SceneError(validator.faults)
    return scene


def _missing_plugins(root: MappingNode) -> Iterator[Fault]:
    """Plug-ins that a resolved scene names and that are not there; of another version they may give
    other numbers, and the scene is resolved with that.
    """
    node = root.entries.get("plugins")
    if not isinstance(node, ScalarNode):
        return
    there = {canonical(plugin.name): plugin for plugin in plugins()}
    for each in str(node.value).split(","):
        name, _, version = each.strip().partition(" ")
        plugin = there.get(canonical(name))
        if plugin is not None and version.strip() not in ("", plugin.version):
            _caution(each.strip(), str(plugin))
        if name and plugin is None:
            sentence = f"the scene uses the plug-in {each.strip()}, which is not installed; install it beside the bench"
            yield Fault(node.mark.source, node.mark.line, node.mark.column, "plugins", sentence)


@cache
def _caution(stated: str, there: str) -> None:
    """A line on standard error, once a process."""
    _log.warning(
        "the scene was resolved with the plug-in %s; it runs with %s, which may give other numbers",
        printable(stated), there,
    )  # fmt: skip


class _Validator:
    def __init__(self, root: MappingNode, faults: list[Fault]) -> None:
        self.faults = faults
        self._root = root
        self._faulty: list[str] = [fault.where for fault in faults if fault.where]
        self._taken = {(fault.file, fault.line, fault.column, fault.where) for fault in faults}

    def types(self) -> Scene | None:
        """The scene, faulty keys replaced by their defaults or examples so that rules can still
        look at the rest.
        """
        plain = to_plain(self._root)
        for _ in range(MOST_ROUNDS):
            try:
                return Scene.model_validate(plain)
            except ValidationError as error:
                for problem in error.errors(include_url=False, include_context=False):
                    self._problem(problem["type"], problem["loc"], plain)
        return None

    def add_breaches(self, found: Iterable[Breach]) -> None:
        """Add the breaches whose keys are free of faults."""
        for breach in found:
            used = any(
                _within(where, faulty) or _within(faulty, where) for where in breach.uses for faulty in self._faulty
            )
            if not used and not any(_within(breach.where, faulty) for faulty in self._faulty):
                self._add(tuple(breach.where.split(".")), breach.sentence)

    def _problem(self, kind: str, location: Path, plain: Any) -> None:
        path = without_kinds(location)
        if kind == "extra_forbidden":
            self._add(path, self._unknown(location, path), at_key=True)
            _replace_faulty(plain, path, None)
            return
        entry = entry_of(location)
        if entry is None:
            raise AssertionError(f"the schema has no key {location}")
        path = _path_of(entry, path)
        if kind == "missing":
            self._add(path, missing(entry))
        elif entry.kind == "kinds":
            self._bad_kind(entry, path)
        elif kind == TOO_NEAR_ZERO:
            self._add(path, too_near_zero(entry, self._node(path)))
        else:
            node = self._node(path)
            self._add(path, bad_value(entry, node) + key_of_word(entry, node) if node is not None else "is not allowed")
        # The rest of the scene is checked with a value that the schema allows
        key = path[: len(without_kinds(entry.location))]
        self._faulty.append(".".join(map(str, key)))
        _replace_faulty(plain, key, entry)

    def _unknown(self, location: Path, path: Path) -> str:
        key = str(path[-1])
        unavailable = unavailable_effect(path)
        if unavailable:
            return unavailable
        parent = location[:-1]
        known = [where[-1] for where in catalog() if where[:-1] == parent]
        return unknown_key(key, known, place_of(key, tuple(map(str, parent))))

    def _bad_kind(self, entry: Entry, path: Path) -> None:
        node = self._node(path)
        if not isinstance(node, MappingNode):
            self._add(path, bad_value(entry, node) if node is not None else "is not allowed")
            return
        kind = node.entries.get("kind")
        allowed = f"allowed: {', '.join(entry.words)}"
        if kind is None:
            self._add((*path, "kind"), f"is missing; {allowed}")
        else:
            shown = repr(kind.raw) if isinstance(kind, ScalarNode) else "a list or mapping"
            hint = suggestion(kind.raw, entry.words) if isinstance(kind, ScalarNode) else ""
            self._add((*path, "kind"), f"{shown} is not a kind of {path[-1]}; {allowed}{hint}")

    def _node(self, path: Path) -> Node | None:
        node: Node | None = self._root
        for part in path:
            if isinstance(node, MappingNode):
                node = node.entries.get(str(part))
            elif isinstance(node, ListNode) and isinstance(part, int) and part < len(node.items):
                node = node.items[part]
            else:
                return None
        return node

    def _mark(self, path: Path, at_key: bool) -> Mark:
        """The place of the key or value at the path, or of the nearest section above it."""
        for length in range(len(path), 0, -1):
            parent, node = self._node(path[: length - 1]), self._node(path[:length])
            if isinstance(parent, MappingNode) and node is not None:
                missing_below = length < len(path)
                return parent.key_marks[str(path[length - 1])] if at_key or missing_below else node.mark
            if node is not None:
                return node.mark
        return self._root.mark

    def _add(self, path: Path, sentence: str, *, at_key: bool = False) -> None:
        where = ".".join(map(str, path))
        mark = self._mark(path, at_key)
        if (mark.source, mark.line, mark.column, where) not in self._taken:
            self._taken.add((mark.source, mark.line, mark.column, where))
            self.faults.append(mark.fault(where, sentence))
        self._faulty.append(where)


def _within(where: str, section: str) -> bool:
    return (where + ".").startswith(section + ".")


def _path_of(entry: Entry, path: Path) -> Path:
    """The path cut after the key of the entry; items of lists stay, names of union members go."""
    depth = len(without_kinds(entry.location))
    items = tuple(part for part in path[depth:] if isinstance(part, int))
    return (*path[:depth], *items)


def _replace_faulty(plain: Any, path: Path, entry: Entry | None) -> None:
    """Remove a faulty value; the example of its key replaces it where the key is required."""
    parent = plain
    for part in path[:-1]:
        parent = parent[part]
    if entry is not None and entry.required:
        parent[path[-1]] = copy.deepcopy(entry.example)
    elif isinstance(parent, dict):
        parent.pop(path[-1], None)
