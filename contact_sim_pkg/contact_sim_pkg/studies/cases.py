"""Where the studies find their cases: those that belong to no rig are listed here, by room; rigs
bring theirs.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from contact_sim_pkg.records.registry import rigs
from contact_sim_pkg.records.rig import load

__all__ = ["GOALS", "HARD_CASES", "modules_of_rigs", "objects"]

_PACKAGE = "contact_sim_pkg"

HARD_CASES = (
    *(f"{_PACKAGE}.studies.laws.{name}" for name in (
        "hard_cases_law", "hard_cases_general_law", "hard_cases_impact", "hard_cases_friction", "hard_cases_foam",
    )),
    *(f"{_PACKAGE}.studies.field.{name}" for name in ("hard_cases_geometry", "hard_cases_field", "hard_cases_entries")),
    *(f"{_PACKAGE}.papers.{name}.hard_cases" for name in ("distance", "cnoidal")),
    f"{_PACKAGE}.identify.studies.hard_cases",
    f"{_PACKAGE}.studies.effects.absent_laws",
)  # fmt: skip
"""Modules of hard cases of no rig."""

GOALS = (
    *(f"{_PACKAGE}.studies.goals.{name}" for name in ("runs", "laws")),
    f"{_PACKAGE}.identify.studies.goals",
)
"""Modules of goals of no rig."""


def modules_of_rigs(field: str) -> tuple[str, ...]:
    """Modules that the records of the rigs name in a field, each once."""
    return tuple(dict.fromkeys(name for rig in rigs().values() for name in getattr(rig, field)))


def objects(modules: Iterable[str], constant: str) -> list[Any]:
    """What modules list in a constant, one after the other. Raises what their import raises."""
    return [each for module in modules for each in load(f"{module}:{constant}")]
