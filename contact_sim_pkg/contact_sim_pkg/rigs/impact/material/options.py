"""How impacts are read as a material."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["Options"]


class Options(NamedTuple):
    """Choices, with their usual values."""

    end: str = "force"  # end rule of the motion
    form: str = "exact"  # exact, corrected or printed
    shape: str = "small"  # shape factor, small or iterate
    confidence: float = 0.95  # of the intervals
    temperature_span: float = 2.0  # [K] within which impacts count as repeated
    speed_ratio: float = 1.3  # largest over smallest speed within which impacts count as repeated
