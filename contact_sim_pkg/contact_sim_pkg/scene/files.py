"""Input files that a scene names: where they are found, and the checksum that ties a run to their
content.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from contact_sim_pkg.excitation.kinds import Kind
from contact_sim_pkg.scene.schema.scene import Scene

SHIPPED = Path(__file__).resolve().parent.parent / "excitation"
"""Folder whose `data/` holds the input files of the shipped scenes."""
PACKAGE_PREFIX = "data/"


class InputFile(NamedTuple):
    """A file that a scene names: the dotted path of the key, the name, the checksum if the scene
    states one, and what reads it.
    """

    where: str
    name: str
    sha256: str | None
    reader: Kind


def excitations(scene: Scene) -> dict[str, Kind]:
    """Road and vibration of a scene by the names of their sections, those that it has."""
    return {name: kind for name, kind in (("road", scene.road), ("vibration", scene.vibration)) if kind is not None}


def input_files(scene: Scene) -> list[InputFile]:
    """The files that a scene names."""
    found = ((f"{name}.file", kind.input_file(), kind) for name, kind in excitations(scene).items())
    return [InputFile(where, *file, kind) for where, file, kind in found if file is not None]


def candidates(name: str, folder: Path) -> list[Path]:
    """Places where a file is looked for: from the folder, and for `data/…` also in the package."""
    places = [folder / name]
    if name.startswith(PACKAGE_PREFIX):
        places.append(SHIPPED / name)
    return places


def find_file(name: str, folder: Path) -> Path | None:
    """The first candidate that is a file, absolute; None where there is none."""
    return next((place.absolute() for place in candidates(name, folder) if place.is_file()), None)
