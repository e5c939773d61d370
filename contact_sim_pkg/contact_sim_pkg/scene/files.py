"""Input files that a scene names: where they are found, and the checksum that ties a run to their
content.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import ClassVar, NamedTuple, Protocol, cast

from contact_sim_pkg.excitation.kinds import Kind
from contact_sim_pkg.records.registry import rigs
from contact_sim_pkg.scene.schema.foam_curve import curves_of
from contact_sim_pkg.scene.schema.places import candidates, find_file
from contact_sim_pkg.scene.schema.scene import Scene

__all__ = ["InputFile", "candidates", "excitations", "find_file", "input_files"]


class FileReader(Protocol):
    """What reads an input file."""

    largest_file: ClassVar[int]
    """[bytes]"""

    def input_file(self) -> tuple[str, str | None] | None:
        """Name of the file, and the checksum that the scene states; None: it reads none."""

    def file_memory(self, path: Path) -> int:
        """Memory in [bytes] that reading it takes."""


class InputFile(NamedTuple):
    """A file that a scene names: the dotted path of the key, the name, the checksum if the scene
    states one, and what reads it.
    """

    where: str
    name: str
    sha256: str | None
    reader: FileReader


def excitations(scene: Scene) -> dict[str, Kind]:
    """Road and vibration of a scene by the names of their sections, those that it has."""
    return {name: kind for name, kind in (("road", scene.road), ("vibration", scene.vibration)) if kind is not None}


def _effects(scene: Scene) -> Iterator[tuple[str, FileReader]]:
    """Dotted path and section of each effect that has a file of its own."""
    for contact in rigs()[scene.rig].contacts:
        for name, effect in scene.effects_at(contact):
            if hasattr(effect, "input_file"):
                yield f"effects.{contact.name}.{name}", cast(FileReader, effect)


def _programmes(scene: Scene) -> Iterator[tuple[str, FileReader]]:
    """Dotted path and section of each programme of a contact that may be a file."""
    for contact in rigs()[scene.rig].contacts:
        programme = getattr(getattr(scene, contact.name), "programme", None)
        if hasattr(programme, "input_file"):
            yield f"{contact.name}.programme", cast(FileReader, programme)


def input_files(scene: Scene) -> list[InputFile]:
    """The files that a scene names."""
    readers: list[tuple[str, FileReader]] = [
        *excitations(scene).items(),
        *curves_of(scene),
        *_effects(scene),
        *_programmes(scene),
    ]
    found = ((f"{where}.file", reader.input_file(), reader) for where, reader in readers)
    return [InputFile(where, *file, reader) for where, file, reader in found if file is not None]
