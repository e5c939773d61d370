"""Sections of the laws that several contacts share -> parameters of the kernels."""

from __future__ import annotations

from contact_sim_pkg.laws import parameters
from contact_sim_pkg.laws.general_dissipative import SMOOTHING
from contact_sim_pkg.laws.parameters import (
    ElasticLaw,
    GeneralDissipative,
    NormalDissipation,
    NormalDissipative,
    NormalElastic,
)
from contact_sim_pkg.laws.restitution import damping_of_restitution
from contact_sim_pkg.laws.restitution_law import NEVER_PULLS, PULLS, coefficient_of_restitution
from contact_sim_pkg.scene.errors import Fault, SceneError
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.schema.fields import given
from contact_sim_pkg.scene.schema.laws import (
    Foam,
    FoamHysteresisSection,
    FrictionSection,
    GeneralDissipation,
    HuntCrossley,
    PowerLaw,
)

__all__ = ["elastic_law", "friction", "hysteresis", "normal_loss"]


def elastic_law(scene: ResolvedScene, contact: str) -> ElasticLaw:
    """Elastic law of a contact without pressure field: its foam where the scene names one, its
    power law otherwise.
    """
    foam, power = scene.effect(contact, Foam), given(scene.effect(contact, PowerLaw))
    if foam is None:
        return NormalElastic(power.coefficient, power.exponent)
    return parameters.FoamElastic(
        foam.area, foam.thickness, foam.modulus, foam.plateau, foam.densification, foam.densification_exponent
    )


def normal_loss(scene: ResolvedScene, contact: str, elastic: ElasticLaw, mass: float) -> NormalDissipation | None:
    """Loss of a contact, from its damping or its restitution; None where the scene calls for none.

    ``mass`` [kg] is what a free impact with the requested restitution moves. Raises SceneError
    where the law does not reach it.
    """
    general, loss = scene.effect(contact, GeneralDissipation), scene.effect(contact, HuntCrossley)
    if general is not None:
        return _general_loss(general, contact, elastic, mass)
    if loss is None:
        return None
    if loss.restitution is not None:
        return NormalDissipative(damping_of_restitution(loss.restitution, given(loss.reference_speed)))
    return NormalDissipative(given(loss.damping))


def _general_loss(loss: GeneralDissipation, contact: str, elastic: ElasticLaw, mass: float) -> GeneralDissipative:
    p, q = loss.approach_exponent, loss.rate_exponent
    lowest = NEVER_PULLS if loss.end == "force" else PULLS
    smoothing = SMOOTHING * given(loss.reference_speed) if q < 1.0 else 0.0
    if loss.restitution is None:
        return GeneralDissipative(given(loss.coefficient), p, q, smoothing, lowest)
    assert isinstance(elastic, NormalElastic)
    try:
        coefficient = coefficient_of_restitution(
            loss.restitution, given(loss.reference_speed), mass, elastic, p, q, lowest
        )
    except ValueError as reason:
        where = f"effects.{contact}.general_dissipative.restitution"
        raise SceneError([Fault("scene", 0, 0, where, str(reason))]) from None
    return GeneralDissipative(coefficient, p, q, smoothing, lowest)


def friction(scene: ResolvedScene, contact: str) -> parameters.Friction | None:
    """Friction of a contact; None where the scene calls for none."""
    law = scene.effect(contact, FrictionSection)
    if law is None:
        return None
    return parameters.Friction(law.stiffness, law.damping, law.coefficient_static, law.coefficient_kinetic)


def hysteresis(scene: ResolvedScene, contact: str, offset: int) -> parameters.FoamHysteresis | None:
    """Hysteresis of a contact, its internal variable at ``offset`` of the state; None where the
    scene calls for none.
    """
    law = scene.effect(contact, FoamHysteresisSection)
    return None if law is None else parameters.FoamHysteresis(offset, law.share, law.energy)
