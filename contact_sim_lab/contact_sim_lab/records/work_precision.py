"""A work-precision study: one quantity by several methods, error beside time. Its rows, and the
time of a call.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from typing import Any, NamedTuple, TypeVar

__all__ = ["COLUMNS", "FidelityLevel", "Row", "WorkPrecision", "milliseconds", "relative", "row", "timed_once"]

Row = dict[str, Any]
Answer = TypeVar("Answer")

COLUMNS = (
    "rig", "part", "case", "quantity", "level", "grid", "tolerance", "value", "expected", "error", "solver_error", "grid_error",
    "reference", "ms_per_call",
)  # fmt: skip

SHORTEST_SAMPLE = 2e-4  # [s] shorter calls are timed in groups
FEWEST, MOST = 5, 51  # samples
BUDGET = 0.1  # [s] after which no further sample is begun


class FidelityLevel(NamedTuple):
    """One way to the answer, and what a call of it costs."""

    name: str
    ms: float
    grid: str | None = None
    tolerance: float | None = None


class WorkPrecision(NamedTuple):
    """One quantity by inexpensive and expensive methods on the same input."""

    part: str
    rows: Callable[[], list[Row]]


def milliseconds(call: Callable[[], object]) -> float:
    """Median processor time [ms] of a call in one thread: the wall time on an idle core, and
    independent of the load on a busy one.

    The first call, which may compile, does not count.
    """
    call()
    began = time.thread_time()
    call()
    # Short calls are timed in groups, so that the clock's resolution does not matter
    group = max(1, int(SHORTEST_SAMPLE / max(time.thread_time() - began, 1e-7)))
    samples: list[float] = []
    while len(samples) < FEWEST or (sum(samples) * group < BUDGET and len(samples) < MOST):
        began = time.thread_time()
        for _ in range(group):
            call()
        samples.append((time.thread_time() - began) / group)
    return 1e3 * statistics.median(samples)


def timed_once(call: Callable[[], Answer]) -> tuple[Answer, float]:
    """Result of a call that is too expensive to repeat, and its processor time [ms]."""
    began = time.thread_time()
    answer = call()
    return answer, 1e3 * (time.thread_time() - began)


def relative(value: float, expected: float) -> float:
    """Relative error [1] of `value` against `expected` (same unit): `|value / expected - 1|`."""
    return abs(value / expected - 1.0)


def row(
    part: str,
    case: str,
    quantity: str,
    level: FidelityLevel,
    reference: str,
    error: float,
    *,
    value: float | None = None,
    expected: float | None = None,
    solver_error: float | None = None,
    grid_error: float | None = None,
) -> Row:
    """One row of the study, without the rig. Errors are relative [1]; value and expected have the
    unit of the quantity."""
    return {
        "part": part, "case": case, "quantity": quantity, "level": level.name, "grid": level.grid, "tolerance": level.tolerance,
        "value": value, "expected": expected, "error": error, "solver_error": solver_error, "grid_error": grid_error,
        "reference": reference, "ms_per_call": level.ms,
    }  # fmt: skip
