"""A measured figure and the goal it is compared with."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from typing import NamedTuple

__all__ = ["GoalPart", "Measured", "median_time"]

REPEATS = 7


class Measured(NamedTuple):
    """One figure; `most` or `least` is its goal, both None where it has none. `value` is None where
    it could not be measured.
    """

    what: str
    value: float | None
    unit: str
    most: float | None = None
    least: float | None = None
    note: str = ""

    @property
    def goal(self) -> str:
        """The goal as text, empty where there is none."""
        if self.most is not None:
            return f"≤ {self.most:g}"
        return "" if self.least is None else f"≥ {self.least:g}"

    @property
    def reached(self) -> bool | None:
        """Whether the goal is reached; None where there is no goal or no figure."""
        if self.value is None or (self.most is None and self.least is None):
            return None
        return (self.most is None or self.value <= self.most) and (self.least is None or self.value >= self.least)


class GoalPart(NamedTuple):
    """Figures that are measured together, and what they are of."""

    part: str
    measure: Callable[[], list[Measured]]


def median_time(call: Callable[[], object], repeats: int = REPEATS) -> float:
    """Median wall time [s] of a call, after one that does not count."""
    call()
    walls = []
    for _ in range(repeats):
        began = time.perf_counter()
        call()
        walls.append(time.perf_counter() - began)
    return statistics.median(walls)
