"""Long series for a picture: an envelope that keeps every extreme."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

COLUMNS = 700
"""Columns of an envelope; a plot in the report is about 700 pixels wide."""


def envelope(
    time: NDArray[np.float64], values: NDArray[np.float64], columns: int = COLUMNS
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Smallest and largest value of each of `columns` stretches, in the order in which they occur.

    A series of at most 2 * columns samples is returned as it is. The line through the result covers the same pixels as
    the line through all samples, and its extremes are those of the series.

    Args:
        time: any unit, ascending, one dimension.
        values: any unit, same shape, no nan.
        columns: number of stretches, > 0.
    """
    if values.size <= 2 * columns:
        return time, values
    edges = np.linspace(0, values.size, columns + 1).astype(np.int64)
    picks = np.empty((columns, 2), dtype=np.int64)
    for column, (start, stop) in enumerate(pairwise(edges)):
        stretch = values[start:stop]
        picks[column] = start + stretch.argmin(), start + stretch.argmax()
    order = np.sort(picks, axis=1).ravel()
    return time[order], values[order]
