"""Numbers of the impacts of a run in the summary, and the key numbers at the head of the page."""

from __future__ import annotations

from typing import Any

from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.report.tiles import Tile, number
from contact_sim_pkg.rigs.impact.report.series import ImpactSeries, impacts_of


def summary_numbers(recording: Recording) -> dict[str, Any]:
    """Section `impacts` of a run with impacts."""
    impacts = impacts_of(recording)
    return {} if impacts is None else {"impacts": impact_numbers(impacts)}


def impact_numbers(impacts: ImpactSeries) -> dict[str, Any]:
    """Count and extremes, and of the first hundred impacts start, speed, duration, restitution,
    depth, peak force.
    """
    e = impacts.events
    # A page lists no more than these.
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


def impact_tiles(summary: dict[str, Any]) -> list[Tile]:
    """Count, restitution, largest force and longest contact; none without impacts."""
    impacts = summary.get("impacts")
    if not impacts:
        return []
    span = f"restitution {number(impacts['restitution_min'])} to {number(impacts['restitution_max'])}"
    found = [Tile("impacts", str(impacts["count"]), "", span)]
    largest = f"depth {number(impacts['depth_max_m'] * 1e3)} mm"
    found.append(Tile("largest force of an impact", number(impacts["peak_force_max_N"]), "N", largest))
    longest = f"shortest {number(impacts['duration_min_s'] * 1e3)} ms"
    found.append(Tile("longest contact", number(impacts["duration_max_s"] * 1e3), "ms", longest))
    return found
