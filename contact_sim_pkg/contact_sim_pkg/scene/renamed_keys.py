"""Scene keys that were renamed: a scene with an old key is refused, a scene that stands in an old
bag is read.

A key is a dotted path from the root of the document, such as `effects.tire.brush`. The path of a
section stands for all keys below it. Knows no schema, so that a bag is read without it.
"""

from __future__ import annotations

from typing import Any

from contact_sim_pkg.scene.errors import Fault
from contact_sim_pkg.scene.yaml.nodes import MappingNode, Mark

RENAMED: dict[str, str] = {
    "effects.tire.carcass": "effects.tire.rigid_ring",
    **{
        f"effects.seat.contact_field.{key}": f"effects.seat.half_space_field.{key}"
        for key in ("length", "width", "rows", "cols", "tolerance", "corrector_passes")
    },
}
"""Old key -> new key. `docs/interfaces.md` lists them; an entry stays as long as bags with the old
key are read.
"""


def new_key(path: tuple[str, ...]) -> str:
    """The key that has taken the place of this one or of a section above it; empty where it was not
    renamed.
    """
    for length in range(len(path), 0, -1):
        if (found := RENAMED.get(".".join(path[:length]))) is not None:
            return ".".join([found, *path[length:]])
    return ""


def sentence_of(new: str) -> str:
    """The sentence that a scene with an old key is refused with."""
    return f"was renamed; write {new} in its place"


def use_new_names(root: MappingNode) -> list[Fault]:
    """Move every old key of a document to its new place. Returns one fault for each, at the place
    of the old key.

    Where the new key is given too, its value stays and the old one is dropped.
    """
    faults = []
    for old, new in RENAMED.items():
        parent = _section(root, old)
        name = old.rpartition(".")[2]
        if parent is None or name not in parent.entries:
            continue
        node, mark = parent.entries.pop(name), parent.key_marks.pop(name)
        faults.append(mark.fault(old, sentence_of(new)))
        target = _section(root, new, mark)
        if target is not None and (last := new.rpartition(".")[2]) not in target.entries:
            target.entries[last], target.key_marks[last] = node, mark
    return faults


def with_new_names(scene: dict[str, Any]) -> dict[str, Any]:
    """The plain data of a recorded scene with every old key moved to its new place, in the data
    itself.
    """
    for old, new in RENAMED.items():
        *parents, name = old.split(".")
        section: Any = scene
        for key in parents:
            section = section.get(key) if isinstance(section, dict) else None
        if not isinstance(section, dict) or name not in section:
            continue
        value, target = section.pop(name), scene
        *parents, last = new.split(".")
        for key in parents:
            below = target.setdefault(key, {})
            target = below if isinstance(below, dict) else {}
        target.setdefault(last, value)
    return scene


def _section(root: MappingNode, key: str, mark: Mark | None = None) -> MappingNode | None:
    """The mapping that holds the last part of a key; made on the way where a mark is given."""
    node = root
    for part in key.split(".")[:-1]:
        if mark is not None and part not in node.entries:
            node.entries[part], node.key_marks[part] = MappingNode(mark), mark
        below = node.entries.get(part)
        if not isinstance(below, MappingNode):
            return None
        node = below
    return node
