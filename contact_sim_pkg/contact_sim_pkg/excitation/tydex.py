"""Measurements of a tire in the TYDEX format, release 1.3 (Unrau and Zamow, TYDEX-Format, Description and Reference Manual,
1997).

`**MEASURCHANNELS` names the channels, a line each: 10 characters of name, 30 of comment, 10 of unit, and a factor from the
numbers of the data to that unit. `**MEASURDATA` has the numbers, a row a sample. Lines that begin with `!` are comments.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.table_words import is_number, number
from contact_sim_pkg.files import open_regular_file

__all__ = ["columns"]

NAME, UNIT, FACTOR = slice(0, 10), slice(40, 50), slice(50, None)
Column = tuple[str, str | None, NDArray[numpy.float64]]


def columns(path: Path) -> Iterator[Column]:
    """Name, unit and samples of each channel, in its unit.

    Raises:
        ExcitationError: no channels or no data, a channel with two units, a factor or a sample that is no number, a row
            with more or fewer numbers than channels; with file and line.
    """
    channels: dict[str, tuple[str, float]] = {}
    rows: list[list[float]] = []
    section = ""
    with open_regular_file(path) as file:
        lines = file.read().decode("latin-1").splitlines()
    for place, line in enumerate(lines, 1):
        if line.startswith("**"):
            section = line[2:].strip().upper()
        elif not line.strip() or line.lstrip().startswith("!"):
            continue
        elif section == "MEASURCHANNELS":
            _take(path, place, line.expandtabs(), channels)
        elif section == "MEASURDATA":
            rows.append(_samples(path, place, line.split(), len(channels)))
    if not channels or not rows:
        missing = "**MEASURCHANNELS" if not channels else "**MEASURDATA"
        raise ExcitationError(
            f"{path}: there is nothing under {missing}; a file of TYDEX with measurements was expected"
        )
    samples = numpy.array(rows).T
    for values, (name, (unit, factor)) in zip(samples, channels.items(), strict=True):
        yield name, unit or None, factor * values


def _take(path: Path, place: int, line: str, channels: dict[str, tuple[str, float]]) -> None:
    """Take a channel of a line of the file."""
    name, unit, behind = line[NAME].strip(), line[UNIT].strip(), line[FACTOR].split()
    if name in channels:
        other = channels[name][0]
        units = f"in {other or 'no unit'} and in {unit or 'no unit'}" if other != unit else f"in {unit}"
        raise ExcitationError(f"{path}, line {place}: channel {name} is there twice, {units}; keep one")
    if behind and not is_number(behind[0]):
        raise ExcitationError(
            f"{path}, line {place}: the factor of channel {name} is '{behind[0]}'; a number was expected"
        )
    channels[name] = unit, number(behind[0]) if behind else 1.0


def _samples(path: Path, place: int, fields: list[str], count: int) -> list[float]:
    """The numbers of a row."""
    if len(fields) != count:
        raise ExcitationError(f"{path}, line {place}: the row has {len(fields)} numbers, the file has {count} channels")
    wrong = next((field for field in fields if not is_number(field)), None)
    if wrong is not None:
        raise ExcitationError(f"{path}, line {place}: '{wrong}' is no number")
    return [number(field) for field in fields]
