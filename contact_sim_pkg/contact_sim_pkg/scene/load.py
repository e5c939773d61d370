"""Scene file, or name of a shipped scene, to a validated scene."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

from contact_sim_pkg.records.registry import rigs, shipped_scenes
from contact_sim_pkg.scene.errors import Fault, SceneError
from contact_sim_pkg.scene.limits import file_breaches, limit_breaches
from contact_sim_pkg.scene.overrides import Override, apply
from contact_sim_pkg.scene.schema.scene import Scene
from contact_sim_pkg.scene.schema.validate import RULES, validate
from contact_sim_pkg.scene.yaml.document import read_document
from contact_sim_pkg.scene.yaml.nodes import MappingNode, Mark, ScalarNode


class SceneEntry(NamedTuple):
    """One shipped scene."""

    name: str
    rig: str
    description: str
    path: Path


def load_scene(name_or_path: str | Path, overrides: Iterable[Override] = ()) -> Scene:
    """Read and validate a scene; nothing is created and nothing large is allocated.

    Args:
        name_or_path: name of a shipped scene, or path of a YAML file.
        overrides: values from the command line, put in before validation.

    Raises:
        SceneError: with every fault of the file and of the overrides.
    """
    path = find_scene(name_or_path)
    document = read_document(path)
    faults = document.faults + apply(document.root, overrides)
    _name_after_file(document.root, path)
    return validate(document.root, str(path), faults, (*RULES, limit_breaches, file_breaches))


def find_scene(name_or_path: str | Path) -> Path:
    """The file of a scene.

    Raises:
        SceneError: neither a file nor a shipped scene; names the nearest one.
    """
    given, names = Path(name_or_path), shipped_names()
    if str(name_or_path) in names:  # whatever the current folder holds
        return shipped_scenes()[str(name_or_path)]
    if given.suffix in (".yaml", ".yml") or given.exists() or len(given.parts) > 1:
        return given
    near = difflib.get_close_matches(str(name_or_path).lower(), names, n=1, cutoff=0.5)
    hint = f"; did you mean {near[0]}?" if near else ""
    sentence = f"there is no such scene (shipped are {', '.join(names)}; a file ends in .yaml){hint}"
    raise SceneError([Fault(str(name_or_path), 0, 0, "", sentence)])


def shipped_names() -> list[str]:
    """Names of the shipped scenes, smallest first."""
    return list(shipped_scenes())


def nearest_name(wanted: str) -> str | None:
    """The shipped scene nearest to a ``wanted`` name, among those that share a word with it; None where none does. Where that
    is the name of a rig and nothing else, the first scene of the rig.
    """
    words = set(wanted.lower().split("_"))
    sharing = [each for each in shipped_names() if words & set(each.split("_"))]
    named = words & rigs().keys()
    if named and not any((words - named) & set(each.split("_")) for each in sharing):
        return next(iter(rigs()[min(named)].scenes))
    return next(iter(difflib.get_close_matches(wanted.lower(), sharing, n=1, cutoff=0.0)), None)


def list_scenes() -> list[SceneEntry]:
    """The shipped scenes, smallest first.

    Raises:
        SceneError: a shipped scene is faulty.
    """
    entries = []
    for name, path in shipped_scenes().items():
        scene = load_scene(name)
        entries.append(SceneEntry(scene.name, scene.rig, scene.description, path))
    return entries


def _name_after_file(root: MappingNode, path: Path) -> None:
    """A scene without a name is called like its file."""
    if "name" not in root.entries:
        mark = Mark(str(path), 1, 1)
        root.entries["name"] = ScalarNode(mark, path.stem, path.stem, quoted=True)
        root.key_marks["name"] = mark
