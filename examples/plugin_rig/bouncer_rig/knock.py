"""A vibration that dies away."""

from typing import Any, Literal

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.signals import AxisVibration, Waveform, acceleration_key, frequency_key
from contact_sim_pkg.records.fields import number


class Knock(AxisVibration):
    """A sine that dies away: amplitude · exp(-t / decay) · sin(2π frequency t)."""

    kind: Literal["knock"]
    amplitude: float = acceleration_key("amplitude of the acceleration at the start")
    frequency: float = frequency_key("frequency", 10.0)
    decay: float = number(0.001, 3600.0, "s", "time to 1/e of the amplitude", default=0.5)

    def wave(self, seed: int) -> Waveform:
        """The section is its own waveform; it has the keys `axis` and `sample_rate` too."""
        return self

    def values(self, t: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """Acceleration [m/s²] at times t [s], [n] each."""
        return self.amplitude * numpy.exp(-t / self.decay) * numpy.sin(2.0 * numpy.pi * self.frequency * t)

    def describe(self) -> dict[str, Any]:
        """For the report."""
        return {
            "kind": self.kind,
            "amplitude_m_per_s2": self.amplitude,
            "frequency_Hz": self.frequency,
            "decay_s": self.decay,
        }

    @property
    def fastest(self) -> float:
        """A note says so where the sample rate is too low for it."""
        return self.frequency


KIND = Knock
