"""What a sensor makes of a series of a run: a key of a fit beside those of the scene."""

from __future__ import annotations

from collections.abc import Sequence

import numpy
from numpy.typing import NDArray
from scipy import signal

from contact_sim_pkg.sweep.measured import Measured, Series
from contact_sim_pkg.sweep.variation import SweepError, Values

__all__ = ["FILTER", "check_sensor", "is_of_sensor", "low_passed"]

Field = NDArray[numpy.float64]
FILTER = "sensor.low_pass"
"""[Hz] at which a sine keeps 1/sqrt(2) of its amplitude, of a Butterworth filter of order `ORDER`"""
ORDER = 2
MOST = 0.45
"""Of the rate of a run, that the frequency of a filter may be."""


def is_of_sensor(key: str) -> bool:
    """Whether a key is of the sensor, not of the scene."""
    return key.startswith("sensor.")


def check_sensor(keys: Sequence[str], fixed: Values, to: Measured) -> None:
    """Refuse keys of a sensor that there are not, or that what was measured has nothing of. Raises SweepError."""
    for key in filter(is_of_sensor, [*keys, *fixed]):
        if key != FILTER:
            raise SweepError(f"{key}: a sensor has only {FILTER}, in Hz")
        if not isinstance(to, Series):
            raise SweepError(f"{key}: acts on a recording over time; leave it out, or give --series TOPIC.COLUMN")
    if FILTER in fixed:
        try:
            known = float(fixed[FILTER]) > 0.0
        except ValueError:
            known = False
        if not known:
            raise SweepError(f"--set {FILTER}={fixed[FILTER]}: is no frequency above 0, in Hz")


def low_passed(given: Field, frequency: float) -> Field:
    """Times and values [2, samples] of a run behind a low pass of order 2 that is at rest at the first value.

    ``1 / (1 + sqrt(2) s + s^2)``, ``s = i f / frequency``, by the bilinear transform that meets it at ``frequency`` [Hz] > 0.

    Raises SweepError: the run has too few samples for that frequency, or not at one rate.
    """
    rate = (given.shape[1] - 1) / float(given[0, -1] - given[0, 0])
    if abs(numpy.diff(given[0]) * rate - 1.0).max() > 0.01:
        raise SweepError(f"{FILTER} needs a series at one rate; leave it out")
    if not 0.0 < frequency <= MOST * rate:
        raise SweepError(
            f"{FILTER} {frequency:.4g} Hz: a run of {rate:.4g} samples a second shows one of {MOST * rate:.4g} Hz at most; "
            "narrow its range, or set a higher rate of the outputs"
        )
    above, below = signal.butter(ORDER, frequency, fs=rate)
    at_rest = signal.lfilter_zi(above, below) * given[1, 0]
    return numpy.array([given[0], signal.lfilter(above, below, given[1], zi=at_rest)[0]])
