"""Rows that arrive one by one and never take more than a bounded memory: groups of 1, 2, 4, … rows
become one.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Reduction = Callable[..., Any]
"""`numpy.mean`, `numpy.min` or `numpy.max`: what becomes of a group of rows, called with
`axis=0`.
"""


class ThinnedRows:
    """A table that grows by rows and halves itself whenever it holds `limit` of them.

    Every kept row stands for `group` rows in a row, except for the last one, which may stand for
    fewer.
    """

    def __init__(self, limit: int, reduce: Reduction = np.mean) -> None:
        """Nothing read yet; `limit` is even and at least 2."""
        if limit < 2 or limit % 2:
            raise ValueError(f"thinned rows: limit = {limit}, allowed are even numbers from 2")
        self.group = 1
        self._limit, self._reduce = limit, reduce
        self._kept: list[FloatArray] = []
        self._open: list[FloatArray] = []

    def add(self, row: FloatArray) -> None:
        """Add a row, of the same length as all before."""
        self._open.append(np.asarray(row, dtype=np.float64))
        if len(self._open) < self.group:
            return
        self._kept.append(self._open[0] if self.group == 1 else self._reduce(self._open, axis=0))
        self._open = []
        if len(self._kept) == self._limit:
            pairs = zip(self._kept[::2], self._kept[1::2], strict=True)
            self._kept = [self._reduce(pair, axis=0) for pair in pairs]
            self.group *= 2

    def widen(self, before: int, after: int) -> None:
        """Put zeros in front of and behind the values of every row added so far."""
        self._kept, self._open = ([np.pad(row, (before, after)) for row in rows] for rows in (self._kept, self._open))

    def finish(self) -> FloatArray:
        """The table, [rows, values]; at least one row was read."""
        rest = [self._reduce(self._open, axis=0)] if self._open else []
        return np.array([*self._kept, *rest])
