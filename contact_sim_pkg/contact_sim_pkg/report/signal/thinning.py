"""Rows that arrive in parts and never take more than a bounded memory: groups of 1, 2, 4, … rows
become one.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Reduction = Callable[..., Any]
"""`numpy.mean`, `numpy.min`, `numpy.max` or a mixture by column: what becomes of groups of rows,
[groups, rows of a group, values], called with `axis=1`.
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
        self._kept_rows = 0
        self._open: list[FloatArray] = []
        self._open_rows = 0

    def add(self, rows: FloatArray) -> None:
        """Add rows [rows, values], as wide as all before."""
        while len(rows):
            # At most up to the limit, where the groups double
            room = (self._limit - self._kept_rows) * self.group - self._open_rows
            part, rows = rows[:room], rows[room:]
            self._open.append(part)
            self._open_rows += len(part)
            if self._open_rows >= self.group:
                self._close_groups()

    def _close_groups(self) -> None:
        """Reduce the groups that are full, and double the groups where the limit is reached."""
        rows = np.concatenate(self._open)
        full, rest = divmod(self._open_rows, self.group)
        self._keep(rows[: full * self.group], self.group)
        self._open, self._open_rows = [rows[full * self.group :]] if rest else [], rest
        if self._kept_rows == self._limit:
            rows, self._kept, self._kept_rows = np.concatenate(self._kept), [], 0
            self.group *= 2
            self._keep(rows, 2)

    def _keep(self, rows: FloatArray, group: int) -> None:
        reduced = rows if group == 1 else self._reduce(rows.reshape(-1, group, rows.shape[1]), axis=1)
        self._kept.append(reduced)
        self._kept_rows += len(reduced)

    def widen(self, before: int, after: int) -> None:
        """Put zeros in front of and behind the values of every row added so far."""
        margins = (0, 0), (before, after)
        self._kept, self._open = ([np.pad(rows, margins) for rows in each] for each in (self._kept, self._open))

    def finish(self) -> FloatArray:
        """The table, [rows, values]; at least one row was read."""
        rest = [self._reduce(np.concatenate(self._open)[None], axis=1)] if self._open else []
        return np.concatenate([*self._kept, *rest])
