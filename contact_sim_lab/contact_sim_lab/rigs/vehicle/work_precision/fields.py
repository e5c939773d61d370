"""Pressure fields of a patch on any grid and to any tolerance, and the distance of one answer from
another.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_lab.records.work_precision import FidelityLevel, Row, milliseconds, relative, row
from contact_sim_lab.rigs.vehicle.work_precision.patch_problem import Cells, PatchProblem, means_over
from contact_sim_pkg.pressure.field.halfspace import HalfSpace
from contact_sim_pkg.pressure.field.patch import contact_area
from contact_sim_pkg.pressure.field.rolling import RollingField
from contact_sim_pkg.pressure.field.solver import CONVERGED as CERTIFIED
from contact_sim_pkg.pressure.field.solver import SENTENCES

__all__ = [
    "APPROACH",
    "AREA",
    "CONVERGED",
    "FIELD",
    "FORCE",
    "GIVEN",
    "PEAK",
    "QUANTITIES",
    "Answer",
    "FieldFidelity",
    "PatchSolver",
    "answer_of",
    "distances",
    "rows_of",
    "solve",
    "timed",
]  # fmt: skip

Field = NDArray[numpy.float64]

FORCE, APPROACH, PEAK, AREA, FIELD = "force", "approach", "peak pressure", "contact area", "pressure (L2)"
QUANTITIES = (FORCE, APPROACH, PEAK, AREA, FIELD)
GIVEN = ("given load", "given approach")
CONVERGED = 1e-10
CAP = 2000


class FieldFidelity(NamedTuple):
    """A grid and a tolerance."""

    name: str
    cells: Cells
    tolerance: float


class Answer(NamedTuple):
    """What is compared: resultants and the field."""

    force: float  # [N]
    approach: float  # [m]
    peak: float  # [Pa]
    area: float  # [m^2]
    pressure: Field | None  # [Pa] [rows, cols]


def answer_of(half_space: HalfSpace, pressure: Field, approach: float) -> Answer:
    """Resultants of a `pressure` [rows, cols] [Pa] at its `approach` [m]: force [N], peak [Pa],
    area [m^2] with its edge between cells.
    """
    cell = half_space.cell_x * half_space.cell_y
    area = contact_area(pressure, half_space.cell_x, half_space.cell_y)
    return Answer(float(pressure.sum()) * cell, approach, float(pressure.max()), float(area), pressure)


class PatchSolver:
    """Fields of one problem, each from nothing; tables are made once."""

    def __init__(self, problem: PatchProblem) -> None:
        """Take the problem."""
        self.problem = problem
        self._field = RollingField(problem.half_space)

    def solve(self, given: str, value: float, tolerance: float) -> Answer:
        """The field at a load [N] or an approach [m]; its array is overwritten by the next call.
        given: one of `GIVEN`.

        Raises `RuntimeError` where the field is not certified, or reaches the edge of the patch.
        """
        self._field.reset()
        solve_given = self._field.solve_at_load if given == GIVEN[0] else self._field.solve_at_approach
        result = solve_given(self.problem.gap, value, tolerance, CAP)
        if result.status != CERTIFIED:
            sentence = SENTENCES[result.status]
            raise RuntimeError(f"field on {self.problem.gap.shape} cells to {tolerance:g}: {sentence} ({result})")
        return answer_of(self.problem.half_space, self._field.pressure, result.approach)


def solve(problem: PatchProblem, given: str, value: float, tolerance: float) -> Answer:
    """Solution of the problem for a `value`, an approach [m] or a load [N] by `given`."""
    return PatchSolver(problem).solve(given, value, tolerance)


def timed(fidelity: FieldFidelity, problem: PatchProblem, given: str, value: float) -> tuple[FidelityLevel, Answer]:
    """Answer of a fidelity level and its cold time in ms; `value`: approach [m] or load [N]."""
    solver = PatchSolver(problem)
    grid = "{}x{}".format(*fidelity.cells)
    cost = milliseconds(lambda: solver.solve(given, value, fidelity.tolerance))
    return FidelityLevel(fidelity.name, cost, grid, fidelity.tolerance), solver.solve(given, value, fidelity.tolerance)


def distances(found: Answer, exact: Answer) -> dict[str, float]:
    """Relative distance [1] of each quantity; fields are compared by their means over the coarser
    grid's cells.
    """
    errors = {
        FORCE: relative(found.force, exact.force), APPROACH: relative(found.approach, exact.approach),
        PEAK: relative(found.peak, exact.peak), AREA: relative(found.area, exact.area),
    }  # fmt: skip
    if found.pressure is not None and exact.pressure is not None:
        rows, cols = found.pressure.shape
        means = means_over(exact.pressure, (rows, cols))
        errors[FIELD] = float(numpy.linalg.norm(found.pressure - means) / numpy.linalg.norm(means))
    return errors


def rows_of(
    part: str,
    case: str,
    fidelity: FidelityLevel,
    reference: str,
    found: Answer,
    exact: Answer,
    converged: Answer | None = None,
) -> list[Row]:
    """Rows of all quantities; `converged`: the same grid to 1e-10, which divides the error into
    solver's and grid's.
    """
    rows = rows_of_errors(part, case, fidelity, reference, [errors_of(found, exact, converged)])
    values = dict(zip(QUANTITIES, zip(found[:4], exact[:4], strict=True), strict=False))
    for line in rows:
        line["value"], line["expected"] = values.get(line["quantity"], (None, None))
    return rows


class Errors(NamedTuple):
    """Of one answer, by quantity."""

    total: dict[str, float]
    solver: dict[str, float]
    grid: dict[str, float]


def errors_of(found: Answer, exact: Answer, converged: Answer | None = None) -> Errors:
    """The whole error, and its two parts where the converged field of the same grid is given."""
    if converged is None:
        return Errors(distances(found, exact), {}, {})
    return Errors(distances(found, exact), distances(found, converged), distances(converged, exact))


def rows_of_errors(part: str, case: str, fidelity: FidelityLevel, reference: str, errors: list[Errors]) -> list[Row]:
    """Rows of all quantities with the worst of several errors."""

    def worst(quantity: str, which: int) -> float | None:
        return max((each[which][quantity] for each in errors if quantity in each[which]), default=None)

    return [
        row(
            part,
            case,
            quantity,
            fidelity,
            reference,
            max(each.total[quantity] for each in errors),
            solver_error=worst(quantity, 1),
            grid_error=worst(quantity, 2),
        )
        for quantity in errors[0].total
    ]
