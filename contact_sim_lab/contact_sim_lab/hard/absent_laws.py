"""Hard cases: a law that is off is not compiled into the rig.

A law is what takes its parameter tuple, or its own function where it has none, with all that the rig
reaches through it alone. The same search of the calls (`compiled/call_graph.py`) must find it where
the effect is on, and nothing of it where it is off: a function that was handed `None` returned the
neutral value by its type.

Effects that have no compiled law of their own are not here: those of the impact that add outputs,
and values of the roller's equations (gyroscope, rolling_friction).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from typing import NamedTuple

from contact_sim_lab.records.hard_case import Finding, HardCase, exactly
from contact_sim_pkg.compiled.call_graph import Call, CallGraph, only_through
from contact_sim_pkg.compiled.jit import calls_of
from contact_sim_pkg.records.registry import rigs
from contact_sim_pkg.run.rigs import make_simulation
from contact_sim_pkg.scene.resolve import load_resolved
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.studies.effects.alternatives import effects_of, with_effect, without_effects

__all__ = ["CASES", "LAWS", "Law", "absent_law", "functions_of"]


class Law(NamedTuple):
    """The compiled law of an effect."""

    effect: str  # CONTACT.EFFECT
    mark: str  # class of its parameters, or name of its own function
    scene: str
    values: tuple[str, ...] = ()  # as of `--set`; the effect is then on


SOFT_TIRE = ("effects.tire.inflation=null", "effects.tire.normal_elastic={}")
SPRING_SEAT = ("effects.seat.cushion=null", "effects.seat.normal_elastic={}")
LAWS = (
    Law("tire.inflation", "TabulatedElastic", "tire_cleat"),
    Law("tire.normal_dissipative", "NormalDissipative", "tire_cleat"),
    Law("tire.contact_field", "FieldRequest", "tire_cleat"),
    Law("tire.rigid_ring", "RigidRing", "tire_cleat"),
    Law("tire.brush", "Brush", "tire_cleat"),
    Law("tire.sidewall_compliance", "Sidewalls", "tire_cleat"),
    Law("tire.wheel_spin", "WheelSpin", "tire_cleat"),
    Law("tire.normal_elastic", "NormalElastic", "tire_bump", SOFT_TIRE),
    Law("tire.tread_viscoelasticity", "update_branches", "tire_bump", ("effects.tire.tread_viscoelasticity={}",)),
    Law("tire.asperity_impulses", "AsperityImpulses", "tire_bump", ("effects.tire.asperity_impulses={}",)),
    Law("seat.cushion", "TabulatedElastic", "seat_ride"),
    Law("seat.normal_elastic", "NormalElastic", "seat_ride", SPRING_SEAT),
    Law("seat.foam", "FoamElastic", "seat_ride", (*SPRING_SEAT, "effects.seat.foam={}")),
    Law("seat.normal_dissipative", "NormalDissipative", "seat_ride"),
    Law("seat.foam_hysteresis", "FoamHysteresis", "seat_ride"),
    Law("seat.friction", "friction_force", "seat_ride", ("effects.seat.friction={}",)),
    Law("seat.contact_field", "fit_patch", "seat_ride", ("effects.seat.contact_field={}",)),
    Law("seat.softening", "Softening", "seat_ride", ("effects.seat.softening={}",)),
    Law("backrest.normal_dissipative", "NormalDissipative", "seat_slap"),
    Law("backrest.general_dissipative", "GeneralDissipative", "seat_general"),
    Law("backrest.foam", "FoamElastic", "seat_slap", ("effects.backrest.foam={}",)),
    Law("backrest.foam_hysteresis", "FoamHysteresis", "seat_slap", ("effects.backrest.foam_hysteresis={}",)),
    Law("backrest.friction", "Friction", "seat_slap"),
    Law(
        "backrest.contact_search", "ContactSearch", "seat_slap",
        ("effects.backrest.shell_modes={}", "effects.backrest.contact_search={}", "backrest.preload=20"),
    ),
    Law("roller.tilt_yaw", "TiltYawProblem", "roller_flutter"),
    Law("roller.shaft_bending", "Bending", "roller_corrugation"),
    Law("roller.track_waves", "Heave", "roller_corrugation"),
    Law("roller.subsurface", "Loading", "roller_corrugation"),
    Law("block.compliant_contact", "CompliantBody", "block_slope", ("effects.block.compliant_contact={}",)),
)  # fmt: skip


def absent_law(law: Law) -> Finding:
    """Number of compiled functions of a law in a rig without it; NaN where the search finds none in the
    rig with it.
    """
    scene = load_resolved(law.scene, *law.values)
    graph, roots = _calls(scene)
    if not functions_of(graph, roots, law.mark):
        return Finding(math.nan, f"functions of {law.effect} where it is on", -math.inf)
    return exactly(float(len(functions_of(*_calls(_without(scene, law.effect)), law.mark))), 0.0)


def functions_of(graph: CallGraph, roots: set[Call], mark: str) -> set[Call]:
    """What takes the parameters of a law, or is its function, and what the roots reach through that
    alone. A root that holds the parameters among others is not the law's.
    """
    law = {call for call in graph if call.name == mark or (mark in call.arguments and call not in roots)}
    return only_through(graph, law, roots)


def _calls(scene: ResolvedScene) -> tuple[CallGraph, set[Call]]:
    """What a run of a scene calls, as far as its preparation compiles all of it."""
    return calls_of(lambda: make_simulation(scene).prepare())


def _without(scene: ResolvedScene, name: str) -> ResolvedScene:
    """The scene without an effect; with another in its place where it carries the load."""
    contact, effect = next(each for each in effects_of(scene) if f"{each[0].name}.{each[1].name}" == name)
    if not effect.carries:
        return without_effects(scene, effect).scene
    other = next(each for each in contact.effects if each.carries and each is not effect)
    return with_effect(scene, contact, other).scene


def _cases() -> Iterator[HardCase]:
    models = {contact.name: rig.name for rig in reversed(rigs().values()) for contact in rig.contacts}
    for law in LAWS:
        contact, _dot, effect = law.effect.partition(".")
        yield HardCase(models[contact], f"{effect} off: its compiled functions in the rig", partial(absent_law, law))


CASES = list(_cases())
