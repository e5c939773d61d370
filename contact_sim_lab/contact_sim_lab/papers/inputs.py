"""Inputs of a system: a table with named columns, or a YAML document with named sections."""

from __future__ import annotations

import csv
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy
from numpy.typing import NDArray

from contact_sim_lab.records.paper import PaperError
from contact_sim_pkg.files import printable, read_regular_file
from contact_sim_pkg.scene.yaml.document import parse_plain

__all__ = ["is_bag", "numbers_of", "read_document", "read_table"]

Array = NDArray[numpy.float64]

LARGEST_FILE = 1 << 26  # [bytes]
LARGEST = 1e100  # of a number


def is_bag(path: Path) -> bool:
    """Whether a path is a bag rather than a table."""
    return path.is_dir() or path.suffix in (".mcap", ".db3", ".bag")


def read_table(path: Path, *choices: Sequence[str], fewest: int = 1) -> dict[str, Array]:
    """Columns of a CSV file by name, [rows]: the first line that is no comment (#) names them.

    choices: columns that are read, the first choice whose columns are all there; others are left
    alone. Raises PaperError with the line where a column is missing, a number is none or rows are
    fewer than `fewest`.
    """
    lines = [(number, text) for number, text in enumerate(_text(path).splitlines(), start=1)
             if text.strip() and not text.lstrip().startswith("#")]  # fmt: skip
    rows: list[tuple[int, list[str]]] = []
    for number, text in lines:
        try:
            rows.append((number, next(csv.reader([text], skipinitialspace=True))))
        except csv.Error as error:
            raise PaperError(f"{path}, line {number}: this is no row of a table: {error}") from None
    if not rows:
        raise PaperError(f"{path}: holds no line; a line of names and one of numbers a row are needed")
    names = [name.strip() for name in rows[0][1]]
    columns = next((choice for choice in choices if set(choice) <= set(names)), None)
    if columns is None:
        needed = " or ".join(", ".join(choice) for choice in choices)
        raise PaperError(f"{path}, line {rows[0][0]}: columns {needed} are needed, not {printable(', '.join(names))}")
    if len(rows) - 1 < fewest:
        raise PaperError(f"{path}: {len(rows) - 1} rows of numbers, at least {fewest} are needed")
    places = {name: names.index(name) for name in columns}
    found: dict[str, Array] = {name: numpy.empty(len(rows) - 1) for name in columns}
    for row, (number, cells) in enumerate(rows[1:]):
        for name, place in places.items():
            found[name][row] = _number(cells[place] if place < len(cells) else "", f"{path}, line {number}: {name}")
    return found


def read_document(path: Path) -> Mapping[str, Any]:
    """A YAML document of named sections, within the limits of a scene.

    Raises SceneError where it is no such YAML, PaperError where it has no sections.
    """
    content = parse_plain(_text(path), str(path))
    if not isinstance(content, dict):
        raise PaperError(f"{path}: keys with values are needed")
    return content


def numbers_of(values: Any, where: str, shape: tuple[int | None, ...]) -> Array:
    """Numbers of a shape, None for any length; PaperError, which names the place ``where``."""
    sizes = " x ".join("n" if size is None else str(size) for size in shape)
    try:
        found = numpy.array(values, dtype=numpy.float64)
    except (TypeError, ValueError):
        raise PaperError(f"{where}: {sizes} numbers are needed, not {printable(str(values))}") from None
    fits = found.ndim == len(shape) and all(
        size is None or size == length for size, length in zip(shape, found.shape, strict=True)
    )
    if not fits or not (numpy.abs(found) <= LARGEST).all():
        raise PaperError(f"{where}: {sizes} finite numbers are needed, not {printable(str(values))}")
    return found


def _text(path: Path) -> str:
    return read_regular_file(path, LARGEST_FILE).decode("utf-8-sig", "replace")


def _number(text: str, where: str) -> float:
    try:
        value = float(text)
    except ValueError:
        raise PaperError(f"{where}: {printable(text)!r} is no number") from None
    if not abs(value) <= LARGEST or math.isnan(value):
        raise PaperError(f"{where}: {printable(text)} is not a finite number")
    return value
