"""Force, contact and footprint of an inflated tire on a level road, at evenly spaced approaches: the
force law of a run, and the weights that it sees a road with.

Every approach is a solution of the pressure field on cells of 2.5 mm (for 205/55 R16). The table
follows from the tire alone, so it is kept on disk. On a level road the law *is* the field; on any
other it stands for it between two solutions.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.laws.parameters import TabulatedElastic
from contact_sim_pkg.laws.tabulated_elastic import tabulated_approach_of_force, tabulated_law
from contact_sim_pkg.pressure.field import extent, patch
from contact_sim_pkg.pressure.kept_arrays import kept_arrays
from contact_sim_pkg.pressure.settings import FieldSettings
from contact_sim_pkg.rigs.vehicle.field import inflated_belt, sidewalls
from contact_sim_pkg.rigs.vehicle.field.contact_field import FieldError, PressureField
from contact_sim_pkg.rigs.vehicle.tire.body import TireBody, TireForm
from contact_sim_pkg.rigs.vehicle.tire.footprint import RANGE

__all__ = ["Footprint", "TireTable", "footprint_of", "gap_over_level_road", "tire_table"]

Field = NDArray[numpy.float64]
SPACING = 5e-4  # [m] between two approaches
DEEPEST = 0.06  # [m]; beyond it the law is a straight line
ROWS, COLS = 108, 72  # cells of the body's extent; the table's grid is half as long again
TOLERANCE, ITERATIONS = 1e-6, 400
MAP_EVERY = 4  # approaches from one kept footprint to the next


class Footprint(NamedTuple):
    """Contact of a tire on a level road."""

    length: float  # [m] along the travel
    width: float  # [m] across
    area: float  # [m^2]


class TireTable(NamedTuple):
    """Forces [N] at the approaches 0, ``spacing``, 2 ``spacing`` ... [m] of a level road."""

    spacing: float  # [m]
    force: Field  # [nodes] [N]
    size: Field  # [nodes, 3] length along, width across [m], area [m^2] of the contact, in whole cells
    edges: Field  # [nodes, 3] the same with the edges between cells
    cell: Field  # [2] [m] of the footprints, along and across
    quarters: NDArray[numpy.float32]
    """[nodes / MAP_EVERY, rows, cols] [Pa] footprints, the quarter x, y >= 0: cell (i, j) at (i, j +
    1/2) cells
    """

    def law(self) -> TabulatedElastic:
        """The elastic law through the forces."""
        return tabulated_law(self.spacing, self.force)

    def contact_at(self, load: float) -> tuple[float, float, float]:
        """Length along, width across [m] and area [m^2] of the contact under a ``load`` [N], in whole cells."""
        return self._at(load, self.size)

    def footprint_at(self, load: float) -> Footprint:
        """The footprint under a ``load`` [N], its edges between cells."""
        return Footprint(*self._at(load, self.edges))

    def _at(self, load: float, columns: Field) -> tuple[float, float, float]:
        """Three ``columns`` [nodes, 3] under a ``load`` [N], linear between the nodes."""
        place = tabulated_approach_of_force(self.law(), load) / self.spacing
        nodes = numpy.arange(len(self.force))
        first, second, third = (float(numpy.interp(place, nodes, column)) for column in columns.T)
        return first, second, third

    def weights(self, load: float, cells: tuple[float, float], cols: int) -> Field:
        """Weights of the road under a ``load`` [N] on its nodes, [2 reach + 1, cols], of sum 1; see
        ``footprint.py``.

        cells: their spacing [m] along and across; the middle of rows and of ``cols`` lies under the
        wheel.
        """
        deepest = (len(self.quarters) - 1) * MAP_EVERY * self.spacing
        approach = min(tabulated_approach_of_force(self.law(), load), deepest / (1.0 + RANGE))
        more, less = self._quarter((1.0 + RANGE) * approach), self._quarter((1.0 - RANGE) * approach)
        rows = numpy.flatnonzero(more.any(axis=1))
        reach = int((rows[-1] + 1) * self.cell[0] / cells[0]) + 1
        x = abs(numpy.arange(2 * reach + 1) - reach) * cells[0] / self.cell[0]
        y = abs(numpy.arange(cols) - 0.5 * (cols - 1)) * cells[1] / self.cell[1] - 0.5
        found = _between(_between(more - less, x).T, y).T
        return numpy.ascontiguousarray(found / found.sum())

    def quarter_at(self, load: float) -> Field:
        """Quarter x, y >= 0 of the footprint [Pa] under a ``load`` [N], on cells of ``cell``; linear between two that are
        kept.
        """
        return self._quarter(tabulated_approach_of_force(self.law(), load))

    def _quarter(self, approach: float) -> Field:
        """Quarter of the footprint [Pa] at an ``approach`` [m]."""
        place = approach / self.spacing / MAP_EVERY
        i = min(int(place), len(self.quarters) - 2)
        part = min(place - i, 1.0)
        return numpy.asarray((1.0 - part) * self.quarters[i].astype(numpy.float64) + part * self.quarters[i + 1])


def footprint_of(pressure: Field, cell_x: float, cell_y: float) -> Footprint:
    """Footprint of a ``pressure`` [rows, cols] [Pa] on cells of ``cell_x`` by ``cell_y`` [m], its edges where the square
    of the pressure comes to 0; zeros without contact.
    """
    length, width = extent.extent(pressure) * cell_x, extent.extent(pressure.T) * cell_y
    return Footprint(length, width, float(patch.contact_area(pressure, cell_x, cell_y)))


def _between(values: Field, place: Field) -> Field:
    """Rows of ``values`` at places between them, linear; zeros beyond the last."""
    low = numpy.clip(numpy.floor(place).astype(numpy.int64), 0, len(values) - 2)
    part = numpy.clip(place - low, 0.0, 1.0)[:, None]
    found = (1.0 - part) * values[low] + part * values[low + 1]
    return numpy.asarray(numpy.where(place[:, None] <= len(values) - 1, found, 0.0))


def gap_over_level_road(form: TireForm, x: NDArray[numpy.floating[Any]], y: NDArray[numpy.floating[Any]]) -> Field:
    """Gap [m] [rows, cols] of the unloaded tire, its lowest point on a level road, or on the top of the form's drum,
    at x [rows], y [cols] [m].
    """
    if form.circular:
        along = form.radius_rolling - numpy.sqrt(numpy.maximum(form.radius_rolling**2 - x**2, 0.0))
    else:
        along = 0.5 * x**2 / form.radius_rolling
    if form.drum > 0.0:
        along = along + x**2 * form.drum / (1.0 + numpy.sqrt(numpy.maximum(1.0 - (form.drum * x) ** 2, 0.0)))
    across = 0.5 * y**2 / form.radius_lateral + form.shoulder * (y / form.half_width) ** 6
    return numpy.asarray(along[:, None] + across[None, :])


def tire_table(body: TireBody, solver: type | None = None) -> TireTable:
    """The table of a body, kept on disk; not so with another ``solver`` of a half-space."""
    if solver is not None:
        return _make(body, solver)
    sources = [__file__, inflated_belt.__file__, sidewalls.__file__, extent.__file__, patch.__file__]
    arrays = kept_arrays("tires", repr(body), sources, lambda: _make(body)._asdict())
    arrays["spacing"] = float(arrays["spacing"])  # type: ignore[assignment]
    return TireTable(**arrays)  # type: ignore[arg-type]


def _make(body: TireBody, solver: type | None = None) -> TireTable:
    """Solve approach after approach, each from the one before, until the contact comes to the edge."""
    assert body.extent is not None
    cell_x, cell_y = body.extent[0] / ROWS, body.extent[1] / COLS
    rows, cols = ROWS + ROWS // 2, COLS + COLS // 2
    settings = FieldSettings(rows, cols, cell_x, cell_y, body.modulus, TOLERANCE, ITERATIONS, 0, body.belt)
    middle_row, middle_col = rows // 2, cols // 2
    x, y = (numpy.arange(rows) - middle_row) * cell_x, (numpy.arange(cols) - 0.5 * (cols - 1)) * cell_y
    gap, field = gap_over_level_road(body.form, x, y), PressureField(settings._replace(solver=solver), "tire")
    force, size, edges = [0.0], [(0.0, 0.0, 0.0)], [Footprint(0.0, 0.0, 0.0)]
    quarters: list[Field] = [numpy.zeros((rows - middle_row, cols - middle_col))]
    for node in range(1, round(DEEPEST / SPACING) + 1):
        try:
            load = field.solve(gap, node * SPACING)
        except FieldError:
            break
        if load <= force[-1] and load > 0.0:  # sidewalls on a soft ring give way: the law ends before
            break
        loaded = field.pressure > 0.0
        force.append(load)
        size.append(
            (loaded.any(axis=1).sum() * cell_x, loaded.any(axis=0).sum() * cell_y, loaded.sum() * cell_x * cell_y)
        )
        edges.append(footprint_of(field.pressure, cell_x, cell_y))
        if node % MAP_EVERY == 0:
            quarters.append(field.pressure[middle_row:, middle_col:].copy())
    return TireTable(
        SPACING, numpy.array(force), numpy.array(size), numpy.array(edges), numpy.array([cell_x, cell_y]),
        numpy.array(quarters, dtype=numpy.float32),
    )  # fmt: skip
