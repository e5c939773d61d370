"""A scene with nothing left open, as it goes to the nodes and into the bag. Knows no schema."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from io import StringIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ruamel.yaml import YAML

from contact_sim_pkg.files import open_regular_file
from contact_sim_pkg.scene.errors import Fault, SceneError

if TYPE_CHECKING:
    from contact_sim_pkg.scene.schema.scene import Scene


@dataclass(frozen=True)
class ResolvedScene:
    """A scene with nothing left open.

    Attributes:
        data: plain dict of dicts, lists, texts and numbers, in the keys of the scene schema.
        files: where each input file was found, by the dotted path of its key; not part of the data and not compared.
    """

    data: dict[str, Any]
    files: Mapping[str, Path] = field(default_factory=dict, compare=False)

    @cached_property
    def typed(self) -> Scene:
        """The same scene with typed sections, of which the parameters of kernels are made; reads the schema."""
        from contact_sim_pkg.scene.schema.scene import Scene

        return Scene.model_validate(self.data)

    def to_yaml(self) -> str:
        """The data as YAML 1.2; `resolve.read_resolved` reads the same data from it, to the bit."""
        writer = YAML(typ="safe", pure=True)
        writer.default_flow_style = False
        writer.sort_base_mapping_type_on_output = False  # type: ignore[assignment]
        writer.allow_unicode = True
        writer.width = 120
        stream = StringIO()
        writer.dump(self.data, stream)
        return stream.getvalue()

    @classmethod
    def from_own_yaml(cls, text: str, files: Mapping[str, str | Path]) -> ResolvedScene:
        """Read what `to_yaml` wrote in this very run, without checking it again: a node starts without the schema."""
        return cls(YAML(typ="safe", pure=True).load(text), {where: Path(path) for where, path in files.items()})

    def file_path(self, where: str) -> Path:
        """The input file of a key (`road.file`, `vibration.file`), its content checked against the checksum.

        Raises:
            SceneError: not found, or its content differs from the one that the scene was resolved with.
        """
        section = where.split(".")[0]
        name, stated = self.data[section]["file"], self.data[section]["sha256"]
        path = self.files.get(where)
        if path is None or not path.is_file():
            raise SceneError([Fault("resolved scene", 0, 0, where, f"the file {name!r} is not there; give its path")])
        found = sha256_of(path)
        if found != stated:
            sentence = f"{path} has another content than the scene was resolved with: sha256 {found}, stated {stated}"
            raise SceneError([Fault("resolved scene", 0, 0, where, sentence)])
        return path


def effects_at(scene: dict[str, Any], contact: str) -> dict[str, Any]:
    """Effects that a resolved scene names at a contact, with their parameters."""
    return scene["effects"].get(contact) or {}


def sha256_of(path: Path) -> str:
    """Checksum of the content, as 64 hexadecimal digits."""
    digest = hashlib.sha256()
    with open_regular_file(path) as stream:
        while chunk := stream.read(1 << 20):
            digest.update(chunk)
    return digest.hexdigest()
