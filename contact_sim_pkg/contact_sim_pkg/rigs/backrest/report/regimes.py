"""What the scenes of a back expect: that it slaps, slips while it keeps contact, or is struck."""

from __future__ import annotations

import math

from contact_sim_pkg.records.regime import Figure
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.rigs.backrest.report.numbers import BACKREST


def slaps(recording: Recording) -> Figure:
    """Number of contacts that began with a touch and ended in the run."""
    if recording.episodes is None:
        return Figure(math.nan, "no episodes were recorded")
    found = recording.episodes.slaps()
    return Figure(float(found.point.size), f"restitution {found.restitution.mean():.3g}" if found.point.size else "")


def struck(recording: Recording) -> Figure:
    """Largest load over that at the first instant."""
    contact = recording.contacts.get(BACKREST)
    if contact is None or not contact.normal[0] > 0.0:
        return Figure(math.nan, "the back does not lean on the seat back at the start")
    low, high = float(contact.normal.min()), float(contact.normal.max())
    return Figure(high / float(contact.normal[0]), f"{low:.4g} to {high:.4g} N")


def slipping(recording: Recording) -> Figure:
    """Share [%] of the time in which a point slips; no value where contact is lost."""
    points, contact = recording.points, recording.contacts.get(BACKREST)
    if points is None or contact is None:
        return Figure(math.nan, "no points were recorded")
    if (contact.normal <= 0.0).any():
        return Figure(math.nan, "contact is lost")
    return Figure(100.0 * float(points.slipping.mean()) / points.points, "in contact all along")
