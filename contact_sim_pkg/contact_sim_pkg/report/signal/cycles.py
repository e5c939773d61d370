"""Cycles of a load by rainflow counting (ASTM E1049), by the library `rainflow`."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact_sim_pkg.bag.errors import BagError

__all__ = ["Cycles", "rainflow_cycles"]


class Cycles(NamedTuple):
    """Cycles of a signal, halves counted as halves."""

    ranges: NDArray[np.float64]
    """[cycles] in the unit of the signal"""
    means: NDArray[np.float64]
    counts: NDArray[np.float64]
    """[cycles] 1 or 0.5"""

    def equivalent(self, exponent: float, cycles: float) -> float:
        """Range that in so many ``cycles`` does the damage of all (Miner, Basquin's ``exponent`` m):
        (sum n_i r_i^m / N)^(1/m), in the unit of the signal.
        """
        return float((np.sum(self.counts * self.ranges**exponent) / cycles) ** (1.0 / exponent))


def rainflow_cycles(values: NDArray[np.float64]) -> Cycles:
    """Cycles of a signal [samples], in the order in which they close. Raises BagError without the library."""
    try:
        from rainflow import extract_cycles
    except ImportError:
        raise BagError(
            "cycles are counted by rainflow, which is not installed; pip install 'contact_sim_pkg[fatigue]'"
        ) from None
    rows = np.array([(span, mean, count) for span, mean, count, _start, _end in extract_cycles(values)])
    rows = rows.reshape(-1, 3)
    return Cycles(rows[:, 0], rows[:, 1], rows[:, 2])
