"""Figures of *Rolling Contact*."""

from __future__ import annotations

from contact_sim_lab.papers.rolling_contact.figures_ellipse import FIGURE_9, FIGURE_10
from contact_sim_lab.papers.rolling_contact.figures_stress import STRESS_FIGURES
from contact_sim_lab.papers.rolling_contact.figures_track import FIGURE_2, FIGURE_3, FIGURE_4, FIGURE_6
from contact_sim_lab.records.paper import Figure

__all__ = ["FIGURES"]

FIGURES: tuple[Figure, ...] = (FIGURE_2, FIGURE_3, FIGURE_4, FIGURE_6, FIGURE_9, FIGURE_10, *STRESS_FIGURES)
