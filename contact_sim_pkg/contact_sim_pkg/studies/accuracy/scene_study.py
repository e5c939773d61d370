"""`bench accuracy SCENE`: what accuracy costs in time, for each tolerance, grid and rung that the scene can be run with.

Columns of a row: `quantity`, `part` (integrator, coupling, field solver, field grid, modes,
scheme in time, turning on held contacts, friction cone, contact model, those of the roller), `rung`, `grid`, `tolerance`,
`error` (relative), `reference` (what the error is against, and whether it is own code),
`ms_per_simulated_s`, and in a new process the time to the first answer: `first_call_s`, with nothing compiled, and
`next_start_s`, with the kernels on disk. How to read it: `docs/accuracy.md`.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable
from typing import Any

from contact_sim_pkg.rigs.backrest.studies import accuracy as backrest
from contact_sim_pkg.rigs.body.studies import accuracy as accuracy_cost_block
from contact_sim_pkg.rigs.impact.studies import accuracy as accuracy_cost_impact
from contact_sim_pkg.rigs.roller.studies import accuracy as accuracy_cost_roller
from contact_sim_pkg.rigs.vehicle.studies import accuracy_coupling as accuracy_cost_coupling
from contact_sim_pkg.rigs.vehicle.studies import accuracy_field as accuracy_cost_field
from contact_sim_pkg.rigs.vehicle.studies import accuracy_integrator as accuracy_cost_integrator
from contact_sim_pkg.rigs.vehicle.studies.scene_drive import load_resolved
from contact_sim_pkg.scene.errors import Fault, SceneError
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.studies.accuracy.scene_plot import write_plot
from contact_sim_pkg.studies.accuracy.scene_table import sections

__all__ = ["first_call_times", "sections", "study", "write_plot"]

Part = Callable[[str, ResolvedScene, Callable[[str], None]], list[dict[str, Any]]]
_VEHICLE: tuple[Part, ...] = (
    lambda _name, scene, tell: accuracy_cost_integrator.tolerance_rows(scene, tell),
    accuracy_cost_coupling.coupling_rows,
    lambda _name, scene, tell: accuracy_cost_field.field_rows(scene, tell),
)


def _named(contact: str, part: Part) -> Part:
    """The rows of ``part`` under the name of a contact, where a rig has them of two."""

    def rows(name: str, scene: ResolvedScene, tell: Callable[[str], None]) -> list[dict[str, Any]]:
        return [{**row, "quantity": f"{contact}: {row['quantity']}"} for row in part(name, scene, tell)]

    return rows


_BACKREST: tuple[Part, ...] = (backrest.tolerance_rows, backrest.mode_rows)
PARTS: dict[str, tuple[Part, ...]] = {
    "tire": _VEHICLE,
    "seat": _VEHICLE,
    "car": _VEHICLE,
    "backrest": _BACKREST,
    "occupant": (
        *(_named("seat", part) for part in _VEHICLE),
        *(_named("backrest", part) for part in _BACKREST),
    ),
    "impact": (accuracy_cost_impact.way_rows,),
    "block": (
        accuracy_cost_block.scheme_rows,
        accuracy_cost_block.turn_rows,
        accuracy_cost_block.facet_rows,
        accuracy_cost_block.contact_rows,
    ),
    "roller": (accuracy_cost_roller.rows,),
}
"""Rig -> what is measured of it; each part gives its rows. A further rig is one more entry."""
COLUMNS = (
    "quantity", "part", "rung", "grid", "tolerance", "error", "reference", "ms_per_simulated_s", "first_call_s",
    "next_start_s",
)  # fmt: skip


def study(scene_name: str, progress: Callable[[str], None] | None = None) -> list[dict[str, Any]]:
    """All rows for a scene by name or path. Takes 30 to 90 s. Raises what a bad scene raises."""
    tell = progress or (lambda text: None)
    scene = load_resolved(scene_name)
    rig = scene.data["rig"]
    if rig not in PARTS:
        sentence = (
            f"the cost of accuracy is measured for the rigs {', '.join(PARTS)}, not for {rig}; compare "
            "runs with --set integrator.relative_tolerance=… instead"
        )
        raise SceneError([Fault(scene_name, 0, 0, "rig", sentence)])
    tell("first call in a new process: everything is compiled, then again from the disk")
    first, again = first_call_times(scene_name)
    rows = [row for part in PARTS[rig] for row in part(scene_name, scene, tell)]
    for row in rows:
        key = "field" if row["part"].startswith("field") else "simulation"
        row["first_call_s"], row["next_start_s"] = first[key], again[key]
    return [{name: row.get(name) for name in COLUMNS} for row in rows]


def first_call_times(scene_name: str) -> tuple[dict[str, float | None], dict[str, float | None]]:
    """Seconds until the first block and the first field solve are done in a new process: compiled anew, and from the disk.

    None where it could not be measured.
    """
    with tempfile.TemporaryDirectory() as folder:
        environment = {**os.environ, "CONTACT_BENCH_CACHE": folder}
        return _first_call(scene_name, environment), _first_call(scene_name, environment)


def _first_call(scene_name: str, environment: dict[str, str]) -> dict[str, float | None]:
    command = [sys.executable, "-m", "contact_sim_pkg.studies.first_call", scene_name]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        return {"simulation": None, "field": None}
    times: dict[str, float | None] = json.loads(done.stdout)
    return times
