"""Checks of single numbers at the boundary of the laws, each with one sentence: what, its value, what is allowed."""

from __future__ import annotations

import math

__all__ = ["check_not_nan", "check_number", "check_positive", "check_within"]


def check_not_nan(name: str, value: float) -> None:
    """Raises ValueError where ``value`` is nan; infinite it may be."""
    if math.isnan(value):
        raise ValueError(f"{name} is {value}, it must be a number")


def check_number(name: str, value: float) -> None:
    """Raises ValueError where ``value`` is not a finite number."""
    if not math.isfinite(value):
        raise ValueError(f"{name} is {value}, it must be a finite number")


def check_positive(name: str, value: float) -> None:
    """Raises ValueError where ``value`` is not a finite number above 0."""
    if not 0.0 < value < math.inf:
        raise ValueError(f"{name} is {value}, it must be a finite number above 0")


def check_within(name: str, value: float, low: float, high: float) -> None:
    """Raises ValueError where ``value`` is not a number from ``low`` to ``high``, ends included."""
    if not low <= value <= high:
        raise ValueError(f"{name} is {value}, it must be a number from {low:g} to {high:g}")
