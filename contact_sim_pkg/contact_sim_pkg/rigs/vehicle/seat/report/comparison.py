"""Transmissibility and spectra of several seats over each other, and as curves that are compared."""

from __future__ import annotations

import numpy as np

from contact_sim_pkg.compare.side_by_side import Curve
from contact_sim_pkg.report.comparison.figures import Run, legend, over_legend
from contact_sim_pkg.report.drawing import MUTED, Picture, picture
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.report.signal.spectrum import band, power_density
from contact_sim_pkg.rigs.vehicle.seat.report.figures_ride import frequency_axis
from contact_sim_pkg.rigs.vehicle.seat.report.response import TRUSTED_COHERENCE, transmissibility_curve
from contact_sim_pkg.rigs.vehicle.seat.report.ride import ride_signals


def seat_curves(recording: Recording) -> dict[str, Curve]:
    """`seat.transmissibility` where it is trusted, `seat.psd`, `floor.psd` up to 80 Hz; none without a seat."""
    signals = ride_signals(recording.motion)
    if signals is None:
        return {}
    way = transmissibility_curve(signals)
    found = {} if way is None else {"seat.transmissibility": way}
    for name, values in (("seat.psd", signals.seat), ("floor.psd", signals.floor)):
        density = power_density(values, signals.sample_rate)
        inside = band(density.frequency)
        found[name] = Curve("Hz", density.frequency[inside], density.density[inside])
    return found


def seat_comparison(key: str, _contact: str, runs: list[Run]) -> list[Picture]:
    """T(f) and the spectra of the seats; none where a run has no seat."""
    curves = [seat_curves(run.recording) for run in runs]
    if not all(curves):
        return []
    figure, (left, right) = over_legend(3.4, 2)
    parts = []
    for run, found in zip(runs, curves, strict=True):
        way = found.get("seat.transmissibility")
        if way is not None:
            left.semilogx(way.x, way.y, color=run.colour, label=run.label, marker=".", markersize=3.0, linewidth=1.0)
            if np.isfinite(way.y).any():
                place = int(np.nanargmax(way.y))
                parts.append(f"{run.label}: largest {way.y[place]:.3g} at {way.x[place]:.3g} Hz")
        density = found["seat.psd"]
        right.loglog(density.x, np.maximum(density.y, 1e-9 * density.y.max()), color=run.colour, linewidth=0.9)
    left.axhline(1.0, color=MUTED, linewidth=0.7)
    left.set_ylim(bottom=0.0)
    left.set_ylabel("T(f), seat over floor")
    right.set_ylabel("PSD of the seat, (m/s²)²/Hz")
    for axes in (left, right):
        frequency_axis(axes, curves[0]["seat.psd"].x)
        axes.set_xlabel("frequency, Hz")
    legend(figure, left, "run")
    caption = (
        f"Left: transmissibility where its coherence is at least {TRUSTED_COHERENCE} and the floor moves enough. "
        f"{'; '.join(parts)}. Right: power spectral density of the seat's vertical acceleration."
    )
    return [picture(f"{key}-response", figure, "Transmissibility and spectrum of the seat in every run", caption)]
