"""Accuracy of the occupant rig: the studies of seat and seat back, their quantities named by the
contact.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from contact_sim_pkg.records.accuracy import AccuracyStudy
from contact_sim_pkg.rigs.backrest.studies import accuracy as backrest
from contact_sim_pkg.rigs.vehicle.studies import accuracy as vehicle
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["ACCURACY"]


def _named(contact: str, study: AccuracyStudy) -> AccuracyStudy:
    """The study with rows under the name of a contact."""

    def rows(name: str, scene: ResolvedScene, notify: Callable[[str], None]) -> list[dict[str, Any]]:
        return [{**row, "quantity": f"{contact}: {row['quantity']}"} for row in study.rows(name, scene, notify)]

    return study._replace(rows=rows)


ACCURACY = (
    *(_named("seat", study) for study in vehicle.ACCURACY),
    *(_named("backrest", study) for study in backrest.ACCURACY),
)
