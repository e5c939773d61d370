"""A hard case: a computed value beside an expectation that shares no code with it, and the margin
that is left.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

__all__ = ["Finding", "HardCase", "at_most", "close_to", "exactly"]


class Finding(NamedTuple):
    """Result of a case."""

    value: float
    expectation: str
    margin: float  # part of the allowance that is left; the case holds where it is not negative


class HardCase(NamedTuple):
    """One row: the model, what is hard about it, and the function that finds out."""

    model: str
    case: str
    find: Callable[[], Finding]


def close_to(value: float, expected: float, allowed: float) -> Finding:
    """Finding that `value` lies within `allowed` (absolute) of `expected`; all in one unit, the
    margin [1]."""
    error = abs(value - expected)
    margin = 1.0 - error / allowed if math.isfinite(error) else -math.inf
    return Finding(value, f"{expected:.10g} ± {allowed:.2g}", margin)


def at_most(value: float, limit: float) -> Finding:
    """Finding that `value`, a size that is not negative, is at most `limit` (same unit); the margin
    [1]."""
    margin = 1.0 - value / limit if math.isfinite(value) else -math.inf
    return Finding(value, f"≤ {limit:.3g}", margin)


def exactly(value: float, expected: float) -> Finding:
    """Finding that `value` equals `expected` (same unit) to the last bit, as counts, codes and true
    zeros do; margin [1]."""
    return Finding(value, f"= {expected:.10g}", 1.0 if value == expected else -math.inf)
