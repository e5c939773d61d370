"""Numerical error of metrics by what the run estimates of itself, block by block.

A largest value errs by the error of its kind. A mean or rms averages it out: the blocks err with signs that have
nothing to do with each other, so that n of them leave sqrt(sum e^2) / n. What no request makes smaller is the same
share of every sample, and so of the mean or rms itself.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from contact_sim_pkg.compare.estimated import accuracy_numbers
from contact_sim_pkg.records.definitions import RESOLVED
from contact_sim_pkg.report.series import FloatArray, Recording

__all__ = ["Errors", "errors_of", "not_resolved"]

FORCE = "force.normal"


class Errors(NamedTuple):
    """Estimated errors of a run."""

    numbers: Mapping[str, Any]
    """`accuracy_numbers`, which the last lines of the run are made from; empty without a scene"""
    blocks: Mapping[str, FloatArray]
    """[blocks] error by column, in its unit"""

    def largest(self, place: str, kind: str) -> float:
        """Error of a kind at a contact, or of the ``motion``, over its largest value; nan where none is known."""
        estimated = self.numbers.get("estimated", {}).get(place, {}).get(kind)
        return float(np.fmax(math.nan if estimated is None else estimated, self._least(place, kind)))

    def of_mean(self, place: str, kind: str, mean: float, largest: float) -> float:
        """Error of a ``mean`` or rms over the run, both in one unit, which the result has; ``largest``: the largest value
        that it is taken of. nan where nothing is known.
        """
        estimated = self.numbers.get("estimated", {}).get(place, {}).get(kind)
        own = f"{place}/{FORCE}"
        columns = [own] if own in self.blocks else [each for each in self.blocks if each.endswith(FORCE)]
        share = max((_averaged(self.blocks[each]) for each in columns), default=1.0)
        averaged = math.nan if estimated is None else share * estimated * largest
        return float(np.fmax(averaged, self._least(place, kind) * mean))

    def of_column_mean(self, column: str, values: FloatArray) -> float:
        """Error of the mean of a column of forces with these ``values`` [samples], in its unit; nan where none is known."""
        errors = self.blocks.get(column)
        averaged = math.nan if errors is None else _averaged(errors) * float(errors.max())
        return float(np.fmax(averaged, self._least(column.partition("/")[0], "force") * float(np.abs(values).mean())))

    def _least(self, place: str, kind: str) -> float:
        """Error over the largest value that no request makes smaller; nan where there is none."""
        least, _effect = self.numbers.get("not_below", {}).get(place, {}).get(kind, (math.nan, ""))
        return float(least)


def errors_of(recording: Recording) -> Errors:
    """Of a run; of a bag without a scene nothing is known."""
    return Errors(accuracy_numbers(recording), recording.block_errors)


def not_resolved(value: float, error: float) -> tuple[str, ...]:
    """That a small difference of large numbers errs by more than a tenth of itself; empty where it does not."""
    if not error > RESOLVED * abs(value):
        return ()
    return (f"not resolved: numerical error {error:.2g} of {value:.2g}",)


def _averaged(errors: FloatArray) -> float:
    """What random signs leave of the largest of ``errors`` [blocks] in their mean, 0 to 1."""
    largest = float(errors.max(initial=0.0))
    return math.sqrt(float(np.square(errors).sum())) / (errors.size * largest) if largest > 0.0 else 0.0
