"""A part of a study's table as a person reads it: a heading, rows, and a line below. The flat rows
are for scripts.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

__all__ = ["Section", "number_of"]


class Section(NamedTuple):
    """Rows that share their columns, which are the keys."""

    title: str
    rows: Sequence[Mapping[str, Any]]
    note: str = ""


def number_of(value: float) -> str:
    """Two digits, as `7e-3` or `1.2e-2`; 0 for what is rounding, less than 1e-15."""
    if not value > 1e-15:
        return "0"
    exponent = math.floor(math.log10(value))
    digits = round(value / 10.0**exponent, 1)
    if digits >= 10.0:
        digits, exponent = 1.0, exponent + 1
    return f"{digits:g}e{exponent}" if exponent else f"{digits:g}"
