"""Work-precision study of the pressure field on a rough road: Winkler bed, fidelity levels of the
field, every grid and tolerance, another code.
"""

from __future__ import annotations

import functools

import numpy

from contact_sim_lab.records.work_precision import FidelityLevel, Row, WorkPrecision, milliseconds
from contact_sim_lab.rigs.vehicle.work_precision.fields import (
    CONVERGED,
    GIVEN,
    Answer,
    FieldFidelity,
    answer_of,
    errors_of,
    rows_of,
    rows_of_errors,
    solve,
    timed,
)
from contact_sim_lab.rigs.vehicle.work_precision.patch_problem import (
    CURVATURES,
    LOAD,
    MODULUS,
    Cells,
    PatchProblem,
    patch_problem,
)
from contact_sim_lab.rigs.vehicle.work_precision.smooth import FIELD_CELLS, LEVELS
from contact_sim_lab.twins.halfspace import dense_influence, pressure_at_approach
from contact_sim_pkg.pressure.field.winkler import bed_stiffness, winkler_at_approach, winkler_at_load

__all__ = [
    "CHECK_PART",
    "GRIDS_PART",
    "OWN",
    "PART",
    "SEED",
    "WORK_PRECISION",
    "check_rows",
    "finest",
    "grid_rows",
    "rows",
]

PART = "pressure field, rough road"
GRIDS_PART = "rough road, every grid and tolerance"
CHECK_PART = "rough road, against another code"
SEEDS = (36, 8, 17, 20, 37)
"""Roads on which the contact stays clear of the edge of the patch, up to 1.2 of the load."""

SEED = SEEDS[0]
WORST = f", worst of {len(SEEDS)} roads"
GRIDS = ((64, 48), (128, 96), (256, 192))
TOLERANCES = (3e-2, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
FINEST, FINEST_TOLERANCE = (512, 384), 1e-8
OWN = "own code, grid 512x384 to 1e-8"
CHECK_CELLS, CHECK_TOLERANCES = (24, 24), (1e-2, 1e-3, 1e-4, 1e-6, 1e-8)
DENSE = "dense NNLS (scipy), no shared code"


def rows() -> list[Row]:
    """A Winkler bed and the fidelity levels, at a given load and at the approach that the finest
    grid has there.
    """
    found: list[Row] = []
    for given in GIVEN:
        found += _winkler(given)
        for level in LEVELS:
            found += _field(PART, level, given)
    return found


def grid_rows() -> list[Row]:
    """Error of the solver and of the grid for each grid and tolerance."""
    fidelities = [
        FieldFidelity(_level_of(cells, tolerance), cells, tolerance) for cells in GRIDS for tolerance in TOLERANCES
    ]
    return [line for given in GIVEN for fidelity in fidelities for line in _field(GRIDS_PART, fidelity, given)]


def check_rows() -> list[Row]:
    """The solver on 24 x 24 cells against dense non-negative least squares, at its approach and at
    its load.
    """
    problem = patch_problem(CHECK_CELLS, SEED)
    half_space, cells = problem.half_space, CHECK_CELLS
    influence = dense_influence(*cells, half_space.cell_x, half_space.cell_y, MODULUS)
    approach = finest().approach
    exact = answer_of(half_space, pressure_at_approach(influence, problem.gap, approach), approach)
    found: list[Row] = []
    for given, value in zip(GIVEN, (exact.force, approach), strict=True):
        for tolerance in CHECK_TOLERANCES:
            fidelity, answer = timed(FieldFidelity("check", cells, tolerance), problem, given, value)
            found += rows_of(CHECK_PART, given, fidelity, DENSE, answer, exact)
    return found


@functools.cache
def finest(seed: int = SEED) -> Answer:
    """The field on twice the finest grid."""
    return solve(patch_problem(FINEST, seed), GIVEN[0], LOAD, FINEST_TOLERANCE)


@functools.cache
def _converged(cells: Cells, given: str, seed: int) -> Answer:
    return solve(_problem(cells, seed), given, _value(given, seed), CONVERGED)


@functools.cache
def _problem(cells: Cells, seed: int) -> PatchProblem:
    return patch_problem(cells, seed)


def _value(given: str, seed: int) -> float:
    return LOAD if given == GIVEN[0] else finest(seed).approach


def _level_of(cells: Cells, tolerance: float) -> str:
    names = {(level.cells, level.tolerance): level.name for level in LEVELS}
    return names.get((cells, tolerance), "FFT-CG")


def _field(part: str, fidelity: FieldFidelity, given: str) -> list[Row]:
    """Worst error over the roads; time on the first."""
    described, _answer = timed(fidelity, _problem(fidelity.cells, SEED), given, _value(given, SEED))
    errors = []
    for seed in SEEDS:
        found = solve(_problem(fidelity.cells, seed), given, _value(given, seed), fidelity.tolerance)
        errors.append(errors_of(found, finest(seed), _converged(fidelity.cells, given, seed)))
    return rows_of_errors(part, f"{given}{WORST}", described, OWN, errors)


def _winkler(given: str) -> list[Row]:
    """The bed that has Hertz's approach under the load on the smooth road."""
    stiffness = bed_stiffness(*CURVATURES, MODULUS, LOAD)
    solve_given = winkler_at_load if given == GIVEN[0] else winkler_at_approach
    errors = []
    for seed in reversed(SEEDS):
        half_space, gap = _problem(FIELD_CELLS, seed)
        pressure = numpy.zeros(gap.shape)
        arguments = (gap, stiffness, half_space.cell_x, half_space.cell_y, _value(given, seed), pressure)
        found = answer_of(half_space, pressure, solve_given(*arguments).approach)
        cell = half_space.cell_x * half_space.cell_y
        found = found._replace(area=float(numpy.count_nonzero(pressure)) * cell)  # its edge is no root
        errors.append(errors_of(found, finest(seed)))
    fidelity = FidelityLevel("Winkler bed", milliseconds(lambda: solve_given(*arguments)), "{}x{}".format(*FIELD_CELLS))
    return rows_of_errors(PART, f"{given}{WORST}", fidelity, OWN, errors)


WORK_PRECISION = (
    WorkPrecision(PART, rows),
    WorkPrecision(GRIDS_PART, grid_rows),
    WorkPrecision(CHECK_PART, check_rows),
)
