"""A sine of changing frequency."""

from collections.abc import Iterator
from math import log, log2, pi
from typing import Any, Literal

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.signals import (
    HIGHEST_FREQUENCY,
    LARGEST_ACCELERATION,
    AxisVibration,
    acceleration_key,
    frequency_key,
    require,
)
from contact_sim_pkg.records.breach import Breach, one_of, show
from contact_sim_pkg.records.fields import number


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
        require("sweep", "amplitude", amplitude, 0.0, LARGEST_ACCELERATION, "m/s^2")
        require("sweep", "start frequency", start, 1e-6, HIGHEST_FREQUENCY, "Hz")
        require("sweep", "end frequency", end, 1e-6, HIGHEST_FREQUENCY, "Hz")
        require("sweep", "duration", duration, 1e-6, 1e6, "s")
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


class SweepSection(AxisVibration):
    """A sine of rising or falling frequency, logarithmic in time; `octaves_per_minute` or
    `duration`.
    """

    kind: Literal["sweep"]
    start_frequency: float = frequency_key("frequency at the start", 0.5)
    end_frequency: float = frequency_key("frequency at the end", 20.0)
    amplitude: float = acceleration_key("amplitude of the acceleration")
    octaves_per_minute: float | None = number(
        0.0, 6000.0, "1/min", "rate of the sweep; 1 is usual", above=True, default=None
    )
    duration: float | None = number(
        0.001, 3600.0, "s", "time from the start frequency to the end frequency", default=None
    )

    def wave(self, seed: int) -> SweepSignal:
        """See AxisVibration. Its duration is as given, or by the octaves per minute."""
        duration = self.duration
        if duration is None:
            assert self.octaves_per_minute is not None
            duration = 60.0 * abs(log2(self.end_frequency / self.start_frequency)) / self.octaves_per_minute
        return SweepSignal(self.amplitude, self.start_frequency, self.end_frequency, duration)

    def strength(self) -> float:
        """See VibrationKind."""
        return abs(self.amplitude)

    @property
    def fastest(self) -> float:
        """See AxisVibration."""
        return max(self.start_frequency, self.end_frequency)

    def breaches(self, duration: float) -> Iterator[Breach]:
        """See Kind."""
        given = self.octaves_per_minute is not None, self.duration is not None
        yield from one_of("vibration", "octaves_per_minute", given[0], "duration", given[1])
        yield from self.not_below_half_rate("start_frequency", self.start_frequency)
        yield from self.not_below_half_rate("end_frequency", self.end_frequency)
        if self.start_frequency == self.end_frequency:
            sentence = f"is equal to start_frequency ({show(self.start_frequency)} Hz); take kind: sine"
            yield Breach("vibration.end_frequency", sentence, ("vibration.start_frequency",))


KIND = SweepSection
