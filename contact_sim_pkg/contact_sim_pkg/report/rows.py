"""Nested values as rows of a table, each with its unit."""

from __future__ import annotations

import math
from functools import cache
from typing import Any, NamedTuple

from contact_sim_pkg.scene.schema.catalog import catalog, without_kinds

SUFFIXES = {
    "_m_per_s2": "m/s²",
    "_Hz_per_s": "Hz/s",
    "_octaves_per_minute": "octaves/min",
    "_m_per_s": "m/s",
    "_percent": "%",
    "_degrees": "°",
    "_rad": "rad",
    "_Hz": "Hz",
    "_m3": "m³",
    "_m": "m",
    "_s": "s",
}
"""Endings of the keys that an excitation describes itself with, longest first where one ends
another.
"""


SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


class Row(NamedTuple):
    """One row: what it is, and its value with unit."""

    label: str
    value: str


def scene_rows(value: Any, location: tuple[str, ...] = (), shown_from: int = 0) -> list[Row]:
    """Values of a scene, or of the part at `location`, with the units of the schema; None is left
    out.

    Args:
        value: of the scene at `location`.
        location: keys from the scene's root.
        shown_from: number of leading keys that the labels leave out.
    """
    if value is None:
        return []
    if isinstance(value, dict):
        return [row for key, item in value.items() for row in scene_rows(item, (*location, str(key)), shown_from)]
    return [
        Row(
            " · ".join(plain_name(key) for key in location[shown_from:]),
            scene_value(value, location),
        )
    ]


def scene_value(value: Any, location: tuple[str, ...]) -> str:
    """The value at `location`, keys from the scene's root, with the unit of the schema."""
    return with_unit(value, _scene_units().get(location, ""))


def described_rows(value: Any, label: str = "") -> list[Row]:
    """Values that an excitation describes itself with; the unit is the end of the key
    (`frequency_Hz`).
    """
    if value is None or value in ([], {}):
        return []
    if isinstance(value, dict):
        return [
            row
            for key, item in value.items()
            for row in described_rows(item, f"{label} · {key}" if label else str(key))
        ]
    if isinstance(value, list) and any(isinstance(item, dict) for item in value):
        return [row for item in value for row in described_rows(item, label)]
    suffix = next((ending for ending in SUFFIXES if label.endswith(ending)), "")
    return [Row(plain_name(label.removesuffix(suffix)), with_unit(value, SUFFIXES.get(suffix, "")))]


def number(value: float) -> str:
    """Text of a value (any unit, dimensionless too) in three digits; very small and large ones as
    1.2·10⁻⁸; `–` for what is no number."""
    if not math.isfinite(value):
        return "–"
    if value != 0.0 and not 1e-3 <= abs(value) < 1e6:
        mantissa, exponent = f"{value:.1e}".split("e")
        return f"{mantissa}·10{str(int(exponent)).translate(SUPERSCRIPT)}"
    digits = f"{value:.3g}"
    return f"{value:.0f}" if "e" in digits else digits


def with_unit(value: Any, unit: str) -> str:
    """`0.5`, `m` -> `0.5 m`."""
    return f"{plain(value)} {unit}".rstrip()


def plain(value: Any) -> str:
    """A value as a person writes it: 6 digits, yes and no, lists with commas."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, (list, tuple)):
        return ", ".join(plain(item) for item in value)
    return str(value)


def plain_name(key: str) -> str:
    """`kernel_fingerprint` -> `kernel fingerprint`."""
    return key.replace("_", " ")


@cache
def _scene_units() -> dict[tuple[str | int, ...], str]:
    return {without_kinds(location): entry.unit for location, entry in catalog().items() if entry.unit}
