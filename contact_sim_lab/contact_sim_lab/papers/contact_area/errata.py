"""Errata of *Contact Area*."""

from __future__ import annotations

from contact_sim_lab.records.paper import Erratum

__all__ = ["ERRATA"]

ERRATA: tuple[Erratum, ...] = ()
