"""Tables of a seat: third-octave bands of floor and seat surface, apparent mass and impedance of the occupant."""

from __future__ import annotations

import numpy as np

from contact_sim_pkg.records.table import Section
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.report.spectra import band_rows
from contact_sim_pkg.rigs.vehicle.seat.report.occupant import apparent_mass_of, occupant_signals
from contact_sim_pkg.rigs.vehicle.seat.report.ride import ride_signals

__all__ = ["band_table", "impedance_table"]

HIGHEST = 20.0
"""[Hz] of the impedance"""


def band_table(recording: Recording) -> list[Section]:
    """Root mean square of the vertical acceleration by third octave; none without a seat."""
    ride = ride_signals(recording.motion)
    if ride is None:
        return []
    return [band_rows({"floor [m/s²]": ride.floor, "seat [m/s²]": ride.seat}, ride.sample_rate)]


def impedance_table(recording: Recording) -> list[Section]:
    """Apparent mass M = F / a and driving-point impedance Z = j w M of the occupant by frequency; none without one."""
    signals = occupant_signals(recording)
    if signals is None:
        return []
    way = apparent_mass_of(signals)
    phase = np.degrees((way.phase + 1.5 * np.pi) % (2.0 * np.pi) - np.pi)  # a quarter of a turn ahead
    rows = [
        {
            "frequency [Hz]": float(way.frequency[k]), "apparent mass [kg]": float(way.magnitude[k]),
            "impedance [N s/m]": float(2.0 * np.pi * way.frequency[k] * way.magnitude[k]),
            "its phase [deg]": float(phase[k]), "coherence": float(way.coherence[k]),
        }
        for k in np.flatnonzero((way.frequency > 0.0) & (way.frequency <= HIGHEST) & np.isfinite(way.magnitude))
    ]  # fmt: skip
    return [Section(f"occupant {signals.name}", rows, "force of the seat over its acceleration, and over its velocity")]
