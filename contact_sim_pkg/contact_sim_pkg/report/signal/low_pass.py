"""Peaks of a sampled signal, raw and through a low-pass filter that shifts nothing in time.

A contact on a sharp edge makes peaks of one or two milliseconds that say as much about the solver
as about the tire; the filtered peak is the one to compare between models.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

CUTOFF = 100.0
"""[Hz] at which a sine keeps 1/sqrt(2) of its amplitude, as CFC 60 of SAE J211-1"""
ORDER = 2
"""of the Butterworth filter, which runs forward and backward: order 4 in all, no phase"""


class Peak(NamedTuple):
    """The largest sample in the direction requested."""

    time: float
    """[s]"""
    value: float
    """unit of the signal"""


def low_pass(values: FloatArray, sample_rate: float, cutoff: float = CUTOFF) -> FloatArray | None:
    """Butterworth filter of order 2, forward and backward (zero phase); None where the rate is too
    low for the cutoff.

    Both passes together have the gain 1/(1 + (sqrt(2) - 1) (tan(pi f/fs)/tan(pi cutoff/fs))^4), which
    is applied in the frequency domain. The signal is continued at its ends by its odd reflection, and
    from there by the mirror image of it all, so that no end shows.

    Args:
        values: [samples], any unit.
        sample_rate: [Hz] > 0.
        cutoff: [Hz] > 0.
    """
    if not 2.0 * cutoff < sample_rate or values.size < 2:
        return None
    reach = min(values.size - 1, math.ceil(3.0 * sample_rate / cutoff))
    before, after = 2.0 * values[0] - values[reach:0:-1], 2.0 * values[-1] - values[-2 : -reach - 2 : -1]
    continued = np.concatenate([before, values, after])
    spectrum = np.fft.rfft(np.concatenate([continued, continued[::-1]]))
    # tan(pi f/fs) over that of the cutoff, which grows beyond all bounds towards half the rate
    angle = np.linspace(0.0, 0.5 * math.pi, spectrum.size)
    with np.errstate(over="ignore"):
        spectrum /= 1.0 + (math.sqrt(2.0) - 1.0) * (np.tan(angle) / math.tan(math.pi * cutoff / sample_rate)) ** 4
    filtered: FloatArray = np.fft.irfft(spectrum)[reach : reach + values.size]
    return filtered


def highest(time: FloatArray, values: FloatArray) -> Peak:
    """The first of the largest of values [samples], with its time [samples] in [s]."""
    place = int(values.argmax())
    return Peak(float(time[place]), float(values[place]))


def lowest(time: FloatArray, values: FloatArray) -> Peak:
    """The first of the smallest of values [samples], with its time [samples] in [s]."""
    place = int(values.argmin())
    return Peak(float(time[place]), float(values[place]))
