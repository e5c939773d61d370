"""The rolling pressure field against its reference: error, time and convolutions of a solve, cold
and in a sequence.

    python -m contact_sim_lab.field.field_benchmark [--grid 128x96] [--cells 1] [--seeds 5]
    [--steps 200] [--json]

The problem is that of `rolling_problem`. Error: `|p - p_ref| / |p_ref|` in L2, p_ref on the same
grid to 1e-12. Time: from heights and load in memory to the certified field; one thread, warm,
without tables and compilation. A solver's tolerance says little, so times are read at a requested
error, by interpolation of both logarithms between tolerances. Sequences: the median and the 95th
percentile over the steps from the third on, of all seeds. Cold: median over the seeds of the median
of nine solves. Beside it stands the time of a fixed amount of work, before and after: where the two
differ the machine was not quiet.
"""

from __future__ import annotations

import itertools
import json
import math
import time
from collections.abc import Callable
from typing import Any, NamedTuple

import click
import numpy
from numpy.typing import NDArray

from contact_sim_lab.rigs.vehicle.work_precision.rolling_problem import (
    GRIDS,
    LOAD,
    RollingProblem,
    rolling_problem,
)
from contact_sim_pkg.pressure.field import solver as field_solver
from contact_sim_pkg.pressure.field.rolling import RollingField
from contact_sim_pkg.pressure.field.solver import FieldResult, make_workspace

__all__ = ["Sequence", "calibrate", "cold", "read_at", "rows_of", "sequence"]

Field = NDArray[numpy.float64]
COLD, NESTED, LAST, SHIFTED, ROLLING = "cold", "cold, nested", "start: last field", "start: shifted field", "rolling"
TOLERANCES = {
    COLD: (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-9, 1e-11),
    NESTED: (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-9, 1e-11),
    LAST: (1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 1e-4, 1e-5, 1e-6),
    SHIFTED: (1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 1e-4, 1e-5, 1e-6),
    ROLLING: (1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 1e-4, 1e-5, 1e-6),
}
REQUESTED = {COLD: (1e-3, 1e-5), NESTED: (1e-3, 1e-5), LAST: (1e-2, 1.5e-3, 3e-4, 1e-4)}
GOALS = {
    ("128x96", ROLLING, 1e-2): 0.5,
    ("128x96", ROLLING, 1.5e-3): 1.0,
    ("128x96", ROLLING, 1e-4): 2.2,
    ("256x192", ROLLING, 3e-4): 10.0,
    ("128x96", NESTED, 1e-3): 5.0,
}
"""ms a solve on a quiet AMD EPYC core."""
REFERENCE, CAP, COLD_REPEATS, SKIPPED = 1e-12, 1000, 9, 3


class Sequence(NamedTuple):
    """One solver at one tolerance, by steps; the first steps count for nothing."""

    errors: list[float]  # [1]
    seconds: list[float]
    processor_seconds: list[float]  # of this thread: less, where others take turns on its core
    convolutions: list[int]


def references(problem: RollingProblem, steps: int) -> list[Field]:
    """Fields to 1e-12, each on the whole grid."""
    half_space = problem.half_space
    workspace, pressure = make_workspace(half_space), numpy.zeros((half_space.rows, half_space.cols))
    fields: list[Field] = []
    for step in range(steps):
        _roll(pressure, problem.cells if step else 0)
        result = field_solver.solve_at_load(half_space, workspace, problem.gap(step), LOAD, REFERENCE, CAP, pressure)
        if not result.residual <= REFERENCE:
            raise RuntimeError(
                f"rolling problem: the reference of step {step} stays at a residual of {result.residual}"
            )
        fields.append(pressure.copy())
    return fields


def sequence(problem: RollingProblem, kind: str, tolerance: float, fields: list[Field]) -> Sequence:
    """Relative errors [1] against `fields`, and the time [s] and convolutions of each step;
    tolerance: on the residual [1]."""
    solve, count = _solver(problem, kind, tolerance)
    if kind == ROLLING:  # tables of windows are made as they come: not counted
        for step in range(len(fields)):
            solve(problem.gap(step), problem.cells if step else len(fields[0]))
    found = Sequence([], [], [], [])
    for step, reference in enumerate(fields):
        gap = problem.gap(step)
        before, began, began_on_processor = count(), time.perf_counter(), time.thread_time()
        pressure, result = solve(gap, problem.cells if step else len(reference))
        on_processor, seconds = time.thread_time() - began_on_processor, time.perf_counter() - began
        if not result.residual <= tolerance or abs(result.load / LOAD - 1.0) > 1e-8:
            raise RuntimeError(f"rolling problem: step {step} to {tolerance:g} ended with {result}")
        if step >= SKIPPED or kind in (COLD, NESTED):
            found.errors.append(float(numpy.linalg.norm(pressure - reference) / numpy.linalg.norm(reference)))
            found.seconds.append(seconds)
            found.processor_seconds.append(on_processor)
            found.convolutions.append(count() - before)
    return found


def cold(problem: RollingProblem, kind: str, tolerance: float, reference: Field) -> Sequence:
    """Errors [1] and times [s] of the first step nine times over, each without a previous field;
    tolerance: on the residual [1]."""
    sequence(problem, kind, tolerance, [reference])
    return sequence(problem._replace(cells=0), kind, tolerance, [reference] * COLD_REPEATS)


def _solver(
    problem: RollingProblem, kind: str, tolerance: float
) -> tuple[Callable[[Field, int], tuple[Field, FieldResult]], Callable[[], int]]:
    half_space = problem.half_space
    if kind in (ROLLING, NESTED):
        # These carry fields from one step to the next
        rolling = RollingField(half_space)

        def solve_rolling(gap: Field, cells: int) -> tuple[Field, FieldResult]:
            if kind == NESTED:
                rolling.reset()
            rolling.roll(cells)
            return rolling.pressure, rolling.solve_at_load(gap, LOAD, tolerance, CAP)

        return solve_rolling, lambda: rolling.convolutions
    # These start from the field of the step before, shifted or not, or from zero
    workspace, pressure = make_workspace(half_space), numpy.zeros((half_space.rows, half_space.cols))

    def solve(gap: Field, cells: int) -> tuple[Field, FieldResult]:
        if kind == COLD or cells >= len(pressure):
            pressure[:] = 0.0
        elif kind == SHIFTED:
            _roll(pressure, cells)
        result = field_solver.solve_at_load(half_space, workspace, gap, LOAD, tolerance, CAP, pressure)
        return pressure, result

    return solve, lambda: int(workspace.buffers.convolutions[0])


def _roll(pressure: Field, cells: int) -> None:
    """Shift a field by the cells that the road moved."""
    if cells:
        pressure[:-cells] = pressure[cells:].copy()
        pressure[-cells:] = 0.0


def calibrate() -> float:
    """Time [ms] of a fixed amount of work: a pair of transforms of 256 x 256, the median of 25."""
    field, walls = numpy.ones((256, 256)), []
    for _ in range(25):
        began = time.perf_counter()
        numpy.fft.irfft2(numpy.fft.rfft2(field))
        walls.append(time.perf_counter() - began)
    return 1e3 * float(numpy.median(walls))


def rows_of(
    grid: str, cells: int, seeds: int, steps: int, kinds: tuple[str, ...], notify: Callable[[str], None]
) -> list[dict[str, Any]]:
    """One row a solver and tolerance."""
    problems = [rolling_problem(grid, seed, cells) for seed in range(1, seeds + 1)]
    notify(f"{grid}: references")
    wanted = [
        references(problem, steps if any(kind not in (COLD, NESTED) for kind in kinds) else 1) for problem in problems
    ]
    rows: list[dict[str, Any]] = []
    for kind in kinds:
        for tolerance in TOLERANCES[kind]:
            notify(f"{grid}: {kind}, {tolerance:g}")
            if kind in (COLD, NESTED):
                found = [
                    cold(problem, kind, tolerance, fields[0]) for problem, fields in zip(problems, wanted, strict=True)
                ]
            else:
                if not rows or rows[-1]["solver"] != kind:
                    sequence(problems[0], kind, tolerance, wanted[0][:5])  # warm
                found = [
                    sequence(problem, kind, tolerance, fields) for problem, fields in zip(problems, wanted, strict=True)
                ]
            errors = numpy.concatenate([one.errors for one in found])
            seconds = numpy.concatenate([one.seconds for one in found])
            on_processor = numpy.concatenate([one.processor_seconds for one in found])
            rows.append(
                {
                    "grid": grid,
                    "cells": cells,
                    "solver": kind,
                    "tolerance": tolerance,
                    "error": float(numpy.median(errors)),
                    "largest error": float(errors.max()),
                    "largest/median": float(errors.max() / numpy.median(errors)),
                    "ms": 1e3 * float(numpy.median(seconds)),
                    "ms, 95 %": 1e3 * float(numpy.percentile(seconds, 95)),
                    "processor ms": 1e3 * float(numpy.median(on_processor)),
                    "convolutions": float(numpy.mean(numpy.concatenate([one.convolutions for one in found]))),
                }
            )
    return rows


def read_at(rows: list[dict[str, Any]], requested: float, column: str = "ms") -> float | None:
    """Time [ms] (or another column) at a requested relative error [1]: both logarithms
    interpolated; None outside what was measured."""
    points = sorted((row["error"], row[column]) for row in rows)
    for (low, slow), (high, fast) in itertools.pairwise(points):
        if low <= requested <= high and low < high:
            share = math.log(requested / low) / math.log(high / low)
            return math.exp((1.0 - share) * math.log(slow) + share * math.log(fast))
    return points[-1][1] if points and requested > points[-1][0] else None


def readings(rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Times at equal error."""
    found = []
    for grid, kind in dict.fromkeys((row["grid"], row["solver"]) for row in rows):
        those = [row for row in rows if (row["grid"], row["solver"]) == (grid, kind)]
        for requested in REQUESTED.get(kind, REQUESTED[LAST]):
            read = {
                name: read_at(those, requested, name) for name in ("ms", "ms, 95 %", "processor ms", "convolutions")
            }
            goal = GOALS.get((grid, kind, requested))
            found.append(
                {"grid": grid, "cells": those[0]["cells"], "solver": kind, "error": requested, **read, "goal": goal}
            )
    return found


@click.command()
@click.option("--grid", "grids", multiple=True, type=click.Choice(list(GRIDS)), help="Both where none is given.")
@click.option("--solver", "kinds", multiple=True, type=click.Choice(list(TOLERANCES)), help="All where none is given.")
@click.option("--cells", default=1, show_default=True, type=click.IntRange(1, 8), help="Travel of a step in cells.")
@click.option("--seeds", default=5, show_default=True, type=click.IntRange(1, 20), help="Roads.")
@click.option("--steps", default=200, show_default=True, type=click.IntRange(10, 220), help="Steps of a sequence.")
@click.option("--json", "as_json", is_flag=True, help="One JSON object on standard output, and nothing else.")
def main(grids: tuple[str, ...], kinds: tuple[str, ...], cells: int, seeds: int, steps: int, as_json: bool) -> None:
    """Measure the pressure field of a rolling tire patch: error, time, convolutions."""
    before = calibrate()
    rows: list[dict[str, Any]] = []
    for grid in grids or tuple(GRIDS):
        rows += rows_of(grid, cells, seeds, steps, kinds or tuple(TOLERANCES), lambda text: click.echo(text, err=True))
    machine = {"calibration before, ms": before, "calibration after, ms": calibrate()}
    read = readings(rows)
    if as_json:
        click.echo(json.dumps({"machine": machine, "rows": rows, "at equal error": read}, indent=2))
        return
    for table in (rows, read, [machine]):
        _print(table)


def _print(rows: list[dict[str, Any]]) -> None:
    cells = [["" if value is None else _text(value) for value in row.values()] for row in rows]
    heads = list(rows[0])
    widths = [max(len(line[column]) for line in [heads, *cells]) for column in range(len(heads))]
    for line in [heads, *cells]:
        click.echo("  ".join(text.ljust(width) for text, width in zip(line, widths, strict=True)).rstrip())
    click.echo()


def _text(value: Any) -> str:
    return f"{value:.3g}" if isinstance(value, float) else str(value)


if __name__ == "__main__":
    main()
