"""Systems of *Tire/Road Contact*, and the command that reaches each."""

from __future__ import annotations

from contact_sim_lab.records.paper import Parameter, System

__all__ = ["SYSTEMS"]

SYSTEMS = (
    System("elastic half-space on a rigid road: domain, pressure, displacement", "1-4", "bench run tire_half_space"),
    System("single bump and irregular road", "section 3", "bench paper tire-road --figure 4"),
    System("Lamé ansatz of the pressure, and its equivalent ellipse", "5-9", "bench paper tire-road --equation 7"),
    System("travelling impulsive forces of asperities", "10",
           "bench run tire_irregular_road"),
    System(
        "contact of a shape of one's own: Sneddon's integrals of a tip, Lamé forms of an outline", "5-9, text",
        "bench paper tire-road --system profile examples/papers/profile_tip.csv", name="profile",
        run="contact_sim_lab.papers.tire_road.system_profile:profile",
        input="a CSV file with columns r, height of a tip, or x, y of an outline [m], as examples/papers/profile_*.csv",
        parameters=(
            Parameter("modulus", "Pa", 4.0e6, above=0.0, most=1e15, help="E* of both bodies"),
            Parameter("load", "N", 50.0, above=0.0, most=1e9),
        ),
    ),
    System(
        "load of a wheel over the uncertainty of its road: mean and spread", "section 3",
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
