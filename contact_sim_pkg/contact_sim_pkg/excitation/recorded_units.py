"""The columns of a recording in m/s^2."""

from __future__ import annotations

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.judge import LARGEST_ACCELERATION
from contact_sim_pkg.excitation.recorded_csv import UNITS, RecordedTable
from contact_sim_pkg.excitation.table_words import bare_name

KEYS = {"x": "forward_column", "y": "lateral_column", "z": "vertical_column"}
"""Axis -> key of a vibration that names its column."""
Array = NDArray[numpy.float64]


def signed_column(table: RecordedTable, name: str, unit: str | None, axis: str = "") -> Array:
    """One axis, [samples] in [m/s^2]; ExcitationError where a value is none that can be
    measured.
    """
    plain = bare_name(name.removeprefix("-"))
    column = table.column(plain, KEYS.get(axis, ""))
    factor = 1.0 if unit is None or plain in table.with_unit else UNITS[unit]
    wrong = numpy.flatnonzero(numpy.abs(column) > LARGEST_ACCELERATION / factor)
    if wrong.size:
        raise ExcitationError(
            f"{table.file}, line {table.lines[wrong[0]]}: column '{plain}' is {column[wrong[0]]:g} {unit or 'm/s^2'}; "
            f"allowed: within +-{LARGEST_ACCELERATION / factor:g} ({wrong.size} such samples)"
        )
    column = column if factor == 1.0 else column * factor
    return -column if name.startswith("-") else column
