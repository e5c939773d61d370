"""Work of the rig occupant, estimated before the run."""

from __future__ import annotations

from collections.abc import Iterator

from contact_sim_pkg.records.work import Work
from contact_sim_pkg.rigs.backrest.work import back_steps
from contact_sim_pkg.rigs.vehicle.work import seat_steps
from contact_sim_pkg.run.integrator_work import segments
from contact_sim_pkg.scene.resolved_scene import ResolvedScene


def work_of_occupant(scene: ResolvedScene) -> Iterator[Work]:
    """Segments and steps of an occupant on a seat and against its back."""
    yield segments(scene)
    yield from seat_steps(scene)
    yield from back_steps(scene)
