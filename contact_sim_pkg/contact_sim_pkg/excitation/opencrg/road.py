"""Measured roads from OpenCRG files (ASAM OpenCRG 1.x, text and binary).

The road is used in the coordinates of its reference line: x = u - start of the file - start, y = v
- lateral_offset. A path beside a curved reference line is longer or shorter than its x by the part
|curvature v|, which `describe` reports. Heights between the grid's nodes are bilinear.
"""

import os
from pathlib import Path
from typing import Any

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.borders import BORDERS, bring_inside
from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.opencrg.grid import ROWS_AT_ONCE, Grid, fill_missing, make_grid
from contact_sim_pkg.excitation.opencrg.header import LONGEST_HEADER, Header, parse_header
from contact_sim_pkg.excitation.opencrg.layout import make_layout
from contact_sim_pkg.excitation.opencrg.payload import read_payload
from contact_sim_pkg.excitation.opencrg.settings import Circumstances, FileSettings, read_settings
from contact_sim_pkg.files import open_regular_file, read_regular_file

LARGEST_FILE = 1 << 30  # [bytes]
# Numbers of the road resampled on one track's lines, 32 MiB; above, only the rows of a block
LARGEST_TABLE = 1 << 22
MISSING = ("refuse", "fill", "hole")
BYTES_PER_NUMBER = {"LRFI": 10, "LDFI": 20, "KRBI": 4, "KDBI": 8}
BYTES_PER_CELL = 26
"""The road twice, as it is read and in rows, or beside it the copy that its median is taken of,
with marks of missing cells.
"""
LARGEST_RISE = 0.6  # [m] across the track, about a wheel's radius: steeper, no wheel stands on it
ROUNDING = 1e-9  # [m] of a level: less is not said
LEVELS = ("origin", "mean", "raw")

Array = NDArray[numpy.float64]


class OpenCrgRoad:
    """A measured road with all that was found in its file and done to it."""

    def __init__(
        self,
        path: str | Path,
        start: float = 0.0,
        lateral_offset: float = 0.0,
        missing: str = "refuse",
        hole_depth: float = 0.05,
        border_u: str | None = None,
        border_v: str | None = None,
        level: str = "origin",
        file_settings: str = "refuse",
    ) -> None:
        """Read and check the file.

        Args:
            path: of the .crg file. start: distance from the file's start to x = 0, [m].
            lateral_offset: v of the track's middle, left positive, [m]. missing: cells without a
            height: refuse (with their count), fill (linear along the cross section, its
                outermost value kept to the edge), hole (the filled surface lowered by hole_depth).
            hole_depth: depth of such a hole, [m]. border_u: beyond the ends: none (an error), zero,
            constant (the last cross section), repeat, reflect; None:
                as the file specifies where its settings are applied, else constant, the default of
                the format.
            border_v: the same beyond the sides. level: origin (height 0 on the reference line at
            the file's start, as the reference library evaluates by
                default), mean (mean of all cells 0), raw (as the file gives them).
            file_settings: the file's own options and modifiers, see opencrg_settings.read_settings.

        Raises:
            ExcitationError: the file cannot be read or is malformed, with line or byte; an unknown
            choice; missing
                cells.
        """
        self.path, self.start, self.lateral_offset = Path(path), start, lateral_offset
        self.missing, self.hole_depth, self.level = missing, hole_depth, level
        self._check_choices(border_u, border_v)
        data = _read(self.path)
        header = parse_header(data, str(path))
        # The numbers of the file and the grid are large: each goes as soon as it is used
        layout = make_layout(header)
        values = read_payload(data, header, layout)
        del data
        missing_cells = any(numpy.isnan(values[:, column]).any() for column in layout.section_columns)
        along = {*layout.reference_columns} | {
            name for name in ("slope", "banking") if f"reference_line_start_{name[0]}" in header.road
        }
        circumstances = Circumstances(missing_cells, along, (border_u, border_v))
        self._settings = read_settings(header, file_settings, circumstances)
        grid = make_grid(header, layout, values, self._settings.scale_z)
        del values
        self._layout_notes = layout.notes
        self.border_u = border_u or self._settings.border_u or "constant"
        self.border_v = border_v or self._settings.border_v or "constant"
        self.format = header.format
        self._take(header, grid, self._settings)
        self._track: tuple[bytes, Array] | None = None

    def _check_choices(self, border_u: str | None, border_v: str | None) -> None:
        for name, choice, allowed in (
            ("missing", self.missing, MISSING),
            ("level", self.level, LEVELS),
            ("border_u", border_u or "constant", BORDERS),
            ("border_v", border_v or "constant", BORDERS),
        ):
            if choice not in allowed:
                raise ExcitationError(f"{self.path}: {name} is '{choice}'; allowed: {', '.join(allowed)}")
        for name, value, low, high in (
            ("hole_depth", self.hole_depth, 0.0, 10.0),
            ("start", self.start, -1e6, 1e6),
            ("lateral_offset", self.lateral_offset, -1e4, 1e4),
        ):
            if not low <= value <= high:
                raise ExcitationError(f"{self.path}: {name} is {value} m; allowed: {low:g} to {high:g} m")

    def _take(self, header: Header, grid: Grid, settings: FileSettings) -> None:
        """Treat the missing cells, set the level and keep the grid."""
        if grid.missing and self.missing == "refuse":
            raise ExcitationError(
                f"{header.file}: {grid.missing} of {grid.height.size} cells have no height; say how they are treated "
                "(road.missing_cells: fill or hole)"
            )
        # Missing cells.
        height, holes = grid.height, None
        if grid.missing:
            holes = numpy.isnan(height)
            fill_missing(height)
        self.lowest, self.highest = float(height.min()), float(height.max())
        # Height of the reference line.
        nearest = int(numpy.argmin(numpy.abs(grid.v)))
        on_line = (
            float(numpy.interp(0.0, grid.v, height[0])) if grid.v[0] <= 0.0 <= grid.v[-1] else float(height[0, nearest])
        )
        self.removed = {"origin": on_line, "mean": float(height.mean()), "raw": 0.0}[self.level]
        if self.missing == "hole" and holes is not None:
            numpy.subtract(height, self.hole_depth, out=height, where=holes)
        # Level and offset.
        height -= self.removed
        height += settings.offset_z
        self._height = numpy.ascontiguousarray(height)
        self._grid = grid._replace(height=self._height)

    def heights(self, x: Array, y: Array) -> Array:
        """Heights in [m], [len(x), len(y)]; ExcitationError outside of the road where the border is
        'none'.
        """
        grid = self._grid
        cells = len(grid.height) - 1
        position, outside_u = self._inside(
            (x + self.start) / grid.u_increment, 0.0, float(cells), self.border_u, "x", x
        )
        # Linear along u between two cross sections; `_lines` interpolates across
        left = numpy.minimum(position.astype(numpy.int64), cells - 1)
        weight = (position - left)[:, None]
        table, first = self._lines(y, left)
        height = table.take(left - first, axis=0)
        height *= 1.0 - weight
        right = table.take(left - first + 1, axis=0)
        right *= weight
        height += right
        if outside_u is not None:
            height[outside_u] = 0.0
        return height

    def refuse_steep_track(self, y: Array) -> None:
        """Raise ExcitationError where the road rises across the track's lines `y`, [m], by more
        than a wheel can stand on.
        """
        for start in range(0, len(self._height), ROWS_AT_ONCE):
            rise = numpy.ptp(self._across(self._height[start : start + ROWS_AT_ONCE], y), axis=1)
            row = int(rise.argmax())
            if rise[row] > LARGEST_RISE:
                raise ExcitationError(
                    f"{self.path}: {(start + row) * self._grid.u_increment:g} m after its start the road rises by "
                    f"{rise[row]:.3g} m across the {y[-1] - y[0]:.3g} m of the tire's track; allowed: {LARGEST_RISE:g} m; "
                    "choose another line of travel (road.track_offset) or another file"
                )

    def _lines(self, y: Array, left: NDArray[numpy.int64]) -> tuple[Array, int]:
        """The road resampled on the track's lines, and the number of its first row: all rows
        (kept), or those of a block."""
        if len(self._height) * len(y) > LARGEST_TABLE:
            first = int(left.min())
            return self._across(self._height[first : int(left.max()) + 2], y), first
        key = y.tobytes()
        if self._track is None or self._track[0] != key:
            self._track = (key, self._across(self._height, y))
        return self._track[1], 0

    def _across(self, rows: Array, y: Array) -> Array:
        v, outside_v = self._inside(y + self.lateral_offset, self._grid.v[0], self._grid.v[-1], self.border_v, "y", y)
        if len(self._grid.v) == 1:
            lines = numpy.repeat(rows, len(y), axis=1)
        else:
            right = numpy.clip(numpy.searchsorted(self._grid.v, v, side="right") - 1, 0, len(self._grid.v) - 2)
            weight = (v - self._grid.v[right]) / numpy.diff(self._grid.v)[right]
            lines = rows[:, right] * (1.0 - weight) + rows[:, right + 1] * weight
        if outside_v is not None:
            lines[:, outside_v] = 0.0
        return numpy.ascontiguousarray(lines)

    def _inside(
        self, value: Array, low: float, high: float, border: str, name: str, requested: Array
    ) -> tuple[Array, Any]:
        return bring_inside(str(self.path), value, low, high, border, name, requested)

    def describe(self) -> dict[str, Any]:
        """See blocks.Surface."""
        grid = self._grid
        return {
            "kind": "opencrg", "file": self.path.name, "format": self.format,
            "rows": len(grid.height), "long_sections": len(grid.v),
            "length_m": (len(grid.height) - 1) * grid.u_increment, "increment_m": grid.u_increment,
            "right_edge_m": float(grid.v[0]), "left_edge_m": float(grid.v[-1]),
            "start_m": self.start, "lateral_offset_m": self.lateral_offset,
            "lowest_height_in_file_m": self.lowest, "highest_height_in_file_m": self.highest,
            "level": self.level, "height_removed_m": self.removed,
            "missing_cells": grid.missing, "missing_cells_treated": self.missing,
            "heading_change_rad": grid.heading_change, "largest_stretch_beside_reference_line": grid.largest_stretch,
            "border_u": self.border_u, "border_v": self.border_v, "notes": self._notes(),
        }  # fmt: skip

    def _notes(self) -> list[str]:
        grid, notes = self._grid, [*self._layout_notes, *self._settings.notes]
        # Missing cells.
        if grid.missing:
            done = {"fill": "filled along their cross section", "hole": f"made holes of {self.hole_depth:g} m depth"}[
                self.missing
            ]
            notes.append(f"{grid.missing} of {grid.height.size} cells have no measured height; {done}.")
        # Level.
        if abs(self.removed) > ROUNDING:
            what = {"origin": "the height on the reference line at the file's start", "mean": "the mean height"}[
                self.level
            ]
            notes.append(f"{self.removed:.6g} m, {what}, was taken off all heights.")
        # Curvature of the reference line.
        if grid.largest_stretch > 1e-3:
            notes.append(
                f"The reference line is curved (heading changes by {grid.heading_change:.3g} rad); a path at the "
                f"road's edge is up to {100.0 * grid.largest_stretch:.2g} % longer or shorter than its x."
            )
        # Seam.
        if self.border_u == "repeat":
            seam = float(numpy.abs(grid.height[-1] - grid.height[0]).max())
            notes.append(
                f"The road repeats every {(len(grid.height) - 1) * grid.u_increment:g} m, with a step of up to "
                f"{seam:.3g} m at the seam."
            )
        return notes


def memory_needed(path: Path) -> int:
    """Memory in [bytes] that reading a file takes, from its size and its format; 0 for no file."""
    try:
        with open_regular_file(path) as file:
            size, head = os.fstat(file.fileno()).st_size, file.read(LONGEST_HEADER)
        form = parse_header(head, str(path)).format
    except (OSError, ExcitationError):
        return 0
    cells = size // BYTES_PER_NUMBER[form]
    return max(size + 8 * cells, BYTES_PER_CELL * cells)


def _read(path: Path) -> bytes:
    try:
        return read_regular_file(path, LARGEST_FILE, "cut the road")
    except OSError as error:
        raise ExcitationError(f"{path}: cannot be read: {error.strerror or error}") from error
