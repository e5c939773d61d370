"""Energies of the roller rig."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["Energies"]


class Energies(NamedTuple):
    """Of a part of the rig [J]."""

    kinetic: float = 0.0
    potential: float = 0.0  # of the load pressed on
    stored: float = 0.0  # in contact, shaft and suspension
    dissipated: float = 0.0
    supplied: float = 0.0

    def less(self, other: Energies) -> Energies:
        """What is more than in another."""
        return Energies(*(one - two for one, two in zip(self, other, strict=True)))

    def plus(self, other: Energies) -> Energies:
        """Of both."""
        return Energies(*(one + two for one, two in zip(self, other, strict=True)))
