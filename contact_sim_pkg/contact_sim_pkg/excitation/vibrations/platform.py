"""The spectra that seats of machines are tested with on a platform.

G(f) = G0 |HP(f)|^2 |LP(f)|^2 in (m/s^2)^2/Hz, one-sided, of Butterworth filters:
|HP|^2 = 1 / (1 + (high / f)^(2 poles)), |LP|^2 = 1 / (1 + (f / low)^(2 poles)).

Source of the constants: HVLab human response toolbox (ISVR, University of Southampton, 2009), `hvtestspectrum`, which
takes them from ISO 7096:2000 (EM, earth-moving machines), EN 13490:2001 (IT, industrial trucks) and ISO 5007:2003 (AG,
agricultural tractors). The standards themselves were not at hand.
"""

from collections.abc import Iterator
from math import sqrt
from typing import Literal, NamedTuple, TypeAlias

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.signals import AxisVibration
from contact_sim_pkg.excitation.vibrations.noise import NoiseSignal
from contact_sim_pkg.records.breach import Breach
from contact_sim_pkg.records.fields import choice, number

__all__ = ["HIGHEST", "LOWEST", "PERIOD", "SPECTRA", "PlatformSection", "Spectrum"]

SpectrumName: TypeAlias = Literal[
    "EM1", "EM2", "EM3", "EM4", "EM5", "EM6", "EM7", "EM8", "EM9", "IT1", "IT2", "IT3", "IT4", "AG1", "AG2", "AG3"
]
LOWEST, HIGHEST = 0.5, 25.0
"""[Hz] of the harmonics. Below, the high-pass leaves less than 2e-4 of the density."""
PERIOD = 180.0
"""[s] after which it repeats: a run of a test, whose rms is exact then."""


class Spectrum(NamedTuple):
    """Density of an acceleration: a plateau between two Butterworth filters."""

    plateau: float
    """G0, [(m/s^2)^2/Hz]"""
    high_poles: int
    high: float
    """[Hz] of the high-pass"""
    low_poles: int
    low: float
    """[Hz] of the low-pass"""

    def density(self, frequency: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
        """G [n] in [(m/s^2)^2/Hz] at ``frequency`` [n] in [Hz], above 0."""
        high = 1.0 + (self.high / frequency) ** (2 * self.high_poles)
        low = 1.0 + (frequency / self.low) ** (2 * self.low_poles)
        return numpy.asarray(self.plateau / (high * low))


SPECTRA: dict[str, Spectrum] = {
    "EM1": Spectrum(2.82, 4, 1.5, 4, 2.5),
    "EM2": Spectrum(2.72, 4, 1.5, 4, 3.0),
    "EM3": Spectrum(1.93, 4, 1.5, 4, 3.0),
    "EM4": Spectrum(0.60, 4, 1.5, 4, 3.0),
    "EM5": Spectrum(1.11, 4, 1.5, 1, 3.5),
    "EM6": Spectrum(0.79, 2, 6.5, 2, 9.0),
    "EM7": Spectrum(9.25, 8, 3.0, 8, 3.5),
    "EM8": Spectrum(1.45, 4, 3.0, 2, 3.0),
    "EM9": Spectrum(2.10, 4, 3.5, 2, 4.0),
    "IT1": Spectrum(1.66, 4, 4.5, 2, 5.0),
    "IT2": Spectrum(1.45, 4, 3.0, 2, 3.0),
    "IT3": Spectrum(0.60, 4, 1.5, 4, 3.0),
    "IT4": Spectrum(1.64, 4, 1.5, 4, 3.0),
    "AG1": Spectrum(9.25, 8, 3.0, 8, 3.5),
    "AG2": Spectrum(7.22, 8, 2.1, 8, 2.6),
    "AG3": Spectrum(5.85, 8, 1.95, 8, 2.45),
}


class PlatformSection(AxisVibration):
    """Gaussian noise with the spectrum of a seat test: ISO 7096 (EM), EN 13490 (IT), ISO 5007 (AG); drawn from `seed`."""

    kind: Literal["platform"]
    spectrum: SpectrumName = choice("class of machines", example="EM1")
    scale: float = number(0.0, 10.0, "1", "factor on the acceleration", default=1.0, live="excitation")

    def wave(self, seed: int) -> NoiseSignal:
        """See AxisVibration."""
        return NoiseSignal(self.strength(), LOWEST, HIGHEST, seed, PERIOD, self._spectrum.density)

    def strength(self) -> float:
        """See VibrationKind: of all harmonics, [m/s^2]."""
        frequency = numpy.arange(round(LOWEST * PERIOD), round(HIGHEST * PERIOD) + 1) / PERIOD
        return self.scale * sqrt(float(self._spectrum.density(frequency).sum()) / PERIOD)

    @property
    def _spectrum(self) -> Spectrum:
        return SPECTRA[self.spectrum]

    def breaches(self, duration: float) -> Iterator[Breach]:
        """See Kind."""
        yield from self.not_below_half_rate("spectrum", HIGHEST)


KIND = PlatformSection
