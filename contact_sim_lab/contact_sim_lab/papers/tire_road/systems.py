"""Systems of *Tire/Road Contact*, and the command that reaches each."""

from __future__ import annotations

from contact_sim_lab.records.paper import System

__all__ = ["SYSTEMS"]

SYSTEMS = (
    System("elastic half-space on a rigid road: domain, pressure, displacement", "1-4", "bench run tire_half_space"),
    System("single bump and irregular road", "section 3", "bench paper tire-road --figure 4"),
    System("Lamé ansatz of the pressure, and its equivalent ellipse", "5-9", "bench paper tire-road --equation 7"),
    System("travelling impulsive forces of asperities", "10",
           "bench run tire_half_space --set effects.tire.asperity_impulses={}"),
)  # fmt: skip
