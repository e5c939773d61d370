"""Systems of *Contact Area*, and the command that reaches each."""

from __future__ import annotations

from contact_sim_lab.records.paper import System

__all__ = ["SYSTEMS"]

SYSTEMS = (
    System("free impact of a sphere: elastic and viscous force, restitution, contact time", "1-9, 54-71",
           "bench run impact_rubber_drop"),
    System("position of the contact surface in both variants, with heating", "10-40",
           "bench run impact_rubber_drop --set effects.impact.thermal_volume={}"),
    System("ring, circular surface wave and micro-front", "43-53, 72-80", "bench run impact_rubber_drop"),
    System("stress over the contact area, elastic and viscous", "41, 42, 81-89", "bench run impact_rubber_drop"),
    System("complex modulus in harmonic motion, operator form, relations of moduli", "90-103, 114-125",
           "bench paper contact-area --equation 96"),
    System("material of a measured impact, time-temperature shift", "104-107", "bench material IMPACTS.csv"),
    System("hereditary indentation", "108-113", "bench run impact_rubber_drop --set effects.impact.history={}"),
)  # fmt: skip
