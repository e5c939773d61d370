"""Patches that bring a new rig, effect, topic and column, as a developer would, and the shared files that each edits."""

from __future__ import annotations

import re
from pathlib import Path
from typing import NamedTuple

FOLDER = Path(__file__).parent


class Patch(NamedTuple):
    """How many shared files such an addition edited before, and how many are wanted, as words."""

    before: str
    wanted: str
    whole: bool = False  # whether all of its files count, new ones included
    most: int = 3  # files that a test lets it edit


PATCHES = {
    "rig": Patch("24", "0 (a package of its own)"),
    "effect": Patch("10 to 20", "1 to 3"),
    "effect that acts": Patch("10", "2 and a row", whole=True),
    "topic": Patch("14", "3"),
    "column": Patch("15", "3"),
    "obstacle": Patch("6", "1", whole=True, most=1),
    "metric": Patch("closed", "1", whole=True, most=1),
}


def file_of(name: str) -> Path:
    """The patch as `git diff` writes it."""
    return FOLDER / f"{name.replace(' ', '_')}.patch"


def shared_files(name: str) -> list[str]:
    """Files that exist without the patch and that it edits (all of its files where the patch counts `whole`), tests and
    generated pages left out.

    What commands write from the same definitions (`records/messages.pyi`, `config/sros2_policy.xml`) is in no patch.
    """
    edited = re.findall(
        rf"^{r'[+]{3} b' if PATCHES[name].whole else '--- a'}/(\S+)$",
        file_of(name).read_text(encoding="utf-8"),
        re.MULTILINE,
    )
    return [path for path in edited if not path.startswith(("tests/", "docs/"))]
