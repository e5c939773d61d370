"""Checks of numbers, each with one sentence."""

from __future__ import annotations

import math

from .errors import ImpactError

__all__ = ["check_not_negative", "check_poisson_ratio", "check_positive"]


def check_positive(name: str, value: float, unit: str = "") -> float:
    """`value` where it is finite and above 0; raises ImpactError otherwise."""
    if not (math.isfinite(value) and value > 0.0):
        raise ImpactError(f"{name} {value:g}{_blank(unit)}: a finite number above 0 is needed")
    return float(value)


def check_not_negative(name: str, value: float, unit: str = "") -> float:
    """`value` where it is finite and not below 0; raises ImpactError otherwise."""
    if not (math.isfinite(value) and value >= 0.0):
        raise ImpactError(f"{name} {value:g}{_blank(unit)}: a finite number, 0 or above, is needed")
    return float(value)


def check_poisson_ratio(value: float) -> float:
    """`value` where it lies above -1 and not above 1/2; raises ImpactError otherwise."""
    if not -1.0 < value <= 0.5:
        raise ImpactError(f"Poisson ratio {value:g}: a number above -1, at most 0.5, is needed")
    return float(value)


def _blank(unit: str) -> str:
    return f" {unit}" if unit else ""
