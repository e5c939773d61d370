"""Long series for a picture: an envelope that keeps every extreme."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

BANDS = 350
"""Columns of a band with its mean: two pixels each."""
COLUMNS = 700
"""Columns of an envelope; a plot in the report is about 700 pixels wide."""


def bands(
    time: NDArray[np.float64], values: NDArray[np.float64], columns: int = BANDS
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Time in the middle of each of `columns` intervals, [columns], with the smallest, mean and
    largest value of each.

    Args:
        time: any unit, ascending, one dimension.
        values: any unit, same shape, no nan, at least `columns` of them.
        columns: number of intervals, > 0.
    """
    edges = np.linspace(0, values.size, columns + 1).astype(np.int64)
    lengths = np.diff(edges)
    low, high = (each.reduceat(values, edges[:-1]) for each in (np.minimum, np.maximum))
    return 0.5 * (time[edges[:-1]] + time[edges[1:] - 1]), low, np.add.reduceat(values, edges[:-1]) / lengths, high


def envelope(
    time: NDArray[np.float64], values: NDArray[np.float64], columns: int = COLUMNS
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Smallest and largest value of each of `columns` intervals, in the order in which they occur.

    A series of at most 2 * columns samples is returned as it is. The line through the result covers
    the same pixels as the line through all samples, and its extremes are those of the series.

    time: [samples], any unit, ascending; values: [samples], any unit, no nan; columns: number of
    intervals, > 0. The result: time and values, [2 columns].
    """
    if values.size <= 2 * columns:
        return time, values
    edges = np.linspace(0, values.size, columns + 1).astype(np.int64)
    picks = np.empty((columns, 2), dtype=np.int64)
    for column, (start, stop) in enumerate(pairwise(edges)):
        interval = values[start:stop]
        picks[column] = start + interval.argmin(), start + interval.argmax()
    # In the order of time
    order = np.sort(picks, axis=1).ravel()
    return time[order], values[order]
