"""Pressure field of a foam cushion of finite thickness, and the force law that is its integral."""

from __future__ import annotations

from collections.abc import Sequence

__all__ = ["REACH", "VALID_STRAIN", "valid_strain"]

VALID_STRAIN = 0.75
"""To which the law of a seat foam holds."""
REACH = 0.85
"""Of the thickness: the last approach of a table; beyond it the force goes on along its tangent."""


def valid_strain(points: Sequence[Sequence[float]] | None) -> float:
    """Strain to which the law of a cushion's foam holds: the end of its measured curve, whose ``points`` begin with
    their strain, at most that of a table; that of the formula where there is no curve.
    """
    return VALID_STRAIN if points is None else min(float(points[-1][0]), REACH)
