"""Pictures of the ride: spectra of floor and seat, and the way from one to the other."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from contact_sim_pkg.report.drawing import ACCENT, INK, MUTED, SHADE, Picture, new_figure, picture
from contact_sim_pkg.report.metrics.bands import published_range
from contact_sim_pkg.report.signal.spectrum import (
    HIGHEST_FREQUENCY,
    Density,
    Transmissibility,
    band,
    power_density,
    shortage,
    transmissibility,
)
from contact_sim_pkg.rigs.vehicle.seat.report.response import TRUSTED_COHERENCE, peak_of, trusted_part
from contact_sim_pkg.rigs.vehicle.seat.report.ride import RideSignals

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
    frequency_axis(axes, floor.frequency)
    axes.legend(loc="best")
    caption = (
        f"Power spectral density of the vertical acceleration, Welch's method: {seat.segments} half-overlapping "
        f"segments, {seat.frequency[1]:.3g} Hz resolution. The floor's power is largest at {_top(floor):.3g} Hz, "
        f"the seat's at {_top(seat):.3g} Hz."
    )
    return picture("ride-spectrum", figure, "Spectrum of the vertical acceleration of floor and seat", caption)


def seat_transmissibility(signals: RideSignals, *, published: bool) -> Picture | None:
    """Magnitude, phase and coherence of the seat over the floor; None for a floor at rest. ``published``: whether the seat is
    one that published peaks are of.
    """
    result = transmissibility(signals.floor, signals.seat, signals.sample_rate)
    trusted = trusted_part(result, signals.floor, signals.sample_rate)
    if trusted is None:
        return None
    figure, axes = response_figure(result, trusted, "seat / floor")
    axes[0].axhline(1.0, color=MUTED, linewidth=0.7)
    axes[0].set_ylim(0.0, 1.5 * max(1.0, float(result.magnitude[trusted].max(initial=1.0))))
    caption = _transmissibility_caption(result, trusted)
    if published:
        (left, right), (low, high) = published_range("seat_peak_frequency"), published_range("seat_peak")
        axes[0].fill_between([left, right], low, high, color=SHADE, alpha=0.6, linewidth=0.0, zorder=0.0)
        caption += " Shaded: where textbooks have the peak of car seats with people."
    return picture(
        "ride-transmissibility", figure, "Transmissibility from floor to seat: magnitude, phase, coherence", caption
    )  # fmt: skip


def peak_sentence(result: Transmissibility, trusted: NDArray[np.bool_]) -> str:
    """The peak in words, or that there is none."""
    peak = peak_of(result, trusted)
    if peak is None:
        return "No peak can be read from this record: none lies between trusted lines."
    caution = shortage(result.segments, 1.0 / float(result.frequency[1]))
    return f"Peak: {peak[0]:.3g} at {peak[1]:.3g} Hz{f' ({caution})' if caution else ''}."


def response_figure(result: Transmissibility, trusted: NDArray[np.bool_], label: str) -> tuple[Figure, list[Axes]]:
    """Magnitude (``label``), phase and coherence of a response over frequency, blue where
    ``trusted`` [frequencies].
    """
    shown = band(result.frequency) & np.isfinite(result.magnitude)
    figure, axes = new_figure(2.9, 3, sharex=True, height_ratios=[2, 1, 1])
    frequency = result.frequency[shown]
    for place, values in ((axes[0], result.magnitude), (axes[1], np.degrees(result.phase))):
        place.semilogx(frequency, values[shown], color=MUTED, linewidth=0.6, alpha=0.6)
        place.semilogx(frequency, np.where(trusted, values, np.nan)[shown], color=ACCENT, marker=".", markersize=3.5)
    axes[0].set_ylabel(label)
    axes[1].set_ylabel("phase, °")
    axes[1].set_yticks([-180, 0, 180])
    axes[2].semilogx(frequency, result.coherence[shown], color=INK, linewidth=0.9)
    axes[2].axhline(TRUSTED_COHERENCE, color=MUTED, linewidth=0.7, linestyle=(0, (4, 3)))
    axes[2].set_ylabel("γ²")
    axes[2].set_ylim(0.0, 1.05)
    axes[2].set_xlabel("frequency, Hz")
    frequency_axis(axes[2], result.frequency)
    return figure, list(axes)


def _transmissibility_caption(result: Transmissibility, trusted: NDArray[np.bool_]) -> str:
    text = f"Seat over floor, {result.segments} segments. "
    if not trusted.any():
        return text + "Nowhere is it coherent with enough excitation: no resonance can be read from this record."
    return text + (
        f"{peak_sentence(result, trusted)} Blue: coherence γ² at least {TRUSTED_COHERENCE} (dashed) and a floor that moves "
        "enough; not to be read where grey."
    )


def _visible(spectrum: Density) -> NDArray[np.float64]:
    smallest = FLOOR_OF_POWER * spectrum.density.max()
    return np.where(spectrum.density > smallest, spectrum.density, np.nan)


def frequency_axis(axes: Axes, frequency: NDArray[np.float64]) -> None:
    """Ticks from the second ``frequency`` [frequencies] in [Hz] up to 80 Hz."""
    ticks = [tick for tick in (0.5, 1, 2, 5, 10, 20, 50, 80) if tick >= frequency[1]]
    axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.minorticks_off()
    axes.set_xlim(max(frequency[1], 0.1), HIGHEST_FREQUENCY)


def _top(spectrum: Density) -> float:
    return float(spectrum.frequency[spectrum.density.argmax()])
