"""A part of a study's table as a person reads it: a heading, rows, and a line below. The flat rows
are for scripts.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

__all__ = ["Section"]


class Section(NamedTuple):
    """Rows that share their columns, which are the keys."""

    title: str
    rows: Sequence[Mapping[str, Any]]
    note: str = ""
