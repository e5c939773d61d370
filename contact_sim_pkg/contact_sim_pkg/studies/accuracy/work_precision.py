"""`bench accuracy RIG`: the ladders of a rig: each quantity at several prices on the same input, error beside time.

Columns of a row: `rig`, `part` (the ladder), `case` (the input), `quantity`, `rung`, `grid`, `tolerance`, `value` and `expected`
(SI; null for an L2 distance), `error` (relative, against `reference`), and where a grid is solved its two parts: `solver_error`,
against the same grid to 1e-10, and `grid_error`, of the converged grid against the reference; `ms_per_call` (processor time
of one thread, median of many calls, compiled and warm, fields from nothing). How to read it: `docs/accuracy.md`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from contact_sim_pkg.identify.studies import work_precision as ladder_identification
from contact_sim_pkg.papers.cnoidal import work_precision_modes as ladder_modes
from contact_sim_pkg.papers.cnoidal import work_precision_periodic as ladder_periodic
from contact_sim_pkg.papers.distance import work_precision as ladder_closest
from contact_sim_pkg.records.work_precision import COLUMNS, Row
from contact_sim_pkg.rigs.backrest.studies import work_precision_shell as ladder_shell
from contact_sim_pkg.rigs.body.studies import work_precision as ladder_block
from contact_sim_pkg.rigs.impact.studies import work_precision as ladder_impact
from contact_sim_pkg.rigs.impact.studies import work_precision_material as ladder_impact_material
from contact_sim_pkg.rigs.impact.studies import work_precision_memory as ladder_impact_memory
from contact_sim_pkg.rigs.roller.studies import work_precision as ladder_roller
from contact_sim_pkg.rigs.roller.studies import work_precision_interval as ladder_roller_interval
from contact_sim_pkg.rigs.vehicle.studies import work_precision_area as ladder_area
from contact_sim_pkg.rigs.vehicle.studies import work_precision_elliptic as ladder_elliptic
from contact_sim_pkg.rigs.vehicle.studies import work_precision_exponent as ladder_exponent
from contact_sim_pkg.rigs.vehicle.studies import work_precision_force as ladder_force
from contact_sim_pkg.rigs.vehicle.studies import work_precision_road as ladder_road
from contact_sim_pkg.rigs.vehicle.studies import work_precision_rough as ladder_rough
from contact_sim_pkg.rigs.vehicle.studies import work_precision_smooth as ladder_smooth
from contact_sim_pkg.studies.laws import work_precision_restitution as ladder_restitution

__all__ = ["RIGS", "Ladder", "study"]


class Ladder(NamedTuple):
    """One quantity at several prices."""

    part: str
    rows: Callable[[], list[Row]]


RIGS: dict[str, tuple[Ladder, ...]] = {
    "tire": (
        Ladder(ladder_elliptic.PART, ladder_elliptic.rows),
        Ladder(ladder_force.PART, ladder_force.rows),
        Ladder(ladder_smooth.PART, ladder_smooth.rows),
        Ladder(ladder_rough.PART, ladder_rough.rows),
        Ladder(ladder_rough.GRIDS_PART, ladder_rough.grid_rows),
        Ladder(ladder_rough.CHECK_PART, ladder_rough.check_rows),
        Ladder(ladder_area.PART, ladder_area.rows),
        Ladder(ladder_exponent.PART, ladder_exponent.rows),
        Ladder(ladder_road.PART, ladder_road.rows),
    ),
    "seat": (
        Ladder(ladder_restitution.PART, ladder_restitution.rows),
        Ladder(ladder_periodic.PART, ladder_periodic.rows),
        Ladder(ladder_periodic.ANSATZ_PART, ladder_periodic.ansatz_rows),
        Ladder(ladder_modes.PART, ladder_modes.rows),
        Ladder(ladder_shell.PART, ladder_shell.rows),
        Ladder(ladder_closest.PART, ladder_closest.rows),
    ),
    "block": (
        Ladder(ladder_block.SOLVER_PART, ladder_block.solver_rows),
        Ladder(ladder_block.CONE_PART, ladder_block.cone_rows),
        Ladder(ladder_block.STEP_PART, ladder_block.step_rows),
        Ladder(ladder_block.TURN_PART, ladder_block.turn_rows),
        Ladder(ladder_identification.PART, ladder_identification.rows),
    ),
    "impact": (
        Ladder(ladder_impact.PART, ladder_impact.rows),
        Ladder(ladder_impact_material.PART, ladder_impact_material.rows),
        Ladder(ladder_impact_material.FRONT_PART, ladder_impact_material.front_rows),
        Ladder(ladder_impact_memory.HISTORY_PART, ladder_impact_memory.history_rows),
        Ladder(ladder_impact_memory.RESPONSE_PART, ladder_impact_memory.response_rows),
    ),
    "roller": (
        Ladder(ladder_elliptic.PART, ladder_elliptic.rows),
        Ladder(ladder_roller.STRESS_PART, ladder_roller.stress_rows),
        Ladder(ladder_roller.VOLUME_PART, ladder_roller.volume_rows),
        Ladder(ladder_roller.MOTION_PART, ladder_roller.motion_rows),
        Ladder(ladder_roller.SPLIT_PART, ladder_roller.split_rows),
        Ladder(ladder_roller.WAVE_PART, ladder_roller.wave_rows),
        Ladder(ladder_roller_interval.PART, ladder_roller_interval.rows),
    ),
}
"""Rig -> its ladders. A further rig is one more entry."""


def study(rig: str, progress: Callable[[str], None] | None = None) -> list[dict[str, Any]]:
    """All rows of a rig of `RIGS`; raises `KeyError` for another."""
    found: list[dict[str, Any]] = []
    for ladder in RIGS[rig]:
        if progress is not None:
            progress(f"{rig}: {ladder.part}")
        found += [{"rig": rig, **row} for row in ladder.rows()]
    return [{name: row.get(name) for name in COLUMNS} for row in found]
