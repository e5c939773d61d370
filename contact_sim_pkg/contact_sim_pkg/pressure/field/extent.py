"""Length of a contact on a grid, its edges between cells."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["extent"]

Field = NDArray[np.float64]


def extent(pressure: Any) -> float:
    """Length of a contact along the first axis of its ``pressure`` [rows, cols], in cells; 0 without load.

    Along each line the edge lies where the square of the pressure comes to 0, as `pressure.field.patch.beyond` has it;
    the extent runs from the first of these edges to the last.
    """
    squares = np.square(np.asarray(pressure, dtype=np.float64))
    squares = squares[:, (squares > 0.0).any(axis=0)]
    if not squares.size:
        return 0.0
    loaded = squares > 0.0
    first, last = loaded.argmax(axis=0), squares.shape[0] - 1 - loaded[::-1].argmax(axis=0)
    ends, starts = last + 0.5 + _beyond(squares, last, -1), first - 0.5 - _beyond(squares, first, 1)
    return float(ends.max() - starts.min())


def _beyond(squares: Field, edge: Any, inwards: int) -> Field:
    """Reach of each line beyond its outermost cell, -1/2 to 1/2 of a cell; 0 at the edge of the grid, and where the
    pressure does not fall outwards.
    """
    rows, lines = squares.shape[0], np.arange(squares.shape[1])
    within = (edge > 0) & (edge < rows - 1)
    own, inner = squares[edge, lines], squares[np.clip(edge + inwards, 0, rows - 1), lines]
    falls = within & (inner > own)
    return np.where(falls, np.minimum(own / np.where(falls, inner - own, 1.0), 1.0) - 0.5, 0.0)
