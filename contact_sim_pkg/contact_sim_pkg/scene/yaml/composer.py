"""Parser events to nodes, within limits: tags, aliases, nesting and number of values."""

from __future__ import annotations

import copy
from typing import Any

from contact_sim_pkg.scene.errors import Fault, SceneError
from contact_sim_pkg.scene.yaml.nodes import ListNode, MappingNode, Mark, Node, ScalarNode, read_scalar

MOST_VALUES = 10_000
"""Most keys, values and containers of a scene file, aliases counted with all that they stand
for.
"""
DEEPEST_NESTING = 20
"""Deepest nesting of lists and mappings."""
MOST_ALIASES = 32
"""Most aliases (`*name`) of a scene file."""


class Composer:
    """Builds nodes from parser events; counts and limits while doing so."""

    def __init__(self, start: Mark, faults: list[Fault], plain: bool = False, most_values: int = MOST_VALUES) -> None:
        """Args: `plain`: null is a value, and no scene is spoken of; `most_values`: limit in place
        of `MOST_VALUES`.
        """
        self.root: Node | None = None
        self._plain, self._most_values = plain, most_values
        self._subject = "text" if plain else "scene"
        self.empty = "is empty" if plain else "is empty; a scene needs at least 'rig' and 'effects'"
        self._start = start
        self._faults = faults
        self._open: list[tuple[ListNode | MappingNode, str | None, int]] = []
        self._pending: list[tuple[str, Mark] | None] = []
        self._anchors: dict[str, tuple[Node, int, int]] = {}
        self._values = 0
        self._aliases = 0

    def handle(self, event: Any) -> None:
        """Handle the next parser event."""
        mark = self._mark(event)
        name = type(event).__name__
        if getattr(event, "tag", None) is not None:
            self._refuse(mark, f"the tag {event.tag} is not allowed; a {self._subject} holds plain data only")
        if name == "DocumentStartEvent":
            self._begin_document(event, mark)
        elif name == "AliasEvent":
            self._alias(event, mark)
        elif name == "ScalarEvent":
            self._scalar(event, mark)
        elif name in ("SequenceStartEvent", "MappingStartEvent"):
            self._start_container(ListNode(mark) if name[0] == "S" else MappingNode(mark), event.anchor)
        elif name in ("SequenceEndEvent", "MappingEndEvent"):
            self._end_container()

    def _mark(self, event: Any) -> Mark:
        if not self._start.line:
            return self._start
        return Mark(self._start.source, event.start_mark.line + 1, event.start_mark.column + 1)

    def _refuse(self, mark: Mark, sentence: str) -> None:
        raise SceneError([*self._faults, mark.fault(self._where(), sentence)])

    def _where(self, last: str = "") -> str:
        keys = [pending[0] for pending in self._pending if pending]
        return ".".join([*keys, last] if last else keys)

    def _begin_document(self, event: Any, mark: Mark) -> None:
        if self.root is not None:
            self._refuse(mark, f"a second document begins here; a {self._subject} file holds one")
        if event.version not in (None, (1, 2)):
            self._refuse(mark, "the directive asks for another YAML version; scenes are YAML 1.2")

    def _count(self, mark: Mark, more: int = 1) -> None:
        self._values += more
        if self._values > self._most_values:
            self._refuse(mark, f"the {self._subject} has more than {self._most_values} keys and values")

    def _scalar(self, event: Any, mark: Mark) -> None:
        self._count(mark)
        plain = event.style is None or event.style == ""
        value = read_scalar(event.value) if plain else event.value
        if self._expects_key():
            self._key(event.value, mark)
            return
        node = ScalarNode(mark, event.value, value, quoted=not plain)
        if value is None and not self._plain:
            if not event.value and self._pending and self._pending[-1]:
                mark = node.mark = self._pending[-1][1]
            cure = "write {} for an effect without parameters, or remove the key"
            self._faults.append(mark.fault(self._where(), f"has no value; {cure}"))
        self._finish(node, event.anchor, 1, 0)

    def _expects_key(self) -> bool:
        return bool(self._open) and isinstance(self._open[-1][0], MappingNode) and self._pending[-1] is None

    def _key(self, key: str, mark: Mark) -> None:
        mapping = self._open[-1][0]
        assert isinstance(mapping, MappingNode)
        if key in mapping.key_marks:
            first = mapping.key_marks[key]
            sentence = f"the key is given twice, in line {first.line} and in line {mark.line}; keep one"
            self._faults.append(mark.fault(self._where(key), sentence))
        self._pending[-1] = (key, mark)

    def _start_container(self, node: ListNode | MappingNode, anchor: str | None) -> None:
        self._count(node.mark)
        if self._expects_key():
            self._refuse(node.mark, "a key must be a word, not a list or mapping")
        if len(self._open) >= DEEPEST_NESTING:
            self._refuse(node.mark, f"lists and mappings are nested deeper than {DEEPEST_NESTING} levels")
        self._open.append((node, anchor, self._values))
        self._pending.append(None)

    def _end_container(self) -> None:
        node, anchor, before = self._open.pop()
        self._pending.pop()
        self._finish(node, anchor, self._values - before + 1, _depth(node))

    def _alias(self, event: Any, mark: Mark) -> None:
        self._aliases += 1
        if self._aliases > MOST_ALIASES:
            self._refuse(mark, f"the {self._subject} has more than {MOST_ALIASES} aliases; write the values out")
        if event.anchor not in self._anchors:
            self._refuse(mark, f"the alias *{event.anchor} stands inside or before its own anchor")
        if self._expects_key():
            self._refuse(mark, "a key must be a word, not an alias")
        node, size, depth = self._anchors[event.anchor]
        self._count(mark, size)
        if len(self._open) + depth > DEEPEST_NESTING:
            self._refuse(mark, f"lists and mappings are nested deeper than {DEEPEST_NESTING} levels")
        self._finish(node if self._plain else copy.deepcopy(node), None, size, depth)  # only a scene is changed later

    def _finish(self, node: Node, anchor: str | None, size: int, depth: int) -> None:
        if anchor is not None:
            self._anchors[anchor] = (node, size, depth)
        if not self._open:
            self.root = node
            return
        parent = self._open[-1][0]
        if isinstance(parent, ListNode):
            parent.items.append(node)
            return
        pending = self._pending[-1]
        assert pending is not None
        key, mark = pending
        parent.entries.setdefault(key, node)
        parent.key_marks.setdefault(key, mark)
        self._pending[-1] = None


def _depth(node: Node) -> int:
    if isinstance(node, MappingNode):
        return 1 + max((_depth(child) for child in node.entries.values()), default=0)
    if isinstance(node, ListNode):
        return 1 + max((_depth(child) for child in node.items), default=0)
    return 0
