"""Hard cases of the half-space and of the pressure field."""

from __future__ import annotations

import functools
import math

import numpy
from numpy.typing import NDArray

from contact_sim_lab.records import guard
from contact_sim_lab.records.hard_case import Finding, HardCase, at_most, exactly
from contact_sim_lab.twins import halfspace as reference
from contact_sim_pkg.pressure.field.halfspace import HalfSpace, displacement, make_buffers, make_half_space
from contact_sim_pkg.pressure.field.solver import (
    CONVERGED,
    FieldResult,
    make_workspace,
    solve_at_approach,
    solve_at_load,
)

Field = NDArray[numpy.float64]
SIDE, CELL, MODULUS = 24, 0.01, 4.0e6


@functools.cache
def grid() -> HalfSpace:
    """The check grid of 24 x 24 cells."""
    return make_half_space(SIDE, SIDE, CELL, CELL, MODULUS)


@functools.cache
def dense() -> Field:
    """Its dense influence matrix, from logarithms in multiple precision."""
    return reference.dense_influence(SIDE, SIDE, CELL, CELL, MODULUS)


def bowl(radius: float = 0.5) -> Field:
    """Gap of a sphere [m]."""
    x = (numpy.arange(SIDE) - 0.5 * (SIDE - 1)) * CELL
    return numpy.asarray((x[:, None] ** 2 + x[None, :] ** 2) / (2.0 * radius))


def solved(gap: Field, approach: float, tolerance: float = 1e-12, limit: int = 400) -> tuple[Field, FieldResult]:
    """Pressure [rows, cols] [Pa] and result at an approach [m]; gap: [rows, cols] [m]; tolerance:
    on the residual [1]."""
    pressure = numpy.zeros((SIDE, SIDE))
    return pressure, solve_at_approach(grid(), make_workspace(grid()), gap, approach, tolerance, limit, pressure)


def field_error(gap: Field, approach: float) -> float:
    """Relative L2 distance [1] to the dense non-negative least squares; infinite where the solver
    does not converge.

    gap: [rows, cols] [m]; approach: [m].
    """
    pressure, result = solved(gap, approach)
    if result.status != CONVERGED:
        return math.inf
    exact = reference.pressure_at_approach(dense(), gap, approach)
    return float(numpy.linalg.norm(pressure - exact) / numpy.linalg.norm(exact))


def influence() -> Finding:
    """Largest relative error of the displacement under one loaded cell: no logarithm of 0 on its
    edges.
    """
    pressure, result = numpy.zeros((SIDE, SIDE)), numpy.zeros((SIDE, SIDE))
    pressure[5, 7] = 1.0
    displacement(grid(), make_buffers(grid()), pressure, result)
    exact = reference.displacement(dense(), pressure)
    return at_most(float(numpy.abs(result / exact - 1.0).max()), 1e-12, hard=(pressure > 0.0).sum())


def smooth() -> Finding:
    """Sphere against dense non-negative least squares."""
    pressure, _result = solved(bowl(), 0.004)
    return at_most(field_error(bowl(), 0.004), 1e-8, hard=((bowl() < 0.004) & (pressure == 0.0)).sum())


def rough() -> Finding:
    """White noise of 2 mm and a single-cell spike of 20 mm against dense non-negative least
    squares.
    """
    gap = bowl() + numpy.random.default_rng(20).normal(0.0, 0.002, (SIDE, SIDE))
    gap[10, 13] -= 0.02
    step = float(0.25 * (gap[9, 13] + gap[11, 13] + gap[10, 12] + gap[10, 14]) - gap[10, 13])
    gap -= gap.min()
    return at_most(field_error(gap, 0.012), 1e-8, hard=step / 0.012)


def no_contact() -> Finding:
    """Load without contact and for load 0, with a field that is left from before."""
    load, approach = 0.0, -1e-6
    left = numpy.full((SIDE, SIDE), 1e4)
    separated = solve_at_approach(grid(), make_workspace(grid()), bowl(), approach, 1e-8, 100, left)
    again = numpy.full((SIDE, SIDE), 1e4)
    zero = solve_at_load(grid(), make_workspace(grid()), bowl(), load, 1e-8, 100, again)
    codes = 0 if (separated.status, zero.status) == (CONVERGED, CONVERGED) else 1
    return exactly(separated.load + zero.load + float(left.max() + again.max()) + codes, 0.0, hard=max(load, approach))


CASES = (
    HardCase("halfspace", "influence of a cell, its edges included: relative error", influence,
        guard.at_most("loaded cells", 1)),
    HardCase("halfspace", "sphere against dense NNLS: error of the field", smooth,
        guard.at_least("cells that overlap undeformed, and yet part", 20)),
    HardCase("rough road", "white noise and a 20 mm spike: error of the field", rough,
        guard.at_least("height of one cell over the approach", 1.0)),
    HardCase("halfspace", "no contact, and load 0: load and field", no_contact,
        guard.at_most("load [N] and approach [m]", 0.0)),
)  # fmt: skip
