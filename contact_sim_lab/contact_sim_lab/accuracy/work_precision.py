"""`bench accuracy RIG`: each quantity of a rig by inexpensive and expensive methods on the same
input.

Columns of a row: `rig`, `part` (the study), `case` (the input), `quantity`, `level`, `grid`,
`tolerance`, `value` and `expected` (SI; null for an L2 distance), `error` (relative, against
`reference`), and where a grid is solved its two parts: `solver_error`, against the same grid to
1e-10, and `grid_error`, of the converged grid against the reference; `ms_per_call` (processor time
of one thread, median of many calls, compiled and warm, fields from nothing). How to read it:
`docs/accuracy_notebook.md`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from contact_sim_lab.cases import objects, rig_studies
from contact_sim_lab.records.work_precision import COLUMNS, WorkPrecision

__all__ = ["measured_rigs", "studies_of", "study"]


def measured_rigs() -> list[str]:
    """Rigs that have studies."""
    return [name for name, studies in rig_studies().items() if studies.work_precision]


def studies_of(rig: str) -> list[WorkPrecision]:
    """Studies of a rig, in the order of its record. KeyError for one that is not there."""
    return objects(rig_studies()[rig].work_precision, "WORK_PRECISION")


def study(rig: str, progress: Callable[[str], None] | None = None) -> list[dict[str, Any]]:
    """All rows of a rig. KeyError for one that is not there."""
    found: list[dict[str, Any]] = []
    for part, rows in studies_of(rig):
        if progress is not None:
            progress(f"{rig}: {part}")
        found += [{"rig": rig, **row} for row in rows()]
    return [{name: row.get(name) for name in COLUMNS} for row in found]
