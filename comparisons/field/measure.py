"""Errors and times of the solvers on one task.

Error: `|p - p_ref| / |p_ref|` in L2; p_ref is our solver's field on the same grid with a residual of 1e-12, on the whole grid and
without prediction. Time: from gap and load in memory to the field; warm; tables, plans and compilation are shown apart. It is
processor time of the process (all its threads), which is the wall time of one thread on a quiet core; wall time is measured beside
it. Cold solves come in up to three rounds over all solvers, so that a busy moment of the machine does not hit one of them alone.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import suppress
from typing import NamedTuple

import numpy

from comparisons.field.plan import Share, Task
from comparisons.field.problems import Field, Problem
from comparisons.field.solver import OURS, Candidate, NotSolvedError, Solver
from contact_sim_pkg.pressure.field.halfspace import HalfSpace, make_half_space
from contact_sim_pkg.pressure.field.periodic import make_periodic_half_space
from contact_sim_pkg.pressure.field.solver import make_workspace, solve_at_load

__all__ = ["REFERENCE", "Cost", "Row", "SetUp", "measure", "reference_fields"]

REFERENCE = 1e-12
REFERENCE_REACHED = 1e-11
"""Residual at which a reference still counts: rounding stops some grids of 512 x 512 above 1e-12."""

LARGEST = 3.0
"""Times the median that the largest error of a sequence may be; a solver with a longer tail pays for it."""

ROUNDS = 3
SKIPPED = 2
"""Steps at the beginning of a sequence that do not count: the prediction needs two fields."""


class Cost(NamedTuple):
    """Of one solve [s]."""

    processor: float
    wall: float


class Row(NamedTuple):
    """One solver on one task, seed and tolerance."""

    task: str
    solver: str
    seed: int
    tolerance: float
    error: float  # median
    largest_error: float
    load_error: float  # largest
    ms: float  # processor time, median
    ms_95: float  # 95th percentile
    wall_ms: float  # wall time, median
    solves: int
    closed_form: float | None  # error against the closed form, where there is one

    @property
    def counted_error(self) -> float:
        """The error that the row is compared at: the median, or a third of the largest where that is more."""
        return max(self.error, self.largest_error / LARGEST)


class SetUp(NamedTuple):
    """What the first seed of a task cost before the first warm solve."""

    task: str
    solver: str
    ms: float  # plans, tables
    first_solve_ms: float  # compilation or loading of compiled code included


def measure(
    task: Task, solvers: list[Candidate], tell: Callable[[str], None]
) -> tuple[list[Row], list[SetUp], list[str]]:
    """All rows of a task, its set-up costs, and what solvers did not solve."""
    rows: list[Row] = []
    set_ups: list[SetUp] = []
    refused: list[str] = []
    taking_part = [one for one in solvers if one.name in task.shares]
    for seed in range(1, 1 + max(share.seeds for share in task.shares.values())):
        tell(f"{task.name}: seed {seed}")
        problem = task.problem(seed)
        shares = {one.name: task.shares[one.name] for one in taking_part if seed <= task.shares[one.name].seeds}
        steps = max(share.solves for share in shares.values()) if task.sequence else 1
        references = reference_fields(problem, steps)
        ready: dict[str, Solver] = {}
        for one in taking_part:
            if one.name in shares:
                ready[one.name], spent = _prepare(task, problem, one, shares[one.name])
                set_ups += [spent] if seed == 1 else []
        found = (_sequences if task.sequence else _cold)(task.name, seed, problem, references, ready, shares, refused)
        rows += found
    return rows, set_ups, refused


def reference_fields(problem: Problem, steps: int) -> list[Field]:
    """Fields [Pa] to 1e-12, each started from the one before."""
    space = _half_space(problem)
    workspace, pressure = make_workspace(space), numpy.zeros((problem.rows, problem.cols))
    fields: list[Field] = []
    for step in range(steps):
        result = solve_at_load(space, workspace, problem.gap(step), problem.load, REFERENCE, 5000, pressure)
        if not result.residual <= REFERENCE_REACHED:
            raise RuntimeError(f"reference of step {step}: the residual stays at {result.residual:.3g}")
        fields.append(pressure.copy())
    return fields


def _half_space(problem: Problem) -> HalfSpace:
    make = make_periodic_half_space if problem.periodic else make_half_space
    return make(problem.rows, problem.cols, problem.cell, problem.cell, problem.modulus)


def _prepare(task: Task, problem: Problem, one: Candidate, share: Share) -> tuple[Solver, SetUp]:
    began = time.perf_counter()
    solver = one.make(problem, task.sequence)
    made = time.perf_counter()
    with suppress(NotSolvedError):  # told with the tolerance when it is measured
        solver.solve(problem.gap(0), 0, share.tolerances[0])
    done = time.perf_counter()
    return solver, SetUp(task.name, one.name, 1e3 * (made - began), 1e3 * (done - made))


def _cold(
    task: str,
    seed: int,
    problem: Problem,
    references: list[Field],
    ready: dict[str, Solver],
    shares: dict[str, Share],
    refused: list[str],
) -> list[Row]:
    gap = problem.gap(0)
    costs: dict[tuple[str, float], list[Cost]] = {}
    fields: dict[tuple[str, float], Field] = {}
    for turn in range(ROUNDS):
        for name, solver in ready.items():
            for tolerance in shares[name].tolerances:
                key = name, tolerance
                for _ in range(_in_turn(shares[name].solves, turn)):
                    solver.reset()
                    try:
                        field, cost = _timed(solver, gap, 0, tolerance)
                    except NotSolvedError as error:
                        refused.append(f"{task}, {name} at {tolerance:g}: {error}")
                        break
                    fields.setdefault(key, field.copy())
                    costs.setdefault(key, []).append(cost)
    return [
        _row(task, name, seed, tolerance, problem, [field], references, costs[name, tolerance])
        for (name, tolerance), field in fields.items()
    ]


def _in_turn(solves: int, turn: int) -> int:
    """Solves of one of the rounds, as even as they go."""
    return solves // ROUNDS + (1 if turn < solves % ROUNDS else 0)


def _sequences(
    task: str,
    seed: int,
    problem: Problem,
    references: list[Field],
    ready: dict[str, Solver],
    shares: dict[str, Share],
    refused: list[str],
) -> list[Row]:
    rows: list[Row] = []
    for name, solver in ready.items():
        steps = shares[name].solves
        for tolerance in shares[name].tolerances:
            try:
                if name == OURS:  # tables of windows are made as they come: set-up, not counted
                    _run(solver, problem, steps, tolerance)
                fields, costs = _run(solver, problem, steps, tolerance)
            except NotSolvedError as error:
                refused.append(f"{task}, {name} at {tolerance:g}: {error}")
                continue
            kept = slice(SKIPPED, steps)
            rows.append(_row(task, name, seed, tolerance, problem, fields[kept], references[kept], costs[kept]))
    return rows


def _run(solver: Solver, problem: Problem, steps: int, tolerance: float) -> tuple[list[Field], list[Cost]]:
    solver.reset()
    fields: list[Field] = []
    costs: list[Cost] = []
    for step in range(steps):
        field, cost = _timed(solver, problem.gap(step), problem.cells if step else 0, tolerance)
        fields.append(field.copy())
        costs.append(cost)
    return fields, costs


def _timed(solver: Solver, gap: Field, cells: int, tolerance: float) -> tuple[Field, Cost]:
    wall, processor = time.perf_counter(), time.process_time()
    field = solver.solve(gap, cells, tolerance)
    processor, wall = time.process_time() - processor, time.perf_counter() - wall
    kept = 1.0 - solver.untimed / wall  # untimed is wall time: a busy machine stretches it as it stretches the whole
    return field, Cost(processor * kept, wall * kept)


def _row(
    task: str,
    name: str,
    seed: int,
    tolerance: float,
    problem: Problem,
    fields: list[Field],
    references: list[Field],
    costs: list[Cost],
) -> Row:
    errors = [_difference(field, wanted) for field, wanted in zip(fields, references, strict=False)]
    loads = [abs(float(field.sum()) * problem.cell**2 / problem.load - 1.0) for field in fields]
    times = 1e3 * numpy.array(costs)
    return Row(
        task,
        name,
        seed,
        tolerance,
        float(numpy.median(errors)),
        max(errors),
        max(loads),
        float(numpy.median(times[:, 0])),
        float(numpy.percentile(times[:, 0], 95)),
        float(numpy.median(times[:, 1])),
        len(costs),
        None if problem.exact is None else _difference(fields[0], problem.exact),
    )


def _difference(field: Field, wanted: Field) -> float:
    return float(numpy.linalg.norm(field - wanted) / numpy.linalg.norm(wanted))
