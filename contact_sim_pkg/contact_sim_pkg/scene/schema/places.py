"""Where the input files that a scene names are found."""

from __future__ import annotations

from pathlib import Path

__all__ = ["SHIPPED", "candidates", "find_file"]

SHIPPED = Path(__file__).resolve().parents[2] / "excitation"
"""Folder whose `data/` holds the input files of the shipped scenes."""
PACKAGE_PREFIX = "data/"


def candidates(name: str, folder: Path) -> list[Path]:
    """Places where a file is looked for: from the folder, and for `data/…` also in the package."""
    places = [folder / name]
    if name.startswith(PACKAGE_PREFIX):
        places.append(SHIPPED / name)
    return places


def find_file(name: str, folder: Path) -> Path | None:
    """The first candidate that is a file, absolute; None where there is none."""
    return next((place.absolute() for place in candidates(name, folder) if place.is_file()), None)
