"""Work-precision study of a random road: 20 sines, 400 sines, inverse FFT; power by third octaves
against the integral of the spectrum.

ISO 8608 class C, 0.011 to 2.83 cycles/m. Sines stand at the geometric means of bins of equal ratio,
where `2 G(n) dn` is twice the exact power of the bin, so the variance of the whole band is exact
for any number of them; what few sines miss is how the power is spread: third octaves with no sine,
or two. Time: 1000 heights along the road, which is made.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_lab.records.work_precision import FidelityLevel, Row, WorkPrecision, milliseconds, relative, row
from contact_sim_pkg.excitation.roads.iso8608 import Iso8608Road, band_variance, roughness_of_class

__all__ = ["PART", "WORK_PRECISION", "SineRoad", "rows", "third_octaves"]

Field = NDArray[numpy.float64]

PART = "road"
LOWEST, HIGHEST = 0.011, 2.83  # [cycles/m]
ROUGHNESS, EXPONENT = roughness_of_class("C"), 2.0
LENGTH, SEED = 1000.0, 1  # [m]
POINTS = 1000
REFERENCE = "integral of ISO 8608's spectrum, closed form"


class SineRoad(NamedTuple):
    """`h(x) = sum of amplitude cos(2 pi n x + phase)`."""

    wave_number: Field  # [cycles/m]
    amplitude: Field  # [m]
    phase: Field  # [rad]

    def heights(self, x: Field) -> Field:
        """Heights [m] at x [m]."""
        angle = 2.0 * math.pi * x[:, None] * self.wave_number[None, :] + self.phase[None, :]
        return numpy.asarray(numpy.cos(angle) @ self.amplitude)

    def power(self, low: float, high: float) -> float:
        """Mean square [m^2] of the sines within a band."""
        inside = (self.wave_number >= low) & (self.wave_number < high)
        return float(0.5 * numpy.sum(self.amplitude[inside] ** 2))


class FftRoad:
    """The road of the bench, its power measured on its own heights over one period."""

    def __init__(self) -> None:
        self.road = Iso8608Road(ROUGHNESS, SEED, LENGTH, EXPONENT, 1.0 / HIGHEST, 1.0 / LOWEST)
        points = int(LENGTH / 0.1)
        heights = self.road.heights(numpy.arange(points, dtype=numpy.float64) * 0.1, numpy.zeros(1))[:, 0]
        spectrum = numpy.fft.rfft(heights) / points
        self.wave_number, self.mean_square = numpy.arange(len(spectrum)) / LENGTH, 2.0 * abs(spectrum) ** 2

    def heights(self, x: Field) -> Field:
        """Heights [m] at x [m]."""
        return self.road.heights(x, numpy.zeros(1))

    def power(self, low: float, high: float) -> float:
        """Mean square [m^2] of the harmonics within a band."""
        inside = (self.wave_number >= low) & (self.wave_number < high)
        return float(numpy.sum(self.mean_square[inside]))


def sine_road(count: int) -> SineRoad:
    """`count` sines at the geometric means of bins of equal ratio."""
    edges = numpy.geomspace(LOWEST, HIGHEST, count + 1)
    power = band_variance(ROUGHNESS, EXPONENT, edges[:-1], edges[1:])
    phase = 2.0 * math.pi * numpy.random.default_rng(SEED).random(count)
    return SineRoad(numpy.sqrt(edges[:-1] * edges[1:]), numpy.sqrt(2.0 * power), phase)


def third_octaves() -> Field:
    """Edges [cycles/m] of the 24 bands of (nearly) a third octave between the limits."""
    return numpy.asarray(numpy.geomspace(LOWEST, HIGHEST, 25), dtype=numpy.float64)


def rows() -> list[Row]:
    """Variance of the band, and the rms and worst error of the power in the third octaves."""
    roads: dict[str, SineRoad | FftRoad] = {
        "20 sines": sine_road(20), "400 sines": sine_road(400), "inverse FFT": FftRoad()
    }  # fmt: skip
    edges = third_octaves()
    expected = numpy.array([band_variance(ROUGHNESS, EXPONENT, *edges[i : i + 2]) for i in range(len(edges) - 1)])
    x = numpy.linspace(0.0, 20.0, POINTS)
    found: list[Row] = []
    for name, road in roads.items():
        power = numpy.array([road.power(*edges[i : i + 2]) for i in range(len(edges) - 1)])
        fidelity = FidelityLevel(name, milliseconds(lambda road=road: road.heights(x)))  # type: ignore[misc]
        total, right = float(road.power(0.0, math.inf)), float(expected.sum())
        share = power / expected - 1.0
        head = (PART, "class C")
        found.append(row(*head, "variance", fidelity, REFERENCE, relative(total, right), value=total, expected=right))
        found.append(row(*head, "third octaves, rms", fidelity, REFERENCE, float(numpy.sqrt(numpy.mean(share**2)))))
        found.append(row(*head, "third octaves, worst", fidelity, REFERENCE, float(abs(share).max())))
    return found


WORK_PRECISION = (WorkPrecision(PART, rows),)
