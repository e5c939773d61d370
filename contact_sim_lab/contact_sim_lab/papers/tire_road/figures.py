"""Figures of *Tire/Road Contact*."""

from __future__ import annotations

from contact_sim_lab.records.paper import Figure

__all__ = ["FIGURES"]

FIGURES: tuple[Figure, ...] = ()
