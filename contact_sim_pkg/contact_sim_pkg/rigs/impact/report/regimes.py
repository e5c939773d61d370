"""What the scenes of a sphere that strikes a sample expect: blows, flights, rest, a sample that softens."""

from __future__ import annotations

import math

import numpy as np

from contact_sim_pkg.records.messages import ImpactEvents
from contact_sim_pkg.records.regime import Figure
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.rigs.impact.report.series import impacts_of

NO_BLOW = Figure(math.nan, "no impact ended in the run")


def blows(recording: Recording) -> Figure:
    """Number of impacts."""
    events = _events(recording)
    return NO_BLOW if events is None else Figure(float(len(events.number)))


def brief_contacts(recording: Recording) -> Figure:
    """Longest contact over the flight behind it; no value without a second impact."""
    events = _events(recording)
    if events is None or len(events.number) < 2:
        return Figure(math.nan, "fewer than two impacts ended in the run")
    share = events.duration[:-1] / (events.start[1:] - events.end[:-1])
    longest = int(share.argmax())
    return Figure(float(share[longest]), f"contact of {1e6 * events.duration[longest]:.4g} µs")


def decay(recording: Recording) -> Figure:
    """Largest speed [m/s] in the last tenth of the run, over the speed of the first impact."""
    events, motion = _events(recording), recording.motion
    if events is None or motion is None:
        return NO_BLOW
    (speed,) = motion.velocity.values()
    last = np.abs(speed[motion.time >= 0.9 * recording.duration])
    return Figure(float(last.max() / events.speed[0]), f"after {len(events.number)} impacts")


def softening(recording: Recording) -> Figure:
    """Contact time at the highest temperature over that at the lowest, at equal speed; no value at one temperature."""
    events = _events(recording)
    if events is None:
        return NO_BLOW
    slow = np.isclose(events.speed, events.speed[0], rtol=1e-3)
    warm, cold = (slow & (events.temperature == end) for end in (events.temperature.max(), events.temperature.min()))
    if events.temperature.max() == events.temperature.min():
        return Figure(math.nan, "every impact has the same temperature")
    span = f"{events.temperature.min():g} to {events.temperature.max():g} K"
    if not warm.any() or not cold.any():
        return Figure(math.nan, f"no two impacts of the same speed at {span}")
    return Figure(float(np.median(events.duration[warm]) / np.median(events.duration[cold])), span)


def _events(recording: Recording) -> ImpactEvents | None:
    found = impacts_of(recording)
    return None if found is None else found.events
