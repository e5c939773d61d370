"""The tree of values that a scene file is read into; each node knows its line and column."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field
from typing import Any, TypeAlias

from contact_sim_pkg.scene.errors import Fault

_INTEGER = re.compile(r"[-+]?(0|[1-9][0-9]*)")
_NUMBER = re.compile(r"[-+]?(0|[1-9][0-9]*)?(\.[0-9]*)?([eE][-+]?[0-9]+)?")
_WORDS: dict[str, bool | None] = {
    **dict.fromkeys(("true", "True", "TRUE"), True),
    **dict.fromkeys(("false", "False", "FALSE"), False),
    **dict.fromkeys(("null", "Null", "NULL", "~", ""), None),
}


@dataclass(frozen=True, slots=True)
class Mark:
    """Where something stands: file (or option), line and column from 1 (0 for an option)."""

    source: str
    line: int
    column: int

    def fault(self, where: str, sentence: str) -> Fault:
        """A fault at this place."""
        return Fault(self.source, self.line, self.column, where, sentence)


@dataclass(slots=True)
class ScalarNode:
    """One value; `raw` is its text as written, `value` what it was read as."""

    mark: Mark
    raw: str
    value: str | int | float | bool | None
    quoted: bool = False


@dataclass(slots=True)
class ListNode:
    """A list."""

    mark: Mark
    items: list[Node] = field(default_factory=list)


@dataclass(slots=True)
class MappingNode:
    """A mapping; `key_marks` are the places of its keys."""

    mark: Mark
    entries: dict[str, Node] = field(default_factory=dict)
    key_marks: dict[str, Mark] = field(default_factory=dict)


Node: TypeAlias = ScalarNode | ListNode | MappingNode


def to_plain(node: Node) -> Any:
    """The values of a node tree as dict, list and scalars."""
    if isinstance(node, MappingNode):
        return {key: to_plain(value) for key, value in node.entries.items()}
    if isinstance(node, ListNode):
        return [to_plain(item) for item in node.items]
    return node.value


def read_scalar(raw: str) -> str | int | float | bool | None:
    """Value of an unquoted scalar; text unless it is null, boolean or a finite JSON number
    (dimensionless)."""
    if raw in _WORDS:
        return _WORDS[raw]
    if _INTEGER.fullmatch(raw) and len(raw) <= 18:
        return int(raw)
    if any(letter.isdigit() for letter in raw) and _NUMBER.fullmatch(raw):
        try:
            number = float(raw)
        except ValueError:
            return raw
        return number if math.isfinite(number) else raw
    return raw
