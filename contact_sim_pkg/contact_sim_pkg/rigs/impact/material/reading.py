"""Reading a file of measured impacts: a line an impact, columns m, R, V0, tau, k and, where
measured, T and g.
"""

from __future__ import annotations

import csv
import math
import re
from pathlib import Path
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.files import read_regular_file
from contact_sim_pkg.rigs.impact.material.errors import MaterialError

__all__ = ["Impacts", "read_impacts"]

Vector = NDArray[numpy.float64]
FORCE_NAMES = ("force", "f", "fz", "f_z", "force_z", "impact_force", "kraft")
"""of a column of a force over time, in small letters"""
LARGEST_FILE = 1 << 26  # [bytes]
SEPARATORS = (";", "\t", ",")

COLUMNS: dict[str, tuple[str, ...]] = {
    "m": ("m", "mass"),
    "R": ("r", "radius"),
    "V0": ("v0", "v", "speed", "impact_speed"),
    "tau": ("tau", "τ", "tau_x", "duration", "contact_time"),
    "k": ("k", "k_x", "e", "restitution"),
    "T": ("t", "temperature"),
    "g": ("g", "gravity"),
}
"""Column -> names that are read as it, in small letters."""

UNITS: dict[str, dict[str, float]] = {
    "m": {"kg": 1.0, "g": 1e-3},
    "R": {"m": 1.0, "mm": 1e-3},
    "V0": {"m/s": 1.0, "mm/s": 1e-3},
    "tau": {"s": 1.0, "ms": 1e-3, "us": 1e-6, "µs": 1e-6, "μs": 1e-6},
    "k": {"1": 1.0, "-": 1.0},
    "T": {"K": 1.0, "C": 1.0, "°C": 1.0, "degC": 1.0, "F": 5.0 / 9.0, "°F": 5.0 / 9.0, "degF": 5.0 / 9.0},
    "g": {"m/s^2": 1.0, "m/s2": 1.0, "m/s²": 1.0},
}
OPTIONAL = ("T", "g")
FREEZING = 273.15
OFFSETS = dict.fromkeys(("C", "°C", "degC"), FREEZING) | dict.fromkeys(("F", "°F", "degF"), FREEZING - 160.0 / 9.0)
"""Unit of a temperature -> its zero in [K]."""
RANGES = {
    "m": (1e-12, 1e6), "R": (1e-9, 1e3), "V0": (1e-9, 1e4), "tau": (1e-12, 1e3), "k": (0.0, 1.5), "T": (1.0, 5000.0),
    "g": (0.0, 1e4),
}  # fmt: skip
"""Column -> what is read, in SI; a value outside is another column or unit."""


class Impacts(NamedTuple):
    """Measured impacts in SI units, arrays [impacts]."""

    file: str
    line: NDArray[numpy.int64]
    mass: Vector  # [kg]
    radius: Vector  # [m]
    speed: Vector  # V0 [m/s]
    duration: Vector  # tau [s]
    restitution: Vector  # k; noise may lift single ones above 1
    temperature: Vector | None  # [K]
    notes: tuple[str, ...]
    gravity: Vector | None = None  # [m/s^2] along the blow during the contact; None: none


def read_impacts(path: Path) -> Impacts:
    """Read ``path``: the first line that is no comment (#) names the columns, with a unit in
    brackets where it is not SI.

    Separated by semicolon, tab or comma. Rows without a value are passed over. Further columns are
    left alone and noted. Raises MaterialError with the line.
    """
    lines = _lines(path)
    separator = next((mark for mark in SEPARATORS if mark in lines[0][1]), ",")
    rows = [(number, _fields(path, number, text, separator)) for number, text in lines]
    # Columns by their names, each number in SI units.
    header, unused = _header(path, *rows[0])
    values: dict[str, list[float]] = {name: [] for name in header}
    for number, fields in rows[1:]:
        if len(fields) != len(rows[0][1]):
            raise MaterialError(f"{path}, line {number}: {len(fields)} fields, the header names {len(rows[0][1])}")
        for name, (place, factor, offset) in header.items():
            values[name].append(_number(path, number, name, fields[place], factor, offset))
    arrays = {name: numpy.array(column) for name, column in values.items()}
    notes = (f"columns not used: {', '.join(unused)}",) if unused else ()
    line = numpy.array([number for number, _ in rows[1:]], dtype=numpy.int64)
    return Impacts(
        file=str(path),
        line=line,
        mass=arrays["m"],
        radius=arrays["R"],
        speed=arrays["V0"],
        duration=arrays["tau"],
        restitution=arrays["k"],
        temperature=arrays.get("T"),
        notes=notes,
        gravity=arrays.get("g"),
    )


def _fields(path: Path, number: int, text: str, separator: str) -> list[str]:
    try:
        return next(csv.reader([text], delimiter=separator))
    except csv.Error as error:
        raise MaterialError(f"{path}, line {number}: this is no row of a table: {error}") from None


def _lines(path: Path) -> list[tuple[int, str]]:
    """Numbered lines that hold something."""
    try:
        text = read_regular_file(path, LARGEST_FILE, "a file of impacts has a line an impact").decode("utf-8-sig")
    except OSError as error:
        raise MaterialError(f"{path}: cannot be read: {error.strerror or error}") from error
    except UnicodeDecodeError as error:
        raise MaterialError(
            f"{path}, byte {error.start}: this is no text; impacts are read from a text file in UTF-8"
        ) from error
    lines = [(number, line.strip(" ")) for number, line in enumerate(text.splitlines(), start=1)]
    kept = [(number, line) for number, line in lines if line.strip("".join(SEPARATORS) + '" ') and line[0] != "#"]
    if len(kept) < 2:
        raise MaterialError(
            f"{path}: a line of column names and at least one impact were expected, {len(kept)} lines were found"
        )
    return kept


def _header(path: Path, number: int, fields: list[str]) -> tuple[dict[str, tuple[int, float, float]], list[str]]:
    """Column -> place, factor and offset to SI; and the names that are none of ours."""
    found: dict[str, tuple[int, float, float]] = {}
    unused = []
    for place, field in enumerate(fields):
        # Name and unit of a column.
        match = re.fullmatch(r"\s*([^\[(]*?)\s*(?:[\[(]\s*([^\])]*?)\s*[\])])?\s*", field)
        label, unit = (match.group(1), match.group(2)) if match else (field.strip(), None)
        name = next((name for name, names in COLUMNS.items() if label.lower() in names), None)
        if name is None:
            unused.append(label or f"column {place + 1}")
            continue
        if name in found:
            raise MaterialError(f"{path}, line {number}: column '{name}' is named twice")
        if unit is not None and unit not in UNITS[name]:
            raise MaterialError(
                f"{path}, line {number}: unit '{unit}' of column '{label}' is not read; {', '.join(UNITS[name])} are"
            )
        found[name] = (place, UNITS[name][unit] if unit else 1.0, OFFSETS.get(unit or "", 0.0))
    # Columns that every file has.
    missing = [name for name in COLUMNS if name not in found and name not in OPTIONAL]
    if missing:
        over_time = any(each.lower() in FORCE_NAMES for each in unused)
        cure = "; a force over time needs --mass KG and --speed M/S" if over_time else ""
        raise MaterialError(
            f"{path}, line {number}: no column {', '.join(missing)}; the columns m, R, V0, tau, k and, where measured, T are "
            f"read{cure}"
        )
    return found, unused


def _number(path: Path, line: int, name: str, field: str, factor: float, offset: float) -> float:
    text = field.strip()
    try:
        value = float(text) * factor + offset
        if "_" in text or not math.isfinite(value):
            raise ValueError
    except ValueError:
        raise MaterialError(
            f"{path}, line {line}: '{text[:40]}' in column '{name}' is no finite number (a decimal point is expected)"
        ) from None
    low, high = RANGES[name]
    if not ((value > 0.0 or name == "g") and low <= value <= high):
        raise MaterialError(
            f"{path}, line {line}: {value:g} in column '{name}'; a number above 0, {low:g} to {high:g} in SI units, is needed"
        )
    return value
