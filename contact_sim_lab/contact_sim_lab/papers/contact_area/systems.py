"""Systems of *Contact Area*, and the command that reaches each."""

from __future__ import annotations

from contact_sim_lab.records.paper import System

__all__ = ["SYSTEMS"]

POSITION = "impact/position: surface_depth, compression, volume, compression_volume, heating_volume"
HEATED = "--set effects.impact.thermal_volume.heating=20"

SYSTEMS = (
    System(
        "free impact of a sphere: elastic and viscous force, restitution, contact time",
        (("2, 8, 9, 54, 55", "impact/course: depth, elastic_force, viscous_force"),),
        "bench run impact_rubber_drop",
    ),
    System(
        "position of the contact surface, its border on the surface (variant 2), with heating",
        (("30-40", POSITION),),
        f"bench run impact_rubber_drop {HEATED}",
    ),
    System(
        "position of the contact surface, its border sinks (variant 1), with heating",
        (("10-29", POSITION),),
        f"bench run impact_rubber_drop --set effects.impact.thermal_volume.variant=1 {HEATED}",
    ),
    System(
        "ring, circular surface wave and micro-front",
        (
            ("48", "impact/wave: ring_ratio"), ("72-74", "impact/wave: height, length, speed"),
            ("76-79", "impact/front: border_speed, front_speed, front_time"),
        ),
        "bench run impact_rubber_drop",
    ),
    System(
        "stress over the contact area, elastic and viscous", (("81-87", "impact/stress: elastic, viscous"),),
        "bench run impact_rubber_drop",
    ),
    System(
        "hereditary indentation of a standard solid",
        (("112, 113", "impact/history: depth"),),
        "bench run impact_rubber_drop --set effects.impact.history.model=standard_solid",
    ),
    System(
        "material of a measured impact", (("104, 105", "E', tan_beta"),), "bench material IMPACTS.csv"
    ),
    System(
        "single formulas: overlap, damped sine, restitution, velocities of the surface, retarded stress",
        (
            *((each, each) for each in ("1", "6", "41", "42")), ("56-60", "58"),
            *((each, each) for each in ("57", "66", "67", "71", "80", "88", "89")),
        ),
        "bench paper contact-area --equation N",
    ),
    System(
        "complex modulus in harmonic motion, shift, relaxation, relations of moduli, operator form",
        (
            ("90", "90"), ("91-93", "93"), ("94-102", "96"), ("103", "87"), ("106, 107", "106"),
            *((each, each) for each in ("114", "115", "116", "117", "118", "119", "120", "121", "122")),
            ("124, 125", "124"),
        ),
        "bench paper contact-area --equation N",
    ),
)  # fmt: skip
