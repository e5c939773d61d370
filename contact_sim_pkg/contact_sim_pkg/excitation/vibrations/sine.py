"""A sine of the floor."""

from collections.abc import Iterator
from math import pi
from typing import Any, Literal

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.signals import (
    HIGHEST_FREQUENCY,
    LARGEST_ACCELERATION,
    AxisVibration,
    acceleration_key,
    frequency_key,
    require,
)
from contact_sim_pkg.records.breach import Breach


class Sine:
    """amplitude sin(2 pi frequency t + phase)."""

    def __init__(self, amplitude: float, frequency: float, phase: float = 0.0) -> None:
        """Take amplitude [m/s^2], frequency [Hz] and phase [rad]; ExcitationError for a value out
        of range.
        """
        require("sine", "amplitude", amplitude, 0.0, LARGEST_ACCELERATION, "m/s^2")
        require("sine", "frequency", frequency, 0.0, HIGHEST_FREQUENCY, "Hz")
        require("sine", "phase", phase, -1e3, 1e3, "rad")
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


class SineSection(AxisVibration):
    """A sine: amplitude · sin(2π frequency t)."""

    kind: Literal["sine"]
    frequency: float = frequency_key("frequency", 4.0)
    amplitude: float = acceleration_key("amplitude of the acceleration")

    def wave(self, seed: int) -> Sine:
        """See AxisVibration."""
        return Sine(self.amplitude, self.frequency)

    def strength(self) -> float:
        """See VibrationKind."""
        return abs(self.amplitude)

    @property
    def fastest(self) -> float:
        """See AxisVibration."""
        return self.frequency

    @property
    def period(self) -> float:
        """See VibrationKind."""
        return 1.0 / self.frequency

    def breaches(self, duration: float) -> Iterator[Breach]:
        """See Kind."""
        yield from self.not_below_half_rate("frequency", self.frequency)


KIND = SineSection
