"""The unit of a recording: columns in m/s^2, and what values say that are in another unit."""

from __future__ import annotations

from math import sqrt

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.recorded_csv import STANDARD_GRAVITY, UNITS, RecordedTable

LARGEST_ACCELERATION = 1e5  # [m/s^2] about 10 000 g, the end of the range of shock accelerometers
# [m/s^2] no rig is accelerated so for the length of a recording
LARGEST_MEAN = 5.0 * STANDARD_GRAVITY
LARGEST_RMS = 200.0  # [m/s^2] about 20 g: seats and floors stay a factor 10 below
GRAVITY_AGREEMENT = 0.1  # a mean this close to 1 or 1000 is gravity in g or mg

KEYS = {"x": "forward_column", "z": "vertical_column"}
"""Axis -> key of a vibration that names its column."""
Array = NDArray[numpy.float64]


def signed_column(table: RecordedTable, name: str, unit: str | None, axis: str = "") -> Array:
    """One axis, [samples] in [m/s^2]; ExcitationError where a value is none that can be
    measured.
    """
    plain = name.removeprefix("-").lower()
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


def refuse_other_unit(file: str, raw: dict[str, Array]) -> None:
    """Refuse values that are not in m/s^2 by what they show: gravity, a steady acceleration or an
    rms that cannot be.

    raw: [samples] of each axis, as if in [m/s^2].
    """
    mean = sqrt(sum(float(values.mean()) ** 2 for values in raw.values()))
    rms = max(float(values.std()) for values in raw.values())
    cure = "state the unit (vibration.unit: m/s^2, g or mg; or in the header, such as z [g])"
    # A mean of 1 or 1000 is gravity in g or mg
    for unit, gravity in (("g", 1.0), ("mg", 1000.0)):
        if abs(mean - gravity) <= GRAVITY_AGREEMENT * gravity:
            raise ExcitationError(
                f"{file}: the mean acceleration is {mean:.4g}, which is gravity in {unit} and not in m/s^2 "
                f"({STANDARD_GRAVITY:.4g}); {cure}"
            )
    if mean > LARGEST_MEAN or rms > LARGEST_RMS:
        raise ExcitationError(
            f"{file}: the mean acceleration is {mean:.4g} and the rms about it {rms:.4g}; in m/s^2 allowed are "
            f"{LARGEST_MEAN:.3g} and {LARGEST_RMS:g}; {cure}"
        )
