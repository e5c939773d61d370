"""ASPHER: preconditioned Polonsky-Keer on nested grids. It takes square grids only, so a patch is put into a square.

The square's cells beside the patch have a gap as large as the patch's largest and 0.1 m more: no contact there, and the same
discrete problem in the patch. Options were chosen by time on problem (c): the exact transform as operator (not the
hierarchical one, 6 times slower on these grids), the transform as preconditioner on all levels (not its stencil), 32 cells on
the coarsest side.
"""

from __future__ import annotations

from importlib.metadata import version as version_of

import aspher
import numpy

from comparisons.field.problems import Field, Problem
from comparisons.field.solver import NotSolvedError, Solver, rolled

__all__ = ["SETTINGS", "make", "version"]

SETTINGS = (
    "built with -march=native; cold: solve_nested, backend 'fft' ('periodic' for (b)), precond_engine 'fft', coarsest 32, "
    "light_result; a sequence: ContactSolver, precond 'fourier-fft', started from the shifted pressure"
)
MOST_ITERATIONS = 5000
COARSEST = 32
ABOVE = 0.1  # [m]


def version() -> str:
    """Of the library."""
    return version_of("aspher")


def make(problem: Problem, sequence: bool) -> Solver:
    """Nested grids cannot take a start, so a sequence is solved on one grid."""
    return _Sequence(problem) if sequence else _Nested(problem)


class _Square:
    """The patch inside a square grid."""

    def __init__(self, problem: Problem) -> None:
        self.side = max(problem.rows, problem.cols)
        self.backend = "periodic" if problem.periodic else "fft"
        self.mean_pressure = problem.load / (self.side * problem.cell) ** 2
        self.grid = {"grid_size": self.side, "domain_size": self.side * problem.cell, "E_star": problem.modulus}
        first_row, first_col = (self.side - problem.rows) // 2, (self.side - problem.cols) // 2
        self.patch = (slice(first_row, first_row + problem.rows), slice(first_col, first_col + problem.cols))
        self._gap: Field = numpy.zeros((self.side, self.side))

    def gap(self, patch: Field) -> Field:
        """The square's gap [m]; the patch itself where that is square."""
        if patch.shape == self._gap.shape:
            return patch
        self._gap.fill(patch.max() + ABOVE)
        self._gap[self.patch] = patch
        return self._gap


class _Nested:
    """Builds its tables with each call and says how long that took."""

    def __init__(self, problem: Problem) -> None:
        self.untimed = 0.0
        self._square = _Square(problem)

    def reset(self) -> None:
        return

    def solve(self, gap: Field, cells: int, tolerance: float) -> Field:
        square = self._square
        result = aspher.solve_nested(
            gap=square.gap(gap),
            p_nominal=square.mean_pressure,
            coarsest=COARSEST,
            tol=tolerance,
            max_iter=MOST_ITERATIONS,
            precond_engine="fft",
            backend=square.backend,
            light_result=True,
            **square.grid,
        )
        self.untimed = float(result.timings["build"])
        return _pressure(result)[square.patch]


class _Sequence:
    untimed = 0.0

    def __init__(self, problem: Problem) -> None:
        self._square = _Square(problem)
        self._solver = aspher.ContactSolver(backend=self._square.backend, **self._square.grid)
        self._pressure: Field | None = None

    def reset(self) -> None:
        self._pressure = None

    def solve(self, gap: Field, cells: int, tolerance: float) -> Field:
        square = self._square
        start = None if self._pressure is None else rolled(self._pressure, cells)
        result = self._solver.solve(
            square.gap(gap),
            square.mean_pressure,
            tol=tolerance,
            max_iter=MOST_ITERATIONS,
            precond="fourier-fft",
            p_init=start,
        )
        self._pressure = _pressure(result)
        return self._pressure[square.patch]


def _pressure(result: aspher.ContactResult) -> Field:
    if not result.converged:
        raise NotSolvedError(f"{result.status}, {result.status_reason}")
    pressure: Field = result.pressure
    return pressure
