"""Third-octave bands of a signal (IEC 61260-1, base ten)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["NOMINAL", "third_octaves"]

NOMINAL = (
    0.5, 0.63, 0.8, 1.0, 1.25, 1.6, 2.0, 2.5, 3.15, 4.0, 5.0, 6.3, 8.0, 10.0, 12.5, 16.0, 20.0, 25.0, 31.5, 40.0, 50.0, 63.0,
    80.0, 100.0,
)  # fmt: skip
"""[Hz] names of the bands; their centres are 10^(n/10)"""
LOWEST = -3
"""n of the first one"""


def third_octaves(values: NDArray[np.float64], sample_rate: float) -> NDArray[np.float64]:
    """Root mean square [bands] of a signal in each band of `NOMINAL`, in its unit; nan for a band that ends above half
    the rate, or is narrower than the lines of the record, 1/T apart.

    The band n goes from 10^((n - 1/2)/10) to 10^((n + 1/2)/10) Hz; a line on its edge counts by its part inside.

    Args:
        values: [unit] one dimension, at least 2 samples; its mean is removed.
        sample_rate: [Hz] > 0.
    """
    count = values.size
    spacing = sample_rate / count
    power = 2.0 * np.abs(np.fft.rfft(values - values.mean())) ** 2 / count**2
    if count % 2 == 0:  # half the rate stands for itself alone
        power[-1] *= 0.5
    lines = np.arange(power.size) * spacing
    # power up to a frequency: each line fills its spacing evenly
    edges, filled = np.append(lines - 0.5 * spacing, lines[-1] + 0.5 * spacing), np.append(0.0, np.cumsum(power))
    order = np.arange(len(NOMINAL)) + LOWEST
    low, high = 10.0 ** ((order - 0.5) / 10.0), 10.0 ** ((order + 0.5) / 10.0)
    inside = np.interp(high, edges, filled) - np.interp(low, edges, filled)
    known = (high <= 0.5 * sample_rate) & (high - low >= spacing)
    found: NDArray[np.float64] = np.where(known, np.sqrt(np.maximum(inside, 0.0)), np.nan)
    return found
