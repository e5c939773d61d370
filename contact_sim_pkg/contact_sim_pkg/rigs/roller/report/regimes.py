"""What the scenes of a roller expect: growing tilt, waves on the track, an ellipse that turns, yield, sound
acceleration of time.
"""

from __future__ import annotations

import math

import numpy as np

from contact_sim_pkg.records.regime import Figure
from contact_sim_pkg.report.ranges import FIRST_YIELD
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.rigs.roller.report.series import roller_of

NOTHING = Figure(math.nan, "no state of the roller was recorded")


def growth(recording: Recording) -> Figure:
    """Rate [1/s] at which tilt and yaw grow, from the motion itself: logarithm of their root mean square over the
    last tenth of the run over that of its second tenth, by the time between; the mean of each tenth is taken off.
    """
    roller = roller_of(recording)
    if roller is None or roller.time.size < 100:
        return NOTHING
    tenth = roller.time.size // 10
    first, last = (
        math.hypot(*(float(np.std(column[part])) for column in (roller.contact.tilt, roller.contact.yaw)))
        for part in (slice(tenth, 2 * tenth), slice(-tenth, None))
    )
    if first == 0.0 or last == 0.0:
        return Figure(math.nan, "the roller does not tilt")
    between = 0.1 * recording.duration * 8.0
    return Figure(math.log(last / first) / between, f"from {1e3 * first:.3g} to {1e3 * last:.3g} mrad")


def alternation(recording: Recording) -> Figure:
    """How often the long axis of the ellipse passes from one direction to the other."""
    roller = roller_of(recording)
    if roller is None:
        return NOTHING
    along_x = roller.contact.along_x > roller.contact.along_y
    changes = np.flatnonzero(along_x[1:] != along_x[:-1])
    instants = ", ".join(f"{roller.time[each + 1]:.3g}" for each in changes[:4])
    return Figure(float(changes.size), f"at {instants} s" if changes.size else "")


def waves(recording: Recording) -> Figure:
    """Height of the waves of the track at the end over that of the roughness that it began with."""
    roller = roller_of(recording)
    if roller is None or len(roller.tracks) < 2:
        return Figure(math.nan, "no track was recorded")
    first, last = roller.tracks[0], roller.tracks[-1]
    if first.range <= 0.0:
        return Figure(math.nan, "the track begins without waves")
    return Figure(last.range / first.range, f"{1e6 * last.range:.3g} µm after {last.cycles:.6g} cycles")


def acceleration(recording: Recording) -> Figure:
    """Largest relative error of the time acceleration among the intervals that are also ridden turn by turn."""
    roller = roller_of(recording)
    errors = [] if roller is None else [each.check_error for each in roller.tracks if each.checked > 0.0]
    known = [each for each in errors if math.isfinite(each)]
    return Figure(max(known), f"{len(known)} intervals") if known else Figure(math.nan, "no interval was checked")


def first_yield(recording: Recording) -> Figure:
    """Instant [s] from which the pressure exceeds first yield below the surface, 1.60 Y."""
    roller = roller_of(recording)
    strength = (recording.scene.get("roller") or {}).get("yield_strength")
    if roller is None or not strength:
        return NOTHING
    over = roller.contact.peak_pressure / (FIRST_YIELD * float(strength))
    places = np.flatnonzero(over > 1.0)
    if places.size == 0:
        return Figure(math.nan, f"pressure over first yield {over.max():.4g} at most")
    return Figure(float(roller.time[places[0]]), f"pressure over first yield {over.max():.4g} at most")
