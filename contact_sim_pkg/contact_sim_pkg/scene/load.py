"""Scene file, or name of a shipped scene, to a validated scene."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

from contact_sim_pkg.scene.errors import Fault, SceneError
from contact_sim_pkg.scene.files import SCENES
from contact_sim_pkg.scene.limits import file_breaches, limit_breaches
from contact_sim_pkg.scene.overrides import Override, apply
from contact_sim_pkg.scene.schema.scene import Scene
from contact_sim_pkg.scene.schema.validate import RULES, validate
from contact_sim_pkg.scene.yaml.document import read_document
from contact_sim_pkg.scene.yaml.nodes import MappingNode, Mark, ScalarNode

ORDER = (
    "seat_ride",
    "block_fall",
    "block_slope",
    "block_zeno",
    "block_painleve",
    "block_identify",
    "box_3d_tumble",
    "roller_flutter",
    "roller_steady",
    "roller_corrugation",
    "roller_hour",
    "roller_programme",
    "seat_slap",
    "seat_slip",
    "seat_shock",
    "seat_general",
    "seat_drop",
    "seat_ride_full",
    "impact_rubber_drop",
    "impact_pendulum",
    "impact_steel",
    "impact_temperature_sweep",
    "tire_bump",
    "tire_cleat",
    "tire_braking",
    "tire_rough_road",
    "tire_belgian_block",
    "tire_texture",
    "car_full_bench",
)
"""Shipped scenes, smallest first; any others follow by name."""


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
    given = Path(name_or_path)
    if given.suffix in (".yaml", ".yml") or given.exists() or len(given.parts) > 1:
        return given
    names = shipped_names()
    if str(name_or_path) in names:
        return SCENES / f"{name_or_path}.yaml"
    near = difflib.get_close_matches(str(name_or_path), names, n=1, cutoff=0.5)
    hint = f"; did you mean {near[0]}?" if near else ""
    sentence = f"there is no such scene (shipped are {', '.join(names)}; a file ends in .yaml){hint}"
    raise SceneError([Fault(str(name_or_path), 0, 0, "", sentence)])


def shipped_names() -> list[str]:
    """Names of the shipped scenes, smallest first."""
    names = sorted(path.stem for path in SCENES.glob("*.yaml"))
    return sorted(names, key=lambda name: ORDER.index(name) if name in ORDER else len(ORDER))


def list_scenes() -> list[SceneEntry]:
    """The shipped scenes, smallest first.

    Raises:
        SceneError: a shipped scene is faulty.
    """
    entries = []
    for name in shipped_names():
        scene = load_scene(name)
        entries.append(SceneEntry(scene.name, scene.rig, scene.description, SCENES / f"{name}.yaml"))
    return entries


def _name_after_file(root: MappingNode, path: Path) -> None:
    """A scene without a name is called like its file."""
    if "name" not in root.entries:
        mark = Mark(str(path), 1, 1)
        root.entries["name"] = ScalarNode(mark, path.stem, path.stem, quoted=True)
        root.key_marks["name"] = mark
