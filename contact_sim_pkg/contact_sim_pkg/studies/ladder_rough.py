"""Ladder of the pressure field on a rough road: Winkler bed, tiers of the field, every grid and tolerance, another code."""

from __future__ import annotations

import functools

import numpy

from contact_sim_pkg.core.winkler import bed_stiffness, winkler_at_approach, winkler_at_load
from contact_sim_pkg.reference.halfspace import dense_influence, pressure_at_approach
from contact_sim_pkg.studies.ladder_field import (
    CONVERGED,
    GIVEN,
    Answer,
    FieldRung,
    answer_of,
    rows_of,
    solve,
    timed,
)
from contact_sim_pkg.studies.ladder_row import Row, Rung, milliseconds
from contact_sim_pkg.studies.ladder_smooth import FIELD_CELLS, TIERS
from contact_sim_pkg.studies.patch_problem import CURVATURES, LOAD, MODULUS, Cells, PatchProblem, patch_problem

__all__ = ["CHECK_PART", "GRIDS_PART", "OWN", "PART", "SEED", "check_rows", "finest", "grid_rows", "rows"]

PART = "pressure field, rough road"
GRIDS_PART = "rough road, every grid and tolerance"
CHECK_PART = "rough road, against another code"
SEED = 36  # a road on which the contact stays clear of the edge of the patch, up to 1.2 of the load
GRIDS = ((64, 48), (128, 96), (256, 192))
TOLERANCES = (3e-2, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
FINEST, FINEST_TOLERANCE = (512, 384), 1e-8
OWN = "own code, grid 512x384 to 1e-8"
CHECK_CELLS, CHECK_TOLERANCES = (24, 24), (1e-2, 1e-3, 1e-4, 1e-6, 1e-8)
DENSE = "dense NNLS (scipy), no shared code"


def rows() -> list[Row]:
    """A Winkler bed and the tiers, at a given load and at the approach that the finest grid has there."""
    found: list[Row] = []
    for given in GIVEN:
        found += _winkler(given, _value(given))
        for tier in TIERS:
            found += _field(PART, tier, given)
    return found


def grid_rows() -> list[Row]:
    """Error of the solver and of the grid for each grid and tolerance."""
    rungs = [FieldRung(_tier_of(cells, tolerance), cells, tolerance) for cells in GRIDS for tolerance in TOLERANCES]
    return [line for given in GIVEN for rung in rungs for line in _field(GRIDS_PART, rung, given)]


def check_rows() -> list[Row]:
    """The solver on 24 x 24 cells against dense non-negative least squares, at its approach and at its load."""
    problem = patch_problem(CHECK_CELLS, SEED)
    half_space, cells = problem.half_space, CHECK_CELLS
    influence = dense_influence(*cells, half_space.cell_x, half_space.cell_y, MODULUS)
    approach = finest().approach
    exact = answer_of(half_space, pressure_at_approach(influence, problem.gap, approach), approach)
    found: list[Row] = []
    for given, value in zip(GIVEN, (exact.force, approach), strict=True):
        for tolerance in CHECK_TOLERANCES:
            rung, answer = timed(FieldRung("check", cells, tolerance), problem, given, value)
            found += rows_of(CHECK_PART, given, rung, DENSE, answer, exact)
    return found


@functools.cache
def finest() -> Answer:
    """The field on twice the finest grid."""
    return solve(patch_problem(FINEST, SEED), GIVEN[0], LOAD, FINEST_TOLERANCE)


@functools.cache
def _converged(cells: Cells, given: str) -> Answer:
    return solve(_problem(cells), given, _value(given), CONVERGED)


@functools.cache
def _problem(cells: Cells) -> PatchProblem:
    return patch_problem(cells, SEED)


def _value(given: str) -> float:
    return LOAD if given == GIVEN[0] else finest().approach


def _tier_of(cells: Cells, tolerance: float) -> str:
    names = {(tier.cells, tier.tolerance): tier.name for tier in TIERS}
    return names.get((cells, tolerance), "FFT-CG")


def _field(part: str, rung: FieldRung, given: str) -> list[Row]:
    described, answer = timed(rung, _problem(rung.cells), given, _value(given))
    return rows_of(part, given, described, OWN, answer, finest(), _converged(rung.cells, given))


def _winkler(given: str, value: float) -> list[Row]:
    """The bed that has Hertz's approach under the load on the smooth road."""
    half_space, gap = _problem(FIELD_CELLS)
    stiffness = bed_stiffness(*CURVATURES, MODULUS, LOAD)
    solve_given = winkler_at_load if given == GIVEN[0] else winkler_at_approach
    pressure = numpy.zeros(gap.shape)
    arguments = (gap, stiffness, half_space.cell_x, half_space.cell_y, value, pressure)
    rung = Rung("Winkler bed", milliseconds(lambda: solve_given(*arguments)), "{}x{}".format(*FIELD_CELLS))
    found = answer_of(half_space, pressure, solve_given(*arguments).approach)
    cell = half_space.cell_x * half_space.cell_y
    found = found._replace(area=float(numpy.count_nonzero(pressure)) * cell)  # its edge is no root
    return rows_of(PART, given, rung, OWN, found, finest())
