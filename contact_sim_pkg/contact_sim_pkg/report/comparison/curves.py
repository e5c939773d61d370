"""A run as it is compared: its metrics, what its rigs add to them, and its curves."""

from __future__ import annotations

from collections.abc import Sequence

from contact_sim_pkg.compare.side_by_side import Compared
from contact_sim_pkg.records.metric import Metric
from contact_sim_pkg.records.rig import load
from contact_sim_pkg.report.curves import curves_of
from contact_sim_pkg.report.metrics.curve_bands import beyond_bands
from contact_sim_pkg.report.metrics.listing import metrics_of
from contact_sim_pkg.report.metrics.requirements import Requirement, bands_of, required
from contact_sim_pkg.report.rig_reports import reports_of
from contact_sim_pkg.report.series import Recording

__all__ = ["compared"]


def compared(name: str, recording: Recording, requirements: Sequence[Requirement] = ()) -> Compared:
    """A run as it is compared, under the ``name`` of its bag, its metrics judged by ``requirements``: its list, and what
    its rigs add where runs are compared.
    """
    added: list[Metric] = [
        metric for report in reports_of(recording) if report.compared for metric in load(report.compared)(recording)
    ]
    listed = {
        each.key: each for each in (*added, *metrics_of(recording), *beyond_bands(recording, bands_of(requirements)))
    }
    return Compared(
        name, required([*listed.values()], requirements), curves_of(recording), leading=[each.key for each in added]
    )
