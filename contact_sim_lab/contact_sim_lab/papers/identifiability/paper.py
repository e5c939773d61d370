"""The record of *Identifiability*."""

from __future__ import annotations

from contact_sim_lab.papers.identifiability.equations import EQUATIONS
from contact_sim_lab.papers.identifiability.errata import ERRATA
from contact_sim_lab.papers.identifiability.figures import FIGURES
from contact_sim_lab.papers.identifiability.systems import SYSTEMS
from contact_sim_lab.records.paper import Paper

__all__ = ["PAPER"]

PAPER = Paper(
    key="identifiability",
    short="Identifiability",
    title=("Identifiability analysis of a rigid body undergoing frictional contact with its environment"),
    authors="not named in the text that the bench follows",
    year="not named",
    models=(
        "A rigid body in free fall strikes a fixed surface. Contact is a complementarity problem in "
        "velocities and impulses; which inertial parameters and impulses can be found from the motion, "
        "sliding and sticking, with and without known external forces."
    ),
    systems=SYSTEMS,
    figures=FIGURES,
    equations=EQUATIONS,
    errata=ERRATA,
    left_open=("Further drawings: the text announces three more and has none.",),
)
