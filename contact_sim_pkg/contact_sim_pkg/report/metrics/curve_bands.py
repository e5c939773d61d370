"""A band round a curve of a run, such as a tolerance of a transmissibility over frequency, and how far the curve leaves it."""

from __future__ import annotations

import csv
import math
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

import numpy as np

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.files import open_regular_file
from contact_sim_pkg.records.metric import EVENT, NO_BAND, STATIONARY, Metric
from contact_sim_pkg.report.curves import curves_of
from contact_sim_pkg.report.series import FloatArray, Recording

__all__ = ["BEYOND", "CurveBand", "beyond_bands", "read_curve_band"]

BEYOND = "beyond"
COLUMNS = ("x", "low", "high")
WIDEST_GAP = 0.1
"""between two points of the curve, or one and an end of the band, of the band's length"""


class CurveBand(NamedTuple):
    """Lowest and highest value of a curve, straight between its points."""

    curve: str
    """`seat.transmissibility`, as `bench compare` names it"""
    x: tuple[float, ...]
    """increasing"""
    low: tuple[float, ...]
    high: tuple[float, ...]

    @property
    def metric(self) -> str:
        """Key of the number that is required to be at most 0."""
        return f"{self.curve}.{BEYOND}"


def read_curve_band(curve: str, path: Path) -> CurveBand:
    """The band of a CSV file with the columns x, low and high: two rows or more, x increasing, low at most high.

    Raises:
        BagError: the file holds no band. FileRefusedError: it cannot be read.
    """
    with open_regular_file(path) as file:
        lines = file.read().decode("utf-8-sig", "replace").splitlines()
    rows = [[each.strip() for each in row] for row in csv.reader(lines) if row and not row[0].startswith("#")]
    form = f"{path}: a band has a header {','.join(COLUMNS)} and two rows or more"
    if len(rows) < 3 or tuple(rows[0]) != COLUMNS:
        raise BagError(f"{form}; it begins with {','.join(rows[0]) if rows else 'nothing'} and has {len(rows)} lines")
    try:
        table = np.array([[float(cell) for cell in row] for row in rows[1:]])
    except ValueError as error:
        raise BagError(f"{form} of three numbers: {error}") from None
    if table.shape[1] != len(COLUMNS) or not np.isfinite(table).all():
        raise BagError(f"{form} of three finite numbers")
    for number, (x, low, high) in enumerate(table, start=2):
        if low > high or (number > 2 and x <= table[number - 3, 0]):
            fault = (
                f"low {low:g} is above high {high:g}" if low > high else f"x {x:g} does not come after the one before"
            )
            raise BagError(f"{path}: line {number}: {fault}")
    x, low, high = (tuple(map(float, column)) for column in table.T)
    return CurveBand(curve, x, low, high)


def beyond_bands(recording: Recording, bands: Iterable[CurveBand]) -> list[Metric]:
    """How far the curves of a run lie beyond their bands, negative inside, one number a band; none of a curve that the
    run does not have.

    The value is the largest of low − y and y − high over the points of the curve between the ends of the band. Where the
    curve is not known up to both ends it is nan, and the number says what is.
    """
    bands = list(bands)
    curves = curves_of(recording) if bands else {}
    return [
        _beyond(each, np.asarray(curves[each.curve].x), np.asarray(curves[each.curve].y), curves[each.curve].unit_x)
        for each in bands
        if each.curve in curves
    ]


def _beyond(band: CurveBand, x: FloatArray, y: FloatArray, unit: str) -> Metric:
    inside = np.isfinite(y) & (x >= band.x[0]) & (x <= band.x[-1])
    x, y = x[inside], y[inside]
    # what lies between two points that are far apart is not known
    steps = np.diff([band.x[0], *x, band.x[-1]])
    if not x.size or steps.max() > WIDEST_GAP * (band.x[-1] - band.x[0]):
        known = f"at {x.size} points from {x[0]:.4g} to {x[-1]:.4g} {unit}" if x.size else "nowhere in it"
        value, remark = math.nan, f"the curve is known {known}, its band is {band.x[0]:.4g} to {band.x[-1]:.4g} {unit}"
    else:
        far = np.maximum(np.interp(x, band.x, band.low) - y, y - np.interp(x, band.x, band.high))
        value, remark = float(far.max()), f"at {x[far.argmax()]:.4g} {unit}"
    # what chance does to a spectrum is known from replications alone
    basis = STATIONARY if unit == "Hz" else EVENT
    return Metric(
        band.metric, f"{band.curve}, beyond its band", value, "", NO_BAND, None, remark, size=x.size, basis=basis
    )
