"""YAML 1.2 text to a tree of nodes that know their line and column.

The tree is built from the parser's event stream, so that everything that could run code or grow
without bound (tags, aliases, nesting, sheer size) is refused before any value exists. Only the
JSON forms of numbers and booleans count as such: `5e6` is a number; `010`, `60:30`, `1_000`, `on`,
`yes`, `.nan` and `.inf` are text, which the schema then refuses where it needs a number.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ruamel.yaml import YAML
from ruamel.yaml.error import MarkedYAMLError, YAMLError
from ruamel.yaml.reader import ReaderError

from contact_sim_pkg.files import read_regular_file
from contact_sim_pkg.scene.errors import Fault, SceneError
from contact_sim_pkg.scene.yaml.composer import DEEPEST_NESTING, MOST_VALUES, Composer
from contact_sim_pkg.scene.yaml.nodes import ListNode, MappingNode, Mark, Node, to_plain

LARGEST_FILE = 1 << 20
"""Largest scene file [bytes]."""
LONGEST_LINE = 10_000
"""Longest line of a scene file [characters]."""


@dataclass(slots=True)
class Document:
    """The node tree of a file and the faults found so far that do not hinder reading on."""

    root: MappingNode
    faults: list[Fault]


def read_document(path: Path) -> Document:
    """Read a scene file.

    Raises:
        SceneError: not a readable file, larger than `LARGEST_FILE`, not UTF-8, not YAML 1.2,
            a tag, or one of the limits of this module; nothing has been constructed then.
    """
    start = Mark(str(path), 1, 1)
    try:
        if path.is_dir():
            raise SceneError([start.fault("", "is a directory; a scene is a YAML file")])
        if not path.exists():
            raise SceneError([start.fault("", "there is no such file")])
        # Bounded before it is read: a file may be endless
        content = read_regular_file(path, LARGEST_FILE, "a scene has at most 1 MiB")
    except OSError as error:
        raise SceneError([start.fault("", f"cannot be read: {error.strerror}")]) from error
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        sentence = f"byte {error.start} is not UTF-8; a scene is a UTF-8 text file"
        raise SceneError([start.fault("", sentence)]) from error
    return parse_document(text, str(path))


def parse_document(text: str, source: str) -> Document:
    """Parse the text of a scene; `source` is the file's name in faults.

    Raises:
        SceneError: as `read_document`.
    """
    faults: list[Fault] = []
    start = Mark(source, 1, 1)
    _check_lines(text, start)
    root = _compose(text, start, Composer(start, faults))
    if not isinstance(root, MappingNode):
        found = "a list" if isinstance(root, ListNode) else f"the value {_shorten(root.raw)}"
        sentence = f"a scene is a mapping of keys to values, such as 'rig: seat'; found {found}"
        raise SceneError([root.mark.fault("", sentence)])
    return Document(root, faults)


def parse_value(text: str, option: str) -> Node:
    """Parse the value of a command-line option as YAML; `option` stands for the file in faults.

    Raises:
        SceneError: as `read_document`.
    """
    faults: list[Fault] = []
    start = Mark(option, 0, 0)
    _check_lines(text, start)
    node = _compose(text, start, Composer(start, faults))
    if faults:
        raise SceneError(faults)
    return node


def parse_plain(text: str, source: str, most_values: int = MOST_VALUES) -> Any:
    """Plain data from any YAML text from outside, within the limits of a scene but that of its
    lines; null is a value.

    Raises:
        SceneError: as `read_document`, with `source` as the file's name.
    """
    faults: list[Fault] = []
    composer = Composer(Mark(source, 1, 1), faults, plain=True, most_values=most_values)
    root = _compose(text, Mark(source, 1, 1), composer)
    if faults:
        raise SceneError(faults)
    return to_plain(root)


def parse_json(text: str, source: str) -> Any:
    """Plain data from a JSON text from outside, within the same limits of size and nesting.

    Raises:
        SceneError: not JSON, or beyond a limit.
    """
    start = Mark(source, 1, 1)
    _check_size(text, start)
    try:
        level = [value := json.loads(text)]
    except (ValueError, RecursionError) as error:
        reason = "is nested too deeply" if isinstance(error, RecursionError) else f"is not JSON: {error}"
        raise SceneError([start.fault("", reason)]) from None
    for _ in range(DEEPEST_NESTING + 1):
        inner = [each.values() if isinstance(each, dict) else each for each in level if isinstance(each, (dict, list))]
        level = [each for values in inner for each in values]
    if level:
        raise SceneError([start.fault("", f"is nested deeper than {DEEPEST_NESTING} levels")])
    return value


def _shorten(text: str, length: int = 40) -> str:
    shown = text if len(text) <= length else text[: length - 1] + "…"
    return repr(shown)


def _compose(text: str, start: Mark, composer: Composer) -> Node:
    _check_size(text, start)
    try:
        for event in YAML(typ="safe", pure=True).parse(text):
            composer.handle(event)
    except RecursionError as error:
        raise SceneError([start.fault("", "is nested too deeply")]) from error
    except ReaderError as error:
        # The reader counts characters, people count lines
        line = text.count("\n", 0, error.position) + 1
        column = error.position - text.rfind("\n", 0, error.position)
        place = Mark(start.source, line * bool(start.line), column * bool(start.line))
        code = ord(text[error.position])
        sentence = f"the character U+{code:04X} is not allowed in YAML"
        raise SceneError([place.fault("", sentence)]) from error
    except MarkedYAMLError as error:
        raise SceneError([_syntax_fault(error, start)]) from error
    except YAMLError as error:
        raise SceneError([start.fault("", f"is not YAML: {error}")]) from error
    except AssertionError as error:  # of the parser, at a directive of a version that it does not know
        raise SceneError([start.fault("", f"is not YAML 1.2: {error}")]) from error
    if composer.root is None:
        raise SceneError([start.fault("", composer.empty)])
    return composer.root


def _check_size(text: str, start: Mark) -> None:
    if len(text) > LARGEST_FILE:
        raise SceneError([start.fault("", f"has {len(text)} characters; at most {LARGEST_FILE} are read")])


def _check_lines(text: str, start: Mark) -> None:
    for number, line in enumerate(text.split("\n"), start=1):
        if len(line) > LONGEST_LINE:
            place = Mark(start.source, number if start.line else 0, 1 if start.line else 0)
            sentence = f"the line has {len(line)} characters; at most {LONGEST_LINE} are allowed"
            raise SceneError([place.fault("", sentence)])


def _syntax_fault(error: MarkedYAMLError, start: Mark) -> Fault:
    mark = error.problem_mark or error.context_mark
    line, column = (mark.line + 1, mark.column + 1) if mark and start.line else (start.line, start.column)
    parts = [part for part in (error.context, error.problem) if part]
    return Fault(start.source, line, column, "", "is not YAML: " + ", ".join(parts))
