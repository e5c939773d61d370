"""What the scenes of a tire expect: a locked wheel, a belt that rings, a shaken load, Hertz's ellipse, a footprint
in pieces, asperities that push.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from contact_sim_pkg.records.regime import Figure
from contact_sim_pkg.report.series import FieldSeries, Recording
from contact_sim_pkg.rigs.vehicle.tire.report.axle_series import axle_of
from contact_sim_pkg.rigs.vehicle.tire.report.metrics import ringing_of
from contact_sim_pkg.rigs.vehicle.tire.report.numbers import TIRE, standing_load_of
from contact_sim_pkg.rigs.vehicle.tire.report.shear_series import MOSTLY, shear_of

STANDING_RANGE = 0.1
"""Share of the standing load by which the load may differ where the standing tire is meant."""
LOCKED = -0.999
"""Slip of a wheel that hardly turns."""


def shaking(recording: Recording) -> Figure:
    """Standard deviation of the load over the standing load: the dynamic load coefficient."""
    contact, standing = recording.contacts.get(TIRE), standing_load_of(recording.scene)
    if contact is None or standing is None:
        return Figure(math.nan, "no load was recorded")
    normal = contact.normal
    return Figure(float(normal.std()) / standing, f"{normal.min():.4g} to {normal.max():.4g} N")


def locking(recording: Recording) -> Figure:
    """Time [s] in which the wheel does not turn and the whole footprint slides."""
    shear = shear_of(recording)
    if shear is None or shear.time.size < 2:
        return Figure(math.nan, "no friction was recorded")
    locked = (shear.slip <= LOCKED) & (shear.sliding_share >= MOSTLY)
    first = f"from {shear.time[locked][0]:.4g} s" if locked.any() else f"slip {shear.slip.min():.3g} at the least"
    return Figure(float(locked.sum() * np.median(np.diff(shear.time))), first)


def ringing(recording: Recording) -> Figure:
    """Frequency [Hz] of the force along the road behind its largest value; no value where that is not followed by a
    force the other way.
    """
    axle = axle_of(recording)
    found = None if axle is None else ringing_of(axle)
    if axle is None or found is None:
        return Figure(math.nan, "no force along the road rings in the run")
    low, high = float(axle.longitudinal.min()), float(axle.longitudinal.max())
    if low >= 0.0 or high <= 0.0:
        return Figure(math.nan, f"it does not change its direction: {low:.4g} to {high:.4g} N")
    return Figure(found, f"{low:.4g} to {high:.4g} N")


def ellipse(recording: Recording) -> Figure:
    """Exponent of the Lame curve through the border of the footprint, its median about the standing load: 2 for an
    ellipse.
    """
    about = _about_standing(recording)
    if about is None:
        return Figure(math.nan, "no footprint about the standing load")
    field, chosen = about
    peak = float(np.median(field.peak[chosen] / field.mean[chosen]))
    return Figure(float(np.median(field.lame_n[chosen])), f"peak over mean pressure {peak:.3g}, Hertz 1.5")


def unevenness(recording: Recording) -> Figure:
    """Peak over mean pressure, its median about the standing load: 1.5 in Hertz's ellipse, nearly 1 in a tire on an
    even road.
    """
    about = _about_standing(recording)
    if about is None:
        return Figure(math.nan, "no footprint about the standing load")
    field, chosen = about
    share = float(np.median(field.area[chosen] / (field.length[chosen] * field.width[chosen])))
    return Figure(
        float(np.median(field.peak[chosen] / field.mean[chosen])), f"{100.0 * share:.3g} % of its length by width"
    )


def _about_standing(recording: Recording) -> tuple[FieldSeries, NDArray[np.bool_]] | None:
    """Field, and which of its instants [fields] carry about the standing load; None where none does."""
    field, standing = recording.fields.get(TIRE), standing_load_of(recording.scene)
    if field is None or standing is None:
        return None
    chosen = np.abs(field.load - standing) <= STANDING_RANGE * standing
    return (field, chosen) if chosen.any() else None


def pushing(recording: Recording) -> Figure:
    """Largest force of the road's asperities over the standing load."""
    contact, standing = recording.contacts.get(TIRE), standing_load_of(recording.scene)
    if contact is None or standing is None or not contact.impulses.size:
        return Figure(math.nan, "no asperities pushed")
    largest = float(contact.impulses.max())
    return Figure(largest / standing, f"{largest:.4g} N of {standing:.4g} N")
