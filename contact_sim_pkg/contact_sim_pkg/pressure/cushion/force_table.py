"""Force and pressure maps of a cushion at evenly spaced approaches: the force law of a run, and the
map that belongs to it, from the same solutions.

A cell enters the contact as a whole, which bends the force: with cells of 10 mm its slope scatters by 1 %, up to 4 %, over
the approach and over a key of the foam. So the forces of a run are solved on cells below those of its maps, at fewer
approaches, with a cubic spline between them (`smoothed`).

The law is the monotone cubic through the forces (``laws/tabulated_elastic.py``). A map between two
nodes is the linear mixture of theirs, scaled so that it adds up to the force that acts; the loss of
a contact multiplies force and pressure alike. A map never acts back on the force.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple, Protocol

import numpy
from numpy.typing import NDArray
from scipy.interpolate import BarycentricInterpolator, CubicSpline
from scipy.optimize import brentq

from contact_sim_pkg.compiled.guards import require_positive
from contact_sim_pkg.laws import foam_columns, foam_elastic
from contact_sim_pkg.laws.parameters import TabulatedElastic
from contact_sim_pkg.laws.tabulated_elastic import tabulated_law
from contact_sim_pkg.pressure.cushion import REACH, VALID_STRAIN
from contact_sim_pkg.pressure.cushion.foam_layer import Compression, CushionError, FoamGrid
from contact_sim_pkg.pressure.kept_arrays import kept_arrays

__all__ = [
    "BELOW",
    "SPACING",
    "SPARSE",
    "Carrier",
    "ForceTable",
    "at_load",
    "between",
    "kept_table",
    "make_table",
    "smoothed",
    "without_maps",
]

Field = NDArray[numpy.float64]
SPACING = 5e-4  # [m]; the force between two nodes is then right to 4e-4
FEWEST_NODES = 3
BELOW = 2
"""Cells along a side of one of the maps, on which forces are solved."""
SPARSE = 4
"""Nodes of the table to one at which they are: so many cost no more than all of them on the cells of the maps."""
BEYOND = 1.01 * REACH  # of the foam's strain
FIRST_SOUGHT, SOUGHT_GROWTH = 0.01, 1.4  # [m], factor between approaches until the force is beyond a load


class Carrier(Protocol):
    """What carries a body: a foam layer, foam under tissue, a plate under tissue."""

    grid: FoamGrid

    @property
    def farthest(self) -> float:
        """Last approach [m] of a table."""

    def solve(self, approach: float, start: Compression | None = None) -> Compression:
        """Map and force at ``approach`` [m]."""

    def tangent(self, found: Compression) -> float:
        """Stiffness dF/d(approach) [N/m] at a solution."""


class ForceTable(NamedTuple):
    """Forces and maps at the approaches 0, ``spacing``, 2 ``spacing`` ..."""

    spacing: float  # [m]
    cell_area: float  # [m^2]
    force: Field  # [nodes] [N]
    largest_strain: Field  # [nodes]
    pressure: NDArray[numpy.float32]  # [nodes, rows, cols] [Pa]
    end: str = ""  # why the table ends before its reach; empty where it does not

    def most_force(self, valid: float = VALID_STRAIN) -> float:
        """Largest force [N] of the table at a strain within ``valid``, the range of the foam's law."""
        return float(self.force[self.largest_strain <= valid].max())

    def law(self) -> TabulatedElastic:
        """The elastic law through the forces."""
        return tabulated_law(self.spacing, self.force)

    def map_at(self, approach: float, force: float) -> Field:
        """Pressure [Pa] [rows, cols] at ``approach`` [m], whose sum times the area of a cell is
        ``force`` [N]; zeros for ``force <= 0``. Beyond the last node: its form.
        """
        if force <= 0.0:
            return numpy.zeros(self.pressure.shape[1:])
        last = len(self.force) - 1
        # a node before the first has no map to take the form of; a plate has no strain, and forces of its maps
        first = int(numpy.argmax((self.largest_strain if self.largest_strain[-1] > 0.0 else self.force) > 0.0))
        place = min(max(approach / self.spacing, float(first)), float(last))
        i = min(int(place), last - 1)
        part = place - i
        form = (1.0 - part) * self.pressure[i].astype(numpy.float64) + part * self.pressure[i + 1]
        return numpy.asarray(form * (force / (form.sum() * self.cell_area)))


def at_load(carrier: Carrier, load: float) -> Compression:
    """The solution under ``load`` [N], > 0, its approach to 1 um. Raises CushionError where the carrier does
    not take it within the range of its table.
    """
    require_positive("load", load, "N")
    far, most = FIRST_SOUGHT, carrier.farthest
    while carrier.solve(far).force < load:
        if far >= most:
            raise CushionError(f"{load:.4g} N is more than the cushion carries at {1e3 * most:.4g} mm")
        far = min(SOUGHT_GROWTH * far, most)
    approach = brentq(lambda place: carrier.solve(place).force - load, 0.0, far, xtol=1e-6)
    return carrier.solve(float(approach))


def make_table(
    layer: Carrier,
    spacing: float = SPACING,
    farthest: float | None = None,
    on_progress: Callable[[float], None] | None = None,
) -> ForceTable:
    """Table up to the farthest approach of what carries, each solution from where the two before it lead; it
    ends earlier where the contact comes too near to the edge of the cells, or foam beyond its strain.

    spacing: [m]; farthest: [m], None: that of what carries; on_progress: is handed the part done, 0 to 1.
    Raises CushionError where that is so before the third node.
    """
    require_positive("spacing", spacing, "m")
    nodes = 1 + round((layer.farthest if farthest is None else farthest) / spacing)
    most = BEYOND + spacing / layer.farthest  # the last node of foam alone lies up to half a spacing behind REACH
    force, strain = numpy.zeros(nodes), numpy.zeros(nodes)
    pressure = numpy.zeros((nodes, layer.grid.rows, layer.grid.cols), dtype=numpy.float32)
    before: Compression | None = None
    found: Compression | None = None
    end = ""
    for i in range(1, nodes):
        try:
            before, found = found, layer.solve(i * spacing, _ahead(before, found))
        except CushionError as error:
            if i < FEWEST_NODES:
                raise
            end = str(error)
            nodes = i
            break
        if found.largest_strain > most:  # with tissue above the foam
            nodes = i
            break
        force[i], strain[i], pressure[i] = found.force, found.largest_strain, found.pressure
        if on_progress is not None:
            on_progress(i / (nodes - 1))
    return ForceTable(spacing, layer.grid.cell_area, force[:nodes], strain[:nodes], pressure[:nodes], end)


def _ahead(before: Compression | None, found: Compression | None) -> Compression | None:
    """Where two solutions lead by as far again: the surface straight on, which saves a third of the steps."""
    if before is None or found is None or not before.touching.any():
        return found
    return found._replace(deflection=2.0 * found.deflection - before.deflection)


def smoothed(maps: ForceTable, forces: ForceTable) -> ForceTable:
    """The table of ``maps`` with the forces of another one, on smaller cells at fewer approaches: their cubic spline with no
    slope at the beginning, as under a round body. It ends where either does.
    """
    reach = forces.spacing * (len(forces.force) - 1)
    nodes = min(len(maps.force), int(reach / maps.spacing + 1e-9) + 1)
    spline = CubicSpline(
        forces.spacing * numpy.arange(len(forces.force)), forces.force, bc_type=("clamped", "not-a-knot")
    )
    force = numpy.maximum.accumulate(numpy.maximum(spline(maps.spacing * numpy.arange(nodes)), 0.0))
    return ForceTable(
        maps.spacing, maps.cell_area, force, maps.largest_strain[:nodes], maps.pressure[:nodes], maps.end or forces.end
    )


def without_maps(forces: ForceTable, spacing: float) -> ForceTable:
    """A table of the spline of `smoothed` through ``forces`` each ``spacing`` [m], for runs that show no map."""
    reach = forces.spacing * (len(forces.force) - 1)
    nodes = int(reach / spacing + 1e-9) + 1
    places: Field = numpy.asarray(spacing * numpy.arange(nodes), numpy.float64)
    strain = numpy.interp(places, forces.spacing * numpy.arange(len(forces.force)), forces.largest_strain)
    strain = numpy.asarray(strain, numpy.float64)
    none = numpy.zeros((nodes, 0, 0), dtype=numpy.float32)
    return smoothed(ForceTable(spacing, forces.cell_area, places, strain, none), forces)


def between(places: Field, tables: Sequence[ForceTable], place: float) -> ForceTable:
    """The table at a ``place`` of a parameter, by the polynomial through those at ``places`` (Berrut and Trefethen, SIAM Review
    46 (2004) 501), as long as the shortest of them; it has no maps.
    """
    nodes, first = min(len(each.force) for each in tables), tables[0]
    force, strain = (
        numpy.asarray(BarycentricInterpolator(places, numpy.array([values[:nodes] for values in listed]))(place))
        for listed in ([each.force for each in tables], [each.largest_strain for each in tables])
    )
    force = numpy.maximum.accumulate(numpy.maximum(force, 0.0))
    end = next((each.end for each in tables if len(each.force) == nodes and each.end), "")
    none = numpy.zeros((nodes, 0, 0), dtype=numpy.float32)
    return ForceTable(first.spacing, first.cell_area, force, strain, none, end)


def kept_table(description: str, make: Callable[[], ForceTable], directory: Path | None = None) -> ForceTable:
    """The table that ``description`` stands for, kept on disk (``kept_arrays``)."""
    laws = (Path(foam_columns.__file__), Path(foam_elastic.__file__))
    sources = (*sorted(Path(__file__).parent.glob("*.py")), *laws)
    found = kept_arrays("cushions", description, sources, lambda: make()._asdict(), directory)
    spacing, cell_area = (float(found.pop(name)) for name in ("spacing", "cell_area"))
    return ForceTable(spacing, cell_area, end=str(found.pop("end")), **found)
