"""Curves of a run that are compared: load over time of each contact, and what its rigs add."""

from __future__ import annotations

from collections.abc import Sequence

from contact_sim_pkg.compare.side_by_side import Compared, Curve
from contact_sim_pkg.records.rig import load
from contact_sim_pkg.report.metrics.listing import metrics_of
from contact_sim_pkg.report.metrics.requirements import Requirement, required
from contact_sim_pkg.report.rig_reports import reports_of
from contact_sim_pkg.report.series import Recording

__all__ = ["compared", "curves_of"]


def curves_of(recording: Recording) -> dict[str, Curve]:
    """By name: `tire.load`, `seat.transmissibility`."""
    found = {f"{name}.load": Curve("s", each.time, each.normal) for name, each in recording.contacts.items()}
    for report in reports_of(recording):
        if report.curves:
            found |= load(report.curves)(recording)
    return found


def compared(name: str, recording: Recording, requirements: Sequence[Requirement] = ()) -> Compared:
    """A run as it is compared, under the ``name`` of its bag, its metrics judged by ``requirements``."""
    return Compared(name, required(metrics_of(recording), requirements), curves_of(recording))
