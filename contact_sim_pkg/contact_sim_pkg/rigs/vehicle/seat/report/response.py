"""Way from floor to seat: where a response can be trusted, its curve, and its peak."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from contact_sim_pkg.compare.side_by_side import Curve
from contact_sim_pkg.report.signal.spectrum import Transmissibility, band, power_density, transmissibility
from contact_sim_pkg.rigs.vehicle.seat.report.ride import RideSignals

TRUSTED_COHERENCE = 0.9
DRIVEN_SHARE = 1e-3
"""Share of the floor's largest density below which its leakage, not its motion, is measured."""
PROMINENCE = 0.05
"""Share of a peak by which the lines on either side of it must fall before one of them is not trusted."""


def trusted_part(result: Transmissibility, source: NDArray[np.float64], sample_rate: float) -> NDArray[np.bool_] | None:
    """Mask [frequencies] of a response where it is coherent and its ``source`` [m/s^2], sampled at
    ``sample_rate`` [Hz], moves enough; None for a source at rest.
    """
    shown = band(result.frequency) & np.isfinite(result.magnitude)
    if not shown.any():
        return None
    driven = power_density(source, sample_rate).density
    found: NDArray[np.bool_] = (
        shown & (result.coherence >= TRUSTED_COHERENCE) & (driven >= DRIVEN_SHARE * driven[shown].max())
    )
    return found


def transmissibility_curve(signals: RideSignals) -> Curve | None:
    """T(f) up to 80 Hz, nan where it cannot be trusted, with the spread of each line; None for a floor at rest."""
    way = transmissibility(signals.floor, signals.seat, signals.sample_rate)
    trusted = trusted_part(way, signals.floor, signals.sample_rate)
    if trusted is None:
        return None
    inside = band(way.frequency)
    values = np.where(trusted, way.magnitude, np.nan)
    return Curve("Hz", way.frequency[inside], values[inside], way.spread[inside])


def peak_of(result: Transmissibility, trusted: NDArray[np.bool_]) -> tuple[float, float] | None:
    """Magnitude of the peak and its frequency [Hz]: the largest line of those ``trusted``
    [frequencies], from which trusted neighbours fall by `PROMINENCE` on either side; None where the
    peak may lie beside the trusted lines, or all are about equal.
    """
    if not trusted.any():
        return None
    place = int(np.flatnonzero(trusted)[result.magnitude[trusted].argmax()])
    magnitude = float(result.magnitude[place])
    for side in (slice(place, None), slice(place, None, -1)):
        # Trusted lines without a gap.
        run = result.magnitude[side][np.logical_and.accumulate(trusted[side])]
        if run.min() > (1.0 - PROMINENCE) * magnitude:
            return None
    return magnitude, float(result.frequency[place])
