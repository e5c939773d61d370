"""Effects in scenes that mislead a rule, for `bench hard --effects`: verdicts written down before the
first run, from the definition of the verdicts and the physics of the scene.
"""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["CASES", "FIGURE", "EffectCase"]

FIGURE = "a figure"
"""Of an effect that is off, and that nothing in the scene calls for by more than requested."""
NEEDED, NOT_NEEDED, OFF_NEEDED, OBSERVES = "needed", "not needed", "off but needed", "observes"


class EffectCase(NamedTuple):
    """An effect of a scene, and what is expected of it."""

    name: str
    scene: str
    values: tuple[str, ...]  # as of `--set`
    effect: str  # CONTACT.EFFECT
    expected: str
    since: str


FLAT = "road={kind: flat}"
HIGH_BUMP = "{kind: bump, position: %g, height: 0.08, length: 0.45}"
CLEAT = "road={kind: cleat, position: 10, height: 0.01, length: 0.02, edge: 0.002}"
NO_FIELD = "effects.tire.contact_field=null"
NO_SEAT_LOSS = ("effects.seat.normal_dissipative=null", "effects.seat.foam_hysteresis=null")
SMOOTH_RANDOM = (
    "road={kind: iso8608, roughness: 1.0e-15, length: 100, shortest_wavelength: 0.3, longest_wavelength: 50, "
    "texture: {shortest_wavelength: 0.02}}"
)
CASES = (
    # The ten that static rules got wrong, or nearly
    EffectCase(
        "road of 1e-15 m³", "tire_rough_road", (SMOOTH_RANDOM,), "tire.contact_field", NOT_NEEDED,
        "waves of nanometres under a deflection of centimetres",
    ),
    EffectCase(
        "high bump at 30 m/s", "tire_bump", ("travel.speed=30", f"road={HIGH_BUMP % 30}", NO_FIELD),
        "tire.contact_field", OFF_NEEDED, "its crest is sharper than the wheel",
    ),
    EffectCase(
        "slip angle of 1e-9 rad", "tire_bump", (FLAT, "effects.tire.brush={}", "slip={angle: 1.0e-9}"), "tire.brush",
        NOT_NEEDED, "cornering stiffness times 1e-9",
    ),
    EffectCase(
        "sliding of 1e-12 m", "seat_slap", ("backrest.sliding.amplitude=1.0e-12",), "backrest.friction", NOT_NEEDED,
        "tangential stiffness times 1e-12 m",
    ),
    EffectCase(
        "ride without loss", "seat_ride", NO_SEAT_LOSS, "seat.normal_dissipative", OFF_NEEDED,
        "nothing damps the occupant's resonance but the occupant",
    ),
    EffectCase(
        "rubber at 256 K", "impact_rubber_drop", ("impact.temperatures=[256.0]",), "impact.shift", OFF_NEEDED,
        "its modulus is 15 times that of a room",
    ),
    EffectCase(
        "0.01 K apart", "impact_rubber_drop",
        ("impact.temperatures=[293.15, 293.16]", "impact.period=0.5", "impact.bounces=1", "effects.impact.shift={}"),
        "impact.shift", NOT_NEEDED, "both stand where the table has the values of the sample",
    ),
    EffectCase(
        "ring on a flat road", "tire_bump", (FLAT, "effects.tire.rigid_ring={}"), "tire.rigid_ring", NOT_NEEDED,
        "nothing moves the belt",
    ),
    EffectCase(
        "softening on noise", "seat_ride",
        ("vibration={kind: noise, low: 0.5, high: 20, rms: 1.0}", "duration=20", "effects.seat.softening={}"),
        "seat.softening", NEEDED, "the resonance falls by a hertz at 1 m/s² rms",
    ),
    EffectCase(
        "late bump", "tire_bump", ("travel.speed=30", f"road={HIGH_BUMP % 75}"), "tire.contact_field", NEEDED,
        "the same bump after 2.5 s",
    ),
    # Thirty more
    EffectCase("loss on a flat road", "tire_bump", (FLAT, "effects.tire.normal_dissipative=null"), "tire.normal_dissipative",
               FIGURE, "nothing moves"),
    EffectCase("loss over a bump", "tire_bump", (), "tire.normal_dissipative", NEEDED, "wheel hop behind the bump"),
    EffectCase("bump without loss", "tire_bump", ("effects.tire.normal_dissipative=null",), "tire.normal_dissipative",
               OFF_NEEDED, "wheel hop behind the bump"),
    EffectCase("field over a cleat", "tire_cleat", (), "tire.contact_field", NEEDED, "a point follows the cleat's flanks"),
    EffectCase("ring over a cleat", "tire_cleat", (), "tire.rigid_ring", NEEDED, "a cleat of 20 mm swings the belt at 80 Hz"),
    EffectCase("field on a flat road", "tire_bump", (FLAT,), "tire.contact_field", NOT_NEEDED, "the point law is the field's"),
    EffectCase("long bump without field", "tire_bump", ("road={kind: bump, position: 10, height: 0.03, length: 6}", NO_FIELD),
               "tire.contact_field", FIGURE, "fifty footprints long"),
    EffectCase("cleat without field", "tire_bump", (CLEAT, NO_FIELD), "tire.contact_field", OFF_NEEDED,
               "a cleat shorter than the footprint"),
    EffectCase("cleat without envelopment", "tire_bump",
               (CLEAT, "effects.tire.inflation=null", "effects.tire.normal_elastic={}"), "tire.envelopment", OFF_NEEDED,
               "a cleat shorter than the footprint"),
    EffectCase("slip angle of 0.1 rad", "tire_bump", (FLAT, "effects.tire.brush={}", "slip={angle: 0.1}"), "tire.brush",
               NEEDED, "most of the friction is used"),
    EffectCase("viscous tread, rolling", "tire_bump", (FLAT, "effects.tire.tread_viscoelasticity={}"),
               "tire.tread_viscoelasticity", NEEDED, "pressure leans forward: rolling resistance is about 1 % of the load"),
    EffectCase("field on a rough road", "tire_rough_road", (), "tire.contact_field", NEEDED, "waves of 30 mm"),
    EffectCase("sidewalls on a flat road", "tire_bump",
               (FLAT, "effects.tire.brush={}", "effects.tire.sidewall_compliance={}"), "tire.sidewall_compliance", NOT_NEEDED,
               "no force along or across"),
    EffectCase("locked wheel", "tire_braking", (), "tire.brush", NEEDED, "braking force at 1.5 s"),
    EffectCase("free wheel on a flat road", "tire_bump",
               (FLAT, *(f"effects.tire.{each}={{}}" for each in ("brush", "sidewall_compliance", "wheel_spin"))),
               "tire.wheel_spin", NOT_NEEDED, "it rolls as prescribed"),
    EffectCase("loss of a ride", "seat_ride", (), "seat.normal_dissipative", NEEDED, "part of the damping of 4 Hz"),
    EffectCase("hysteresis of a ride", "seat_ride", (), "seat.foam_hysteresis", NEEDED, "stiffens small vibration"),
    EffectCase("map of a ride", "seat_ride", ("effects.seat.contact_field={}",), "seat.contact_field", OBSERVES,
               "the law is that of the map's table"),
    EffectCase("recorded ride without friction", "seat_ride", (), "seat.friction", OFF_NEEDED,
               "its file shakes fore and aft as well, 0.3 m/s² rms"),
    EffectCase("fore-aft ride without friction", "seat_ride",
               ("vibration={kind: sine, axis: x, frequency: 3, amplitude: 3}", "duration=10"), "seat.friction", OFF_NEEDED,
               "a third of g along the seat"),
    EffectCase("softening at rest", "seat_ride",
               ("vibration={kind: sine, frequency: 4, amplitude: 1.0e-9}", "duration=10", "effects.seat.softening={}"),
               "seat.softening", NOT_NEEDED, "nothing vibrates"),
    EffectCase("loss of a landing", "seat_drop", (), "seat.normal_dissipative", NEEDED, "it damps the impact"),
    EffectCase("friction of a slap", "seat_slap", (), "backrest.friction", NEEDED, "10 mm of sliding at mu 0.4"),
    EffectCase("shock without loss", "seat_shock", ("effects.backrest.normal_dissipative=null",), "backrest.normal_dissipative",
               OFF_NEEDED, "the back bounces on without end"),
    EffectCase("shock of 1e-9 m/s²", "seat_shock", ("vibration.amplitude=1.0e-9",), "backrest.normal_dissipative", NOT_NEEDED,
               "nothing moves"),
    EffectCase("stress of an impact", "impact_rubber_drop", (), "impact.contact_stress", OBSERVES, "a map of the same force"),
    EffectCase("shift in a room", "impact_rubber_drop", (), "impact.shift", FIGURE, "as warm as the sample's values"),
    EffectCase("rubber at 323 K", "impact_rubber_drop", ("impact.temperatures=[323.15]",), "impact.shift", OFF_NEEDED,
               "warmer rubber is softer and more elastic"),
    EffectCase("wear of a track", "roller_corrugation", (), "roller.subsurface", NEEDED, "without volumes nothing wears"),
    EffectCase("compliant block", "block_slope", (), "block.compliant_contact", FIGURE, "a choice of the model"),
)  # fmt: skip
