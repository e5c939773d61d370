"""Soft tissue between the pressing body and what carries it: columns that stiffen as they are
compressed.

``p = A (exp(c/c0) - 1)`` is the pressure at the compression c [m] of a column, ``c(p) = c0 log(1 +
p/A)`` its inverse. ``pan_gap`` is the form of a body that a reference cushion has pressed already
by the map p_ref, so the form without load lies lower by ``c(p_ref)``; with it the body has its old
form on the reference, and spreads on whatever is harder.

Under a rigid plate the columns alone carry: the map is closed. On foam the two act in series,

``minimise  sum(h U(w/h) + 1/2 c w R*w + V((delta - g - w)+)) A``,  V(c) the energy of a column,

so that ``sigma(w/h) + c R*w = A (exp((delta - g - w)+/c0) - 1)``, the pressure that both see.
Newton's method with halved steps: the energy is convex. No flow of tissue sideways: the peak over a
bone on a plate is too high, and that on firm foam too low.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.guards import require, require_fields, require_values
from contact_sim_pkg.laws.parameters import LayerFoam
from contact_sim_pkg.pressure.cushion.foam_layer import Compression, CushionError, FoamGrid, FoamLayer

__all__ = ["PlateUnderTissue", "Tissue", "TissueOnFoam", "form_without_load"]

Field = NDArray[numpy.float64]
MOST_DEPTHS = 4.5
"""Largest compression of a table over c0: 89 times A, five times what people meet on a plate."""
TOLERANCE = 1e-9  # of the largest pressure: difference of the two pressures that is left
INNER_TOLERANCE = 1e-6  # of a Newton step's residual
MOST_STEPS, LEAST_PART = 100, 1e-6  # of Newton; least part of a step


class Tissue(NamedTuple):
    """Columns of tissue, p = A (exp(c/c0) - 1)."""

    pressure: float = 2.0e3  # A [Pa], > 0
    depth: float = 0.01  # c0 [m], > 0

    def pressure_at(self, compression: Field) -> Field:
        """Pressure [Pa] at a compression [m], 0 below 0."""
        return numpy.asarray(self.pressure * numpy.expm1(numpy.maximum(compression, 0.0) / self.depth))

    def compression_at(self, pressure: Field) -> Field:
        """Compression [m] at a pressure [Pa], >= 0."""
        return numpy.asarray(self.depth * numpy.log1p(pressure / self.pressure))

    def slope_at(self, compression: Field) -> Field:
        """dp/dc [Pa/m] at a compression [m], 0 below 0."""
        return numpy.where(compression > 0.0, (self.pressure_at(compression) + self.pressure) / self.depth, 0.0)

    def energy_at(self, compression: Field) -> Field:
        """Energy [J/m^2] of a column."""
        return numpy.asarray(
            self.depth * self.pressure_at(compression) - self.pressure * numpy.maximum(compression, 0.0)
        )


def form_without_load(gap: Field, tissue: Tissue, reference: Field) -> Field:
    """Gap [m] of the body without load over its lowest point, from the ``gap`` [rows, cols] [m] that it has
    under the map ``reference`` [rows, cols] [Pa], >= 0.
    """
    _require_tissue(tissue)
    require_values("reference map", reference, "Pa", shape=gap.shape, least=0.0)
    form = gap - tissue.compression_at(reference)
    return numpy.asarray(form - form.min())


class PlateUnderTissue:
    """A rigid plate under the tissue of a body: one closed map at each approach."""

    def __init__(self, grid: FoamGrid, gap: Field, tissue: Tissue) -> None:
        """``gap``: [rows, cols] [m] of the body without load. Raises ValueError outside the range."""
        _require_tissue(tissue)
        self.grid, self.tissue = grid, tissue
        self.gap = require_values("gap", gap, "m", shape=(grid.rows, grid.cols))

    @property
    def farthest(self) -> float:
        """Last approach [m] of a table."""
        return MOST_DEPTHS * self.tissue.depth

    def solve(self, approach: float, start: Compression | None = None) -> Compression:
        """The map at ``approach`` [m]; a plate has no deflection and no strain."""
        compressed = require("approach", approach, "m") - self.gap
        pressure = self.tissue.pressure_at(compressed)
        force = float(pressure.sum()) * self.grid.cell_area
        return Compression(approach, numpy.zeros_like(pressure), pressure, compressed > 0.0, force, 0.0, 0, 0)

    def tangent(self, found: Compression) -> float:
        """Stiffness dF/d(approach) [N/m] at a solution."""
        return float(self.tissue.slope_at(found.approach - self.gap).sum()) * self.grid.cell_area

    def energy(self, found: Compression) -> float:
        """Energy [J] stored at a solution."""
        return float(self.tissue.energy_at(found.approach - self.gap).sum()) * self.grid.cell_area


class TissueOnFoam(FoamLayer):
    """Foam layer under a body with tissue, two springs in series at each cell."""

    def __init__(
        self, grid: FoamGrid, foam: LayerFoam, gap: Field, tissue: Tissue, shear_share: float = 0.3, *,
        inextensible: bool = False,
    ) -> None:  # fmt: skip
        """As ``FoamLayer``; ``gap``: [rows, cols] [m] of the body without load."""
        super().__init__(grid, foam, gap, shear_share, inextensible=inextensible)
        _require_tissue(tissue)
        self.tissue = tissue

    @property
    def farthest(self) -> float:
        """Last approach [m] of a table."""
        return super().farthest + MOST_DEPTHS * self.tissue.depth

    def solve(self, approach: float, start: Compression | None = None) -> Compression:
        """Foam and tissue at ``approach`` [m], from the solution ``start`` near it where there is one.

        Raises CushionError where the contact comes within 50 mm of the edge of the cells, or the
        solver does not end.
        """
        bound = (
            require("approach", approach, "m", most=self.foam.thickness + 2.0 * MOST_DEPTHS * self.tissue.depth)
            - self.gap
        )
        if (bound <= 0.0).all():
            return Compression(approach, self._zero, self._zero, numpy.zeros_like(bound, dtype=bool), 0.0, 0.0, 0, 0)
        w = numpy.clip(0.5 * bound, 0.0, 0.5 * self.foam.thickness) if start is None else start.deflection.copy()
        everywhere = numpy.ones_like(w, dtype=bool)
        steps = inner_steps = 0
        left = self._left(w, bound)
        while numpy.abs(left).max() > TOLERANCE * self.tissue.pressure_at(bound - w).max():
            if steps == MOST_STEPS:
                raise CushionError(f"cushion at {1e3 * approach:.4g} mm: no solution after {MOST_STEPS} steps")
            steps += 1
            stiffness = self._stiffness(w) + self.tissue.slope_at(bound - w)
            step, inner = self._free_step(stiffness, everywhere, -left, INNER_TOLERANCE)
            inner_steps += inner
            w, left = self._moved(w, step, bound, float(numpy.linalg.norm(left)))
        pressure = self.tissue.pressure_at(bound - w)
        touching = bound > w
        self._refuse_edge(touching, approach)
        strain = float(w.max()) / self.foam.thickness
        force = float(pressure.sum()) * self.grid.cell_area
        return Compression(approach, w, pressure, touching, force, strain, steps, inner_steps)

    def tangent(self, found: Compression) -> float:
        """Stiffness dF/d(approach) [N/m] at a solution, by one linear solve."""
        slope = self.tissue.slope_at(found.approach - self.gap - found.deflection)
        moved, _inner = self._free_step(
            self._stiffness(found.deflection) + slope, numpy.ones_like(found.touching), slope, 1e-10
        )
        return float((slope * (1.0 - moved)).sum()) * self.grid.cell_area

    def energy(self, found: Compression) -> float:
        """Energy [J] stored in foam and tissue at a solution."""
        compressed = found.approach - self.gap - found.deflection
        return super().energy(found) + float(self.tissue.energy_at(compressed).sum()) * self.grid.cell_area

    def _left(self, w: Field, bound: Field) -> Field:
        """Pressure of the foam less that of the tissue [Pa]."""
        return self._pressure(w) - self.tissue.pressure_at(bound - w)

    def _moved(self, w: Field, step: Field, bound: Field, before: float) -> tuple[Field, Field]:
        """The deflection after the part of a step that lowers what is left, and what is left there."""
        part = 1.0
        while True:
            there = numpy.minimum(w + part * step, 0.99 * self.foam.thickness)
            left = self._left(there, bound)
            if numpy.linalg.norm(left) < before or part < LEAST_PART:
                return there, left
            part *= 0.5


def _require_tissue(tissue: Tissue) -> None:
    require_fields("tissue", tissue, positive="pressure depth")
