"""Accuracy to explicit grids and tolerances: the resolved scene, stored in the bag, gives the same
bits again.

A resolved scene is itself a scene: the same keys, every default written out, nothing left to be
taken from `accuracy`, and the checksum of each input file. Reading it back and resolving it once
more changes nothing.
"""

from __future__ import annotations

import copy
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from contact_sim_pkg.records.fields import Section
from contact_sim_pkg.records.registry import plugins_of, rigs
from contact_sim_pkg.scene.errors import Fault, SceneError
from contact_sim_pkg.scene.files import find_file, input_files
from contact_sim_pkg.scene.load import load_scene
from contact_sim_pkg.scene.overrides import Override, apply, set_value
from contact_sim_pkg.scene.renamed_keys import use_new_names
from contact_sim_pkg.scene.resolved_scene import ResolvedScene, leaves_of, sha256_of
from contact_sim_pkg.scene.schema.accuracy import integration_tolerance, requested
from contact_sim_pkg.scene.schema.clock import whole_duration
from contact_sim_pkg.scene.schema.pressure_field import PressureFieldSection
from contact_sim_pkg.scene.schema.scene import Scene
from contact_sim_pkg.scene.schema.travel import points_of
from contact_sim_pkg.scene.schema.validate import validate
from contact_sim_pkg.scene.yaml.document import parse_document

__all__ = ["ResolvedScene", "explicit", "load_resolved", "read_explicit", "read_resolved", "resolve"]


def resolve(scene: Scene) -> ResolvedScene:
    """Turn accuracy into explicit grids and tolerances, write out every default, take the checksums
    of input files.

    Raises:
        SceneError: an input file is not there.
    """
    data, files = explicit(scene), {}
    for file in input_files(scene):
        path = find_file(file.name, Path(scene.file).parent)
        if path is None:
            raise SceneError([Fault(scene.file, 1, 1, file.where, f"the file {file.name!r} is not there")])
        section = data
        for name in file.where.split(".")[:-1]:
            section = section[name]
        section["file"] = path.name if Path(file.name).is_absolute() else file.name
        section["sha256"] = sha256_of(path)
        files[file.where] = path
    return ResolvedScene(_ordered(data), files)


def load_resolved(scene_name: str, *values: str) -> ResolvedScene:
    """A scene by name or path, resolved; `values` as of `--set`."""
    return resolve(load_scene(scene_name, [set_value(value) for value in values]))


def read_resolved(text: str, files: Mapping[str, str | Path] | None = None, folder: str | Path = ".") -> ResolvedScene:
    """Read what `ResolvedScene.to_yaml` wrote.

    Args:
        text: the YAML text.
        files: where input files are, by the dotted path of the key; others are looked for from
            `folder` and in the package.
        folder: where relative file names start.

    Raises:
        SceneError: the text is not a valid scene, or leaves something open. Input files are looked
            for, not required: a bag can be read where they are not; `file_path` asks for them.
    """
    source = "resolved scene"
    document = parse_document(text, source)
    use_new_names(document.root)  # a scene that an earlier version resolved
    scene = validate(document.root, source, document.faults)
    data = explicit(scene)
    given_keys = _dump(scene)  # plug-ins may be of another version now
    open_keys = [
        where for where, value in leaves_of(data)
        if value != {} and where != ("plugins",) and _at(given_keys, where) != value
    ]  # fmt: skip
    if open_keys:
        sentence = "is left open in a resolved scene"
        raise SceneError([Fault(source, 1, 1, ".".join(where), sentence) for where in open_keys])
    found = {file.where: find_file(file.name, Path(folder)) for file in input_files(scene)}
    given = {where: Path(path) for where, path in (files or {}).items()}
    return ResolvedScene(data, {**{where: path for where, path in found.items() if path is not None}, **given})


def read_explicit(text: str, name: str, overrides: Sequence[Override] = ()) -> dict[str, Any]:
    """The data of a resolved scene that stands in a bag, with ``overrides`` applied, made explicit
    and checked again.

    Keys that were renamed since are read under their new names.
    """
    document = parse_document(text, name)
    use_new_names(document.root)
    faults = document.faults + apply(document.root, overrides)
    return explicit(validate(document.root, name, faults))


def explicit(scene: Scene) -> dict[str, Any]:
    """The scene as a plain dict with every default and everything that follows from `accuracy`
    written out.
    """
    contacts = rigs()[scene.rig].contacts
    absent: dict[str, Any] = {contact.name: {} for contact in contacts if getattr(scene, contact.name) is None}
    if scene.slip is None and points_of(scene, "slip", "slip_angle") is not None:
        absent["slip"] = {}
    if scene.travel is None and points_of(scene, "speed") is not None:
        absent["travel"] = {}
    whole = Scene.model_validate({**_dump(scene), **absent})  # the schema fills in the defaults
    whole._file = scene.file
    data = _dump(whole)
    data["duration"] = whole_duration(scene)
    used = plugins_of(data)
    data.pop("plugins", None)
    if used:
        data["plugins"] = ", ".join(map(str, used))
    _fill(whole, whole, data)
    loosest = min(contact.loosest_integration(data["effects"][contact.name]) for contact in contacts)
    data["integrator"].setdefault("relative_tolerance", integration_tolerance(scene.accuracy, loosest))
    if any(scene.effect(contact.name, PressureFieldSection) is not None for contact in contacts):
        data["integrator"].setdefault("coupling_tolerance", requested(scene.accuracy))
    return _ordered(data)


def _fill(section: Section, scene: Scene, data: dict[str, Any]) -> None:
    """Write out what a section, and those in it, leave open."""
    for name, value in section.open_values(scene).items():
        data.setdefault(name, value)
    for name, value in section:
        if isinstance(value, Section):
            _fill(value, scene, data[name])


def _dump(scene: Scene) -> dict[str, Any]:
    return copy.deepcopy(scene.model_dump(exclude_none=True))


def _ordered(data: dict[str, Any]) -> dict[str, Any]:
    """The same data in the order of the schema, whatever was given and whatever was filled in."""
    return _dump(Scene.model_validate(data))


def _at(data: Any, where: tuple[str, ...]) -> Any:
    for key in where:
        data = data.get(key) if isinstance(data, dict) else None
    return data
