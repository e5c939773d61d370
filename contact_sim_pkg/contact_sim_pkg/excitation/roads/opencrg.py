"""A road from an ASAM OpenCRG file; its reader is loaded when a road is made."""

from pathlib import Path
from typing import Literal, TypeAlias

from contact_sim_pkg.excitation.blocks import Surface
from contact_sim_pkg.excitation.borders import BEYOND_THE_ENDS, BORDER_NAMES, Border, FileRoadKind, TurnedBeginning
from contact_sim_pkg.excitation.kinds import Setting, sha256_key
from contact_sim_pkg.records.fields import choice, given, number, text

MissingCells: TypeAlias = Literal["refuse", "fill", "hole"]
FileSettings: TypeAlias = Literal["refuse", "apply", "ignore"]


class OpenCrgRoadSection(FileRoadKind):
    """A road from an ASAM OpenCRG file (text or binary)."""

    kind: Literal["opencrg"]
    file: str = text(
        "file name, from the scene file's folder; data/… also finds the files of the package",
        longest=500,
        example="road.crg",
    )
    sha256: str | None = sha256_key()
    track_offset: float = number(
        -100.0, 100.0, "m", "line of travel, to the left of the reference line (v)", default=0.0
    )
    start: float = number(-1e6, 1e6, "m", "start of the wheel, from the beginning of the road (u)", default=0.0)
    missing_cells: MissingCells = choice(
        "cells without height: refuse the file, fill from their neighbours, or a hole", default="refuse"
    )
    hole_depth: float = number(0.0, 0.5, "m", "depth of a hole (missing_cells: hole)", default=0.05)
    border_u: Border = choice(BEYOND_THE_ENDS, default="refuse")
    border_v: Border = choice("beyond the left and right side of the road", default="keep")
    remove_mean: bool = choice("shift the mean height to 0, else the height at the start", default=True)
    file_settings: FileSettings = choice(
        "options and modifiers of the file: refuse the file, apply, or ignore", default="refuse"
    )

    def surface(self, setting: Setting) -> Surface:
        """See RoadKind."""
        from contact_sim_pkg.excitation.opencrg.road import OpenCrgRoad

        grid = OpenCrgRoad(
            given(setting.file), start=self.start, lateral_offset=self.track_offset, missing=self.missing_cells,
            hole_depth=self.hole_depth, border_u=BORDER_NAMES[self.border_u], border_v=BORDER_NAMES[self.border_v],
            level="mean" if self.remove_mean else "origin", file_settings=self.file_settings,
        )  # fmt: skip
        return TurnedBeginning(grid)

    def file_memory(self, path: Path) -> int:
        """See Kind."""
        from contact_sim_pkg.excitation.opencrg.road import memory_needed

        return memory_needed(path)


KIND = OpenCrgRoadSection
