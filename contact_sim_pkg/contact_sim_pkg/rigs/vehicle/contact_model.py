"""What a contact of either kind is built from: its loss, the grids of its field, and the tangent law between field instants."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.laws.general_dissipative import SMOOTHING
from contact_sim_pkg.laws.parameters import (
    ElasticLaw,
    FoamElastic,
    GeneralDissipative,
    NormalDissipative,
    NormalElastic,
    NormalLoss,
)
from contact_sim_pkg.laws.restitution import damping_of_restitution
from contact_sim_pkg.laws.restitution_law import NEVER_PULLS, PULLS, coefficient_of_restitution
from contact_sim_pkg.pressure.settings import FieldSettings, widened
from contact_sim_pkg.rigs.vehicle.contact_field import FieldError, PressureField, fit_tangent
from contact_sim_pkg.scene.errors import Fault, SceneError
from contact_sim_pkg.scene.resolved_scene import effects_at


@dataclass(frozen=True)
class FieldGrids:
    """The pressure field of one contact, and the wider one that takes over where the contact outgrows it."""

    usual: PressureField
    wide: PressureField

    def both(self) -> tuple[PressureField, PressureField]:
        """Usual grid first."""
        return (self.usual, self.wide)


def elastic_of(effects: dict[str, Any]) -> ElasticLaw:
    """Elastic law of a contact without pressure field: its foam where the scene names one, its power law otherwise."""
    foam, power = effects.get("foam"), effects["normal_elastic"]
    if foam is not None:
        return FoamElastic(*(float(foam[key]) for key in FoamElastic._fields))
    return NormalElastic(float(power["coefficient"]), float(power["exponent"]))


def loss_of(scene: dict[str, Any], contact: str, elastic: ElasticLaw, mass: float) -> NormalLoss | None:
    """Loss of a contact, from its damping or its restitution; None where the scene calls for none.

    ``mass`` [kg] is what a free impact with the asked restitution moves. Raises SceneError where the law does not reach it.
    """
    effects = effects_at(scene, contact)
    if effects.get("general_dissipative") is not None:
        return _general_loss(effects["general_dissipative"], contact, elastic, mass)
    loss = effects.get("normal_dissipative")
    if loss is None:
        return None
    if loss.get("restitution") is not None:
        return NormalDissipative(damping_of_restitution(float(loss["restitution"]), float(loss["reference_speed"])))
    return NormalDissipative(float(loss["damping"]))


def _general_loss(loss: dict[str, Any], contact: str, elastic: ElasticLaw, mass: float) -> GeneralDissipative:
    p, q = float(loss["approach_exponent"]), float(loss["rate_exponent"])
    lowest = NEVER_PULLS if loss["end"] == "force" else PULLS
    smoothing = SMOOTHING * float(loss["reference_speed"]) if q < 1.0 else 0.0
    if loss.get("restitution") is None:
        return GeneralDissipative(float(loss["coefficient"]), p, q, smoothing, lowest)
    asked, speed = float(loss["restitution"]), float(loss["reference_speed"])
    assert isinstance(elastic, NormalElastic)
    try:
        coefficient = coefficient_of_restitution(asked, speed, mass, elastic, p, q, lowest)
    except ValueError as reason:
        where = f"effects.{contact}.general_dissipative.restitution"
        raise SceneError([Fault("scene", 0, 0, where, str(reason))]) from None
    return GeneralDissipative(coefficient, p, q, smoothing, lowest)


def make_grids(settings: FieldSettings, contact: str) -> FieldGrids:
    """Field of a contact on its usual grid and on the wide one."""
    return FieldGrids(PressureField(settings, contact), PressureField(widened(settings), contact))


def tangent_law(
    grids: FieldGrids, gap_on: Callable[[FieldSettings], NDArray[numpy.float64]], load: float, contact: str
) -> tuple[NormalElastic, float]:
    """Tangent law at the standing load, and the length in [m] of the contact there along the rows.

    On the wide grid where the usual one does not hold the contact. Raises SceneError where that does not either.
    """
    for field in grids.both():
        try:
            law = fit_tangent(field, gap_on(field.settings), load)
            return law, int((field.pressure > 0.0).any(axis=1).sum()) * field.settings.cell_x
        except FieldError as error:
            reason = error
    where = f"effects.{contact}.contact_field"
    sentence = (
        f"the contact does not fit on its grid at the standing load of {load:.6g} N: {reason}; enlarge length and width"
    )
    raise SceneError([Fault("scene", 0, 0, where, sentence)])
