"""Peaks of a sampled signal, raw and through a low-pass filter that shifts nothing in time.

A contact on a sharp edge makes peaks of one or two milliseconds that say as much about the solver
as about the tire; the filtered peak is the one to compare between models.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import scipy.signal
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

    One pass has the gain g with g^2 = 1/(1 + (tan(pi f/fs)/tan(pi f0/fs))^4); f0 is chosen so that
    the two passes have the gain 1/sqrt(2) at the cutoff: `tan(pi f0/fs) = tan(pi cutoff/fs) /
    (sqrt(2) - 1)^(1/4)`. The signal is continued at its ends by its odd reflection.

    Args:
        values: [samples], any unit.
        sample_rate: [Hz] > 0.
        cutoff: [Hz] > 0.
    """
    if not 2.0 * cutoff < sample_rate or values.size < 2:
        return None
    # Corner of one pass, so that both together have -3 dB at the cutoff
    widened = math.tan(math.pi * cutoff / sample_rate) / (math.sqrt(2.0) - 1.0) ** 0.25
    corner = math.atan(widened) / math.pi * sample_rate
    sections = scipy.signal.butter(ORDER, corner, fs=sample_rate, output="sos")
    reach = min(values.size - 1, math.ceil(3.0 * sample_rate / cutoff))
    filtered: FloatArray = scipy.signal.sosfiltfilt(sections, values, padtype="odd", padlen=reach)
    return filtered


def highest(time: FloatArray, values: FloatArray) -> Peak:
    """The first of the largest of values [samples], with its time [samples] in [s]."""
    place = int(values.argmax())
    return Peak(float(time[place]), float(values[place]))


def lowest(time: FloatArray, values: FloatArray) -> Peak:
    """The first of the smallest of values [samples], with its time [samples] in [s]."""
    place = int(values.argmin())
    return Peak(float(time[place]), float(values[place]))
