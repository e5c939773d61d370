"""Pictures of the ride: spectra of floor and seat, and the way from one to the other."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .drawing import ACCENT, INK, MUTED, Picture, new_figure, picture
from .ride import RideSignals
from .spectrum import Density, Transmissibility, power_density, transmissibility

HIGHEST_FREQUENCY = 80.0
"""[Hz] upper end of the range of whole-body vibration"""
FLOOR_OF_POWER = 1e-9
"""Share of the largest density below which a spectrum is rounding and not drawn."""


def seat_spectrum(signals: RideSignals) -> Picture:
    """Power spectral density of the accelerations of floor and seat."""
    floor = power_density(signals.floor, signals.sample_rate)
    seat = power_density(signals.seat, signals.sample_rate)
    figure, (axes,) = new_figure(3.0)
    shown = band(floor.frequency)
    axes.loglog(floor.frequency[shown], _visible(floor)[shown], color=MUTED, linestyle=(0, (4, 2)), label="floor")
    axes.loglog(seat.frequency[shown], _visible(seat)[shown], color=ACCENT, label="seat")
    axes.set_xlabel("frequency, Hz")
    axes.set_ylabel("PSD, (m/s²)²/Hz")
    _frequency_axis(axes, floor.frequency)
    axes.legend(loc="best")
    caption = (
        f"Power spectral density of the vertical acceleration, Welch's method: {seat.segments} half-overlapping segments, "
        f"{seat.frequency[1]:.3g} Hz resolution. The floor's power is largest at {_top(floor):.3g} Hz, the seat's at "
        f"{_top(seat):.3g} Hz."
    )
    return picture("ride-spectrum", figure, "Spectrum of the vertical acceleration of floor and seat", caption)


def seat_transmissibility(signals: RideSignals) -> Picture | None:
    """Magnitude, phase and coherence of the seat over the floor; None for a floor at rest."""
    result = transmissibility(signals.floor, signals.seat, signals.sample_rate)
    shown = band(result.frequency) & np.isfinite(result.magnitude)
    if not shown.any():
        return None
    figure, axes = new_figure(4.6, 3, sharex=True, height_ratios=[2, 1, 1])
    frequency = result.frequency[shown]
    axes[0].semilogx(frequency, result.magnitude[shown], color=ACCENT)
    axes[0].axhline(1.0, color=MUTED, linewidth=0.7)
    axes[0].set_ylabel("seat / floor")
    axes[0].set_ylim(bottom=0.0)
    axes[1].semilogx(frequency, np.degrees(result.phase[shown]), color=ACCENT)
    axes[1].set_ylabel("phase, °")
    axes[1].set_yticks([-180, -90, 0, 90, 180])
    axes[2].semilogx(frequency, result.coherence[shown], color=INK, linewidth=0.9)
    axes[2].set_ylabel("coherence")
    axes[2].set_ylim(0.0, 1.05)
    axes[2].set_xlabel("frequency, Hz")
    _frequency_axis(axes[2], result.frequency)
    return picture(
        "ride-transmissibility", figure, "Transmissibility from floor to seat: magnitude, phase, coherence",
        _transmissibility_caption(result, shown),
    )  # fmt: skip


def band(frequency: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Frequencies that are drawn: above 0, up to 80 Hz."""
    inside: NDArray[np.bool_] = (frequency > 0.0) & (frequency <= HIGHEST_FREQUENCY)
    return inside


def _transmissibility_caption(result: Transmissibility, shown: NDArray[np.bool_]) -> str:
    trusted = shown & (result.coherence > 0.9)
    text = f"Seat over floor, mean of {result.segments} segments. "
    if not trusted.any():
        return text + "The coherence stays below 0.9: the record is too short or too noisy to read a resonance from it."
    peak = int(np.flatnonzero(trusted)[result.magnitude[trusted].argmax()])
    return text + (
        f"Largest where the coherence is above 0.9: {result.magnitude[peak]:.3g} at {result.frequency[peak]:.3g} Hz. Below a "
        "coherence of about 0.9 neither magnitude nor phase should be read: little excitation there, or a non-linear seat."
    )


def _visible(spectrum: Density) -> NDArray[np.float64]:
    smallest = FLOOR_OF_POWER * spectrum.density.max()
    return np.where(spectrum.density > smallest, spectrum.density, np.nan)


def _frequency_axis(axes: object, frequency: NDArray[np.float64]) -> None:
    ticks = [tick for tick in (0.5, 1, 2, 5, 10, 20, 50, 80) if tick >= frequency[1]]
    axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])  # type: ignore[attr-defined]
    axes.minorticks_off()  # type: ignore[attr-defined]
    axes.set_xlim(max(frequency[1], 0.1), HIGHEST_FREQUENCY)  # type: ignore[attr-defined]


def _top(spectrum: Density) -> float:
    return float(spectrum.frequency[spectrum.density.argmax()])
