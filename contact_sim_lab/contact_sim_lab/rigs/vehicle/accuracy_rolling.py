"""Accuracy and cost of a rolling tire: cells of the bristles, and steps of the belt.

*cells*: side force, aligning moment and braking force at steady slips of a rigid belt on the cells
of each level, against cells of half the finest side. *steps*: forces over a step of both slips with the belt
on its sidewalls, against steps of a sixteenth. Errors are relative, of a course in time that of its
L2 norm. The cost is that at 20 m/s.
"""

from __future__ import annotations

import copy
import time
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy

from contact_sim_pkg.rigs.vehicle.machines.flat_track import Track, track_of
from contact_sim_pkg.rigs.vehicle.tire.model import LONGEST_STEP
from contact_sim_pkg.rigs.vehicle.tire.schema import BrushSection, SidewallComplianceSection, TireField
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.schema.accuracy import LEVELS

__all__ = ["rolling_rows"]

SPEED = 20.0  # [m/s]
SLIPS = {"longitudinal": -0.03, "angle": 0.03}
CELLS_TIME, STEPS_TIME = 0.1, 0.3  # [s]
FINER = 2  # than the finest level
STEPS = (LONGEST_STEP, 0.5 * LONGEST_STEP, 0.25 * LONGEST_STEP)  # [s]
TINY = LONGEST_STEP / 32.0


def rolling_rows(scene: ResolvedScene, notify: Callable[[str], None]) -> list[dict[str, Any]]:
    """Rows of cells and steps; none for a scene without bristles."""
    field = scene.effect("tire", TireField)
    if scene.effect("tire", BrushSection) is None or field is None:
        return []
    levels = field.levels_of(scene)
    notify("rolling tire: reference cells")
    exact = _steady(_rolled(scene, (FINER * levels[-1].rows, FINER * levels[-1].cols), CELLS_TIME))
    rows = []
    for level, grid in zip(LEVELS, levels, strict=True):
        notify(f"rolling tire: {grid.rows} x {grid.cols} cells")
        began = time.perf_counter()
        found = _steady(_rolled(scene, (grid.rows, grid.cols), CELLS_TIME))
        cost = (time.perf_counter() - began) / CELLS_TIME
        head = _head("bristle cells", level.name, grid, field.length or 0.0, cost)
        rows += [{**head, "quantity": name, "error": abs(value / exact[name] - 1.0)} for name, value in found.items()]
    if scene.effect("tire", SidewallComplianceSection) is None:
        return rows
    notify("belt: reference steps")
    coarse = (levels[0].rows, levels[0].cols)
    course = _rolled(scene, coarse, STEPS_TIME, TINY)
    for step in STEPS:
        notify(f"belt: steps of {1e3 * step:g} ms")
        began = time.perf_counter()
        track = _rolled(scene, coarse, STEPS_TIME, step)
        head = _head("belt steps", "", levels[0], step, (time.perf_counter() - began) / STEPS_TIME)
        every = round(step / TINY)
        for name, column in (("force along on the axle", 0), ("side force on the axle", 1)):
            reference = course.axle[::every, column]
            missed = numpy.linalg.norm(track.axle[:, column] - reference) / numpy.linalg.norm(reference)
            rows.append({**head, "quantity": name, "error": float(missed)})
    return rows


def _head(part: str, level: str, grid: Any, tolerance: float, cost: float) -> dict[str, Any]:
    finest = "own code, finer cells" if part == "bristle cells" else f"own code, steps of {1e6 * TINY:.0f} µs"
    return {
        "part": part, "level": level, "grid": f"{grid.rows}x{grid.cols}",
        "tolerance": tolerance / grid.rows if part == "bristle cells" else tolerance, "reference": finest,
        "ms_per_simulated_s": 1e3 * cost,
    }  # fmt: skip


def _rolled(scene: ResolvedScene, cells: tuple[int, int], duration: float, step: float | None = None) -> Track:
    """The scene's tire at steady slips; with a ``step`` [s] on its sidewalls, without on a rigid belt."""
    data = copy.deepcopy(scene.data)
    tire = data["effects"]["tire"]
    tire["contact_field"] = {**tire["contact_field"], "rows": cells[0], "cols": cells[1]}
    tire["wheel_spin"] = None
    if step is None:
        tire["sidewall_compliance"] = None
    data["slip"] = SLIPS
    return track_of(replace(scene, data=data), SPEED, duration, *(() if step is None else (step,)))


def _steady(track: Track) -> dict[str, float]:
    along, across, moment = track.force[-80:].mean(axis=0)
    return {"braking force": float(along), "side force": float(across), "aligning moment": float(moment)}
