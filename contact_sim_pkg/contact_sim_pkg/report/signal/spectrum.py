"""Power spectral density and transmissibility by Welch's method (scipy)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import scipy.signal
from numpy.typing import NDArray

SEGMENT_TIME = 4.0
"""[s] a segment of a long record: 0.25 Hz resolution, fine for a seat's resonance at 4 Hz (1 Hz
wide or more).
"""
LEAST_SEGMENTS = 8
"""Segments (half overlapping) that a shorter record is cut into; the coherence of one segment would
always be 1.
"""


class Density(NamedTuple):
    """One-sided power spectral density."""

    frequency: NDArray[np.float64]
    """[Hz] from 0"""
    density: NDArray[np.float64]
    """[unit^2/Hz]; its integral over frequency is the variance of the signal"""
    segments: int
    """number of segments averaged"""


class Transmissibility(NamedTuple):
    """Estimate H1 = S_xy / S_xx of the response of y to x."""

    frequency: NDArray[np.float64]
    """[Hz] from 0"""
    magnitude: NDArray[np.float64]
    phase: NDArray[np.float64]
    """[rad] in -pi .. pi; negative where y lags x"""
    coherence: NDArray[np.float64]
    """0 .. 1; share of y's power that follows x linearly"""
    segments: int
    """number of segments averaged"""


def segment_samples(samples: int, sample_rate: float) -> int:
    """Samples a segment: 4 s, or less so that a short record still gives 8 half-overlapping
    segments; sample_rate: [Hz]."""
    wanted = round(SEGMENT_TIME * sample_rate)
    affordable = 2 * samples // (LEAST_SEGMENTS + 1)
    return max(1, min(wanted, affordable))


def power_density(values: NDArray[np.float64], sample_rate: float) -> Density:
    """One-sided power spectral density: Hann window, half overlap, mean of each segment removed.

    Args:
        values: [unit] one dimension, at least 2 samples.
        sample_rate: [Hz] > 0.
    """
    length = segment_samples(values.size, sample_rate)
    frequency, density = scipy.signal.welch(values, sample_rate, nperseg=length)
    return Density(frequency, density, _count_segments(values.size, length))


def transmissibility(source: NDArray[np.float64], target: NDArray[np.float64], sample_rate: float) -> Transmissibility:
    """Magnitude, phase and coherence of `target` over `source`, both sampled at the same instants.

    Frequencies at which the source has no power have magnitude, phase and coherence nan.

    Args:
        source: [unit] one dimension, at least 2 samples.
        target: [unit] same shape.
        sample_rate: [Hz] > 0.
    """
    length = segment_samples(source.size, sample_rate)
    frequency, power_source = scipy.signal.welch(source, sample_rate, nperseg=length)
    _, power_target = scipy.signal.welch(target, sample_rate, nperseg=length)
    _, cross = scipy.signal.csd(source, target, sample_rate, nperseg=length)
    with np.errstate(divide="ignore", invalid="ignore"):
        # H1 estimate: noise of the target averages out
        ratio = cross / power_source
        coherence = np.abs(cross) ** 2 / (power_source * power_target)
    defined = power_source > 0.0
    return Transmissibility(
        frequency,
        np.where(defined, np.abs(ratio), np.nan),
        np.where(defined, np.angle(ratio), np.nan),
        np.where(defined, coherence, np.nan),
        _count_segments(source.size, length),
    )


def _count_segments(samples: int, length: int) -> int:
    step = length - length // 2
    return (samples - length) // step + 1
