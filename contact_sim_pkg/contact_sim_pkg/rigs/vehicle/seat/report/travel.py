"""Travel of a seat suspension in a recording."""

from __future__ import annotations

from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.rigs.vehicle.travel_report import Travel, heights_of, keys_of, travel_of

__all__ = ["seat_travel"]


def seat_travel(recording: Recording) -> Travel | None:
    """Of a seat suspension, 0 at mid-travel; None without one."""
    keys, heights = keys_of(recording, "seat", "suspension"), heights_of(recording)
    if keys is None or "suspension_z" not in heights:
        return None
    half, floor = 0.5 * float(keys["travel"]), heights.get("body_z", 0.0)
    return travel_of(recording, "seat", "suspension", heights["suspension_z"] - floor, (-half, half))
