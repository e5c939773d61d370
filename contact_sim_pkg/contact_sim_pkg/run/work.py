"""The work of a run, estimated from its scene before anything starts: steps, cells and turns times
what each costs.

The costs are those of one core of a usual machine (2 GHz), so that a scene is refused or not
wherever it runs. What depends on the motion itself is left out: the estimate is the least that is
sure. Each rig counts its own parts.
"""

from __future__ import annotations

from collections.abc import Iterator

from contact_sim_pkg.records.fields import given
from contact_sim_pkg.records.registry import rigs
from contact_sim_pkg.records.rig import load
from contact_sim_pkg.records.work import Work
from contact_sim_pkg.scene.errors import Fault, SceneError
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.schema.pressure_field import PressureFieldSection

__all__ = ["BOUND", "estimated_work", "refuse_long"]

BOUND = 600.0
"""[s] of computing that a run may take unasked, or its duration where that is longer."""
LONG = 30.0
"""[s] from which on the estimate is reported."""
BLOCK_COST = 1e-3  # [s] of the outputs of a block
FIELD_COST = 1e-6  # [s] of a cell of a pressure field


def estimated_work(scene: ResolvedScene) -> list[Work]:
    """Parts of the work of a resolved scene, the largest first."""
    parts = [Work("blocks", scene.duration / scene.block_length, BLOCK_COST), *_fields(scene)]
    if named := rigs()[scene.rig].work:
        parts += load(named)(scene)
    return sorted(parts, key=lambda part: part.seconds, reverse=True)


def refuse_long(scene: ResolvedScene, *, allowed: bool) -> str:
    """Report of the work before the run; empty where it is short. SceneError beyond the bound,
    unless ``allowed``.
    """
    parts = estimated_work(scene)
    total, bound = sum(part.seconds for part in parts), max(BOUND, scene.duration)
    report = f"about {parts[0].number:.2g} {parts[0].what}, {_time(total)} of computing"
    if total > bound and not allowed:
        cure = f"more than {_time(bound)}; --allow-long lifts the bound, a shorter duration takes less"
        raise SceneError([Fault(scene.name, 0, 0, "", f"{report}, {cure}")])
    return report if total > LONG else ""


def _time(seconds: float) -> str:
    for unit, length in (("days", 86400.0), ("h", 3600.0), ("min", 60.0)):
        if seconds >= 2.0 * length:
            return f"{seconds / length:.2g} {unit}"
    return f"{seconds:.2g} s"


def _fields(scene: ResolvedScene) -> Iterator[Work]:
    """Cells of the pressure fields, solved as often as they are published at least."""
    for contact in rigs()[scene.rig].contacts:
        for record, field in scene.effects_at(contact.name):
            if isinstance(field, PressureFieldSection):
                solved = scene.duration * scene.outputs.field_rate
                number = given(field.rows) * given(field.cols) * solved
                yield Work(f"cells of {contact.name}.{record.name}", number, FIELD_COST)
