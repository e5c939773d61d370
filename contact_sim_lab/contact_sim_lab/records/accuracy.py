"""An accuracy study of a scene: the function that measures, and how its rows are shown."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

__all__ = ["INTEGRATOR", "AccuracyPart", "AccuracyStudy", "Rows", "field_parts"]

Rows = Callable[[str, Any, Callable[[str], None]], list[dict[str, Any]]]
"""(name of the scene, resolved scene, progress) -> rows"""

CHECK = "check"
"""Fidelity level of rows that compare with another code."""


class AccuracyPart(NamedTuple):
    """Rows that stand in one table and one panel of the plot."""

    part: str
    """value of the column `part`"""
    heading: str
    """of the table"""
    panel: str
    """title of the panel; parts of one title share it"""
    level: str = ""
    """what the lines of the table are called; empty: they are tolerances"""
    contact: str = ""
    """of a pressure field: beginning of the column `quantity`; lines are grids and tolerances"""
    check: bool = False
    """only rows of the level `CHECK`, else only others"""

    def holds(self, row: dict[str, Any]) -> bool:
        """Whether a row belongs to this part."""
        named = row["part"] == self.part and str(row["quantity"]).startswith(self.contact)
        return bool(named and (row["level"] == CHECK) == self.check)


class AccuracyStudy(NamedTuple):
    """Study of a scene's accuracy."""

    rows: Rows
    parts: tuple[AccuracyPart, ...]
    first_call: Callable[[Any], float | None] | None = None
    """resolved scene -> seconds of the first solve of what compiles longest; None where the scene
    has none
    """


INTEGRATOR = AccuracyPart("integrator", "time integration, point contacts: error", "time integration, point contacts")


def field_parts(contact: str) -> tuple[AccuracyPart, ...]:
    """Parts of the pressure field of a contact: solver, grid, check against another code."""
    panel = f"{contact} field"
    return (
        AccuracyPart("field solver", f"{panel}, error of the solver", panel, contact=contact),
        AccuracyPart("field grid", f"{panel}, error of the grid", panel, contact=contact),
        AccuracyPart(
            "field solver", f"{panel}, started from nothing, against another code", panel, contact=contact, check=True
        ),
    )
