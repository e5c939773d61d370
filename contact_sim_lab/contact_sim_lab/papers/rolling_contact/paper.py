"""The record of *Rolling Contact*."""

from __future__ import annotations

from contact_sim_lab.papers.rolling_contact.equations import EQUATIONS
from contact_sim_lab.papers.rolling_contact.errata import ERRATA
from contact_sim_lab.papers.rolling_contact.figures import FIGURES
from contact_sim_lab.papers.rolling_contact.systems import SYSTEMS
from contact_sim_lab.records.paper import Paper

__all__ = ["PAPER"]

PAPER = Paper(
    key="rolling-contact",
    short="Rolling Contact",
    title=("Vibro-impact in rolling contact"),
    authors="not named in the text that the bench follows",
    year="not named",
    models=(
        "A roller pressed on a rotating, bent shaft. Small tilt, yaw and heave, changing curvatures and "
        "friction can make the motion unstable; stress beyond fatigue limits defines dangerous volumes, "
        'which grow waves along the track ("troppy").'
    ),
    systems=SYSTEMS,
    figures=FIGURES,
    equations=EQUATIONS,
    errata=ERRATA,
)
