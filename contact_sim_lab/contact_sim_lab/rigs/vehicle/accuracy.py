"""Accuracy studies of a scene of tire and seat: integrator, coupling of bodies and fields, fields,
bristles and belt.
"""

from __future__ import annotations

from contact_sim_lab.records.accuracy import INTEGRATOR, AccuracyPart, AccuracyStudy, field_parts
from contact_sim_lab.rigs.vehicle.accuracy_coupling import coupling_rows
from contact_sim_lab.rigs.vehicle.accuracy_cushion import cushion_rows
from contact_sim_lab.rigs.vehicle.accuracy_field import field_rows, first_solve
from contact_sim_lab.rigs.vehicle.accuracy_integrator import tolerance_rows
from contact_sim_lab.rigs.vehicle.accuracy_rolling import rolling_rows

__all__ = ["ACCURACY"]

_CUSHION = tuple(
    AccuracyPart(f"cushion {part}", f"seat cushion, error of its {part}", "seat cushion", contact="seat cushion")
    for part in ("cells", "table")
)
_COUPLING = AccuracyPart(
    "coupling", "coupling of bodies and pressure fields: error", "coupling of bodies and fields, whole scene"
)
_ROLLING = (
    AccuracyPart("bristle cells", "rolling tire, error of the bristles' cells", "rolling tire"),
    AccuracyPart("belt steps", "rolling tire, error of the belt's steps", "rolling tire"),
)

ACCURACY = (
    AccuracyStudy(lambda _name, scene, notify: tolerance_rows(scene, notify), (INTEGRATOR,)),
    AccuracyStudy(coupling_rows, (_COUPLING,)),
    AccuracyStudy(
        lambda _name, scene, notify: field_rows(scene, notify),
        (*field_parts("tire"), *field_parts("seat")),
        first_solve,
    ),
    AccuracyStudy(lambda _name, scene, notify: cushion_rows(scene, notify), _CUSHION),
    AccuracyStudy(lambda _name, scene, notify: rolling_rows(scene, notify), _ROLLING),
)
