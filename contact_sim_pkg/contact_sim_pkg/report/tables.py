"""A table of numbers for the page."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple


class Table(NamedTuple):
    """Texts of one table; the first column says what a row is, the others hold its numbers."""

    caption: str
    header: tuple[str, ...]
    rows: Sequence[tuple[str, ...]]
    title: str = ""
    """what a fold is called that holds it; its first heading where it has none"""
