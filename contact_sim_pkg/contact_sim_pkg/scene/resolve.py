"""Accuracy to explicit grids and tolerances: the resolved scene, stored in the bag, gives the same bits again.

A resolved scene is itself a scene: the same keys, every default written out, nothing left to be taken from `accuracy`,
and the checksum of each input file. Reading it back and resolving it once more changes nothing.
"""

from __future__ import annotations

import copy
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from contact_sim_pkg.records.registry import rigs
from contact_sim_pkg.rigs.backrest.schema import complete_backrest
from contact_sim_pkg.rigs.impact.schema import complete_impact
from contact_sim_pkg.scene.errors import Fault, SceneError
from contact_sim_pkg.scene.files import find_file, input_files
from contact_sim_pkg.scene.overrides import Override, apply
from contact_sim_pkg.scene.renamed_keys import take_new_names
from contact_sim_pkg.scene.resolved_scene import ResolvedScene, sha256_of
from contact_sim_pkg.scene.schema.accuracy import Contact, asked, cells_of, integration_tolerance, rung_for
from contact_sim_pkg.scene.schema.clock import whole_duration
from contact_sim_pkg.scene.schema.scene import Scene
from contact_sim_pkg.scene.schema.validate import validate
from contact_sim_pkg.scene.yaml.document import parse_document

__all__ = ["ResolvedScene", "explicit", "read_explicit", "read_resolved", "resolve"]

DEFAULT_DAMPING: dict[str, float] = {"tire": 0.06, "seat": 1.0, "backrest": 1.949743421626532}
"""Hunt-Crossley damping in [s/m] where a scene names neither damping nor restitution, see `scene/schema/effects.py`."""
_COMPLETED: dict[str, Callable[[dict[str, Any]], None]] = {
    "backrest": complete_backrest, "impact": complete_impact, "occupant": complete_backrest,
}  # fmt: skip
"""Rigs with keys whose default follows from others."""
_FIELD_CONTACTS: dict[str, Contact] = {"tire": "tire", "seat": "seat"}

DEFAULT_COEFFICIENT: dict[str, float] = {"seat": 2.73e5, "backrest": 4.7905e5}
"""Coefficient of the general law where a scene names neither coefficient nor restitution: elastic one times damping, by default."""
DEFAULT_SPEED = 0.5
"""[m/s] that the smoothing of a rate exponent below 1 is relative to, where a scene names none."""


def resolve(scene: Scene) -> ResolvedScene:
    """Turn accuracy into explicit grids and tolerances, write out every default, take the checksums of input files.

    Raises:
        SceneError: an input file is not there.
    """
    data, files = explicit(scene), {}
    for file in input_files(scene):
        path = find_file(file.name, Path(scene.file).parent)
        if path is None:
            raise SceneError([Fault(scene.file, 1, 1, file.where, f"the file {file.name!r} is not there")])
        section = data[file.where.split(".")[0]]
        section["file"] = path.name if Path(file.name).is_absolute() else file.name
        section["sha256"] = sha256_of(path)
        files[file.where] = path
    return ResolvedScene(_ordered(data), files)


def read_resolved(text: str, files: Mapping[str, str | Path] | None = None, folder: str | Path = ".") -> ResolvedScene:
    """Read what `ResolvedScene.to_yaml` wrote.

    Args:
        text: the YAML text.
        files: where input files are, by the dotted path of the key; others are looked for from `folder` and in the
            package.
        folder: where relative file names start.

    Raises:
        SceneError: the text is not a valid scene, or leaves something open. Input files are looked for, not
            required: a bag can be read where they are not; `file_path` asks for them.
    """
    source = "resolved scene"
    document = parse_document(text, source)
    take_new_names(document.root)  # a scene that an earlier version resolved
    scene = validate(document.root, source, document.faults)
    data = explicit(scene)
    open_keys = [where for where, value in _leaves(data) if _at(_dump(scene), where) != value]
    if open_keys:
        sentence = "is left open in a resolved scene"
        raise SceneError([Fault(source, 1, 1, ".".join(where), sentence) for where in open_keys])
    found = {file.where: find_file(file.name, Path(folder)) for file in input_files(scene)}
    given = {where: Path(path) for where, path in (files or {}).items()}
    return ResolvedScene(data, {**{where: path for where, path in found.items() if path is not None}, **given})


def read_explicit(text: str, name: str, overrides: Sequence[Override] = ()) -> dict[str, Any]:
    """The data of a resolved scene that stands in a bag, with ``overrides`` applied, made explicit and checked again.

    Keys that were renamed since are read under their new names.
    """
    document = parse_document(text, name)
    take_new_names(document.root)
    faults = document.faults + apply(document.root, overrides)
    return explicit(validate(document.root, name, faults))


def explicit(scene: Scene) -> dict[str, Any]:
    """The scene as a plain dict with every default and everything that follows from `accuracy` written out."""
    data = _dump(scene)
    data["duration"] = whole_duration(scene)
    for contact in rigs()[scene.rig].contacts:
        data.setdefault(contact, {})  # the schema fills in its defaults
        _fill_effects(data["effects"][contact], scene.accuracy, contact)
    if scene.rig in _COMPLETED:
        _COMPLETED[scene.rig](data)
    impacts = scene.rig == "block" and data["effects"]["block"].get("compliant_contact") is None
    data["integrator"].setdefault("relative_tolerance", integration_tolerance(scene.accuracy, impacts=impacts))
    if any((data["effects"][contact] or {}).get("contact_field") is not None for contact in rigs()[scene.rig].contacts):
        data["integrator"].setdefault("coupling_tolerance", asked(scene.accuracy))
    return _ordered(data)


def _fill_effects(effects: dict[str, Any], accuracy: float | str, contact: str) -> None:
    loss = effects.get("normal_dissipative")
    if loss is not None and contact in DEFAULT_DAMPING and "restitution" not in loss:
        loss.setdefault("damping", DEFAULT_DAMPING[contact])
    general = effects.get("general_dissipative")
    if general is not None:
        if "restitution" not in general:
            general.setdefault("coefficient", DEFAULT_COEFFICIENT[contact])
        if general["rate_exponent"] < 1.0:
            general.setdefault("reference_speed", DEFAULT_SPEED)
    grid = effects.get("contact_field")
    if grid is not None:
        rung, field = rung_for(accuracy), _FIELD_CONTACTS[contact]
        grid["rows"], grid["cols"] = cells_of(accuracy, field, grid.get("rows"), grid.get("cols"))
        grid.setdefault("tolerance", rung.field_tolerance(field))
        grid.setdefault("corrector_passes", rung.passes(field))


def _dump(scene: Scene) -> dict[str, Any]:
    return copy.deepcopy(scene.model_dump(exclude_none=True))


def _ordered(data: dict[str, Any]) -> dict[str, Any]:
    """The same data in the order of the schema, whatever was given and whatever was filled in."""
    return _dump(Scene.model_validate(data))


def _leaves(data: dict[str, Any], prefix: tuple[str, ...] = ()) -> list[tuple[tuple[str, ...], Any]]:
    found: list[tuple[tuple[str, ...], Any]] = []
    for key, value in data.items():
        found += _leaves(value, (*prefix, key)) if isinstance(value, dict) else [((*prefix, key), value)]
    return found


def _at(data: Any, where: tuple[str, ...]) -> Any:
    for key in where:
        data = data.get(key) if isinstance(data, dict) else None
    return data
