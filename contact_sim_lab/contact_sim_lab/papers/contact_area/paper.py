"""The record of *Contact Area*."""

from __future__ import annotations

from contact_sim_lab.papers.contact_area.equations import EQUATIONS
from contact_sim_lab.papers.contact_area.errata import ERRATA
from contact_sim_lab.papers.contact_area.figures import FIGURES
from contact_sim_lab.papers.contact_area.systems import SYSTEMS
from contact_sim_lab.records.paper import Paper

__all__ = ["PAPER"]

PAPER = Paper(
    key="contact-area",
    short="Contact Area",
    title=(
        "The position of the contact area, the contact stress distribution and the propagation of the "
        "circular surface waves during the collision between a spherical body and a semi-space surface"
    ),
    authors="N. Goloshchapov",
    year="not named in the text that the bench follows",
    models=(
        "A sphere strikes a viscoelastic half-space: where the contact surface lies, the force by complex "
        "moduli, restitution and contact time, stress over the contact, the surface wave and the front "
        "that runs ahead of it, and how a measured impact yields the material."
    ),
    systems=SYSTEMS,
    figures=FIGURES,
    equations=EQUATIONS,
    errata=ERRATA,
    not_shown=(
        "Figures 1 to 3 are drawings of the geometry and of the machine; their relations are equations 1 to 42."
    ),
    left_open=("Figure 5 as numbers: the photograph has no scales.",),
)
