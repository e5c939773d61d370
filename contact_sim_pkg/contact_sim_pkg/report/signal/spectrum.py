"""Cross spectral densities, power spectral density and transmissibility by Welch's method, of a
whole record or while a run goes on.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact_sim_pkg.records.state import State

SEGMENT_TIME = 4.0
"""[s] a segment of a long record: 0.25 Hz resolution, fine for a seat's resonance at 4 Hz (1 Hz
wide or more).
"""
LEAST_SEGMENTS = 8
"""Segments (half overlapping) that a shorter record is cut into; the coherence of one segment would
always be 1.
"""
FEW_SEGMENTS = 16
"""Segments of `SEGMENT_TIME` below which SEAT and a peak are said to be uncertain: at a coherence of
0.9 the random error of a magnitude is 6 % with 16 (Bendat and Piersol, Random Data, table 9.6).
"""
AT_REST = 1e-6
"""[m/s^2] rms below which an acceleration is rounding: what moves so stands still."""
HIGHEST_FREQUENCY = 80.0
"""[Hz] upper end of the range of whole-body vibration"""


class Density(NamedTuple):
    """One-sided power spectral density."""

    frequency: NDArray[np.float64]
    """[Hz] from 0"""
    density: NDArray[np.float64]
    """[unit^2/Hz]; its integral over frequency is the variance of the signal"""
    segments: int
    """number of segments averaged"""


class Transmissibility(NamedTuple):
    """Estimate H1 = S_xy / S_xx of the response of y to x."""

    frequency: NDArray[np.float64]
    """[Hz] from 0"""
    magnitude: NDArray[np.float64]
    phase: NDArray[np.float64]
    """[rad] in -pi .. pi; negative where y lags x"""
    coherence: NDArray[np.float64]
    """0 .. 1; share of y's power that follows x linearly"""
    segments: int
    """number of segments averaged"""

    @property
    def spread(self) -> NDArray[np.float64]:
        """`magnitude_spread` [frequencies]."""
        return magnitude_spread(self.coherence, self.segments)


def magnitude_spread(coherence: NDArray[np.float64], segments: int | NDArray[np.float64]) -> NDArray[np.float64]:
    """Standard deviation of a magnitude by chance, over the magnitude: ``sqrt((1 - c)/(2 n c))`` of n segments with the
    coherence c, 0 to 1. Source: Bendat and Piersol, Random Data, table 9.6.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(np.sqrt(np.maximum(1.0 - coherence, 0.0) / (2.0 * segments * coherence)))


class CrossDensity(NamedTuple):
    """One-sided cross spectral densities of several signals."""

    frequency: NDArray[np.float64]
    """[Hz] from 0"""
    density: NDArray[np.complex128]
    """[signals, signals, frequencies], S_xy of signals x and y: mean of conj(X) Y [unit_x unit_y/Hz]"""
    segments: int
    """number of segments averaged"""

    def power(self, signal: int) -> Density:
        """Power spectral density of one signal."""
        return Density(self.frequency, self.density[signal, signal].real, self.segments)

    def response(self, source: int, target: int) -> Transmissibility:
        """Response of one signal to another, nan at frequencies at which the source has no power, and
        everywhere for a source at rest.

        source: number of an acceleration [m/s^2]; target: of any signal.
        """
        cross = self.density[source, target]
        power_source, power_target = self.power(source).density, self.power(target).density
        with np.errstate(divide="ignore", invalid="ignore"):
            # H1 estimate: noise of the target averages out
            ratio = cross / power_source
            coherence = np.abs(cross) ** 2 / (power_source * power_target)
        # A running response must not load scipy.integrate for this: 0.3 s in the middle of a run
        moves = float(power_source[1:] @ np.diff(self.frequency)) >= AT_REST**2
        defined = (power_source > 0.0) & moves
        magnitude, phase, coherence = (
            np.where(defined, each, np.nan) for each in (np.abs(ratio), np.angle(ratio), coherence)
        )
        return Transmissibility(self.frequency, magnitude, phase, coherence, self.segments)


class Welch:
    """Welch's method on signals that come part by part: Hann window, half overlap, mean of each
    segment removed. It keeps one segment of samples and the sums over all of them, so the parts do
    not change the result. Source: Welch 1967, IEEE Trans. Audio Electroacoust. 15.
    """

    STATE = State(("_segment", "_filled", "_sums", "segments"))

    def __init__(self, signals: int, length: int, sample_rate: float) -> None:
        """Begin without a sample.

        Args:
            signals: number of signals, >= 1.
            length: samples of a segment, >= 1.
            sample_rate: [Hz] > 0.
        """
        self._length, self._sample_rate = length, sample_rate
        # Periodic: half-overlapping windows add up to 1
        self._window = np.sin(np.pi * np.arange(length) / length) ** 2 if length > 1 else np.ones(1)
        self._segment = np.zeros((signals, length))
        self._filled = 0
        self._sums = np.zeros((signals, signals, length // 2 + 1), dtype=np.complex128)
        self.segments = 0

    def advance(self, samples: NDArray[np.float64]) -> Iterator[int]:
        """Take the next samples [signals, samples], any units, as the result is iterated over:
        numbers of the samples that end a segment, each when that segment is in the sums.
        """
        first, count = 0, samples.shape[1]
        while first < count:
            taken = min(count - first, self._length - self._filled)
            self._segment[:, self._filled : self._filled + taken] = samples[:, first : first + taken]
            self._filled += taken
            first += taken
            if self._filled == self._length:
                self._add_segment()
                yield first - 1

    def _add_segment(self) -> None:
        """Add the spectra of a full segment to the sums, and keep the half that the next one
        shares.
        """
        centred = self._segment - self._segment.mean(axis=1, keepdims=True)
        spectra = np.fft.rfft(centred * self._window)
        self._sums += spectra.conj()[:, None] * spectra
        self.segments += 1
        self._filled = self._length // 2
        self._segment[:, : self._filled] = self._segment[:, self._length - self._filled :]

    def mean(self) -> CrossDensity:
        """Mean over the segments so far, at least one."""
        frequency = np.fft.rfftfreq(self._length, 1.0 / self._sample_rate).astype(np.float64)
        density = self._sums / (self.segments * self._sample_rate * np.sum(self._window**2))
        # One-sided: every frequency but 0, and half the rate, stands for its negative too
        density[:, :, 1 : (self._length + 1) // 2] *= 2.0
        return CrossDensity(frequency, density, self.segments)


def segment_samples(samples: int, sample_rate: float) -> int:
    """Samples a segment: 4 s, or less so that a short record still gives 8 half-overlapping
    segments; sample_rate: [Hz]."""
    wanted = round(SEGMENT_TIME * sample_rate)
    affordable = 2 * samples // (LEAST_SEGMENTS + 1)
    return max(1, min(wanted, affordable))


def shortage(segments: int, segment_time: float) -> str:
    """What is to be said beside a number that so many ``segments`` of ``segment_time`` [s] give; empty
    where they are enough.
    """
    if segments >= FEW_SEGMENTS and segment_time >= 0.999 * SEGMENT_TIME:
        return ""
    needed = 0.5 * SEGMENT_TIME * (FEW_SEGMENTS + 1)
    return f"uncertain: {segments} segments of {segment_time:.2g} s; a ride of {needed:g} s or more gives enough"


def shortage_of_record(samples: int, sample_rate: float) -> str:
    """`shortage` of a record of so many ``samples`` at a rate [Hz]."""
    length = segment_samples(samples, sample_rate)
    step = max(1, length - length // 2)
    return shortage(max(0, samples - length) // step + 1, length / sample_rate)


def power_density(values: NDArray[np.float64], sample_rate: float) -> Density:
    """One-sided power spectral density: Hann window, half overlap, mean of each segment removed.

    Args:
        values: [unit] one dimension, at least 2 samples.
        sample_rate: [Hz] > 0.
    """
    return _cross_density(values[np.newaxis], sample_rate).power(0)


def transmissibility(source: NDArray[np.float64], target: NDArray[np.float64], sample_rate: float) -> Transmissibility:
    """Magnitude, phase and coherence of `target` over `source`, both sampled at the same instants.

    Frequencies at which the source has no power have magnitude, phase and coherence nan, and all for
    a source at rest.

    Args:
        source: [m/s^2] one dimension, at least 2 samples.
        target: [unit] same shape.
        sample_rate: [Hz] > 0.
    """
    return _cross_density(np.stack([source, target]), sample_rate).response(0, 1)


def band(frequency: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Mask [frequencies] of the ``frequency`` [Hz] of whole-body vibration: above 0, up to 80 Hz."""
    inside: NDArray[np.bool_] = (frequency > 0.0) & (frequency <= HIGHEST_FREQUENCY)
    return inside


def _cross_density(signals: NDArray[np.float64], sample_rate: float) -> CrossDensity:
    welch = Welch(len(signals), segment_samples(signals.shape[1], sample_rate), sample_rate)
    for _end in welch.advance(signals):
        pass
    return welch.mean()
