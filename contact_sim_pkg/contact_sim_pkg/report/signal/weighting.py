"""Frequency weightings for whole-body vibration: ISO 2631-1:1997, in the form of ISO 8041-1.

H(s) = Hh Hl Ht Hs with s = j 2 pi f and omega_i = 2 pi f_i:

* high-pass   Hh = s^2 / (s^2 + sqrt(2) omega_1 s + omega_1^2)
* low-pass    Hl = omega_2^2 / (s^2 + sqrt(2) omega_2 s + omega_2^2)
* transition  Ht = (1 + s/omega_3) / (1 + s/(Q4 omega_4) + (s/omega_4)^2)
* step        Hs = (f5/f6)^2 (1 + s/(Q5 omega_5) + (s/omega_5)^2) / (1 + s/(Q6 omega_6) +
(s/omega_6)^2)

Ht has the numerator 1 where f3 is infinite, and is 1 where f4 is too; K is 1 but for Wb.

The weighting of a recorded signal is done in the frequency domain with this exact complex response.
A digital filter would be up to 6 % low at 80 Hz for data sampled at 476 Hz.
"""

from __future__ import annotations

from collections.abc import Callable
from math import inf
from typing import NamedTuple

import numpy as np
import scipy  # its parts are imported on use: they take 0.1 to 0.3 s
from numpy.typing import NDArray

from contact_sim_pkg.memory import refuse_above_limit

BYTES_PER_SAMPLE = 40
"""of a signal that is filtered: padded, its spectrum and frequencies, the result"""
FREQUENCIES_AT_ONCE = 1 << 18

PADDING_TIME = 10.0
"""[s] of zeros behind a signal: the response of the 0.4 Hz high-pass has died out to e^-17 by
then.
"""

PADDED_CORNER = 0.4
"""[Hz] of a high-pass that `PADDING_TIME` is for; a lower one dies out more slowly"""


class UpwardStep(NamedTuple):
    """Parameters of the upward step Hs."""

    frequency_5: float
    """[Hz]"""
    quality_5: float
    frequency_6: float
    """[Hz]"""
    quality_6: float


class Weighting(NamedTuple):
    """Parameters of one frequency weighting."""

    name: str
    high_pass: float
    """[Hz] f1"""
    low_pass: float
    """[Hz] f2"""
    transition_zero: float
    """[Hz] f3; infinite: numerator 1"""
    transition_pole: float
    """[Hz] f4; infinite: no transition"""
    transition_quality: float
    """Q4"""
    step: UpwardStep | None
    """None: the weighting has no upward step."""
    gain: float = 1.0
    """K"""
    use: str = ""


WK = Weighting("Wk", 0.4, 100.0, 12.5, 12.5, 0.63, UpwardStep(2.37, 0.91, 3.35, 0.91), use="seat z, feet")
"""Vertical at the seat surface and at the platform."""
WD = Weighting("Wd", 0.4, 100.0, 2.0, 2.0, 0.63, None, use="seat x and y, backrest y and z")
"""Horizontal at the seat surface."""
WEIGHTINGS = {
    each.name: each
    for each in (
        WK, WD,
        Weighting("Wc", 0.4, 100.0, 8.0, 8.0, 0.63, None, use="backrest x"),
        Weighting("We", 0.4, 100.0, 1.0, 1.0, 0.63, None, use="rotations of the seat, rad/s²"),
        Weighting("Wj", 0.4, 100.0, inf, inf, 1.0, UpwardStep(3.75, 0.91, 5.32, 0.91), use="head, recumbent"),
        Weighting("Wf", 0.08, 0.63, inf, 0.25, 0.86, UpwardStep(0.0625, 0.80, 0.1, 0.80), use="motion sickness, z"),
        Weighting("Wb", 0.4, 100.0, 16.0, 16.0, 0.55, UpwardStep(2.5, 0.9, 4.0, 0.95), 1.024, "rail, BS 6841"),
    )
}  # fmt: skip
"""By name. Source: ISO 8041-1 as in the Larson Davis HVM200 reference manual."""


def response(weighting: Weighting, frequency: NDArray[np.float64]) -> NDArray[np.complex128]:
    """Exact complex response H(j 2 pi f) of a weighting, 0 at f = 0.

    Args:
        weighting: parameters.
        frequency: [Hz] >= 0, [frequencies] or any shape, which is that of the result.
    """
    s = (2j * np.pi * np.asarray(frequency, dtype=np.float64)).astype(np.complex128)
    omega_1, omega_2, omega_3, omega_4 = (2.0 * np.pi * corner for corner in weighting[1:5])
    high = s**2 / (s**2 + np.sqrt(2.0) * omega_1 * s + omega_1**2)
    low = omega_2**2 / (s**2 + np.sqrt(2.0) * omega_2 * s + omega_2**2)
    transition = (1.0 + s / omega_3) / _second_order(s, omega_4, weighting.transition_quality)
    total: NDArray[np.complex128] = weighting.gain * high * low * transition * _step_response(weighting.step, s)
    return total


def apply_weighting(weighting: Weighting, acceleration: NDArray[np.float64], sample_rate: float) -> NDArray[np.float64]:
    """Weighted acceleration [m/s^2], same shape as the input.

    The signal is taken as 0 outside the record and padded with zeros, so that its end does not leak
    into its start. The mean stays in: take it out first where it is an offset of the sensor.

    Args:
        weighting: parameters.
        acceleration: [samples] in [m/s^2], gravity not included.
        sample_rate: [Hz] > 0.

    Raises:
        ValueError: the rate is not a positive number, or the signal has no or more than one
            dimension.
        MemoryLimitError: the signal and the zeros behind it are too many.
    """
    if not (np.isfinite(sample_rate) and sample_rate > 0.0):
        raise ValueError(f"sample_rate is {sample_rate} Hz; a signal can only be weighted at a known rate above 0")
    if acceleration.ndim != 1:
        raise ValueError(f"acceleration has {acceleration.ndim} dimensions; give one signal at a time")
    # Padded by the decay of the filter
    padding = PADDING_TIME * max(1.0, PADDED_CORNER / weighting.high_pass)
    return filtered(acceleration, sample_rate, padding, lambda frequency: response(weighting, frequency))


def filtered(
    signal: NDArray[np.float64],
    sample_rate: float,
    padding: float,
    of: Callable[[NDArray[np.float64]], NDArray[np.complex128]],
) -> NDArray[np.float64]:
    """Signal [samples] times a response in the frequency domain, in the signal's unit.

    Args:
        signal: [samples], taken as 0 outside.
        sample_rate: [Hz] > 0.
        padding: [s] of zeros behind the signal.
        of: response [frequencies] at frequencies [Hz].

    Raises:
        MemoryLimitError: the signal and the zeros behind it are too many.
    """
    samples = signal.size + padding * sample_rate
    refuse_above_limit(
        samples * BYTES_PER_SAMPLE,
        f"weighting {signal.size} samples at {sample_rate:.6g} Hz with {padding:g} s of zeros (are the stamps right?)",
    )
    # To a size that transforms fast; by parts, since a response needs many arrays of its size
    length = scipy.fft.next_fast_len(signal.size + round(padding * sample_rate), real=True)
    spectrum = scipy.fft.rfft(signal, length)
    frequency = scipy.fft.rfftfreq(length, 1.0 / sample_rate)
    for start in range(0, frequency.size, FREQUENCIES_AT_ONCE):
        part = slice(start, start + FREQUENCIES_AT_ONCE)
        spectrum[part] *= of(frequency[part])
    found: NDArray[np.float64] = scipy.fft.irfft(spectrum, length)[: signal.size]
    return found


def _second_order(s: NDArray[np.complex128], omega: float, quality: float) -> NDArray[np.complex128]:
    return 1.0 + s / (quality * omega) + (s / omega) ** 2


def _step_response(step: UpwardStep | None, s: NDArray[np.complex128]) -> NDArray[np.complex128] | float:
    if step is None:
        return 1.0
    omega_5, omega_6 = 2.0 * np.pi * step.frequency_5, 2.0 * np.pi * step.frequency_6
    numerator = _second_order(s, omega_5, step.quality_5)
    return (omega_5 / omega_6) ** 2 * numerator / _second_order(s, omega_6, step.quality_6)
