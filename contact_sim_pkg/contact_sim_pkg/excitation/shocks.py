"""Single shocks of the floor by the shape of their pulse: what the kinds of vibration that are shocks share."""

from abc import abstractmethod
from collections.abc import Iterator
from typing import Any, ClassVar

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.signals import LARGEST_ACCELERATION, SHARPEST, AxisVibration, require
from contact_sim_pkg.records.breach import Breach, show
from contact_sim_pkg.records.fields import number

__all__ = ["Shock", "ShockSection"]

Array = NDArray[numpy.float64]
SAMPLES_OF_A_SHOCK = 10
"""At least; straight lines between as many samples keep its change of speed to 1 %."""


class Shock:
    """peak shape((t - start) / duration) from start to start + duration, else 0. A subclass says its shape.

    Attributes:
        kind: name of the kind.
        area: of the shape over [0, 1].
    """

    kind: ClassVar[str]
    area: ClassVar[float]

    def __init__(self, peak: float, start: float, duration: float) -> None:
        """Take peak [m/s^2], its sign counts, start [s] and duration [s]; ExcitationError for a
        value out of range.
        """
        owner = f"{self.kind.replace('_', '-')} shock"
        require(owner, "peak", peak, -LARGEST_ACCELERATION, LARGEST_ACCELERATION, "m/s^2")
        require(owner, "start", start, -1e6, 1e6, "s")
        require(owner, "duration", duration, 1e-6, 1e3, "s")
        self.peak, self.start, self.duration = peak, start, duration

    @staticmethod
    @abstractmethod
    def shape(part: Array) -> Array:
        """The pulse over its time, both from 0 to 1."""

    def values(self, t: Array) -> Array:
        """See Waveform.

        t: [n] [s]; the result: [n] [m/s^2].
        """
        part = (t - self.start) / self.duration
        return numpy.where((part > 0.0) & (part < 1.0), self.peak * self.shape(part), 0.0)

    def describe(self) -> dict[str, Any]:
        """See Waveform."""
        return {
            "kind": self.kind, "peak_m_per_s2": self.peak, "start_s": self.start, "duration_s": self.duration,
            "velocity_change_m_per_s": self.area * self.peak * self.duration,
        }  # fmt: skip


class ShockSection(AxisVibration):
    """Keys of one shock."""

    pulse: ClassVar[type[Shock]]
    is_shock: ClassVar[bool] = True
    amplitude: float = number(
        -SHARPEST, SHARPEST, "m/s²", "peak of the acceleration; negative is downwards or backwards", example=10.0
    )
    duration: float = number(1e-4, 10.0, "s", "length of the shock", example=0.05)
    start: float = number(0.0, 3600.0, "s", "start of the shock", default=0.5)

    def wave(self, seed: int) -> Shock:
        """See AxisVibration."""
        return self.pulse(self.amplitude, self.start, self.duration)

    def strength(self) -> float:
        """See VibrationKind."""
        return abs(self.amplitude)

    def breaches(self, duration: float) -> Iterator[Breach]:
        """See Kind."""
        if self.start >= duration:
            sentence = f"the shock at {show(self.start)} s lies behind the end of the run ({show(duration)} s)"
            yield Breach("vibration.start", sentence, ("duration",))
        # A shock of few samples would have another impulse than its formula
        if self.duration * self.sample_rate < SAMPLES_OF_A_SHOCK * (1.0 - 1e-9):
            sentence = (
                f"{show(self.duration)} s hold {self.duration * self.sample_rate:.3g} samples; a shock needs "
                f"{SAMPLES_OF_A_SHOCK}, so make it longer, or the sample rate {show(SAMPLES_OF_A_SHOCK / self.duration)} Hz"
            )
            yield Breach("vibration.duration", sentence, ("vibration.sample_rate",))
