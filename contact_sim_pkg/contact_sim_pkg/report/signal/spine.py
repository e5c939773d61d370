"""Repeated shocks to the spine: ISO 2631-5:2018, vertical, 82 kg male.

H(s) = (1 + 2 * 0.35 s/34 + (s/34)^2) / prod_i (1 + 2 zeta_i s/omega_i + (s/omega_i)^2) from seat to spine; dose
D = 1.07 (sum A_i^6)^(1/6) over the peaks A_i of its response; stress S_d = m D_d of the daily dose D_d; risk
R = (sum_years (S_d N^(1/6) / (S_u - m g))^6)^(1/6) with S_u = 6.75 - 0.052 age [MPa].
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact_sim_pkg.report.signal.metrics import EXPOSURE_TIME
from contact_sim_pkg.report.signal.weighting import PADDING_TIME, filtered

ZERO = (34.0, 0.35)
POLES = ((31.0, 0.21), (230.0, 0.88), (260.0, 0.80), (320.0, 0.40), (380.0, 0.75), (420.0, 0.65))
"""omega [rad/s], zeta"""
DOSE_FACTOR = 1.07
STRESS_FACTOR = 0.029
"""[MPa/(m/s^2)] of a male of 82 kg"""
STANDARD_GRAVITY = 9.81
STRENGTH_AT_BIRTH, STRENGTH_LOSS = 6.75, 0.052
"""[MPa] and [MPa/year]"""


class Career(NamedTuple):
    """Years of exposure."""

    first_age: int = 20
    years: int = 45
    days: int = 240
    """a year"""


WORKING_LIFE = Career()


def spine_response(frequency: NDArray[np.float64]) -> NDArray[np.complex128]:
    """H(j 2 pi f) [frequencies] at ``frequency`` [Hz]; 1 at 0 Hz."""
    s = (2j * np.pi * np.asarray(frequency, dtype=np.float64)).astype(np.complex128)
    result: NDArray[np.complex128] = _second_order(s, *ZERO)
    for pole in POLES:
        result = result / _second_order(s, *pole)
    return result


def _second_order(s: NDArray[np.complex128], omega: float, zeta: float) -> NDArray[np.complex128]:
    return 1.0 + 2.0 * zeta * s / omega + (s / omega) ** 2


def spine_acceleration(acceleration: NDArray[np.float64], sample_rate: float) -> NDArray[np.float64]:
    """Acceleration of the spine [samples] in [m/s^2] of that of the seat [samples] in [m/s^2], whose
    mean is removed; 0 outside the record. sample_rate: [Hz] > 0. MemoryLimitError as of `filtered`."""
    return filtered(acceleration - acceleration.mean(), sample_rate, PADDING_TIME, spine_response)


def dose(spine: NDArray[np.float64]) -> float:
    """D [m/s^2] of the acceleration of the spine [samples] in [m/s^2]: its largest value between two
    crossings of zero, upward and downward, is a peak."""
    up = spine > 0.0
    starts = np.flatnonzero(up & ~np.concatenate([[False], up[:-1]]))
    if starts.size == 0:
        return 0.0
    peaks = np.maximum.reduceat(np.where(up, spine, 0.0), starts)
    return DOSE_FACTOR * float(np.sum(peaks**6) ** (1.0 / 6.0))


def daily(dose_of_run: float, duration: float) -> float:
    """D_d [m/s^2] of eight hours of what has a dose [m/s^2] in ``duration`` [s]."""
    return float(dose_of_run * (EXPOSURE_TIME / duration) ** (1.0 / 6.0))


def stress(daily_dose: float) -> float:
    """S_d [MPa] of a daily dose [m/s^2]."""
    return STRESS_FACTOR * daily_dose


def risk(daily_stress: float, career: Career = WORKING_LIFE) -> float:
    """R of a daily stress [MPa] over the years of a career."""
    ages = career.first_age + np.arange(career.years)
    strength = STRENGTH_AT_BIRTH - STRENGTH_LOSS * ages - STRESS_FACTOR * STANDARD_GRAVITY
    return float(np.sum((daily_stress * career.days ** (1.0 / 6.0) / strength) ** 6) ** (1.0 / 6.0))
