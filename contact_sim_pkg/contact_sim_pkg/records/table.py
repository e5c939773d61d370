"""A part of a study's table as a person reads it: a heading, rows, and a line below. The flat rows
are for scripts.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from html import escape
from typing import Any, NamedTuple

__all__ = ["Section", "number_of", "table_html"]


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


def table_html(rows: Sequence[Mapping[str, Any]], caption: str) -> str:
    """Rows as an HTML table with a line above."""
    names = list(rows[0]) if rows else []
    heads = "".join(f"<th>{escape(name)}</th>" for name in names)
    lines = ["".join(f"<td>{escape(str(row[name]))}</td>" for name in names) for row in rows]
    body = "".join(f"<tr>{line}</tr>" for line in lines)
    return f"<p>{escape(caption)}</p><table><thead><tr>{heads}</tr></thead><tbody>{body}</tbody></table>"
