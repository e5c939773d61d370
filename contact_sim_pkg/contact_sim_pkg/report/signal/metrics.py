"""Whole-body vibration metrics of sampled accelerations (ISO 2631-1, ISO 10326-1)."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact_sim_pkg.report.signal.spectrum import AT_REST, Density
from contact_sim_pkg.report.signal.weighting import WK, Weighting, apply_weighting, response


class RideMetrics(NamedTuple):
    """Metrics of one acceleration signal."""

    rms: float
    """[m/s^2] root mean square, not weighted, mean removed"""
    weighted_rms: float
    """[m/s^2] a_w = sqrt(1/T int a_w(t)^2 dt)"""
    vibration_dose: float
    """[m/s^1.75] VDV = (int a_w(t)^4 dt)^(1/4)"""
    crest_factor: float
    """max |a_w(t)| / a_w; nan for a signal at rest. Above 9 the basic method is doubtful."""


def ride_metrics(acceleration: NDArray[np.float64], sample_rate: float, weighting: Weighting = WK) -> RideMetrics:
    """Metrics of one acceleration signal over its whole length; its mean is removed first.

    Args:
        acceleration: [samples] in [m/s^2], at least one sample, gravity may be included.
        sample_rate: [Hz] > 0.
        weighting: frequency weighting; Wk for the vertical at seat and floor.
    """
    centred = acceleration - acceleration.mean()
    weighted = apply_weighting(weighting, centred, sample_rate)
    weighted_rms = root_mean_square(weighted)
    largest = float(np.abs(weighted).max())
    return RideMetrics(
        rms=root_mean_square(centred),
        weighted_rms=weighted_rms,
        vibration_dose=float((np.sum(weighted**4) / sample_rate) ** 0.25),
        crest_factor=largest / weighted_rms if weighted_rms >= AT_REST else math.nan,
    )


def weighted_rms(spectrum: Density, weighting: Weighting = WK) -> float:
    """Weighted rms a_w = sqrt(int |H(f)|^2 S(f) df) [m/s^2] of an acceleration by its power spectral
    density S [(m/s^2)^2/Hz], at least two frequencies: motion slower than a segment is left out.
    """
    power = np.abs(response(weighting, spectrum.frequency)) ** 2 * spectrum.density
    return float(np.sqrt(np.sum(power) * spectrum.frequency[1]))


def seat_factor(seat: float, floor: float) -> float:
    """SEAT = 100 seat / floor [%], from two weighted rms values or two VDVs (same unit); nan for a
    floor at rest."""
    return 100.0 * seat / floor if floor >= AT_REST else math.nan


def root_mean_square(values: NDArray[np.float64]) -> float:
    """sqrt(mean(values^2)) of values [samples] [m/s^2], in their unit."""
    return float(np.sqrt(np.mean(np.square(values))))
