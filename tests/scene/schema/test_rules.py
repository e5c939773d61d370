"""Rules between keys: a contradiction is a fault at its key, and what is just allowed passes."""

import pytest

BUMP = {"kind": "bump", "position": 1.0, "height": 0.1, "length": 0.5}
CLEAT = {"kind": "cleat", "position": 1.0, "height": 0.01, "length": 0.05}
ISO = {"kind": "iso8608", "roughness_class": "C"}
OWN = {"model": "own", "frame_mass": 2.0, "masses": [5.0, 6.0], "stiffness": [1e4, 1e4], "damping": [9.0, 9.0]}
RIGID = {"model": "inert_75"}
CUSHION = "effects.seat"
SWEEP = {"kind": "sweep", "start_frequency": 1.0, "end_frequency": 20.0, "amplitude": 1.0}
SHOCK = {"kind": "half_sine", "amplitude": 10.0, "duration": 0.05}
LOSS = "effects.seat.normal_dissipative"

GENERAL = "effects.seat.general_dissipative"
BREACHES = [
    (
        "seat",
        {GENERAL: {"coefficient": 1.0, "restitution": 0.5, "reference_speed": 0.5}},
        f"{GENERAL}.restitution",
        "both given",
    ),
    ("seat", {GENERAL: {"restitution": 0.5}}, f"{GENERAL}.reference_speed", "is missing"),
    ("seat", {GENERAL: {"reference_speed": 0.5}}, f"{GENERAL}.reference_speed", "has no meaning"),
    ("seat", {"effects.seat.foam": {"plateau": 5e4}}, "effects.seat.foam.modulus", "not above plateau"),
    (
        "seat",
        {GENERAL: {"restitution": 0.5, "reference_speed": 0.5}, "effects.seat.foam": {}},
        f"{GENERAL}.restitution",
        "holds for a power law",
    ),
    ("seat", {GENERAL: {"end": "gap"}, "effects.seat.friction": {}}, f"{GENERAL}.end", "no Coulomb limit"),
    ("tire", {"travel": ...}, "travel", "the rig tire needs it"),
    ("car", {"road": ...}, "road", "the rig car needs it"),
    ("seat", {"vibration": ...}, "vibration", "the rig seat needs it"),
    ("seat", {"road": {"kind": "flat"}}, "road", "the rig seat has no road"),
    ("seat", {"tire": {}}, "tire", "the rig seat has no tire"),
    ("tire", {"seat": {}}, "seat", "the rig tire has no seat"),
    ("tire", {"vibration": SHOCK}, "vibration", "the rig tire has no vibration"),
    ("tire", {"travel": {}}, "travel.speed", "give speed or points"),
    ("tire", {"travel.points": [[0, 1]]}, "travel.points", "both given"),
    ("tire", {"travel": {"points": [[1, 1]]}}, "travel.points.0.0", "it must be 0"),
    ("tire", {"travel": {"points": [[0, 1], [2, 1], [2, 3]]}}, "travel.points.2.0", "times must increase"),
    ("tire", {"travel": {"points": [[0, 1], [2, 101]]}}, "travel.points.1.1", "outside 0 to 100 m/s"),
    ("tire", {"travel": {"points": [[0, 1], [3601, 1]]}}, "travel.points.1.0", "outside 0 to 3600 s"),
    ("tire", {"road": {**BUMP, "period": 0.4}}, "road.period", "shorter than the obstacle"),
    ("tire", {"road": {**CLEAT, "edge": 0.026}}, "road.edge", "longer than the obstacle"),
    ("tire", {"road": {"kind": "iso8608"}}, "road.roughness_class", "give roughness_class or roughness"),
    ("tire", {"road": {**ISO, "roughness": 1e-6}}, "road.roughness", "both given"),
    (
        "tire",
        {"road": {**ISO, "shortest_wavelength": 5.0, "longest_wavelength": 5.0}},
        "road.shortest_wavelength",
        "not below",
    ),
    (
        "tire",
        {"road": {**ISO, "shortest_wavelength": 5.0, "length": 4.0}},
        "road.shortest_wavelength",
        "not below length",
    ),
    (
        "tire",
        {"road": {**ISO, "texture": {"shortest_wavelength": 0.5}}},
        "road.texture.shortest_wavelength",
        "not below",
    ),
    ("seat", {"vibration.frequency": 500.0}, "vibration.frequency", "half the sample rate"),
    ("seat", {"vibration": SWEEP}, "vibration.octaves_per_minute", "give octaves_per_minute or duration"),
    ("seat", {"vibration": {**SWEEP, "duration": 1.0, "octaves_per_minute": 1.0}}, "vibration.duration", "both given"),
    (
        "seat",
        {"vibration": {**SWEEP, "duration": 1.0, "end_frequency": 1.0}},
        "vibration.end_frequency",
        "take kind: sine",
    ),
    (
        "seat",
        {"vibration": {**SWEEP, "duration": 1.0, "end_frequency": 600.0}},
        "vibration.end_frequency",
        "half the sample",
    ),
    (
        "seat",
        {"vibration": {"kind": "noise", "low": 9.0, "high": 8.0, "rms": 1.0}},
        "vibration.low",
        "9 Hz is not below high",
    ),
    ("seat", {"vibration": {**SHOCK, "start": 1.0}}, "vibration.start", "behind the end of the run"),
    ("seat", {"vibration": {**SHOCK, "duration": 0.009}}, "vibration.duration", "hold 9 samples; a shock needs 10"),
    (
        "seat",
        {"seat": {"occupant": {"masses": [5.0], "damping": [9.0]}}},
        "seat.occupant.stiffness",
        "2 values, masses has 1",
    ),
    ("seat", {"seat": {"occupant": {"damping": []}}}, "seat.occupant.damping", "0 values, masses has 2"),
    ("seat", {"seat": {"occupant": {"model": "own"}}}, "seat.occupant.model", "own needs frame_mass and masses"),
    ("seat", {"seat": {"occupant": {**OWN, "posture": 1.2}}}, "seat.occupant.posture", "scales a model by name"),
    ("seat", {"seat": {"occupant": {"percentile": 5, "mass": 40.0}}}, "seat.occupant.mass", "leave one out"),
    (
        "seat",
        {"seat": {"occupant": {"posture": 1.5, "damping": [1.0, 2.0]}}},
        "seat.occupant.damping",
        "follows from posture as",
    ),
    ("seat", {"seat": {"occupant": {"frame_mass": 0.05}}}, "seat.occupant.frame_mass", "write 0 for a massless frame"),
    (
        "seat",
        {"seat": {"occupant": {**OWN, "frame_mass": 0.0, "links": [[0, 1], [1, 2]], "damping": [0.0, 9.0]}}},
        "seat.occupant.frame_mass",
        "needs a damper in a link to it",
    ),
    ("seat", {"seat": {"occupant": {**OWN, "links": [[0, 1], [1, 3]]}}}, "seat.occupant.links.1", "masses has 2"),
    ("seat", {"seat": {"occupant": {**OWN, "links": [[0, 1], [2, 2]]}}}, "seat.occupant.links.1", "to itself"),
    (
        "seat",
        {"seat": {"occupant": {**OWN, "links": [[0, 1], [1, 0]]}}},
        "seat.occupant.links",
        "mass 2 hangs on nothing",
    ),
    (
        "seat",
        {"seat": {"occupant": {**OWN, "links": [[0, 1], [0, 2], [1, 2]], "damping": [9.0, 9.0, 9.0]}}},
        "seat.occupant.stiffness",
        "links has 3; each link",
    ),
    ("seat", {"seat": {"occupant": {**OWN, "head": 3}}}, "seat.occupant.head", "is mass 3, masses has 2"),
    ("seat", {"effects.seat.softening": {"least": 2.5}}, "effects.seat.softening.least", "is not below most"),
    (
        "seat",
        {"effects.seat.friction": {"coefficient_kinetic": 0.41}},
        "effects.seat.friction.coefficient_kinetic",
        "above",
    ),
    ("seat", {LOSS: {"damping": 1.0, "restitution": 0.5, "reference_speed": 1.0}}, f"{LOSS}.restitution", "both given"),
    ("seat", {LOSS: {"restitution": 0.5}}, f"{LOSS}.reference_speed", "holds at one impact speed"),
    ("seat", {LOSS: {"reference_speed": 0.5}}, f"{LOSS}.reference_speed", "no meaning without restitution"),
    (
        "seat",
        {CUSHION: {"cushion": {}}, "seat": {"cushion_modulus": 3e4}},
        "seat.cushion_modulus",
        "acts in half_space_field",
    ),
    (
        "seat",
        {CUSHION: {"cushion": {}}, "seat": {"cushion_poisson": 0.2}},
        "seat.cushion_poisson",
        "acts in half_space_field",
    ),
    (
        "seat",
        {CUSHION: {"cushion": {}}, "seat": {"body": {"thigh_rise": 0.03}}},
        "seat.body.thigh_rise",
        "the cushion has a foam and a body of its own",
    ),
    ("seat", {"seat": {"occupant": {**RIGID, "posture": 1.2}}}, "seat.occupant.posture", "inert_75 has none"),
    (
        "seat",
        {"seat": {"occupant": RIGID}, "effects.seat.softening": {}},
        "effects.seat.softening",
        "the occupant (inert_75) has none",
    ),
    (
        "seat",
        {"seat": {"occupant": {**OWN, "masses": [], "stiffness": [], "damping": []}}, "effects.seat.softening": {}},
        "effects.seat.softening",
        "the occupant (own) has none",
    ),
]


@pytest.mark.parametrize(("base", "changes", "where", "told"), BREACHES)
def test_a_contradiction_is_one_fault_at_its_key(maker, base, changes, where, told):
    faults = maker.faults(base, changes)
    assert len(faults) == 1
    assert faults[0].startswith(f"{where}: ")
    assert told in faults[0]


@pytest.mark.parametrize(
    ("base", "changes"),
    [
        ("tire", {"travel": {"points": [[0, 0], [1, 100]]}}),
        ("tire", {"road": {**BUMP, "period": 0.5}}),
        ("tire", {"road": {**CLEAT, "edge": 0.025}}),
        ("tire", {"road": {"kind": "iso8608", "roughness": 0.0}}),
        ("tire", {"road": {**ISO, "texture": {}}}),
        ("tire", {"road": {"kind": "step", "position": 1, "height": -0.02}}),
        ("tire", {"road": {"kind": "pothole", "position": 1, "depth": 0.05, "length": 0.3, "edge": 0.15}}),
        ("seat", {"vibration.frequency": 499.9}),
        ("seat", {"vibration": {**SWEEP, "duration": 1.0}}),
        ("seat", {"vibration": {**SWEEP, "octaves_per_minute": 1.0, "axis": "x"}}),
        ("seat", {"vibration": {**SHOCK, "start": 0.99, "axis": "x"}}),
        ("seat", {"vibration": {**SHOCK, "duration": 0.01}}),
        ("seat", {"seat": {"occupant": {"masses": [], "stiffness": [], "damping": []}}}),
        ("seat", {"seat": {"occupant": {**OWN, "links": [[0, 1], [2, 1]], "head": 2}}}),
        ("seat", {"seat": {"occupant": {"model": "wan_schimmels", "percentile": 95, "posture": 1.2}}}),
        ("seat", {"effects.seat.friction": {"coefficient_kinetic": 0.4}}),
        ("seat", {LOSS: {"restitution": 1.0, "reference_speed": 0.5}}),
        ("car", {}),
        ("car", {"vibration": SHOCK, "tire": {}, "seat": {}, "effects.tire.contact_field": {}}),
    ],
)
def test_what_is_just_allowed_passes(maker, base, changes):
    assert maker.faults(base, changes) == []


def test_a_rule_does_not_speak_about_a_key_with_a_fault_of_its_own(maker):
    faults = maker.faults("seat", {"vibration.sample_rate": "fast", "vibration.frequency": 600.0})
    assert len(faults) == 1
    assert faults[0].startswith("vibration.sample_rate: 'fast'")
