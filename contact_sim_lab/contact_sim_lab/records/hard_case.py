"""A hard case: a computed value beside an expectation that shares no code with it, the margin that is
left, and the guard that its run must meet to be hard.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

from contact_sim_lab.records.guard import Guard

__all__ = ["Finding", "HardCase", "at_most", "close_to", "exactly"]


class Finding(NamedTuple):
    """Result of a case."""

    value: float
    expectation: str
    margin: float  # part of the allowance that is left; the case holds where it is not negative
    hard: float  # figure of the guard, measured from the run or the input that makes the case hard


class HardCase(NamedTuple):
    """One row: the model, what is hard about it, the function that finds out, and what shows that its run
    is hard.
    """

    model: str
    case: str
    find: Callable[[], Finding]
    is_hard: Guard


def close_to(value: float, expected: float, allowed: float, *, hard: float) -> Finding:
    """Finding that `value` lies within `allowed` (absolute) of `expected`; all in one unit, the
    margin [1]. `hard`: figure of the guard, in its own unit."""
    error = abs(value - expected)
    margin = 1.0 - error / allowed if math.isfinite(error) else -math.inf
    return Finding(value, f"{expected:.10g} ± {allowed:.2g}", margin, float(hard))


def at_most(value: float, limit: float, *, hard: float) -> Finding:
    """Finding that `value`, a size that is not negative, is at most `limit` (same unit); the margin
    [1]. `hard`: figure of the guard, in its own unit."""
    margin = 1.0 - value / limit if math.isfinite(value) else -math.inf
    return Finding(value, f"≤ {limit:.3g}", margin, float(hard))


def exactly(value: float, expected: float, *, hard: float) -> Finding:
    """Finding that `value` equals `expected` (same unit) to the last bit, as counts, codes and true
    zeros do; margin [1]. `hard`: figure of the guard, in its own unit."""
    return Finding(value, f"= {expected:.10g}", 1.0 if value == expected else -math.inf, float(hard))
