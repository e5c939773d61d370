"""Field of a tire on half as many rows and columns: between published fields its force and the offset of the fine one.

Between two published fields the bodies need the force of the field, not its map. That of a grid of half as many
cells each way differs by an offset that hardly moves: on a rough road it scatters by 2e-4 of the largest force from one
place to the next. So where the fine field is published the coarse one is solved as well, and up to the next
published field it alone, with the mean offset.

The coarse grid has the extent of the wide one, so no contact leaves it that the fine grids hold, and each second node of
the road: always the same ones, with the heights that they have. Means of four nodes, or the stiffness of the fine grid
averaged, scatter as much or more (decision 0044).
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.laws.parameters import ElasticLaw, TabulatedElastic
from contact_sim_pkg.pressure.field.patch import contact_area
from contact_sim_pkg.pressure.settings import FieldSettings
from contact_sim_pkg.records.state import State
from contact_sim_pkg.rigs.vehicle.field.contact_field import FieldError, PressureField, approach_at
from contact_sim_pkg.rigs.vehicle.tire.body import TireForm
from contact_sim_pkg.rigs.vehicle.tire.footprint import level_under, mean_slope, tire_gap
from contact_sim_pkg.rigs.vehicle.tire.model import TireGeometry

__all__ = ["CoarseLevel", "LevelSolution", "can_be_halved", "halved", "slope_under"]

TIMES = 2
"""Cells of the fine grid along a side of one of the coarse grid."""

LEAST_HALF = 8
"""Rows and columns of a grid of half as many cells: with fewer it says nothing of the other."""

MARGIN = 8
"""Cells of the fine grid by which the coarse one extends further on each side."""

LOOSER_SIDEWALLS = 3.0
"""Times what the sidewalls of a field may miss of the depth. The height takes the mean of it off, the next solution
the rest: a second pass at each instant would cost as much as the first.
"""

SHARE, UNLUCKY, NEWEST = 0.65, 3.0, 0.125
"""Part of the allowed error that the offset of a place may miss, largest miss over the root mean square, weight of the
newest in that square.
"""

FEWEST_BETWEEN, NEWEST_COUNT = 1.5, 0.125
"""Solutions from one published field to the next that pay for the coarse one beside each, and weight of the newest number
in their mean.
"""

NEWEST_OFFSET = 0.25
"""Weight of the newest offset in their mean: from one published field to the next they scatter about it, which the last
one alone would double.
"""


class LevelSolution(NamedTuple):
    """What a field means for the bodies."""

    height: float  # [m] at which the contact's law has its force
    slope: float  # [1] of the even ground with the same longitudinal force
    exact: float | None = None  # [m] the height where it rests on level road alone


def halved(settings: FieldSettings) -> FieldSettings:
    """The grid of half as many cells each way on the same extent; its rows and columns are even."""
    return settings._replace(
        rows=settings.rows // TIMES, cols=settings.cols // TIMES, cell_x=TIMES * settings.cell_x, cell_y=TIMES * settings.cell_y
    )  # fmt: skip


def can_be_halved(settings: FieldSettings) -> bool:
    """Whether half as many cells each way are whole ones, and enough to see a contact."""
    sides = settings.rows, settings.cols
    return not any(side % TIMES for side in sides) and min(sides) >= TIMES * LEAST_HALF


def slope_under(form: TireForm, field: PressureField, pressure: NDArray[numpy.float64], origin: float) -> float:
    """Effective slope [1] under a ``pressure`` [Pa] on the grid of a field whose row 0 lies ``origin`` [m] before the
    wheel's centre: see `RoadField.effective_slope`.
    """
    settings, softening = field.settings, field.softening
    slope = mean_slope(form, pressure, origin, settings.cell_x)
    return slope if softening is None else slope + softening.climb(pressure, settings.cell_y) / settings.cell_x


class CoarseLevel:
    """Solve it ``at`` a place beside each published field, ``renew`` the offset, and add it between them (``with_offset``)."""

    STATE = State((), ("field", "_offset", "_square", "_between", "_usual_between", "peak_differs", "area_differs"))

    def __init__(self, usual: FieldSettings, contact: str, geometry: TireGeometry, allowed: float) -> None:
        """Make the level of a field with a ``usual`` grid; its offset may move by a part of an ``allowed`` height [m]."""
        self._fine = usual._replace(rows=usual.rows + 2 * MARGIN, cols=usual.cols + 2 * MARGIN)
        self.field = PressureField(halved(self._fine), contact)
        self.field.looser_sidewalls = LOOSER_SIDEWALLS
        self._geometry, self._most = geometry, SHARE * allowed
        self._gap = numpy.empty((self.field.settings.rows, self.field.settings.cols))
        self.reset()

    def reset(self) -> None:
        """Drop solutions and offset."""
        self.field.reset()
        self._offset: LevelSolution | None = None  # fine less coarse, mean of published fields
        self._square = math.nan  # mean of what it missed squared [m^2]
        self._between, self._usual_between = (
            0,
            FEWEST_BETWEEN,
        )  # solutions since the last published field, and their mean
        self.peak_differs = self.area_differs = 0.0  # [Pa], [m^2] of fine and coarse field at the last published one

    @property
    def is_quiet(self) -> bool:
        """Whether the offset is known, and misses so little that the coarse field will do."""
        return self._offset is not None and self.is_worth and UNLUCKY * math.sqrt(self._square) <= self._most

    @property
    def is_worth(self) -> bool:
        """Whether so many fields lie between published ones that coarse ones save more than those beside these cost."""
        return self._usual_between >= FEWEST_BETWEEN

    def count(self, *, is_published: bool) -> None:
        """Count a solution of the run."""
        if not is_published:
            self._between += 1
            return
        self._usual_between += NEWEST_COUNT * (self._between - self._usual_between)
        self._between = 0

    def at(self, road: Any, travel: float, approach: float, law: ElasticLaw) -> LevelSolution | None:
        """Solve at an ``approach`` [m] with the wheel at ``travel`` [m]; None where the coarse field does not carry, or
        cannot be solved: the fine one will say why.
        """
        fine, form = self._fine, self._geometry.form
        row = round(travel / fine.cell_x) - fine.rows // 2
        row -= row % TIMES
        if not tire_gap(road.height, road.first_row, fine.cell_x, fine.cell_y, form, row, travel, TIMES, self._gap):
            return None
        origin = row * fine.cell_x - travel
        try:
            self.field.roll_to(row // TIMES, origin)
            load = self.field.solve(self._gap, approach)
        except FieldError:
            self.field.reset()
            return None
        if load <= 0.0:
            return None
        slope = slope_under(form, self.field, self.field.pressure, origin)
        level = self._level_height(road, row) if isinstance(law, TabulatedElastic) else None
        exact = None if level is None else approach + level
        return LevelSolution(approach_at(law, load) - self.field.unsettled, slope, exact)

    def with_offset(self, coarse: LevelSolution) -> LevelSolution:
        """A ``coarse`` solution with the offset, of the fine field between published ones."""
        if coarse.exact is not None:
            return LevelSolution(coarse.exact, 0.0)
        assert self._offset is not None
        return LevelSolution(coarse.height + self._offset.height, coarse.slope + self._offset.slope)

    def compare(self, pressure: NDArray[numpy.float64]) -> None:
        """Compare largest pressure and area of the fine field's ``pressure`` [Pa] with those of the coarse one there."""
        coarse, cell = self.field.pressure, self._fine.cell_x * self._fine.cell_y
        # Cells count alone: their shape does not matter to the share of them that an edge leaves out
        areas = contact_area(pressure, 1.0, cell), contact_area(coarse, 1.0, TIMES**2 * cell)
        self.peak_differs = abs(float(coarse.max()) - float(pressure.max()))
        self.area_differs = abs(areas[0] - areas[1])

    def renew(self, fine: LevelSolution, coarse: LevelSolution) -> float:
        """Take the offset of a published field; returns by how much [m] the one so far misses it, 0 at first."""
        height, slope, so_far = fine.height - coarse.height, fine.slope - coarse.slope, self._offset
        if so_far is None:
            self._offset = LevelSolution(height, slope)
            return 0.0
        missed, square = height - so_far.height, self._square
        self._square = missed**2 if math.isnan(square) else square + NEWEST * (missed**2 - square)
        self._offset = LevelSolution(
            so_far.height + NEWEST_OFFSET * missed, so_far.slope + NEWEST_OFFSET * (slope - so_far.slope)
        )
        return abs(missed)

    def _level_height(self, road: Any, row: int) -> float | None:
        """As `RoadField.level_height`, under the coarse cells."""
        middle, cols = row - road.first_row + self._fine.rows // 2, road.height.shape[1]
        if road.height[middle, cols // 2] != road.height[middle + 1, cols // 2]:
            return None
        pressure = numpy.repeat(numpy.repeat(self.field.pressure, TIMES, axis=0), TIMES, axis=1)
        level = level_under(road.height, row - road.first_row, (cols - pressure.shape[1]) // 2, pressure)
        return None if math.isnan(level) else level
