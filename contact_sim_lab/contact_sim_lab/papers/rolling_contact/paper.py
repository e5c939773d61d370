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
    not_shown=(
        "Figures 1, 7 and 8 are schemes, figure 5 is a photograph, figure 15 is the flow chart of one interval."
    ),
    left_open=(
        (
            "Instability of the programme at step IX: the print gives neither the loads of the steps nor "
            "the damping of the suspension. With the chosen ones tilt and yaw grow from 380 N on, above the "
            "238.5 N of step IX."
        ),
        "Noise in dB: the bench has no acoustics.",
        "Distribution of the fatigue limits: one limit a body, times a hardness along the track.",
        ("Measured waves: figures 3 and 4 are drawings without values; the bench shows the simulated wave."),
    ),
)
