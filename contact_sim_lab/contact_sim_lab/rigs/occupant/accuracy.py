"""Accuracy of the occupant rig: its integration in time. Fields of the pan are those of the rig seat."""

from __future__ import annotations

from contact_sim_lab.records.accuracy import INTEGRATOR, AccuracyStudy
from contact_sim_lab.rigs.vehicle.accuracy_integrator import tolerance_rows
from contact_sim_pkg.rigs.occupant.model import back_cushion, build_occupant
from contact_sim_pkg.rigs.vehicle.model import Model
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["ACCURACY"]


def _build(scene: ResolvedScene) -> Model:
    return build_occupant(scene, back_cushion(scene))


ACCURACY = (AccuracyStudy(lambda _name, scene, notify: tolerance_rows(scene, notify, _build), (INTEGRATOR,)),)
