"""Numbers of the impacts of a run, and the material that they tell."""

from __future__ import annotations

from typing import Any

import numpy as np

from contact_sim_pkg.rigs.impact.material.errors import MaterialError
from contact_sim_pkg.rigs.impact.material.options import Options
from contact_sim_pkg.rigs.impact.material.reading import Impacts
from contact_sim_pkg.rigs.impact.material.report import MaterialReport, report_of
from contact_sim_pkg.rigs.impact.report.series import ImpactSeries


def impact_numbers(impacts: ImpactSeries) -> dict[str, Any]:
    """Count and extremes, and of the first hundred impacts start, speed, duration, restitution, depth, peak force."""
    e = impacts.events
    first = slice(0, 100)
    return {
        "count": len(e.number),
        "restitution_min": float(e.restitution.min()),
        "restitution_max": float(e.restitution.max()),
        "duration_min_s": float(e.duration.min()),
        "duration_max_s": float(e.duration.max()),
        "depth_max_m": float(e.depth.max()),
        "peak_force_max_N": float(e.peak_force.max()),
        "start_s": e.start[first].tolist(),
        "speed_m_s": e.speed[first].tolist(),
        "duration_s": e.duration[first].tolist(),
        "restitution": e.restitution[first].tolist(),
        "depth_m": e.depth[first].tolist(),
        "peak_force_N": e.peak_force[first].tolist(),
        "temperature_K": e.temperature[first].tolist(),
        "storage_modulus_Pa": e.storage_modulus[first].tolist(),
        "loss_tangent": e.loss_tangent[first].tolist(),
    }


def material_of_run(impacts: ImpactSeries, scene: dict[str, Any]) -> MaterialReport | None:
    """E' and tan(beta) from what the gauges measured; None where they tell none."""
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
