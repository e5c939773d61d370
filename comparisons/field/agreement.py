"""Whether the solvers solve the same discrete problem: their tightest fields against our reference."""

from __future__ import annotations

from typing import NamedTuple

import numpy

from comparisons.field.measure import reference_fields
from comparisons.field.problems import Problem, hertz, rough, tire
from comparisons.field.solver import OURS, Candidate, NotSolvedError

__all__ = ["Agreement", "agreements"]

TIGHT = 1e-10


class Agreement(NamedTuple):
    """One solver at a tolerance of 1e-10 of its own."""

    problem: str
    solver: str
    difference: float | None  # to our reference, L2; None where it was not solved


def agreements(solvers: list[Candidate]) -> list[Agreement]:
    """On a free problem of each kind and on a periodic one; small grids, since the discrete problem does not change."""
    problems: dict[str, Problem] = {
        "(a) Hertz, 64²": hertz(64),
        "(b) rough, periodic, 128²": rough(128, 0.018, 1),
        "(c) tire, 128x96": tire("128x96", 1),
    }
    return [
        Agreement(name, one.name, _difference(problem, one))
        for name, problem in problems.items()
        for one in solvers
        if one.name != OURS
    ]


def _difference(problem: Problem, one: Candidate) -> float | None:
    wanted = reference_fields(problem, 1)[0]
    try:
        field = one.make(problem, False).solve(problem.gap(0), 0, TIGHT)
    except NotSolvedError:
        return None
    return float(numpy.linalg.norm(field - wanted) / numpy.linalg.norm(wanted))
