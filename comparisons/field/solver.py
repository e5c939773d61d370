"""What a solver under comparison offers; each solver is adapted to it in a module of its own."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import NamedTuple, Protocol

import numpy

from comparisons.environment import left_out
from comparisons.field.problems import Field, Problem

__all__ = ["OURS", "Candidate", "NotSolvedError", "Solver", "candidates", "rolled"]

OURS = "ours"
_MODULES = {OURS: "with_ours", "tamaas": "with_tamaas", "ASPHER": "with_aspher"}


class NotSolvedError(Exception):
    """A solver says itself that it did not reach the tolerance."""


class Solver(Protocol):
    """Solves one problem, step by step."""

    untimed: float  # [s] wall time that the last solve spent on tables, which count as set-up

    def reset(self) -> None:
        """The next field starts from nothing."""

    def solve(self, gap: Field, cells: int, tolerance: float) -> Field:
        """The field [Pa] where the road moved by `cells` rows towards row 0 since the last; started from it unless forgotten.

        tolerance: in the solver's own sense. Raises `NotSolvedError`.
        """


class Candidate(NamedTuple):
    """A solver that is installed here."""

    name: str
    version: str
    settings: str
    make: Callable[[Problem, bool], Solver]  # of a problem; whether it comes as a sequence of steps


def candidates() -> tuple[list[Candidate], dict[str, str]]:
    """The solvers that are installed, ours first; and the names of the others with the reason."""
    found: list[Candidate] = []
    missing: dict[str, str] = {}
    reasons = left_out()
    for name, module in _MODULES.items():
        try:
            adapter = import_module(f"comparisons.field.{module}")
        except ImportError as error:
            missing[name] = reasons.get(name, str(error))
            continue
        found.append(Candidate(name, adapter.version(), adapter.SETTINGS, adapter.make))
    return found, missing


def rolled(pressure: Field, cells: int) -> Field:
    """A field moved by `cells` rows towards row 0, zero where nothing is known."""
    if cells <= 0:
        return pressure
    moved = numpy.zeros_like(pressure)
    moved[:-cells] = pressure[cells:]
    return moved
