"""A hard case: a computed value beside an expectation that shares no code with it, and the margin
that is left.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

__all__ = ["Finding", "HardCase", "at_most", "close_to", "exactly"]


class Finding(NamedTuple):
    """What a case found."""

    value: float
    expectation: str
    margin: float  # part of the allowance that is left; the case holds where it is not negative


class HardCase(NamedTuple):
    """One row: the model, what is hard about it, and the function that finds out."""

    model: str
    case: str
    find: Callable[[], Finding]


def close_to(value: float, expected: float, allowed: float) -> Finding:
    """`value` within `allowed` (absolute, same unit) of `expected`."""
    error = abs(value - expected)
    margin = 1.0 - error / allowed if math.isfinite(error) else -math.inf
    return Finding(value, f"{expected:.10g} ± {allowed:.2g}", margin)


def at_most(value: float, limit: float) -> Finding:
    """`value`, a size that is not negative, at most `limit`."""
    margin = 1.0 - value / limit if math.isfinite(value) else -math.inf
    return Finding(value, f"≤ {limit:.3g}", margin)


def exactly(value: float, expected: float) -> Finding:
    """`value` equal to `expected` to the last bit, as for counts, codes and true zeros."""
    return Finding(value, f"= {expected:.10g}", 1.0 if value == expected else -math.inf)
