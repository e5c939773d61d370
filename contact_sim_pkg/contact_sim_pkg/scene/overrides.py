"""Values that command-line options put into a scene before it is validated; their faults name the
option.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from contact_sim_pkg.files import BAG_ENDINGS
from contact_sim_pkg.scene.errors import Fault, SceneError
from contact_sim_pkg.scene.renamed_keys import sentence_of
from contact_sim_pkg.scene.yaml.document import parse_value
from contact_sim_pkg.scene.yaml.nodes import ListNode, MappingNode, Mark, Node, ScalarNode

TIED_TO_FILE = {"road": ("start", "sha256", "header_line"), "vibration": ("start", "sha256", "rate", "time_column")}
"""Keys that say something about one file and go when another file takes its place."""
FILE = "file"
"""Key of an input file, in whatever section."""
READ_FROM_FILE: dict[str, dict[str, tuple[str, ...]]] = {
    "curve": {"file": ("points", "sha256"), **dict.fromkeys(("area", "thickness", "header_line"), ("points",))},
    "magic_formula": {"file": ("coefficients", "version", "unused", "sha256")},
}
"""Sections of a measured foam and of a tire property file, and what of them was read from the file: another one is read
anew.
"""
REMOVED = "null"
"""Value of `--set` that takes a key out of the scene, an effect for instance."""


@dataclass(frozen=True)
class Override:
    """One value of a scene from the command line.

    Attributes:
        option: the option as typed; stands for the file in faults.
        path: keys from the root.
        node: the value; None removes the key.
        file_section: `road` or `vibration` where the value is a file that takes the place of this
            section.
    """

    option: str
    path: tuple[str, ...]
    node: Node | None
    file_section: str = ""


def set_value(assignment: str, option: str = "--set ") -> Override:
    """`--set a.b.c=value`; the value is read as YAML, items of lists are counted from 0. `null`
    removes the key. A key `file` counts from the current folder, or, where nothing is there, from that of the scene.
    `option` stands before the assignment in a sentence on a fault.

    Raises:
        SceneError: no `=`, an empty key, or a value that is not YAML.
    """
    option += assignment
    dotted, equals, text = assignment.partition("=")
    keys = tuple(key.strip() for key in dotted.split("."))
    if not equals or not all(keys):
        raise SceneError([Fault(option, 0, 0, "", "is not of the form a.b.c=value")])
    node = None if text.strip() == REMOVED else parse_value(text, option)
    return Override(option, keys, _from_here(keys[-1], node))


def _from_here(key: str, node: Node | None) -> Node | None:
    """A node with the files of the current folder by their whole path: the value of a key `file`, or of one below."""
    if isinstance(node, MappingNode):
        for below, value in node.entries.items():
            node.entries[below] = _from_here(below, value) or value
    elif key == FILE and isinstance(node, ScalarNode) and Path(node.raw).is_file():
        absolute = str(Path(node.raw).absolute())
        return ScalarNode(node.mark, absolute, absolute, quoted=True)
    return node


def set_duration(text: str | float) -> Override:
    """`--duration S`: simulated time [s]."""
    return _option("--duration", ("duration",), text)


def set_pace(text: str | float) -> Override:
    """`--pace realtime|max|FACTOR`: simulated over wall time [1]."""
    return _option("--pace", ("pace",), text)


def set_road(file: str | Path) -> Override:
    """`--road FILE`: a file in place of the scene's road, an OpenCRG grid or a profile by its name and content;
    the name counts from the current folder.
    """
    return _file("--road", "road", file)


def set_vibration(file: str | Path) -> Override:
    """`--vibration FILE`: a recorded vibration in place of the scene's; give its rate with
    `set_rate` after it.
    """
    return _file("--vibration", "vibration", file)


def set_rate(text: str | float) -> Override:
    """`--rate R`: sampling rate of the vibration file [Hz]."""
    return _option("--rate", ("vibration", "rate"), text)


def apply(root: MappingNode, overrides: Iterable[Override]) -> list[Fault]:
    """Put the values into the document, in order; later ones win. Returns the faults of paths that
    lead nowhere.
    """
    faults = []
    for override in overrides:
        mark = Mark(override.option, 0, 0)
        if old := sentence_of(override.path):
            sentence = old
        elif override.node is None:
            sentence = _remove(root, override.path)
        elif override.file_section:
            sentence = _replace_file(root, override.file_section, override.node, mark)
        else:
            sentence = _put(root, override.path, override.node, mark)
        if sentence:
            faults.append(mark.fault(".".join(override.path), sentence))
        elif len(override.path) > 1:
            read = READ_FROM_FILE.get(override.path[-2], {})
            _drop(root, override.path[:-1], read.get(override.path[-1], ()))
    return faults


def _option(name: str, path: tuple[str, ...], text: str | float) -> Override:
    option = f"{name} {text}"
    return Override(option, path, parse_value(str(text), option))


def _file(name: str, section: str, file: str | Path) -> Override:
    option = f"{name} {file}"
    parts = [each for each in sorted(Path(file).glob("*")) if each.suffix in BAG_ENDINGS]
    absolute = str((parts[0] if len(parts) == 1 else Path(file)).absolute())  # of the folder of a bag its only file
    return Override(option, (section,), ScalarNode(Mark(option, 0, 0), absolute, absolute, quoted=True), section)


def _replace_file(root: MappingNode, section: str, file: Node, mark: Mark) -> str:
    """Let the file take the place of the section; there is no fault."""
    kind = "recorded" if section == "vibration" else _road_kind(file)
    entries = {"kind": ScalarNode(mark, kind, kind), "file": file}
    before = root.entries.get(section)
    kept = MappingNode(mark)
    if isinstance(before, MappingNode) and _kind(before) == kind:
        kept = before
        for key in TIED_TO_FILE[section]:
            kept.entries.pop(key, None)
    elif isinstance(before, MappingNode) and "sample_rate" in before.entries:
        kept.entries["sample_rate"] = before.entries["sample_rate"]
    kept.entries.update(entries)
    for key in kept.entries:
        kept.key_marks.setdefault(key, mark)
    root.entries[section] = kept
    root.key_marks[section] = mark
    return ""


def _road_kind(file: Node) -> str:
    from contact_sim_pkg.excitation.profile.formats import is_opencrg

    assert isinstance(file, ScalarNode)
    return "opencrg" if is_opencrg(Path(file.raw)) else "profile"


def _kind(section: MappingNode) -> str:
    kind = section.entries.get("kind")
    return kind.raw if isinstance(kind, ScalarNode) else ""


def _put(root: MappingNode, path: tuple[str, ...], value: Node, mark: Mark) -> str:
    """Put one value in, making sections on the way; the sentence of the fault where the path leads
    nowhere.
    """
    node: Node = root
    for depth, key in enumerate(path[:-1]):
        if isinstance(node, MappingNode) and key not in node.entries:
            node.entries[key] = MappingNode(mark)
            node.key_marks[key] = mark
        below = _below(node, key)
        if below is None:
            return _no_way(node, path[:depth], key)
        node = below
    if isinstance(node, MappingNode):
        node.entries[path[-1]] = value
        node.key_marks.setdefault(path[-1], mark)
        return ""
    if isinstance(node, ListNode) and _below(node, path[-1]) is not None:
        node.items[int(path[-1])] = value
        return ""
    return _no_way(node, path[:-1], path[-1])


def _remove(root: MappingNode, path: tuple[str, ...]) -> str:
    """Take one key out; the sentence of the fault where the scene does not give it."""
    node: Node | None = root
    for key in path[:-1]:
        node = None if node is None else _below(node, key)
    if not isinstance(node, MappingNode) or path[-1] not in node.entries:
        return "null removes a key, and the scene does not give this one"
    del node.entries[path[-1]]
    node.key_marks.pop(path[-1], None)
    return ""


def _drop(root: MappingNode, path: tuple[str, ...], keys: Iterable[str]) -> None:
    """Take keys out of a section that is there, those that it has."""
    node: Node | None = root
    for key in path:
        node = None if node is None else _below(node, key)
    if isinstance(node, MappingNode):
        for key in keys:
            node.entries.pop(key, None)
            node.key_marks.pop(key, None)


def _below(node: Node, key: str) -> Node | None:
    if isinstance(node, MappingNode):
        return node.entries.get(key)
    if isinstance(node, ListNode) and key.isdecimal() and int(key) < len(node.items):
        return node.items[int(key)]
    return None


def _no_way(node: Node, path: tuple[str, ...], key: str) -> str:
    place = ".".join(path)
    if isinstance(node, ScalarNode):
        return f"'{place}' is the value {node.raw!r} and has no keys"
    count = len(node.items) if isinstance(node, ListNode) else 0
    return f"'{key}' is not an item of the list '{place}', which has {count} items, counted from 0"
