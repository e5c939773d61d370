"""Test procedures of a machine as data: what is varied, what is held, the machine that measures, and the columns
and curves of its result. Imports no numbers.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import product
from typing import NamedTuple

from contact_sim_pkg.files import RefusedError

__all__ = ["Curve", "Map", "Procedure", "ProcedureError", "Quantity", "Rows", "Sheet"]

Rows = list[dict[str, float]]
"""Of one table: column -> value in SI, nan where there is none."""


class ProcedureError(RefusedError):
    """A procedure, a quantity or a value that a test does not take."""


class Quantity(NamedTuple):
    """A quantity of a test, in SI units; how a page shows it."""

    words: str
    unit: str  # SI, empty for a ratio
    shown: str = ""  # unit on the page; empty: the same
    factor: float = 1.0  # to that
    least: float = -1e12  # a value that is set must not be below
    most: float = 1e12  # nor above
    zero: str = ""  # words for 0, where that is no size

    @property
    def label(self) -> str:
        """On an axis: `load [kN]`."""
        unit = self.shown or self.unit
        return f"{self.words} [{unit}]" if unit else self.words


class Curve(NamedTuple):
    """Columns of a sheet as lines: one for each combination of what is varied, but ``along``."""

    across: str
    up: str
    along: str = ""  # varied quantity along a line; empty: that across


class Map(NamedTuple):
    """A column over the plane of two others, a picture for each combination of what is varied."""

    across: str
    up: str
    value: str


class Sheet(NamedTuple):
    """A table of a procedure: the varied quantities and these columns."""

    name: str  # ending of its file; empty: the procedure's own
    columns: tuple[str, ...]
    curves: tuple[Curve | Map, ...]


class Procedure(NamedTuple):
    """One standard test.

    ``machine`` and ``formula`` name functions (`module:name`) of a tire and the conditions of a case, a value for
    each quantity that is varied or held; they return rows by the name of the sheet.
    """

    name: str
    title: str
    machine: str
    formula: str  # the same of a property file; empty: it has none
    varied: Mapping[str, tuple[float, ...]]  # quantity -> values, in SI
    held: Mapping[str, float]
    sheets: tuple[Sheet, ...]
    source: str  # standard or publication

    def conditions(self) -> Iterator[dict[str, float]]:
        """Of each case; the last varied quantity runs fastest."""
        for values in product(*self.varied.values()):
            yield {**self.held, **dict(zip(self.varied, values, strict=True))}

    def at(self, quantity: str, values: tuple[float, ...]) -> Procedure:
        """The procedure with a quantity that it knows at other values: varied where they are several."""
        if quantity not in {*self.varied, *self.held}:
            return self
        held = {name: value for name, value in self.held.items() if name != quantity}
        if quantity in self.varied or len(values) > 1:
            return self._replace(varied={**self.varied, quantity: values}, held=held)
        return self._replace(held={**held, quantity: values[0]})
