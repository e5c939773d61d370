"""Curves of a run that are compared: load over time of each contact, and what its rigs add."""

from __future__ import annotations

from collections.abc import Sequence

from contact_sim_pkg.compare.side_by_side import Compared, Curve
from contact_sim_pkg.records.metric import Metric
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
    """A run as it is compared, under the ``name`` of its bag, its metrics judged by ``requirements``: its list, and what
    its rigs add where runs are compared.
    """
    added: list[Metric] = [
        metric for report in reports_of(recording) if report.compared for metric in load(report.compared)(recording)
    ]
    listed = {each.key: each for each in (*added, *metrics_of(recording))}
    return Compared(
        name, required([*listed.values()], requirements), curves_of(recording), leading=[each.key for each in added]
    )
