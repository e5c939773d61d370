"""Equations of *Identifiability*."""

from __future__ import annotations

from contact_sim_lab.records.paper import Equation

__all__ = ["EQUATIONS"]

EQUATIONS: tuple[Equation, ...] = ()
