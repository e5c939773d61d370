"""From the numbers of an OpenCRG file to a grid of heights over (u, v): reference line, banking,
slope, missing cells."""

from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.opencrg.header import Header
from contact_sim_pkg.excitation.opencrg.layout import CrgLayout

ROWS_AT_ONCE = 1024
TALLEST = 1e3  # [m] heights of one road differ by less than this from their median


class Grid(NamedTuple):
    """Heights over the reference line's own coordinates."""

    u_start: float  # [m]
    u_increment: float  # [m]
    v: NDArray[numpy.float64]  # [m]
    height: NDArray[numpy.float64]  # [rows, long sections], [m]
    missing: int  # cells without a measured height
    heading_change: float  # [rad] of the reference line from start to end
    # Largest |curvature v|: a path beside the reference line is longer or shorter by this part
    largest_stretch: float


def make_grid(header: Header, layout: CrgLayout, values: NDArray[numpy.float64], scale_z: float = 1.0) -> Grid:
    """Raw heights with banking and slope of the reference line added; missing cells are still NaN.

    height(u, v) = scale_z z(u, v) + banking(u) v + start_z + integral of slope du

    `values` [rows, channels] holds heights [m] and channels of the reference line; it is worked on
    in place, so that the road is in memory once. scale_z: [1].

    Raises `ExcitationError` for absurd heights, a reference line that bends so sharply that the
    grid overlaps itself, or an end of the reference line that disagrees with the header.
    """
    first, last = layout.section_columns[0], layout.section_columns[-1]
    together = last - first + 1 == len(layout.section_columns)
    height = values[:, first : last + 1] if together else values[:, list(layout.section_columns)]
    missing = int(numpy.isnan(height).sum())
    if missing == height.size:
        raise ExcitationError(f"{header.file}: all {height.size} cells of the road are missing")
    _refuse_absurd(header, height)
    heading, banking = _heading(header, layout, values), _banking(header, layout, values)
    elevation = _elevation(header, layout, values)
    for start in range(0, len(height), ROWS_AT_ONCE):
        rows = slice(start, start + ROWS_AT_ONCE)
        height[rows] *= scale_z
        height[rows] += banking[rows, None] * layout.v
        height[rows] += elevation[rows, None]
    scale = _largest_scale(header, layout, heading)
    return Grid(
        layout.u_start, layout.u_increment, layout.v, height, missing, float(heading[-1] - heading[0]), scale
    )  # fmt: skip


def _refuse_absurd(header: Header, height: NDArray[numpy.float64]) -> None:
    median = float(numpy.nanmedian(height))
    furthest = max(float(numpy.nanmax(height)) - median, median - float(numpy.nanmin(height)))
    if not furthest <= TALLEST or abs(median) > 1e5:
        distance = numpy.abs(height - median)
        row, section = divmod(int(numpy.nanargmax(distance)), height.shape[1])
        raise ExcitationError(
            f"{header.file}: the height in row {row + 1}, long section {section + 1} is {height[row, section]:.6g} m, "
            f"more than {TALLEST:g} m from the road's median {median:.6g} m; the data is damaged or "
            "in another unit"
        )


def _column(
    header: Header, layout: CrgLayout, values: NDArray[numpy.float64], name: str, first: int
) -> NDArray[numpy.float64] | None:
    """A channel of the reference line; its rows before `first` are unused in the format."""
    if name not in layout.reference_columns:
        return None
    column = values[:, layout.reference_columns[name]].copy()
    column[:first] = column[first]
    wrong = numpy.flatnonzero(~(numpy.abs(column) < 1e3))
    if wrong.size:
        raise ExcitationError(
            f"{header.file}: {name} of the reference line in row {wrong[0] + 1} is {column[wrong[0]]}; a number was "
            "expected"
        )
    return column


def _stated(header: Header, what: str) -> tuple[float | None, float | None]:
    start, end = (header.road.get(f"reference_line_{part}_{what}") for part in ("start", "end"))
    return None if start is None else start.number, None if end is None else end.number


def _agree(
    header: Header, what: str, place: str, stated: float | None, found: float, tolerance: float, unit: str
) -> None:
    if stated is not None and abs(stated - found) > tolerance:
        key = f"reference_line_{place}_{what}"
        raise ExcitationError(
            f"{header.file}, line {header.road[key].line}: {key.upper()} says {stated:.9g} {unit}, the data says "
            f"{found:.9g} {unit}; they must agree within {tolerance:.2g} {unit}"
        )


def _heading(header: Header, layout: CrgLayout, values: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
    """Heading in [rad] of each part of the reference line (part i ends in row i), checked against
    the header's ends."""
    start, end = _stated(header, "phi")
    column = _column(header, layout, values, "phi", 1)
    if column is None:
        column = numpy.full(len(values), start or 0.0)
    # Heading without jumps, checked against the header.
    heading = numpy.asarray(numpy.unwrap(column), dtype=numpy.float64)
    for place, stated, found in (("start", start, heading[0]), ("end", end, heading[-1])):
        if stated is not None:
            _agree(
                header,
                "phi",
                place,
                stated,
                found - 2.0 * numpy.pi * round((found - stated) / (2.0 * numpy.pi)),
                1e-3,
                "rad",
            )
    # Position at the end by summing the parts.
    parts = layout.u_increment * numpy.exp(1j * heading[1:])
    travelled = complex(parts.sum())
    tolerance = 0.01 + 1e-3 * layout.u_increment * len(heading)
    for what, part in (("x", travelled.real), ("y", travelled.imag)):
        first, last = _stated(header, what)
        if first is not None and last is not None:
            _agree(header, what, "end", last, first + part, tolerance, "m")
    return heading


def _banking(header: Header, layout: CrgLayout, values: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
    start, end = _stated(header, "b")
    column = _column(header, layout, values, "banking", 0)
    if column is None:
        column = numpy.full(len(values), start or 0.0)
    _agree(header, "b", "start", start, float(column[0]), 1e-4, "m/m")
    _agree(header, "b", "end", end, float(column[-1]), 1e-4, "m/m")
    return column


def _elevation(header: Header, layout: CrgLayout, values: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
    """Height in [m] of the reference line: start_z and the integral of the slope, checked against
    end_z.
    """
    start, end = _stated(header, "s")
    column = _column(header, layout, values, "slope", 1)
    if column is None:
        column = numpy.full(len(values), start or 0.0)
    _agree(header, "s", "start", start, float(column[0]), 1e-4, "m/m")
    _agree(header, "s", "end", end, float(column[-1]), 1e-4, "m/m")
    start_z, end_z = _stated(header, "z")
    climbed = numpy.concatenate((numpy.zeros(1), numpy.cumsum(column[1:])))
    elevation = numpy.asarray((start_z or 0.0) + layout.u_increment * climbed, dtype=numpy.float64)
    _agree(header, "z", "end", end_z, float(elevation[-1]), 0.01 + 1e-3 * layout.u_increment * len(values), "m")
    return elevation


def _largest_scale(header: Header, layout: CrgLayout, heading: NDArray[numpy.float64]) -> float:
    curvature = numpy.diff(heading[1:], prepend=heading[1]) / layout.u_increment
    reach = numpy.maximum(
        curvature * layout.v[0], curvature * layout.v[-1]
    )  # 1 where the inner edge does not move forward
    worst = int(numpy.argmax(reach))
    if reach[worst] >= 1.0:
        raise ExcitationError(
            f"{header.file}: in row {worst + 2} the reference line bends by {curvature[worst]:.4g} 1/m, so long "
            f"sections up to {layout.v[0] if curvature[worst] < 0 else layout.v[-1]:g} m beside it overlap; the bend "
            "times the distance must stay below 1"
        )
    return float(numpy.abs(curvature).max(initial=0.0) * numpy.abs(layout.v).max())


def fill_missing(height: NDArray[numpy.float64]) -> None:
    """Replace missing cells in place: linear along each cross section, its outermost value kept to
    the edge; empty cross sections linear along u between their neighbours.

    height: [rows, cols] [m], NaN where missing.
    """
    sections = numpy.arange(height.shape[1])
    holes = numpy.isnan(height)
    some = holes.any(axis=1)
    empty = holes.all(axis=1)
    for row in numpy.flatnonzero(some & ~empty):
        known = ~holes[row]
        height[row, ~known] = numpy.interp(sections[~known], sections[known], height[row, known])
    if empty.any():
        rows = numpy.arange(len(height))
        for section in sections:
            height[empty, section] = numpy.interp(rows[empty], rows[~empty], height[~empty, section])
