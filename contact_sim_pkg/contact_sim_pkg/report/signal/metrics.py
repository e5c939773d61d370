"""Whole-body vibration metrics of sampled accelerations (ISO 2631-1, ISO 10326-1)."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact_sim_pkg.report.signal.spectrum import AT_REST, Density
from contact_sim_pkg.report.signal.weighting import WK, Weighting, apply_weighting, response

RUNNING_TIME = 1.0
"""[s] integration time of the running rms (ISO 2631-1, 6.3.1)"""
EXPOSURE_TIME = 8.0 * 3600.0
"""[s] of the daily exposure A(8) and of the daily dose"""
HORIZONTAL_FACTOR = 1.4
"""of x and y at the seat, for health (Directive 2002/44/EC); 1 of z"""


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
    largest_running_rms: float
    """[m/s^2] MTVV, the largest running rms; linear window of 1 s"""
    weighted: NDArray[np.float64]
    """[samples] in [m/s^2], a_w(t)"""


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
        largest_running_rms=float(running_rms(weighted, sample_rate).max()),
        weighted=weighted,
    )


def running_rms(weighted: NDArray[np.float64], sample_rate: float) -> NDArray[np.float64]:
    """Running rms sqrt(1/tau int_(t-tau)^t a_w^2 dt) [samples] in the unit of ``weighted`` [samples],
    tau = 1 s; the signal counts as 0 before its start. Source: ISO 2631-1, 6.3.1.
    """
    window = max(1, round(RUNNING_TIME * sample_rate))
    sums = np.concatenate([np.zeros(window), np.cumsum(np.square(weighted))])
    found: NDArray[np.float64] = np.sqrt(np.maximum(sums[window:] - sums[:-window], 0.0) / window)
    return found


def daily_dose(dose: float, duration: float) -> float:
    """VDV [m/s^1.75] of eight hours of what has the ``dose`` [m/s^1.75] in ``duration`` [s]."""
    return float(dose * (EXPOSURE_TIME / duration) ** 0.25)


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
