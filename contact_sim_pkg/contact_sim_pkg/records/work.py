"""A part of the work of a run, estimated before it."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["STEP_COST", "Work"]

STEP_COST = 1.5e-6
"""[s] of a step of the integrator on one core of a usual machine (2 GHz)."""


class Work(NamedTuple):
    """So many parts of one kind, and what each costs."""

    what: str  # counted, in the plural, and its cause
    number: float
    cost: float  # [s] of one

    @property
    def seconds(self) -> float:
        """Of computing."""
        return self.number * self.cost
