"""Static stiffness of a tire, and whether it is that of a car tire: said once before the run."""

from __future__ import annotations

from contact_sim_pkg.laws.elastic_law import approach_of_force, elastic_force
from contact_sim_pkg.laws.parameters import ElasticLaw
from contact_sim_pkg.rigs.vehicle.motion.spring import Spring

__all__ = ["stiffness_cautions", "tire_stiffness"]

CAR_TIRES = (150e3, 300e3)
"""[N/m] of car tires at their load."""

CAR_LOADS = (1.5e3, 8e3)
"""[N] that a wheel of a car carries."""

STEP = 1e-3
"""Of the approach, to both sides of it."""


def tire_stiffness(law: ElasticLaw, sidewalls: Spring | None, load: float) -> float:
    """Stiffness dF/dz [N/m] of the whole tire at a ``load`` [N]: its contact law, in series with the
    sidewalls of a rigid ring.
    """
    approach = float(approach_of_force(law, load))
    rise = float(elastic_force(law, (1.0 + STEP) * approach) - elastic_force(law, (1.0 - STEP) * approach))
    compliance = 2.0 * STEP * approach / rise + (0.0 if sidewalls is None else 1.0 / sidewalls.stiffness)
    return 1.0 / compliance


def stiffness_cautions(stiffness: float, load: float) -> tuple[str, ...]:
    """A sentence where the ``stiffness`` [N/m] of a tire under the ``load`` [N] of a car's wheel is not that of a car
    tire.
    """
    least, most = CAR_TIRES
    if least <= stiffness <= most or not CAR_LOADS[0] <= load <= CAR_LOADS[1]:
        return ()
    usual = f"that of a car tire is {least / 1e3:.0f} to {most / 1e3:.0f} kN/m"
    cure = "effects.tire.inflation: {} is a tire of 205/55 R16 at 220 kPa"
    return (f"tire: its static stiffness is {stiffness / 1e3:.0f} kN/m under {load:.0f} N; {usual}; {cure}",)
