"""Systems of *Tire/Road Contact*, and the command that reaches each."""

from __future__ import annotations

from contact_sim_lab.records.paper import Parameter, System

__all__ = ["SYSTEMS"]

SYSTEMS = (
    System("elastic half-space on a rigid road under a wheel: domain and pressure",
           (("2-4", "tire/patch: load, area, approach, pressure"),), "bench run tire_half_space"),
    System("displacement of its surface over a single bump", (("1", "largest u"), ("2", "load, ∬ p")),
           "bench paper tire-road --figure 2"),
    System("pressure over a single bump", (("section 3", "largest p/p_ref,max"),), "bench paper tire-road --figure 4"),
    System("pressure over an irregular road", (("section 3", "largest p/p_ref,max"),), "bench paper tire-road --figure 5"),
    System(
        "Lamé ansatz of the pressure, and its equivalent ellipse",
        (("5", "5"), ("6", "6"), ("7-9", "8")),
        "bench paper tire-road --equation N",
    ),

    System("travelling impulsive forces of asperities", (("10", "tire/force: impulses"),), "bench run tire_irregular_road"),
    System(
        "contact of a shape of one's own: Lamé forms of an outline, or Sneddon's integrals of a tip",
        (("5-9", "centre_pressure_Pa, approach_m, pressure_Pa"),),
        "bench paper tire-road --system profile examples/papers/profile_outline.csv", name="profile",
        run="contact_sim_lab.papers.tire_road.system_profile:profile",
        input="a CSV file with columns r, height of a tip, or x, y of an outline [m], as examples/papers/profile_*.csv",
        parameters=(
            Parameter("modulus", "Pa", 4.0e6, above=0.0, most=1e15, help="E* of both bodies"),
            Parameter("load", "N", 50.0, above=0.0, most=1e9),
        ),
    ),
    System(
        "load of a wheel over the uncertainty of its road: mean and spread", (("section 3", "mean load"),),
        "bench paper tire-road --system load tire_irregular_road", name="load",
        run="contact_sim_lab.papers.tire_road.system_load:load_over_seeds",
        input="a scene of rig tire or car, by name or file",
        parameters=(
            Parameter("seeds", "", 20, least=2, most=1000, help="number of runs"),
            Parameter("first", "", 1, least=0, most=2**31, help="first seed"),
            Parameter("duration", "s", 0.0, least=0.0, most=3600.0, help="of each run; 0: that of the scene"),
            Parameter("start", "s", 0.2, least=0.0, most=3600.0, help="of the numbers: the wheel settles before"),
        ),
    ),
)  # fmt: skip
