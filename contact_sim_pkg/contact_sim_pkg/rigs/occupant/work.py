"""Work of the rig occupant, estimated before the run."""

from __future__ import annotations

from collections.abc import Iterator

from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.records.work import Work
from contact_sim_pkg.rigs.backrest.cushion import build_back_cushion
from contact_sim_pkg.rigs.occupant.model import pose_of_scene
from contact_sim_pkg.rigs.vehicle.seat.lean import rest_of
from contact_sim_pkg.rigs.vehicle.seat.schema import SeatSection
from contact_sim_pkg.rigs.vehicle.work import seat_steps
from contact_sim_pkg.run.integrator_work import integrator_steps, segments
from contact_sim_pkg.run.linear_laws import links_of_laws
from contact_sim_pkg.scene.resolved_scene import ResolvedScene


def work_of_occupant(scene: ResolvedScene) -> Iterator[Work]:
    """Segments and steps of an occupant on a seat and against its back."""
    yield segments(scene)
    occupant = scene.section(SeatSection).occupant.model_of()
    rest = rest_of(occupant, pose_of_scene(scene), GRAVITY)
    yield from seat_steps(scene, rest.pan)
    laws = links_of_laws(scene, "backrest", occupant.mass, rest.back, build_back_cushion)
    yield from integrator_steps(scene, "backrest", laws)
