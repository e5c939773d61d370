"""Noise between two frequencies."""

from collections.abc import Callable, Iterator
from math import ceil, floor, pi, sqrt
from typing import Any, Literal

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.periodic import synthesise
from contact_sim_pkg.excitation.signals import (
    HIGHEST_FREQUENCY,
    AxisVibration,
    acceleration_key,
    frequency_key,
    require,
)
from contact_sim_pkg.records.breach import Breach, rising

MOST_POINTS = 1 << 24
Density = Callable[[NDArray[numpy.float64]], NDArray[numpy.float64]]


class NoiseSignal:
    """Gaussian noise between two frequencies, flat or with a spectrum, made of harmonics with random
    phases.

    Harmonics of 1 / period inside [low, high], equal amplitudes or such that their squares go as the
    density, uniform random phases: the rms
    over one period is exactly the rms requested, the distribution Gaussian to within the number of
    harmonics (at least 16). It repeats after `period`. Interpolated to 1e-6 of the rms, see
    excitation/periodic.py.
    """

    def __init__(
        self, rms: float, low: float, high: float, seed: int, period: float = 60.0, density: Density | None = None
    ) -> None:
        """Make the noise.

        Args:
            rms: [m/s^2], 0 to 1000.
            low: lowest frequency, [Hz], above 0.
            high: highest frequency, [Hz].
            seed: whole number from 0; the same seed gives the same bits.
            period: the noise repeats after this time, [s].
            density: of frequencies [n] in [Hz], [n] up to a factor; None: flat.

        Raises:
            ExcitationError: a value out of range, or a band that holds fewer than 16 harmonics of
            the period.
        """
        require("noise", "rms", rms, 0.0, 1000.0, "m/s^2")
        require("noise", "lowest frequency", low, 1e-6, HIGHEST_FREQUENCY, "Hz")
        require("noise", "highest frequency", high, low, HIGHEST_FREQUENCY, "Hz")
        require("noise", "period", period, 1e-3, 1e5, "s")
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
        self._table = self._make(first, last, density)

    def _make(self, first: int, last: int, density: Density | None) -> Any:
        points = 64 * ceil(48 * last / 64)
        if points > MOST_POINTS:
            raise ExcitationError(
                f"noise up to {self.high:g} Hz over {self.period:g} s needs {points} points, limit {MOST_POINTS}; use "
                "a shorter period"
            )
        amplitude = numpy.zeros(last + 1, dtype=numpy.complex128)
        phase = 2.0 * pi * numpy.random.Generator(numpy.random.PCG64(self.seed)).random(self.harmonics)
        amplitude[first:] = self.rms * sqrt(2.0 / self.harmonics) * numpy.exp(1j * phase)
        if density is not None:
            power = density(numpy.arange(first, last + 1) / self.period)
            amplitude[first:] *= numpy.sqrt(power / power.mean())
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
            "notes": [f"The noise repeats after {self.period:g} s."],
        }  # fmt: skip


class NoiseSection(AxisVibration):
    """Gaussian noise of constant spectral density between two frequencies; drawn from `seed`."""

    kind: Literal["noise"]
    low: float = frequency_key("lowest frequency", 0.5)
    high: float = frequency_key("highest frequency", 20.0)
    rms: float = acceleration_key("root mean square of the acceleration")

    def wave(self, seed: int) -> NoiseSignal:
        """See AxisVibration."""
        return NoiseSignal(self.rms, self.low, self.high, seed)

    def strength(self) -> float:
        """See VibrationKind."""
        return abs(self.rms)

    def breaches(self, duration: float) -> Iterator[Breach]:
        """See Kind."""
        yield from rising("vibration", "low", self.low, "high", self.high, "Hz")
        yield from self.not_below_half_rate("high", self.high)


KIND = NoiseSection
