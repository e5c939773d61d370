"""Resolved scene of the rig occupant -> parameters: those of the seat, with a seat back that the same
occupant leans on.
"""

from __future__ import annotations

from contact_sim_pkg.laws.parameters import Contact
from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.records.fields import given
from contact_sim_pkg.rigs.backrest.cushion import build_back_cushion
from contact_sim_pkg.rigs.backrest.schema import BackrestSection
from contact_sim_pkg.rigs.vehicle.model import Model, build
from contact_sim_pkg.rigs.vehicle.seat.lean import Lean, Pose, rest_of
from contact_sim_pkg.rigs.vehicle.seat.mass import occupant_mass
from contact_sim_pkg.rigs.vehicle.seat.schema import SeatSection
from contact_sim_pkg.run.contact_laws import Cushion, elastic_law, hysteresis, normal_loss
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["back_cushion", "back_load", "build_occupant"]


def build_occupant(scene: ResolvedScene, cushion: Cushion | None = None) -> Model:
    """Parameters of a resolved scene, whose seat back has a ``cushion`` or another law. Raises
    FieldError where a pressure field cannot carry the standing load.
    """
    law = elastic_law(scene, "backrest") if cushion is None else cushion.law
    loss = normal_loss(scene, "backrest", law, occupant_mass(scene.section(SeatSection).occupant))
    contact = Contact(law, loss, None, hysteresis(scene, "backrest", 0))
    return build(scene, Lean(pose_of_scene(scene), contact))


def back_cushion(scene: ResolvedScene) -> Cushion | None:
    """Foam of the seat back under its load at rest; None where it has none. Raises SceneError where
    it does not carry that load.
    """
    return build_back_cushion(scene, back_load(scene))


def back_load(scene: ResolvedScene) -> float:
    """Force [N] of the seat back at rest."""
    return rest_of(scene.section(SeatSection).occupant.model_of(), pose_of_scene(scene), GRAVITY).back


def pose_of_scene(scene: ResolvedScene) -> Pose:
    """Pan and seat back."""
    seat, back = scene.section(SeatSection), scene.section(BackrestSection)
    return Pose(given(seat.pan_tilt), given(back.angle), given(back.preload))
