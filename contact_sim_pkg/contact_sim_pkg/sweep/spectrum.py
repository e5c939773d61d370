"""The spectrum of a series as what a fit compares, where two runs go apart in time and agree in their densities."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray
from scipy import signal

from contact_sim_pkg.sweep.variation import SweepError

__all__ = ["LogDensity", "log_density", "loud"]

Field = NDArray[numpy.float64]

SEGMENTS = 16
"""Of half their length over each other, that a series is cut into."""
FEWEST_LINES = 8
OVERLAP = 1.0 + 2.0 / 36.0
"""Times by which the variance of a mean over Hann windows that lie half over each other is that over separate ones."""
APART = 2
"""Lines of a Hann window that are independent: the correlation of every second one is 1/36 squared."""
FAINT = 1e-3
"""Of the largest density: lines below it are noise of the sensor as likely as of the machine."""
UNEVEN = 0.01
"""Of a sampling interval, that two may differ by."""


class LogDensity(NamedTuple):
    """Logarithm of a power spectral density."""

    frequency: Field
    """[Hz]"""
    values: Field
    """ln of the density in units²/Hz"""
    scatter: float
    """standard deviation of a line, by chance"""


def log_density(time: Field, values: Field) -> LogDensity:
    """Independent lines of Welch's estimate with Hann windows (IEEE Trans. Audio Electroacoust. 15 (1967) 70).

    ``ln S`` scatters by ``1 / sqrt(n)``, n the number of separate windows that the overlapping ones are worth.

    Args:
        time: [s], evenly spaced.
        values: as long.

    Raises:
        SweepError: the time is not even, or too short.
    """
    steps = numpy.diff(time)
    step = float(numpy.median(steps))
    if numpy.abs(steps - step).max() > UNEVEN * step:
        raise SweepError(
            f"a spectrum needs samples at one rate; these are {steps.min():.4g} to {steps.max():.4g} s apart"
        )
    length = 2 * values.size // (SEGMENTS + 1)
    if length < 2 * APART * FEWEST_LINES:
        raise SweepError(f"{values.size} samples are too few for a spectrum of {SEGMENTS} segments; record more")
    frequency, density = signal.welch(values, 1.0 / step, nperseg=length, detrend="constant")
    lines = slice(APART, -1, APART)  # neither the mean nor the highest frequency
    with numpy.errstate(divide="ignore"):
        return LogDensity(frequency[lines], numpy.log(density[lines]), math.sqrt(OVERLAP / SEGMENTS))


def loud(density: LogDensity) -> NDArray[numpy.bool_]:
    """Lines that are compared."""
    return numpy.asarray(density.values > density.values.max() + math.log(FAINT))
