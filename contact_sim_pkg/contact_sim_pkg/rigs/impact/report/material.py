"""E' and tan(beta) as `bench material` reads them from the impacts of a run."""

from __future__ import annotations

from typing import Any

import numpy as np

from contact_sim_pkg.rigs.impact.material.errors import MaterialError
from contact_sim_pkg.rigs.impact.material.options import Options
from contact_sim_pkg.rigs.impact.material.reading import Impacts
from contact_sim_pkg.rigs.impact.material.report import MaterialReport, report_of
from contact_sim_pkg.rigs.impact.report.series import ImpactSeries


def material_of_run(impacts: ImpactSeries, scene: dict[str, Any]) -> MaterialReport | None:
    """E' and tan(beta) from what the gauges measured; None where they determine none."""
    e = impacts.events
    loss = ((scene.get("effects") or {}).get("impact") or {}).get("normal_dissipative") or {}
    options = Options(
        end=str(loss.get("end", "force")), shape=str((scene.get("impact") or {}).get("shape_factor", "small"))
    )
    measured = Impacts(
        "bag", e.number.astype(np.int64), e.mass, e.radius, e.measured_speed, e.measured_duration,
        e.measured_restitution, e.temperature, (), e.gravity if e.gravity.any() else None,
    )  # fmt: skip
    try:
        return report_of(measured, options)
    except MaterialError:
        return None
