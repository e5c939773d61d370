"""Scene keys that were renamed or removed: a scene with an old key is refused, a scene that stands
in an old bag is read.

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
        f"tire.{key}": f"effects.tire.normal_elastic.{key}"
        for key in ("radius_rolling", "radius_lateral", "young_modulus", "poisson_ratio")
    },
    **{
        f"effects.seat.contact_field.{key}": f"effects.seat.half_space_field.{key}"
        for key in ("length", "width", "rows", "cols", "tolerance", "corrector_passes")
    },
}
"""Old key -> new key. `docs/interfaces.md` lists them; an entry stays as long as bags with the old
key are read.
"""

REMOVED: dict[str, str] = {
    "effects.seat.pressure_mat": "effects.seat.cushion with effects.seat.contact_field",
    "effects.block.rigid_contact.scheme": "nothing (contact events are always located in time)",
    "effects.block.rigid_contact.step": "nothing (contact events are always located in time)",
}
"""Old key -> what serves in its place. A bag is read without it: nothing that moves followed from
it.
"""


def sentence_of(path: tuple[str, ...]) -> str:
    """The sentence that an old key, or one in an old section, is refused with; empty for any
    other.
    """
    for length in range(len(path), 0, -1):
        key = ".".join(path[:length])
        if key in RENAMED:
            return f"was renamed; write {'.'.join([RENAMED[key], *path[length:]])} in its place"
        if key in REMOVED:
            return f"was removed; write {REMOVED[key]} in its place"
    return ""


def use_new_names(root: MappingNode) -> list[Fault]:
    """Move every old key of a document to its new place, and take out what was removed. Returns one
    fault for each, at the place of the old key.

    Where the new key is given too, its value stays and the old one is dropped. A section that is
    left empty goes: its name may have another meaning today.
    """
    faults = []
    for old in REMOVED:
        section, name = _section(root, old), old.rpartition(".")[2]
        if section is not None and name in section.entries:
            del section.entries[name]
            faults.append(section.key_marks.pop(name).fault(old, sentence_of(tuple(old.split(".")))))
    for old, new in RENAMED.items():
        parent = _section(root, old)
        name = old.rpartition(".")[2]
        if parent is None or name not in parent.entries:
            continue
        node, mark = parent.entries.pop(name), parent.key_marks.pop(name)
        faults.append(mark.fault(old, sentence_of(tuple(old.split(".")))))
        target = _section(root, new, mark)
        if target is not None and (last := new.rpartition(".")[2]) not in target.entries:
            target.entries[last], target.key_marks[last] = node, mark
        if not parent.entries:
            above, emptied = _section(root, old.rpartition(".")[0]), old.split(".")[-2]
            assert above is not None
            del above.entries[emptied], above.key_marks[emptied]
    return faults


def with_new_names(scene: dict[str, Any]) -> dict[str, Any]:
    """The plain data of a recorded scene, in the data itself, as `use_new_names` leaves a document."""
    for old in removed_keys(scene):
        *parents, name = old.split(".")
        del _below(scene, parents)[name]
    for old, new in RENAMED.items():
        *parents, name = old.split(".")
        section = _below(scene, parents)
        if name not in section:
            continue
        value, target = section.pop(name), scene
        *sections, last = new.split(".")
        for key in sections:
            below = target.setdefault(key, {})
            target = below if isinstance(below, dict) else {}
        target.setdefault(last, value)
        if not section and parents:
            del _below(scene, parents[:-1])[parents[-1]]
    return scene


def removed_keys(scene: dict[str, Any]) -> list[str]:
    """The keys of a recorded scene that were removed since."""
    return [old for old in REMOVED if old.rpartition(".")[2] in _below(scene, old.split(".")[:-1])]


def _below(scene: dict[str, Any], parents: list[str]) -> dict[str, Any]:
    """The mapping at these keys; an empty one where there is none."""
    section: Any = scene
    for key in parents:
        section = section.get(key) if isinstance(section, dict) else None
    return section if isinstance(section, dict) else {}


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
