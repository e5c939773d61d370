"""A law that is off is not compiled into its rig.

A law is what takes its parameter tuple, or its own function where it has none, with all that the rig reaches
through it alone. The search of the calls must find it in each scene where the effect is on, and nothing of it
where it is off: a function that was handed `None` returned the neutral value by its type. The scenes of a rig
differ in more than one effect, so that few compilations show every effect both on and off.

Effects without a compiled law of their own are not here: the rigid ring of a tire, which is one more spring between
two masses, those of the impact that add outputs, and values of the
roller's equations (gyroscope, rolling_friction).
"""

import pytest

from contact_sim_pkg.compiled.call_graph import only_through
from contact_sim_pkg.compiled.jit import calls_of
from contact_sim_pkg.run.rigs import make_simulation
from contact_sim_pkg.scene.resolve import load_resolved
from contact_sim_pkg.studies.effects.alternatives import effects_of, is_on

SPRING_TIRE = ("effects.tire.inflation=null", "effects.tire.normal_elastic={}")
SPRING_SEAT = ("effects.seat.cushion=null", "effects.seat.normal_elastic={}")
SEARCH = ("effects.backrest.shell_modes={}", "effects.backrest.contact_search={}", "backrest.preload=20")
SCENES = {
    "tire": (
        ("tire_cleat",),
        ("tire_bump", *SPRING_TIRE, "effects.tire.normal_dissipative=null", "effects.tire.tread_viscoelasticity={}"),
        ("tire_bump", "effects.tire.contact_field=null", "effects.tire.asperity_impulses={}"),
    ),
    "seat": (
        ("seat_ride", "effects.seat.friction={}", "effects.seat.contact_field={}"),
        ("seat_ride", *SPRING_SEAT, "effects.seat.foam_hysteresis=null", "effects.seat.softening={}"),
        ("seat_ride", *SPRING_SEAT, "effects.seat.foam={}", "effects.seat.normal_dissipative=null"),
    ),
    "backrest": (
        ("seat_slap",),
        ("seat_slap", "effects.backrest.foam={}", "effects.backrest.foam_hysteresis={}"),
        ("seat_general",),
        ("seat_slap", *SEARCH),
    ),
    "roller": (("roller_flutter",), ("roller_corrugation",)),
    "block": (("block_slope",), ("block_slope", "effects.block.compliant_contact={}")),
}
# Class of the parameters of an effect, or name of its own function
LAWS = {
    "tire.inflation": "TabulatedElastic",
    "tire.normal_elastic": "NormalElastic",
    "tire.normal_dissipative": "NormalDissipative",
    "tire.contact_field": "FieldRequest",
    "tire.brush": "Brush",
    "tire.sidewall_compliance": "Sidewalls",
    "tire.wheel_spin": "WheelSpin",
    "tire.tread_viscoelasticity": "update_branches",
    "tire.asperity_impulses": "AsperityImpulses",
    "seat.cushion": "TabulatedElastic",
    "seat.normal_elastic": "NormalElastic",
    "seat.foam": "FoamElastic",
    "seat.normal_dissipative": "NormalDissipative",
    "seat.foam_hysteresis": "FoamHysteresis",
    "seat.friction": "friction_force",
    "seat.contact_field": "fit_patch",
    "seat.softening": "Softening",
    "backrest.normal_dissipative": "NormalDissipative",
    "backrest.general_dissipative": "GeneralDissipative",
    "backrest.foam": "FoamElastic",
    "backrest.foam_hysteresis": "FoamHysteresis",
    "backrest.friction": "Friction",
    "backrest.contact_search": "ContactSearch",
    "roller.tilt_yaw": "TiltYawProblem",
    "roller.shaft_bending": "Bending",
    "roller.track_waves": "Heave",
    "roller.subsurface": "Loading",
    "block.compliant_contact": "CompliantBody",
}


def functions_of(graph, roots, mark):
    """What takes the parameters of a law, or is its function, and what the roots reach through that alone. A root that
    holds the parameters among others is not the law's.
    """
    law = {call for call in graph if call.name == mark or (mark in call.arguments and call not in roots)}
    return only_through(graph, law, roots)


@pytest.mark.parametrize("rig", SCENES)
def test_a_law_is_compiled_where_its_effect_is_on_and_nothing_of_it_where_it_is_off(rig):
    marks = {name: mark for name, mark in LAWS.items() if name.startswith(f"{rig}.")}
    seen = {name: set() for name in marks}
    for scene_name, *values in SCENES[rig]:
        scene = load_resolved(scene_name, *values)
        graph, roots = calls_of(lambda scene=scene: make_simulation(scene).prepare())
        on = {f"{contact.name}.{effect.name}": is_on(scene, contact, effect) for contact, effect in effects_of(scene)}
        if on.get("seat.foam"):  # the law of the foam stands in place of the spring's
            on["seat.normal_elastic"] = False
        for name, mark in marks.items():
            found = functions_of(graph, roots, mark)
            seen[name].add(on[name])
            assert bool(found) == on[name], f"{name} in {scene_name} {values}: {sorted(call.name for call in found)}"
    assert all(states == {True, False} for states in seen.values()), seen
