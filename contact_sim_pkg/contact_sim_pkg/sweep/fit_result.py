"""What a fit found: keys between what they are, and what was measured beside the fitted scene."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.sweep.variation import Values

__all__ = ["LEAST_PROBABILITY", "Compared", "Fit", "Fitted"]

Field = NDArray[numpy.float64]
LEAST_PROBABILITY = 1e-3
"""Of a whitened residual that is noise: below it the scene does not follow the recording."""


class Fitted(NamedTuple):
    """A key, what it is, and between what."""

    key: str
    value: float
    low: float
    high: float
    """of the 90 % interval; nan where it is not identifiable"""
    remark: str
    """at a bound, or not identifiable; empty else"""


class Compared(NamedTuple):
    """What was measured beside what the fitted scene gives."""

    name: str
    """with its unit"""
    across: Field
    """time [s], frequency [Hz], or number of the case"""
    measured: Field
    fitted: Field
    axis: str
    """what ``across`` is"""


class Fit(NamedTuple):
    """Result of a fit."""

    parameters: list[Fitted]
    misfit: float
    """standard deviation of the residual, in the unit of what was measured, or of its scatter where that is known"""
    unit: str
    probability: float
    """of so large or so coloured a residual if the scene is right; nan where nothing says it"""
    shift: float
    """[s] by which the recording is late; 0 for points"""
    cases: int
    """runs, those that had run before included"""
    values: Values
    """of the fitted scene"""
    compared: list[Compared]
    """a metric each, a series or its spectrum"""
    coarse: float = 0.0
    """accuracy that the runs request, where what is left of a series may be their own error; 0 where it is more"""

    accuracy: float = math.nan
    """that the runs request"""
    recorded: float = 0.0
    """accuracy that the run of the recording requested, whose own error the intervals hold; 0: of no run of the bench"""
    others: Sequence[Sequence[float]] = ()
    """values of the keys at other minima that chance lets be as good"""

    @property
    def follows(self) -> bool:
        """Whether the scene can follow what was measured, as far as its runs are accurate enough to say it."""
        return not self.probability < LEAST_PROBABILITY or self.coarse > 0.0

    @property
    def is_identified(self) -> bool:
        """Whether each key has an interval, and there is no other minimum that is as good."""
        return all(math.isfinite(each.low) for each in self.parameters) and not self.others
