"""Travel of a wheel between its bump stops in a recording."""

from __future__ import annotations

from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.rigs.vehicle.tire.report.numbers import standing_load_of
from contact_sim_pkg.rigs.vehicle.travel_report import Travel, heights_of, keys_of, travel_of

__all__ = ["wheel_travel"]


def wheel_travel(recording: Recording) -> Travel | None:
    """Of the body over the wheel, 0 at rest on the suspension's spring alone; None without bump stops."""
    keys, heights = keys_of(recording, "tire", "bump_stop"), heights_of(recording)
    load = standing_load_of(recording.scene)
    if keys is None or load is None or "wheel_z" not in heights:
        return None
    tire = recording.scene["tire"]
    sprung = load - float(tire["wheel_mass"]) * GRAVITY
    height = heights["body_z"] - heights["wheel_z"] + sprung / float(tire["suspension_stiffness"])
    return travel_of(recording, "tire", "wheel travel", height, (-float(keys["bump"]), float(keys["rebound"])))
