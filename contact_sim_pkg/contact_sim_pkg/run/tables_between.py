"""Tables of a cushion over one key of its foam, from a few of them: a fit over the key makes no table of its own for each run
(0.7 CPU s, as much as 20 s of a ride).

The few are at Chebyshev's points of the key's logarithm, the table between them is the polynomial through all (`between`). Of
the forces it misses 1e-5 at most over the plateau, modulus, hardness, densification of a seat, over ranges of a factor of 2 to
10; a table is right to 4e-4.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import NamedTuple, Protocol

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.guards import require
from contact_sim_pkg.pressure.cushion.force_table import ForceTable, between
from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.schema.laws import CushionSection

__all__ = ["STRESSES", "KeyRange", "table_between", "tables_between"]

Field = NDArray[numpy.float64]
STRESSES = ("plateau", "modulus", "densification", "hardness")
"""Keys of a cushion that move the forces at its approaches and neither these nor its cells."""
FEWEST, MORE = 3, 2.4
"""Points of a key's range, and to those a factor of e."""
MOST_KEPT = 4
"""Lists of tables in a process."""


class Make(Protocol):
    """The table of a cushion, kept or computed."""

    def __call__(self, keys: CushionSection, *, is_alone: bool) -> ForceTable:
        """That of a run alone has maps."""


class KeyRange(NamedTuple):
    """A key of the cushion of a contact, and its range."""

    contact: str
    key: str
    low: float
    """> 0"""
    high: float
    is_own: bool = False
    """whether a run has its own table all the same, without maps"""

    @property
    def points(self) -> Field:
        """Values of the key with a table, increasing: Chebyshev's points of the logarithm."""
        factor = require("high", self.high, least=self.low) / require("low", self.low, least=1e-12)
        count = FEWEST + math.ceil(MORE * math.log(factor))
        around = -numpy.cos(math.pi * (numpy.arange(count) + 0.5) / count)
        return numpy.asarray(self.low * factor ** (0.5 * (1.0 + around)))


_over: ContextVar[KeyRange | None] = ContextVar("tables_between", default=None)
_known: dict[tuple[KeyRange, str], list[ForceTable]] = {}


@contextmanager
def tables_between(over: KeyRange | None) -> Iterator[None]:
    """While the block of code lasts, cushions of the contact are taken from tables ``over`` the range; None: from their own."""
    token = _over.set(over)
    try:
        yield
    finally:
        _over.reset(token)


def table_between(contact: str, keys: CushionSection, others: str, make: Make) -> ForceTable:
    """The table of a cushion: that which ``make`` gives, or inside `tables_between` one between those over the range.

    ``others``: what a table follows from beside its keys. Errors as those of ``make``.
    """
    over = _over.get()
    value = None if over is None or over.contact != contact else getattr(keys, over.key)
    if over is None or value is None or not over.low <= value <= over.high:
        return make(keys, is_alone=True)
    points = over.points
    if over.is_own:
        return make(keys, is_alone=False)
    name = over, f"{keys.model_copy(update={over.key: over.low})!r} {others}"
    if name not in _known:
        try:
            found = [make(keys.model_copy(update={over.key: float(each)}), is_alone=False) for each in points]
        except SceneError:  # an end of the range that no table reaches
            return make(keys, is_alone=True)
        while len(_known) >= MOST_KEPT:
            del _known[next(iter(_known))]
        _known[name] = found
    return between(numpy.log(points), _known[name], math.log(value))
