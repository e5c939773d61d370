"""Rules that tie keys of the force laws together, wherever a contact has them."""

from __future__ import annotations

from collections.abc import Iterator

from contact_sim_pkg.records.fields import Section
from contact_sim_pkg.records.registry import contacts
from contact_sim_pkg.scene.errors import Breach
from contact_sim_pkg.scene.schema.catalog import show
from contact_sim_pkg.scene.schema.foam_curve import FoamCurveSection
from contact_sim_pkg.scene.schema.laws import CushionSection, Foam, FrictionSection, GeneralDissipation, HuntCrossley
from contact_sim_pkg.scene.schema.scene import Scene

FORMULA_KEYS = ("modulus", "plateau", "densification", "densification_exponent", "hardness")
"""Keys of a cushion's stresses by the formula."""


def law_breaches(scene: Scene) -> Iterator[Breach]:
    """Laws whose coefficients contradict each other, at any contact."""
    for contact in contacts():
        where = f"effects.{contact}"
        dissipative = scene.effect(contact, HuntCrossley)
        if dissipative is not None:
            yield from _hunt_crossley(f"{where}.normal_dissipative", dissipative)
        general, friction = scene.effect(contact, GeneralDissipation), scene.effect(contact, FrictionSection)
        if general is not None:
            yield from _general(where, general, friction)
        for name, foam in (("foam", scene.effect(contact, Foam)), ("cushion", scene.effect(contact, CushionSection))):
            if foam is not None:
                yield from _foam(where, name, foam, general)
            if isinstance(foam, CushionSection) and foam.curve is not None:
                yield from _curve(f"{where}.{name}", foam, foam.curve)
        if friction is not None and friction.coefficient_kinetic > friction.coefficient_static:
            kinetic, static = show(friction.coefficient_kinetic), show(friction.coefficient_static)
            sentence = f"{kinetic} is above coefficient_static ({static})"
            yield Breach(f"{where}.friction.coefficient_kinetic", sentence, (f"{where}.friction.coefficient_static",))


def unused(where: str, section: Section, sentence: str, uses: tuple[str, ...]) -> Iterator[Breach]:
    """A breach for each value of the ``section`` at ``where`` that differs from its default, where
    nothing uses it.
    """
    for name, default in type(section)():
        if getattr(section, name) != default:
            yield Breach(f"{where}.{name}", sentence, uses)


def _hunt_crossley(where: str, dissipative: HuntCrossley) -> Iterator[Breach]:
    damping, restitution, speed = dissipative.damping, dissipative.restitution, dissipative.reference_speed
    if damping is not None and restitution is not None:
        yield Breach(f"{where}.restitution", "damping and restitution are both given; keep one", (f"{where}.damping",))
    if restitution is not None and speed is None:
        yield Breach(
            f"{where}.reference_speed", "is missing; restitution holds at one impact speed", (f"{where}.restitution",)
        )
    if restitution is None and speed is not None:
        yield Breach(
            f"{where}.reference_speed", "has no meaning without restitution; remove it", (f"{where}.restitution",)
        )


def _general(where: str, general: GeneralDissipation, friction: FrictionSection | None) -> Iterator[Breach]:
    """The general law takes a coefficient or a restitution, and may pull only where nothing
    rubs.
    """
    place = f"{where}.general_dissipative"
    if general.coefficient is not None and general.restitution is not None:
        sentence = "coefficient and restitution are both given; keep one"
        yield Breach(f"{place}.restitution", sentence, (f"{place}.coefficient",))
    if general.restitution is not None and general.reference_speed is None:
        sentence = "is missing; restitution holds at one impact speed"
        yield Breach(f"{place}.reference_speed", sentence, (f"{place}.restitution",))
    if general.restitution is None and general.reference_speed is not None and general.rate_exponent >= 1.0:
        sentence = "has no meaning without restitution or a rate_exponent below 1; remove it"
        yield Breach(f"{place}.reference_speed", sentence, (f"{place}.restitution", f"{place}.rate_exponent"))
    if general.end == "gap" and friction is not None:
        sentence = "a contact that pulls has no Coulomb limit; take end: force or remove friction"
        yield Breach(f"{place}.end", sentence, (f"{where}.friction",))


def _curve(where: str, cushion: CushionSection, curve: FoamCurveSection) -> Iterator[Breach]:
    """Stresses of the formula beside those of a curve; a curve that is none."""
    for name in FORMULA_KEYS:
        if getattr(cushion, name) != type(cushion).model_fields[name].default:
            sentence = "is a stress of the formula, the curve has its own; remove one of them"
            yield Breach(f"{where}.{name}", sentence, (f"{where}.curve",))
    yield from curve.breaches(f"{where}.curve")


def _foam(where: str, name: str, foam: Foam | CushionSection, general: GeneralDissipation | None) -> Iterator[Breach]:
    """Foam begins stiffer than its plateau; the general law's restitution is known for power laws
    only.
    """
    if not foam.modulus > foam.plateau:
        sentence = f"{show(foam.modulus)} Pa is not above plateau ({show(foam.plateau)} Pa)"
        yield Breach(f"{where}.{name}.modulus", sentence, (f"{where}.{name}.plateau",))
    if general is not None and general.restitution is not None:
        sentence = "holds for a power law, not for foam; give a coefficient, or take normal_dissipative"
        yield Breach(f"{where}.general_dissipative.restitution", sentence, (f"{where}.{name}",))
