"""`bench accuracy SCENE`: what accuracy costs in time, for each tolerance, grid and rung that the scene can be run with.

Columns of a row: `quantity`, `part` (integrator, corrector, field solver, field grid), `rung`, `grid`, `tolerance`,
`error` (relative), `reference` (what the error is against, and whether it is own code), `ms_per_simulated_s` and
`first_call_s` (in a fresh process, kernels from the disk cache where they are there). How to read it: `docs/accuracy.md`.
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable
from typing import Any

from contact_sim_pkg.studies import accuracy_cost_field, accuracy_cost_integrator
from contact_sim_pkg.studies.accuracy_cost_plot import plot, write_plot
from contact_sim_pkg.studies.scene_drive import load_resolved

__all__ = ["first_call_times", "plot", "study", "write_plot"]

COLUMNS = (
    "quantity", "part", "rung", "grid", "tolerance", "error", "reference", "ms_per_simulated_s", "first_call_s",
)  # fmt: skip


def study(scene_name: str, progress: Callable[[str], None] | None = None) -> list[dict[str, Any]]:
    """All rows for a scene by name or path. Takes 10 to 30 s. Raises what a bad scene raises."""
    tell = progress or (lambda text: None)
    scene = load_resolved(scene_name)
    tell("first call in a fresh process")
    first = first_call_times(scene_name)
    rows = accuracy_cost_integrator.tolerance_rows(scene, tell)
    rows += accuracy_cost_integrator.corrector_rows(scene_name, scene, tell)
    rows += accuracy_cost_field.field_rows(scene, tell)
    for row in rows:
        row["first_call_s"] = first["field" if row["part"].startswith("field") else "simulation"]
    return [{name: row[name] for name in COLUMNS} for row in rows]


def first_call_times(scene_name: str) -> dict[str, float | None]:
    """Seconds until the first block and the first field solve are done, in a new process; None where it could not be measured."""
    command = [sys.executable, "-m", "contact_sim_pkg.studies.first_call", scene_name]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        return {"simulation": None, "field": None}
    times: dict[str, float | None] = json.loads(done.stdout)
    return times
