"""Curves of a run by name: load over time of each contact, and what its rigs add, such as a transmissibility."""

from __future__ import annotations

from contact_sim_pkg.compare.side_by_side import Curve
from contact_sim_pkg.records.rig import load
from contact_sim_pkg.report.rig_reports import reports_of
from contact_sim_pkg.report.series import Recording

__all__ = ["curves_of"]


def curves_of(recording: Recording) -> dict[str, Curve]:
    """By name: `tire.load`, `seat.transmissibility`."""
    found = {f"{name}.load": Curve("s", each.time, each.normal) for name, each in recording.contacts.items()}
    for report in reports_of(recording):
        if report.curves:
            found |= load(report.curves)(recording)
    return found
