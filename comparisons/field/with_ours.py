"""Our solver, by its public interface."""

from __future__ import annotations

from comparisons.field.problems import Field, Problem
from comparisons.field.solver import NotSolvedError, Solver
from contact_sim_pkg import __version__
from contact_sim_pkg.pressure.field.halfspace import make_half_space
from contact_sim_pkg.pressure.field.periodic import PeriodicField, make_periodic_half_space
from contact_sim_pkg.pressure.field.rolling import RollingField
from contact_sim_pkg.pressure.field.solver import CONVERGED, EDGE, SENTENCES

__all__ = ["SETTINGS", "make", "version"]

SETTINGS = "RollingField.solve_at_load, PeriodicField.solve_at_load for (b); double precision"
MOST_ITERATIONS = 5000


def version() -> str:
    """Of this project."""
    return __version__


def make(problem: Problem, sequence: bool) -> Solver:
    """Cold or in a sequence: the same code."""
    return _Ours(problem)


class _Ours:
    untimed = 0.0

    def __init__(self, problem: Problem) -> None:
        self._load = problem.load
        grid = (problem.rows, problem.cols, problem.cell, problem.cell, problem.modulus)
        self._field: RollingField | PeriodicField
        if problem.periodic:
            self._field = PeriodicField(make_periodic_half_space(*grid))
        else:
            self._field = RollingField(make_half_space(*grid))

    def reset(self) -> None:
        if isinstance(self._field, RollingField):
            self._field.reset()

    def solve(self, gap: Field, cells: int, tolerance: float) -> Field:
        if isinstance(self._field, RollingField):
            self._field.roll(cells)
        result = self._field.solve_at_load(gap, self._load, tolerance, MOST_ITERATIONS)
        if result.status not in (CONVERGED, EDGE):
            raise NotSolvedError(f"{SENTENCES[result.status]} (residual {result.residual:.3g})")
        return self._field.pressure
