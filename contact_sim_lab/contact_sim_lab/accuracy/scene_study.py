"""`bench accuracy SCENE`: what accuracy costs in time, for each tolerance, grid and level that the
scene can be run with.

Columns of a row: `quantity`, `part` (what is varied: integrator, coupling, field solver, …),
`level`, `grid`, `tolerance`, `error` (relative), `reference` (what the error is against, and
whether it is own code), `ms_per_simulated_s`, and in a new process the time to the first answer:
`first_call_s`, with nothing compiled, and `next_start_s`, with the kernels on disk. How to read it:
`docs/accuracy_notebook.md`.
"""

from __future__ import annotations

import json
import os
import subprocess
import tempfile
from collections.abc import Callable
from typing import Any

from contact_sim_lab.accuracy.scene_plot import write_plot
from contact_sim_lab.accuracy.scene_table import sections
from contact_sim_lab.cases import RigStudies, objects, rig_studies
from contact_sim_lab.records.accuracy import AccuracyStudy
from contact_sim_pkg.python_process import python_command
from contact_sim_pkg.scene.errors import Fault, SceneError
from contact_sim_pkg.scene.resolve import load_resolved

__all__ = ["first_call_times", "sections", "studies_of", "study", "write_plot"]


def studies_of(rig: str) -> list[AccuracyStudy]:
    """Studies of a rig; none for one without."""
    return objects(rig_studies().get(rig, RigStudies()).accuracy, "ACCURACY")


COLUMNS = (
    "quantity", "part", "level", "grid", "tolerance", "error", "reference", "ms_per_simulated_s", "first_call_s",
    "next_start_s",
)  # fmt: skip


def study(scene_name: str, progress: Callable[[str], None] | None = None) -> list[dict[str, Any]]:
    """All rows for a scene by name or path. Takes 30 to 90 s. Raises what a bad scene raises."""
    notify = progress or (lambda text: None)
    scene = load_resolved(scene_name)
    rig = scene.data["rig"]
    studies = studies_of(rig)
    if not studies:
        measured = ", ".join(name for name, each in rig_studies().items() if each.accuracy)
        sentence = (
            f"the cost of accuracy is measured for the rigs {measured}, not for {rig}; compare "
            "runs with --set integrator.relative_tolerance=… instead"
        )
        raise SceneError([Fault(scene_name, 0, 0, "rig", sentence)])
    notify("first call in a new process: everything is compiled, then again from the disk")
    first, again = first_call_times(scene_name)
    rows = [row for each in studies for row in each.rows(scene_name, scene, notify)]
    # Start-up time is that of the code a row measures
    for row in rows:
        key = "field" if row["part"].startswith("field") else "simulation"
        row["first_call_s"], row["next_start_s"] = first[key], again[key]
    return [{name: row.get(name) for name in COLUMNS} for row in rows]


def first_call_times(scene_name: str) -> tuple[dict[str, float | None], dict[str, float | None]]:
    """Times [s] until the first block and the first field solve are done in a new process: compiled
    anew, and from the disk.

    None where it could not be measured.
    """
    with tempfile.TemporaryDirectory() as folder:
        environment = {**os.environ, "CONTACT_BENCH_CACHE": folder}
        return _first_call(scene_name, environment), _first_call(scene_name, environment)


def _first_call(scene_name: str, environment: dict[str, str]) -> dict[str, float | None]:
    command = python_command("contact_sim_lab.first_call", scene_name)
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        return {"simulation": None, "field": None}
    times: dict[str, float | None] = json.loads(done.stdout)
    return times
