"""Input files that a scene names: where they are found, and the checksum that ties a run to their
content.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from contact_sim_pkg.scene.schema.road import OpenCrgRoadSection, ProfileRoadSection
from contact_sim_pkg.scene.schema.scene import Scene
from contact_sim_pkg.scene.schema.vibration import RecordedSection

SHIPPED = Path(__file__).resolve().parent.parent / "excitation"
"""Folder whose `data/` holds the input files of the shipped scenes."""
PACKAGE_PREFIX = "data/"


class InputFile(NamedTuple):
    """A file that a scene names: the dotted path of the key, the name, the checksum if the scene
    states one.
    """

    where: str
    name: str
    sha256: str | None


def input_files(scene: Scene) -> list[InputFile]:
    """The files that a scene names."""
    named = []
    if isinstance(scene.road, OpenCrgRoadSection | ProfileRoadSection):
        named.append(InputFile("road.file", scene.road.file, scene.road.sha256))
    if isinstance(scene.vibration, RecordedSection):
        named.append(InputFile("vibration.file", scene.vibration.file, scene.vibration.sha256))
    return named


def candidates(name: str, folder: Path) -> list[Path]:
    """Places where a file is looked for: from the folder, and for `data/…` also in the package."""
    places = [folder / name]
    if name.startswith(PACKAGE_PREFIX):
        places.append(SHIPPED / name)
    return places


def find_file(name: str, folder: Path) -> Path | None:
    """The first candidate that is a file, absolute; None where there is none."""
    return next((place.absolute() for place in candidates(name, folder) if place.is_file()), None)
