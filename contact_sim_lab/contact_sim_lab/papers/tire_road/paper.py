"""The record of *Tire/Road Contact*."""

from __future__ import annotations

from contact_sim_lab.papers.tire_road.equations import EQUATIONS
from contact_sim_lab.papers.tire_road.errata import ERRATA
from contact_sim_lab.papers.tire_road.figures import FIGURES
from contact_sim_lab.papers.tire_road.systems import SYSTEMS
from contact_sim_lab.records.paper import Paper

__all__ = ["PAPER"]

PAPER = Paper(
    key="tire-road",
    short="Tire/Road Contact",
    title=("A 3D model for tire/road dynamic contact"),
    authors="not named in the text that the bench follows",
    year="not named",
    models=(
        "The tread of a tire is an incompressible elastic half-space on a rigid rough road. Unknown are "
        "contact domain, pressure and surface displacement, over a single bump and over an irregular "
        "road; moving asperities add impulsive forces."
    ),
    systems=SYSTEMS,
    figures=FIGURES,
    equations=EQUATIONS,
    errata=ERRATA,
    not_shown="Figure 1 is a sketch.",
    left_open=("Figures 2 to 5 as numbers: the paper gives none; tire, bump and irregular road are chosen.",),
)
