"""Vibration given by a formula, along one axis.

A waveform is a pure function of time, values(t), in [m/s^2]; `AxisSignal` puts waveforms on the
axes x (forward) and z (up).
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator, Sequence
from math import acos, cos, isfinite, pi
from typing import Any, Literal, Protocol, TypeAlias

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.kinds import Setting, VibrationKind
from contact_sim_pkg.records.breach import Breach, show
from contact_sim_pkg.records.fields import choice, number

__all__ = [
    "HIGHEST_FREQUENCY", "LARGEST_ACCELERATION", "SHARPEST", "Axis", "AxisSignal", "AxisVibration", "Waveform",
    "acceleration_key", "frequency_key", "require",
]  # fmt: skip

LARGEST_ACCELERATION = 1e4  # [m/s^2] plausibility bound, a thousand times gravity
HIGHEST_FREQUENCY = 1e4  # [Hz]
SHARPEST = 1000.0  # [m/s^2] of a scene
USUAL_RATES = (1000, 2000, 2500, 4000, 5000, 10_000, 12_500, 20_000, 25_000, 40_000, 50_000, 100_000)
"""[Hz] of samples, a whole number of nanoseconds apart."""
Axis: TypeAlias = Literal["x", "z"]


class Waveform(Protocol):
    """One acceleration over time."""

    def values(self, t: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """Acceleration in [m/s^2] at times t in [s]."""

    def describe(self) -> dict[str, Any]:
        """Its parameters, units in the names."""


def require(owner: str, name: str, value: float, low: float, high: float, unit: str) -> None:
    if not (isfinite(value) and low <= value <= high):
        raise ExcitationError(f"{name} of the {owner} is {value} {unit}; allowed: {low:g} to {high:g} {unit}")


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
        return {
            "kind": "formulas", "x": [wave.describe() for wave in self.x], "z": [wave.describe() for wave in self.z],
            "notes": [*(note for wave in (*self.x, *self.z) for note in wave.describe().get("notes", ())), *self.notes],
        }  # fmt: skip


def _sum(waves: Sequence[Waveform], t: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
    total = numpy.zeros(len(t))
    for wave in waves:
        total += wave.values(t)
    return total


class AxisVibration(VibrationKind):
    """A waveform along one axis."""

    axis: Axis = choice("direction: z up, x forward", default="z")

    @abstractmethod
    def wave(self, seed: int) -> Waveform:
        """Its waveform, drawn from ``seed`` where it is random."""

    @property
    def fastest(self) -> float:
        """Frequency [Hz] of a sine, whose samples are joined by straight lines; 0 for what is none."""
        return 0.0

    @property
    def axes(self) -> str:
        """See VibrationKind."""
        return self.axis

    def signal(self, setting: Setting) -> AxisSignal:
        """See VibrationKind."""
        notes = _joined(self.fastest, self.sample_rate, setting.accuracy)
        return AxisSignal(**{self.axis: (self.wave(setting.seed),)}, notes=notes)

    def not_below_half_rate(self, key: str, frequency: float) -> Iterator[Breach]:
        """A breach where the frequency [Hz] of a key is too high for the sample rate."""
        if not frequency < 0.5 * self.sample_rate:
            sentence = f"{show(frequency)} Hz is not below half the sample rate ({show(self.sample_rate)} Hz)"
            yield Breach(f"vibration.{key}", sentence, ("vibration.sample_rate",))


def _joined(fastest: float, rate: float, accuracy: float) -> list[str]:
    """Sentence where straight lines between the samples are less accurate than requested: ``1 -
    cos(pi f / rate)`` of a sine.
    """
    off = 1.0 - cos(pi * fastest / rate)
    if off <= accuracy:
        return []
    needed = pi * fastest / acos(1.0 - accuracy)
    enough = next((each for each in USUAL_RATES if each >= needed), USUAL_RATES[-1])
    sentence = (
        f"The excitation is straight between its {rate:g} samples a second, at {fastest:g} Hz up to {off:.2g} of its amplitude "
        f"off; vibration.sample_rate: {enough} leaves {1.0 - cos(pi * fastest / enough):.2g}."
    )
    return [sentence]


def frequency_key(meaning: str, example: float) -> Any:
    """A key of a frequency."""
    return number(0.0, HIGHEST_FREQUENCY, "Hz", meaning, above=True, example=example)


def acceleration_key(meaning: str) -> Any:
    """A key of an acceleration that is not negative; it scales the vibration, so that it is live."""
    return number(0.0, SHARPEST, "m/s²", meaning, example=1.0, live="excitation")
