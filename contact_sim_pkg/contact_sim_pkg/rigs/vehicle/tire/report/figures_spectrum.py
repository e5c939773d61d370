"""Picture of the tire's load by frequency: how much of it comes from the body, how much from the hop of the wheel."""

from __future__ import annotations

import numpy as np

from contact_sim_pkg.report.drawing import ACCENT, SHADE, Picture, new_figure, picture
from contact_sim_pkg.report.series import ContactSeries
from contact_sim_pkg.report.signal.spectrum import power_density

__all__ = ["load_spectrum"]

BANDS = (("body", 0.5, 4.0), ("wheel hop", 5.0, 20.0))
"""[Hz] in which the parts of a vehicle's corner have their resonances"""
HIGHEST = 100.0
"""[Hz] drawn"""
LEAST_TIME = 2.0
"""[s] of a record below which no segment reaches the body's resonance"""
LEAST_SPREAD = 1e-4
"""of the mean load, below which it is constant"""


def load_spectrum(key: str, name: str, contact: ContactSeries) -> Picture | None:
    """Power spectral density of the normal force, Welch's method; None for a constant load or a short record."""
    load, rate = contact.normal, 1.0 / contact.sample_period
    spread = float(load.std())
    if load.size < LEAST_TIME * rate or spread <= LEAST_SPREAD * float(load.mean()):
        return None
    found = power_density(load, rate)
    shown = (found.frequency > 0.0) & (found.frequency <= HIGHEST)
    figure, (axes,) = new_figure(3.0)
    axes.loglog(found.frequency[shown], found.density[shown], color=ACCENT)
    step, whole = float(found.frequency[1]), float(found.density[1:].sum())
    shares = []
    for label, low, high in BANDS:
        axes.axvspan(low, high, color=SHADE, alpha=0.4, linewidth=0.0)
        axes.text(float(np.sqrt(low * high)), 0.04, label, transform=axes.get_xaxis_transform(), ha="center")
        inside = (found.frequency >= low) & (found.frequency <= high)
        shares.append(
            f"{100.0 * float(found.density[inside].sum()) / whole:.3g} % of the variance lie in {low:g} to {high:g} Hz"
        )
    axes.set_xlabel("frequency, Hz")
    axes.set_ylabel("PSD of the load, N²/Hz")
    highest = float(found.frequency[1:][found.density[1:].argmax()])
    caption = (
        f"Welch's method: {found.segments} half-overlapping segments, {step:.3g} Hz resolution; its integral is the variance, "
        f"(dynamic load coefficient × mean load)². Largest at {highest:.3g} Hz; {', '.join(shares)}."
    )
    return picture(f"{key}-spectrum", figure, f"Spectrum of the load of the {name}", caption)
