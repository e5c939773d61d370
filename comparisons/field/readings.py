"""Times at equal error, ratios between solvers, and how they stand to what was aimed at."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy

from comparisons.field.measure import Row
from comparisons.field.plan import Task
from comparisons.field.solver import OURS
from contact_sim_lab.field.field_benchmark import read_at

__all__ = ["AIMS", "Aim", "Reading", "Verdict", "readings", "verdicts"]


class Reading(NamedTuple):
    """One solver at one error: medians over the seeds."""

    task: str
    error: float
    solver: str
    ms: float | None
    ms_95: float | None
    largest_error: float | None  # of a step, the worst seed; equal to the error where there is one field
    ratio: float | None  # its time over ours, median over the seeds that both solved


class Aim(NamedTuple):
    """What a reading should be: our ratio to a solver at least, or our time [ms] at most."""

    task: str
    error: float
    solver: str
    study: float | None  # reached by the study that the solver's method was taken from
    goal: float


class Verdict(NamedTuple):
    """An aim and what was measured; None where it was not."""

    aim: Aim
    measured: float | None
    study_reached: bool | None
    goal_reached: bool | None


C_128, C_256 = "(c) tire, cold, 128x96", "(c) tire, cold, 256x192"
D_128, D_256 = "(d) tire, sequence, 128x96", "(d) tire, sequence, 256x192"
AIMS = (
    Aim(C_128, 1e-3, "ASPHER", 3.8, 4.0),
    Aim(C_128, 1e-5, "ASPHER", 3.8, 4.0),
    Aim(C_128, 1e-3, "tamaas", 24.0, 25.0),
    Aim(C_128, 1e-5, "tamaas", 26.0, 25.0),
    Aim(C_256, 1e-3, "ASPHER", None, 3.0),
    Aim(D_128, 1e-4, "ASPHER", 6.7, 7.0),
    Aim(D_128, 1.5e-3, OURS, 1.5, 1.0),
    Aim(D_128, 1e-2, OURS, 0.69, 0.5),
    Aim(D_256, 3e-4, OURS, None, 10.0),
)


def readings(task: Task, rows: list[Row]) -> list[Reading]:
    """Every solver of a task at every error asked."""
    found: list[Reading] = []
    for asked in task.asked:
        ours = _by_seed(rows, task.name, OURS, asked, "ms")
        for solver in task.shares:
            times = _by_seed(rows, task.name, solver, asked, "ms")
            slowest = _by_seed(rows, task.name, solver, asked, "ms_95")
            ratios = [times[seed] / ours[seed] for seed in times if seed in ours]
            largest = _by_seed(rows, task.name, solver, asked, "largest_error")
            found.append(
                Reading(
                    task.name,
                    asked,
                    solver,
                    _median(times.values()),
                    _median(slowest.values()),
                    max(largest.values(), default=None),
                    _median(ratios),
                )
            )
    return found


def verdicts(found: list[Reading]) -> list[Verdict]:
    """The aims whose task was measured."""
    result: list[Verdict] = []
    for aim in AIMS:
        those = [one for one in found if one[:3] == aim[:3]]
        if not those:
            continue
        measured = those[0].ms if aim.solver == OURS else those[0].ratio
        result.append(Verdict(aim, measured, _reached(aim, aim.study, measured), _reached(aim, aim.goal, measured)))
    return result


def _reached(aim: Aim, wanted: float | None, measured: float | None) -> bool | None:
    if wanted is None or measured is None:
        return None
    return measured <= wanted if aim.solver == OURS else measured >= wanted


def _by_seed(rows: list[Row], task: str, solver: str, asked: float, column: str) -> dict[int, float]:
    those: dict[int, list[dict[str, float]]] = {}
    for row in rows:
        if (row.task, row.solver) == (task, solver):
            those.setdefault(row.seed, []).append({"error": row.counted_error, "value": getattr(row, column)})
    read = {seed: read_at(points, asked, "value") for seed, points in those.items()}
    return {seed: value for seed, value in read.items() if value is not None}


def _median(values: Iterable[float]) -> float | None:
    numbers = list(values)
    return float(numpy.median(numbers)) if numbers else None
