"""The table of load over deflection, `[DEFLECTION_LOAD_CURVE]`, that a tire property file may hold beside
or in place of a stiffness.
"""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple

__all__ = ["LoadCurve"]


class LoadCurve(NamedTuple):
    """Points of rising deflection [m] and load [N], straight lines between them."""

    points: tuple[tuple[float, float], ...]
    line: int  # of the section in the file

    def under(self, load: float) -> tuple[float, float] | None:
        """Deflection [m] and stiffness [N/m] under a ``load`` [N]: of the line that ends at or above
        it. None beyond the points.
        """
        for (shallow, low), (deep, high) in pairwise(self.points):
            if low < load <= high:
                stiffness = (high - low) / (deep - shallow)
                return shallow + (load - low) / stiffness, stiffness
        return None

    def load_at(self, deflection: float) -> float | None:
        """Load [N] at a ``deflection`` [m]; None beyond the points."""
        for (shallow, low), (deep, high) in pairwise(self.points):
            if shallow < deflection <= deep:
                return low + (deflection - shallow) * (high - low) / (deep - shallow)
        return None
