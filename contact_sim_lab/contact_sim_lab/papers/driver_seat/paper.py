"""The record of *Driver and Seat*."""

from __future__ import annotations

from contact_sim_lab.papers.driver_seat.equations import EQUATIONS
from contact_sim_lab.papers.driver_seat.errata import ERRATA
from contact_sim_lab.papers.driver_seat.figures import FIGURES
from contact_sim_lab.papers.driver_seat.systems import SYSTEMS
from contact_sim_lab.records.paper import Paper

__all__ = ["PAPER"]

PAPER = Paper(
    key="driver-seat",
    short="Driver and Seat",
    title=("On the contact interfaces between the driver and the vehicle seat"),
    authors="not named in the text that the bench follows",
    year="not named",
    models=(
        "The back of an occupant, a doubly curved thin shell, slaps and slips on a seat back. The contact "
        "domain is found by minimum distance and interference of two bodies, with a genetic algorithm; "
        "its motion is written in cnoidal waves."
    ),
    systems=SYSTEMS,
    figures=FIGURES,
    equations=EQUATIONS,
    errata=ERRATA,
    not_shown="Figures 1 and 2 are sketches.",
    left_open=(
        (
            "Nonlinear normal modes of the shell: the paper names them and gives none; linear modes with "
            "the nonlinear contact force take their place."
        ),
        (
            "Figures 4 to 7 as numbers: the paper gives the band of the spine and no other value; mass, "
            "law, friction and amplitudes are chosen."
        ),
    ),
)
