"""A longitudinal profile from a file; its reader is loaded when a road is made."""

from pathlib import Path
from typing import Literal

from contact_sim_pkg.excitation.blocks import Surface
from contact_sim_pkg.excitation.borders import BEYOND_THE_ENDS, BORDER_NAMES, Border, FileRoadKind, TurnedBeginning
from contact_sim_pkg.excitation.kinds import Setting, sha256_key
from contact_sim_pkg.records.fields import choice, given, number, text


class ProfileRoadSection(FileRoadKind):
    """A longitudinal profile: pairs of distance x and height z, or x, z_left, z_right; a table, UMTRI
    ERD, or RDF.
    """

    kind: Literal["profile"]
    file: str = text(
        "file name, from the scene file's folder; straight between its points", longest=500, example="x_z.csv"
    )
    sha256: str | None = sha256_key()
    header_line: int | None = number(
        1, 100000, "", "line that names the columns; without it the first that is no comment", default=None
    )
    track_width: float = number(
        0.1, 10.0, "m", "distance of two tracks; straight across between them, level beyond", default=1.5
    )
    track_offset: float | None = number(
        -100.0, 100.0, "m", "line of travel, to the left of the middle; without it the left of two tracks", default=None
    )
    start: float = number(-1e6, 1e6, "m", "start of the wheel, from the first point of the road", default=0.0)
    border_u: Border = choice(BEYOND_THE_ENDS, default="refuse")
    remove_mean: bool = choice("shift the mean height to 0, else the height at the first point", default=True)

    def surface(self, setting: Setting) -> Surface:
        """See RoadKind."""
        from contact_sim_pkg.excitation.profile.road import ProfileRoad

        profile = ProfileRoad(
            given(setting.file), start=self.start, track_offset=self.track_offset, track_width=self.track_width,
            border_u=BORDER_NAMES[self.border_u], level="mean" if self.remove_mean else "origin",
            header_line=self.header_line,
        )  # fmt: skip
        return TurnedBeginning(profile)

    def file_memory(self, path: Path) -> int:
        """See Kind."""
        from contact_sim_pkg.excitation.table_files import memory_needed

        return memory_needed(path)


KIND = ProfileRoadSection
