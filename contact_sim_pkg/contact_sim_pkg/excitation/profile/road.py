"""Measured roads as longitudinal profiles: points (x, z) of one track, or of a left and a right one.

The road is straight between its points, which may be unevenly spaced, and as high all across on one track; on two
it is straight across between them, and level beyond. x = distance from the first point - start.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.borders import bring_inside
from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.opencrg.grid import TALLEST
from contact_sim_pkg.excitation.opencrg.road import LARGEST_RISE, ROUNDING
from contact_sim_pkg.excitation.profile.formats import ProfilePoints, read_points

__all__ = ["ProfileRoad"]

Array = NDArray[numpy.float64]

GAP = 5.0
"""Of the median step: a longer one is said."""
UNEVEN = 0.01
"""Of the median step: a step that differs by more is said."""
STEEPEST, LONGEST = 1.0, 5.0
"""Slope, and step [m], of which half the road has more: its numbers are in another unit."""


class ProfileRoad:
    """A profile with all that was found in its file and done to it."""

    def __init__(
        self,
        path: str | Path,
        start: float = 0.0,
        track_offset: float | None = None,
        track_width: float = 1.5,
        border_u: str = "none",
        level: str = "mean",
        header_line: int | None = None,
    ) -> None:
        """Read and check the file.

        Args:
            path: of a table, an ERD or an RDF file, see `formats.read_points`. start: distance from the first
            point to x = 0, [m]. track_offset: line of travel, to the left of the middle of two tracks, [m];
            None: the left track. track_width: distance of two tracks, [m]. border_u: beyond the ends, one
            of borders.BORDERS. level: mean (mean height over the road 0), origin (height 0 at the first
            point). header_line: line that names the columns of a table, from 1; None: the first.

        Raises:
            ExcitationError: the file cannot be read or is malformed, points do not go forward or are no
            numbers (with the line), or are in another unit.
        """
        self.path, self.start, self.border_u, self.level = Path(path), start, border_u, level
        self._points = points = read_points(self.path, header_line)
        self._check(points)
        self._x = points.x - points.x[0]
        tracks = points.z.shape[1]
        self.track_width = track_width
        self.track_offset = (0.5 * track_width if tracks == 2 else 0.0) if track_offset is None else track_offset
        middle = points.z.mean(axis=1)
        mean = float(0.5 * (middle[1:] + middle[:-1]) @ numpy.diff(self._x) / self._x[-1])
        self.removed = mean if level == "mean" else float(middle[0])
        self._z = points.z - self.removed
        self._notes = [*points.notes, *self._said(points, chosen=track_offset is not None)]

    def _check(self, points: ProfilePoints) -> None:
        path, x, z, lines = self.path, points.x, points.z, points.lines
        if len(x) < 2:
            raise ExcitationError(f"{path}: the file has {len(x)} points; a profile has two at least")
        wrong = numpy.flatnonzero(~(numpy.isfinite(x) & numpy.isfinite(z).all(axis=1)))
        if wrong.size:
            where = wrong[0]
            shown = ", ".join(f"{value:g}" for value in (x[where], *z[where]))
            raise ExcitationError(
                f"{path}, line {lines[where]}: the point is ({shown}); finite numbers were expected ({wrong.size} such points); "
                "delete the line, and the road is straight across the gap"
            )
        steps = numpy.diff(x)
        back = numpy.flatnonzero(steps <= 0.0)
        if back.size:
            where = back[0] + 1
            turn = "repeats" if steps[back[0]] == 0.0 else "falls"
            cure = (
                "sort the lines by x, or turn the file round" if turn == "falls" else
                "delete one of the two lines; a vertical face needs a millimetre, such as 1.000 and 1.001"
            )  # fmt: skip
            raise ExcitationError(
                f"{path}, line {lines[where]}: x {turn}, {x[where]:.9g} m after {x[where - 1]:.9g} m in line {lines[where - 1]} "
                f"({back.size} such places); {cure}"
            )
        # Millimetres that are taken for metres
        furthest = numpy.abs(z - numpy.median(z)).max(axis=1)
        high, slope, step = (
            int(furthest.argmax()),
            float(numpy.median(numpy.abs(numpy.diff(z[:, 0]) / steps))),
            float(numpy.median(steps)),
        )
        where = f"; the unit that is {'assumed' if points.assumed else 'stated'} is wrong: write it behind the names, x [m],z [mm]"
        if furthest[high] > TALLEST:
            raise ExcitationError(
                f"{path}, line {lines[high]}: the height is more than {TALLEST:g} m from the road's median{where}"
            )
        if slope > STEEPEST:
            raise ExcitationError(f"{path}: half of the road is steeper than {slope:.3g}{where}")
        if step > LONGEST and len(x) > 10:
            raise ExcitationError(f"{path}: half of its steps are longer than {step:.3g} m, which no tire feels{where}")

    def _said(self, points: ProfilePoints, *, chosen: bool) -> list[str]:
        """Sentences on steps, line of travel, level and seam."""
        steps, lines, notes = numpy.diff(points.x), points.lines, []
        median = float(numpy.median(steps))
        long = numpy.flatnonzero(steps > GAP * median)
        if long.size:
            first = long[0]
            notes.append(
                f"{long.size} steps of x are longer than {GAP:g} times the median {median:.3g} m, the first from line "
                f"{lines[first]} to {lines[first + 1]} with {steps[first]:.3g} m; the road is straight there."
            )
        elif numpy.ptp(steps) > UNEVEN * median:
            notes.append(
                f"The points are unevenly spaced, by {steps.min():.3g} to {steps.max():.3g} m; the road is straight between them."
            )
        if points.z.shape[1] == 2 and not chosen and (points.z[:, 0] != points.z[:, 1]).any():
            notes.append(
                f"The wheel rolls on the left track; road.track_offset: {-self.track_offset:g} takes the right one."
            )
        if abs(self.removed) > ROUNDING:
            what = "the mean height" if self.level == "mean" else "the height at the first point"
            notes.append(f"{self.removed:.6g} m, {what}, was taken off all heights.")
        if self.border_u == "repeat":
            seam = float(numpy.abs(self._z[-1] - self._z[0]).max())
            notes.append(f"The road repeats every {self._x[-1]:g} m, with a step of up to {seam:.3g} m at the seam.")
        return notes

    def heights(self, x: Array, y: Array) -> Array:
        """Heights in [m], [len(x), len(y)]; ExcitationError outside of the road where the border is
        'none'.
        """
        place, outside = bring_inside(str(self.path), x + self.start, 0.0, float(self._x[-1]), self.border_u, "x", x)
        tracks = [numpy.interp(place, self._x, track) for track in self._z.T]
        if len(tracks) == 1:
            height = numpy.repeat(tracks[0][:, None], len(y), axis=1)
        else:
            left = numpy.clip((y + self.track_offset) / self.track_width + 0.5, 0.0, 1.0)
            height = tracks[0][:, None] * left + tracks[1][:, None] * (1.0 - left)
        if outside is not None:
            height[outside] = 0.0
        return height

    def refuse_steep_track(self, y: Array) -> None:
        """See borders.FileRoad."""
        rise = numpy.ptp(self._z, axis=1) * min(1.0, (y[-1] - y[0]) / self.track_width)
        worst = int(rise.argmax())
        if rise[worst] > LARGEST_RISE:
            raise ExcitationError(
                f"{self.path}, line {self._points.lines[worst]}: the road rises by {rise[worst]:.3g} m across the "
                f"{y[-1] - y[0]:.3g} m of the tire's track; allowed: {LARGEST_RISE:g} m; take one track alone"
            )

    def describe(self) -> dict[str, Any]:
        """See blocks.Surface."""
        steps = numpy.diff(self._x)
        return {
            "kind": "profile", "file": self.path.name, "format": self._points.format, "points": len(self._x),
            "tracks": self._z.shape[1], "length_m": float(self._x[-1]), "median_step_m": float(numpy.median(steps)),
            "longest_step_m": float(steps.max()), "first_distance_in_file_m": float(self._points.x[0]),
            "start_m": self.start, "track_offset_m": self.track_offset, "track_width_m": self.track_width,
            "lowest_height_in_file_m": float(self._points.z.min()), "highest_height_in_file_m": float(self._points.z.max()),
            "level": self.level, "height_removed_m": self.removed, "border_u": self.border_u, "notes": self._notes,
        }  # fmt: skip
