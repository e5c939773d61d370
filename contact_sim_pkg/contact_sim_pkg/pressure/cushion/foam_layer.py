"""Contact of a rigid body with a foam layer on a rigid base: nonlinear columns in parallel with the
linear remainder of the bonded layer.

With the deflection w [m] of the top, the strain ``e = w/h`` and the body's gap g at the approach
delta:

``minimise  sum(h U(w/h) + 1/2 c w R*w) A  subject to  w >= delta - g``,

U the energy density of the foam under an even load (``laws/foam_columns.py``), A the area of a
cell, ``R = 1/K - E_i/h >= 0`` in wave numbers, K the influence function of the layer
(``bonded_layer.py``, nu = 0, modulus E_i, that of the foam at first contact). ``p = sigma(w/h) + c
R*w`` is the pressure where the body touches and 0 elsewhere. Small strains with c = 1 are the
bonded layer, an even load is the foam's own law at any c. c is the share of the shear stiffness
that buckled foam keeps: 0.3 has an indentation force of 1.42 times area by stress at 40 %
(usual 1.25 to 1.45), a choice of this project in the form of Pasternak's two-parameter bed.
Unbuckled foam beside the body bulges: ``sigma = E_i e`` for e < 0.

Solver: primal-dual active set (Hintermueller, Ito, Kunisch 2002) around Newton's method, conjugate
gradients with one FFT pair as preconditioner. The box is periodic: a contact that comes near its
edge is refused.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy
from numpy.typing import NDArray
from scipy import fft

from contact_sim_pkg.compiled.guards import require, require_count, require_positive, require_values
from contact_sim_pkg.laws.foam_columns import columns_of
from contact_sim_pkg.laws.parameters import LayerFoam
from contact_sim_pkg.pressure.cushion import REACH
from contact_sim_pkg.pressure.cushion.bonded_layer import layer_influence

__all__ = ["Compression", "CushionError", "FoamGrid", "FoamLayer"]

Field = NDArray[numpy.float64]
Cells = NDArray[numpy.bool_]
EDGE = 0.05  # [m] of free cells that a contact needs around it
TOLERANCE = 1e-9  # of the largest pressure: what is left where nothing touches
INNER_TOLERANCE = 1e-4  # of a Newton step's residual
MOST_STEPS = 200
MOST_INNER_STEPS = 500


class CushionError(ValueError):
    """A contact that the layer cannot have: at the edge of its cells, or beyond its strain."""


class FoamGrid(NamedTuple):
    """Cells of a cushion's top."""

    rows: int  # along x
    cols: int  # along y
    cell_x: float  # [m]
    cell_y: float  # [m]

    @property
    def cell_area(self) -> float:
        """In [m^2]."""
        return self.cell_x * self.cell_y


class Compression(NamedTuple):
    """A solution at one approach."""

    approach: float  # [m]
    deflection: Field  # [rows, cols] [m]
    pressure: Field  # [rows, cols] [Pa], 0 without contact
    touching: Cells  # [rows, cols]
    force: float  # [N]
    largest_strain: float
    newton_steps: int
    inner_steps: int  # of conjugate gradients


class FoamLayer:
    """Foam layer under one body: cells, remainder in wave numbers, gap of the body."""

    def __init__(
        self, grid: FoamGrid, foam: LayerFoam, gap: Field, shear_share: float = 0.3, *, inextensible: bool = False
    ) -> None:
        """Make the remainder's transform.

        foam: its ``thickness`` is that of the layer, an ``area`` does not act; gap: [rows, cols]
        [m] of the body at zero approach; shear_share: c, 0 to 1; inextensible: a cover that cannot
        move sideways. Raises ValueError outside the range.
        """
        self._columns = columns_of(foam)
        require_count("rows", grid.rows, least=4)
        require_count("cols", grid.cols, least=4)
        require_positive("cell_x", grid.cell_x, "m")
        require_positive("cell_y", grid.cell_y, "m")
        self.grid, self.foam = grid, foam
        self.shear_share = require("shear share", shear_share, least=0.0, most=1.0)
        self.gap = require_values("gap", gap, "m", shape=(grid.rows, grid.cols))
        self.first_modulus = self._columns.first_modulus
        along = 2.0 * numpy.pi * numpy.fft.fftfreq(grid.rows, grid.cell_x)
        across = 2.0 * numpy.pi * numpy.fft.rfftfreq(grid.cols, grid.cell_y)
        wave_number = numpy.hypot(along[:, None], across[None, :])
        influence = layer_influence(wave_number, foam.thickness, self.first_modulus, inextensible=inextensible)
        columns = self.first_modulus / foam.thickness
        self._remainder: Field = self.shear_share * numpy.maximum(1.0 / influence - columns, 0.0)  # c R [Pa/m]
        self._zero = numpy.zeros((grid.rows, grid.cols))

    @property
    def farthest(self) -> float:
        """Last approach [m] of a table."""
        return REACH * self.foam.thickness

    def solve(self, approach: float, start: Compression | None = None) -> Compression:
        """The layer at ``approach`` [m], from the solution ``start`` near it where there is one.

        Raises CushionError where the contact comes within 50 mm of the edge of the cells, or the
        solver does not end.
        """
        require("approach", approach, "m", most=0.99 * self.foam.thickness)
        bound = approach - self.gap
        if (bound <= 0.0).all():
            none = numpy.zeros_like(bound, dtype=bool)
            return Compression(approach, self._zero, self._zero, none, 0.0, 0.0, 0, 0)
        if start is None or not start.touching.any():
            w, touching = numpy.maximum(bound, 0.0), bound > 0.0
        else:
            w, touching = start.deflection.copy(), start.touching | (bound > start.deflection)
        steps = inner_steps = 0
        while steps < MOST_STEPS:
            steps += 1
            # Newton step of the cells without contact, those in contact prescribed.
            w[touching] = bound[touching]
            pressure, stiffness = self._pressure(w), self._stiffness(w)
            step, inner = self._free_step(stiffness, ~touching, -pressure)
            inner_steps += inner
            w += step
            pressure = self._pressure(w)
            # Contact pulls nowhere, and the top lies nowhere within the body.
            following = numpy.where(touching, pressure > 0.0, w < bound)
            left = numpy.abs(pressure[~following]).max(initial=0.0)
            if (following == touching).all() and left <= TOLERANCE * pressure.max():
                break
            touching = following
        else:
            raise CushionError(f"cushion at {1e3 * approach:.4g} mm: no solution after {MOST_STEPS} steps")
        self._refuse_edge(touching, approach)
        contact = numpy.where(touching, pressure, 0.0)
        strain = float(w.max()) / self.foam.thickness
        force = float(contact.sum()) * self.grid.cell_area
        return Compression(approach, w, contact, touching, force, strain, steps, inner_steps)

    def tangent(self, found: Compression) -> float:
        """Stiffness dF/d(approach) [N/m] at a solution, by one linear solve: the cells in contact
        move by 1, the others follow.
        """
        stiffness, moved = self._stiffness(found.deflection), found.touching.astype(numpy.float64)
        if not found.touching.any():
            return 0.0
        load = stiffness * moved + self._spread(moved)
        step, _inner = self._free_step(stiffness, ~found.touching, -load, 1e-10)
        moved = moved + step
        return float((stiffness * moved + self._spread(moved))[found.touching].sum()) * self.grid.cell_area

    def energy(self, found: Compression) -> float:
        """Energy [J] stored at a solution."""
        w = found.deflection
        columns = self._columns.energy(w / self.foam.thickness).sum() * self.foam.thickness
        return float(columns + 0.5 * (w * self._spread(w)).sum()) * self.grid.cell_area

    def _pressure(self, w: Field) -> Field:
        """sigma(w/h) + c R*w [Pa]."""
        return self._columns.stress(w / self.foam.thickness) + self._spread(w)

    def _stiffness(self, w: Field) -> Field:
        """d(sigma)/dw [Pa/m] of each column."""
        return self._columns.modulus(w / self.foam.thickness) / self.foam.thickness

    def _spread(self, w: Field) -> Field:
        """c R*w [Pa]."""
        return numpy.asarray(fft.irfft2(self._remainder * fft.rfft2(w), s=w.shape))

    def _free_step(
        self, stiffness: Field, free: Cells, load: Field, tolerance: float = INNER_TOLERANCE
    ) -> tuple[Field, int]:
        """Deflection [m] of the ``free`` cells under ``load`` [Pa], the others held; and the steps
        of the conjugate gradients.
        """
        x, residual = numpy.zeros_like(load), numpy.where(free, load, 0.0)
        size = numpy.linalg.norm(residual)
        if size == 0.0:
            return x, 0
        mean = float(stiffness[free].mean())
        smooth = 1.0 / (mean + self._remainder)
        direction, before, steps = x, 1.0, 0
        while steps < MOST_INNER_STEPS and numpy.linalg.norm(residual) > tolerance * size:
            steps += 1
            better = fft.irfft2(smooth * fft.rfft2(residual), s=load.shape) * free
            now = float((residual * better).sum())
            direction = better + now / before * direction
            applied = (stiffness * direction + self._spread(direction)) * free
            length = now / float((direction * applied).sum())
            x += length * direction
            residual -= length * applied
            before = now
        return x, steps

    def _refuse_edge(self, touching: Cells, approach: float) -> None:
        grid = self.grid
        if touching.all():  # an even load has no edge
            return
        for axis, cells, cell, name in ((1, grid.rows, grid.cell_x, "along"), (0, grid.cols, grid.cell_y, "across")):
            places = numpy.flatnonzero(touching.any(axis=axis))
            free = min(int(places[0]), cells - 1 - int(places[-1])) * cell
            if free < EDGE - 1e-9:
                raise CushionError(
                    f"cushion at {1e3 * approach:.4g} mm: the contact comes within {1e3 * free:.3g} mm of the edge of the "
                    f"cells {name}, where {1e3 * EDGE:.0f} mm must stay free"
                )
