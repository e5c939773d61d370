"""tamaas: Polonsky and Keer's conjugate gradients; its operators are the same discrete problem as ours."""

from __future__ import annotations

import tamaas

from comparisons.field.problems import Field, Problem
from comparisons.field.solver import NotSolvedError, Solver, rolled

__all__ = ["SETTINGS", "make", "version"]

SETTINGS = (
    "PolonskyKeerRey, primal and constraint pressure; free: registerNonPeriodic 'dcfft', periodic: its default operator; "
    "a sequence starts from the shifted traction"
)
MOST_ITERATIONS = 5000
FREE = "dcfft"

tamaas.set_log_level(tamaas.LogLevel.error)


def version() -> str:
    """Of the library."""
    return str(tamaas.__version__)


def make(problem: Problem, sequence: bool) -> Solver:
    """Cold or in a sequence: the same code."""
    return _Tamaas(problem)


class _Tamaas:
    untimed = 0.0

    def __init__(self, problem: Problem) -> None:
        self._problem = problem
        size = [problem.rows * problem.cell, problem.cols * problem.cell]
        self._model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, size, [problem.rows, problem.cols])
        self._model.E, self._model.nu = problem.modulus, 0.0
        if not problem.periodic:
            tamaas.ModelFactory.registerNonPeriodic(self._model, FREE)

    def reset(self) -> None:
        self._model.traction[:] = 0.0

    def solve(self, gap: Field, cells: int, tolerance: float) -> Field:
        traction: Field = self._model.traction
        if cells:
            traction[:] = rolled(traction, cells)
        solver = tamaas.PolonskyKeerRey(self._model, -gap, tolerance)
        if not self._problem.periodic:
            solver.setIntegralOperator(FREE)
        solver.max_iter = MOST_ITERATIONS
        reached = solver.solve(self._problem.mean_pressure)
        if not reached <= tolerance:
            raise NotSolvedError(f"error {reached:.3g} after at most {MOST_ITERATIONS} iterations")
        return traction
