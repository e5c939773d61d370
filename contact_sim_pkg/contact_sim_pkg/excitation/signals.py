"""Vibration given by formulas: rest, sine, sweep, band-limited noise, half-sine shock, and their
sum on the two axes.

A waveform is a pure function of time, values(t), in [m/s^2]; `AxisSignal` puts waveforms on the
axes x (forward) and z (up).
"""

from collections.abc import Sequence
from math import ceil, floor, isfinite, log, pi, sqrt
from typing import Any, Protocol

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.periodic import synthesise

LARGEST_ACCELERATION = 1e4  # [m/s^2] plausibility bound, a thousand times gravity
HIGHEST_FREQUENCY = 1e4  # [Hz]
MOST_POINTS = 1 << 24


class Waveform(Protocol):
    """One acceleration over time."""

    def values(self, t: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """Acceleration in [m/s^2] at times t in [s]."""

    def describe(self) -> dict[str, Any]:
        """Its parameters, units in the names."""


def _require(owner: str, name: str, value: float, low: float, high: float, unit: str) -> None:
    if not (isfinite(value) and low <= value <= high):
        raise ExcitationError(f"{name} of the {owner} is {value} {unit}; allowed: {low:g} to {high:g} {unit}")


class Sine:
    """amplitude sin(2 pi frequency t + phase)."""

    def __init__(self, amplitude: float, frequency: float, phase: float = 0.0) -> None:
        """Take amplitude [m/s^2], frequency [Hz] and phase [rad]; ExcitationError for a value out
        of range.
        """
        _require("sine", "amplitude", amplitude, 0.0, LARGEST_ACCELERATION, "m/s^2")
        _require("sine", "frequency", frequency, 0.0, HIGHEST_FREQUENCY, "Hz")
        _require("sine", "phase", phase, -1e3, 1e3, "rad")
        self.amplitude, self.frequency, self.phase = amplitude, frequency, phase

    def values(self, t: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """See Waveform.

        t: [n] [s]; the result: [n] [m/s^2].
        """
        return self.amplitude * numpy.sin(2.0 * pi * self.frequency * t + self.phase)

    def describe(self) -> dict[str, Any]:
        """See Waveform."""
        return {
            "kind": "sine", "amplitude_m_per_s2": self.amplitude, "frequency_Hz": self.frequency,
            "phase_rad": self.phase,
        }  # fmt: skip


class SweepSignal:
    """Sine of constant acceleration amplitude whose frequency runs from start to end over the
    duration, then 0.

    logarithmic:  f = start (end/start)^(t/duration),  phase = 2 pi start duration / ln(end/start)
        ((end/start)^(t/duration) - 1)
    linear:       f = start + (end - start) t/duration,  phase = 2 pi (start t + (end - start) t^2 /
    (2 duration))
    """

    def __init__(self, amplitude: float, start: float, end: float, duration: float, logarithmic: bool = True) -> None:
        """Take amplitude [m/s^2], start and end frequency [Hz], duration [s]; ExcitationError for a
        value out of range."""
        _require("sweep", "amplitude", amplitude, 0.0, LARGEST_ACCELERATION, "m/s^2")
        _require("sweep", "start frequency", start, 1e-6, HIGHEST_FREQUENCY, "Hz")
        _require("sweep", "end frequency", end, 1e-6, HIGHEST_FREQUENCY, "Hz")
        _require("sweep", "duration", duration, 1e-6, 1e6, "s")
        if start == end:
            raise ExcitationError(f"the sweep starts and ends at {start} Hz; use a sine")
        self.amplitude, self.start, self.end = amplitude, start, end
        self.duration, self.logarithmic = duration, logarithmic

    def values(self, t: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """See Waveform.

        t: [n] [s]; the result: [n] [m/s^2].
        """
        inside = (t >= 0.0) & (t <= self.duration)
        part = numpy.where(inside, t, 0.0) / self.duration
        if self.logarithmic:
            rate = log(self.end / self.start)
            cycles = self.start * self.duration * numpy.expm1(rate * part) / rate
        else:
            cycles = self.duration * part * (self.start + 0.5 * (self.end - self.start) * part)
        return numpy.where(inside, self.amplitude * numpy.sin(2.0 * pi * cycles), 0.0)

    def describe(self) -> dict[str, Any]:
        """See Waveform."""
        octaves = log(self.end / self.start) / log(2.0)
        described = {
            "kind": "sweep", "amplitude_m_per_s2": self.amplitude, "start_frequency_Hz": self.start,
            "end_frequency_Hz": self.end, "duration_s": self.duration, "logarithmic": self.logarithmic,
        }  # fmt: skip
        if self.logarithmic:
            return {**described, "rate_octaves_per_minute": 60.0 * octaves / self.duration}
        return {**described, "rate_Hz_per_s": (self.end - self.start) / self.duration}


class HalfSine:
    """One half sine: peak sin(pi (t - start) / duration) from start to start + duration, else 0."""

    def __init__(self, peak: float, start: float, duration: float) -> None:
        """Take peak [m/s^2], its sign counts, start [s] and duration [s]; ExcitationError for a
        value out of range.
        """
        _require("half-sine shock", "peak", peak, -LARGEST_ACCELERATION, LARGEST_ACCELERATION, "m/s^2")
        _require("half-sine shock", "start", start, -1e6, 1e6, "s")
        _require("half-sine shock", "duration", duration, 1e-6, 1e3, "s")
        self.peak, self.start, self.duration = peak, start, duration

    def values(self, t: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """See Waveform.

        t: [n] [s]; the result: [n] [m/s^2].
        """
        part = (t - self.start) / self.duration
        return numpy.where((part > 0.0) & (part < 1.0), self.peak * numpy.sin(pi * part), 0.0)

    def describe(self) -> dict[str, Any]:
        """See Waveform."""
        return {
            "kind": "half_sine", "peak_m_per_s2": self.peak, "start_s": self.start, "duration_s": self.duration,
            "velocity_change_m_per_s": 2.0 * self.peak * self.duration / pi,
        }  # fmt: skip


class NoiseSignal:
    """Gaussian noise with a flat spectrum between two frequencies, made of harmonics with random
    phases.

    Harmonics of 1 / period inside [low, high], equal amplitudes, uniform random phases: the rms
    over one period is exactly the rms requested, the distribution Gaussian to within the number of
    harmonics (at least 16). It repeats after `period`. Interpolated to 1e-6 of the rms, see
    excitation/periodic.py.
    """

    def __init__(self, rms: float, low: float, high: float, seed: int, period: float = 60.0) -> None:
        """Make the noise.

        Args:
            rms: [m/s^2], 0 to 1000.
            low: lowest frequency, [Hz], above 0.
            high: highest frequency, [Hz].
            seed: whole number from 0; the same seed gives the same bits.
            period: the noise repeats after this time, [s].

        Raises:
            ExcitationError: a value out of range, or a band that holds fewer than 16 harmonics of
            the period.
        """
        _require("noise", "rms", rms, 0.0, 1000.0, "m/s^2")
        _require("noise", "lowest frequency", low, 1e-6, HIGHEST_FREQUENCY, "Hz")
        _require("noise", "highest frequency", high, low, HIGHEST_FREQUENCY, "Hz")
        _require("noise", "period", period, 1e-3, 1e5, "s")
        if not isinstance(seed, int) or seed < 0:
            raise ExcitationError(f"seed of the noise is {seed!r}; allowed: a whole number from 0")
        # The harmonics of the period that lie in the band
        first, last = ceil(low * period * (1.0 - 1e-12)), floor(high * period * (1.0 + 1e-12))
        if last - first + 1 < 16:
            raise ExcitationError(
                f"the noise band {low:g} to {high:g} Hz holds {max(last - first + 1, 0)} harmonics of a period of "
                f"{period:g} s; at least 16 are needed, use a longer period"
            )
        self.rms, self.low, self.high, self.seed, self.period = rms, low, high, seed, period
        self.harmonics = last - first + 1
        self._table = self._make(first, last)

    def _make(self, first: int, last: int) -> Any:
        points = 64 * ceil(48 * last / 64)
        if points > MOST_POINTS:
            raise ExcitationError(
                f"noise up to {self.high:g} Hz over {self.period:g} s needs {points} points, limit {MOST_POINTS}; use "
                "a shorter period"
            )
        amplitude = numpy.zeros(last + 1, dtype=numpy.complex128)
        phase = 2.0 * pi * numpy.random.Generator(numpy.random.PCG64(self.seed)).random(self.harmonics)
        amplitude[first:] = self.rms * sqrt(2.0 / self.harmonics) * numpy.exp(1j * phase)
        return synthesise(amplitude, points, self.period)

    def values(self, t: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """See Waveform.

        t: [n] [s]; the result: [n] [m/s^2].
        """
        return numpy.asarray(self._table.at(t)[:, 0])

    def describe(self) -> dict[str, Any]:
        """See Waveform."""
        return {
            "kind": "noise", "rms_m_per_s2": self.rms, "lowest_frequency_Hz": self.low,
            "highest_frequency_Hz": self.high, "seed": self.seed, "period_s": self.period, "harmonics": self.harmonics,
        }  # fmt: skip


class AxisSignal:
    """Sum of waveforms on each axis; an axis without a waveform rests."""

    def __init__(self, x: Sequence[Waveform] = (), z: Sequence[Waveform] = (), notes: Sequence[str] = ()) -> None:
        """Take the waveforms of the axes x (forward) and z (up), and what else is reported of
        them.
        """
        self.x, self.z, self.notes = tuple(x), tuple(z), tuple(notes)

    def acceleration(self, t: NDArray[numpy.float64]) -> tuple[NDArray[numpy.float64], NDArray[numpy.float64]]:
        """See blocks.Signal.

        t: [n] [s]; the result: forward and up, [n] each [m/s^2].
        """
        return _sum(self.x, t), _sum(self.z, t)

    def describe(self) -> dict[str, Any]:
        """See blocks.Signal."""
        notes = [
            f"The noise repeats after {wave.period:g} s."
            for wave in (*self.x, *self.z)
            if isinstance(wave, NoiseSignal)
        ] + list(self.notes)
        return {
            "kind": "formulas", "x": [wave.describe() for wave in self.x], "z": [wave.describe() for wave in self.z],
            "notes": notes,
        }  # fmt: skip


def _sum(waves: Sequence[Waveform], t: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
    total = numpy.zeros(len(t))
    for wave in waves:
        total += wave.values(t)
    return total
