"""Numbers of the roller in the summary."""

from __future__ import annotations

from typing import Any

import numpy as np

from contact_sim_pkg.records.messages import RollerTrack
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.rigs.roller.forecast import stability_facts
from contact_sim_pkg.rigs.roller.report.series import RollerSeries, roller_of
from contact_sim_pkg.rigs.roller.report.tables import volume_facts


def summary_numbers(recording: Recording) -> dict[str, Any]:
    """Section `roller`; none where the bag holds no state of the roller."""
    roller = roller_of(recording)
    return {} if roller is None else {"roller": roller_numbers(roller)}


def roller_numbers(roller: RollerSeries) -> dict[str, Any]:
    """Largest pressure, stability as known before the run, track at the end, dangerous volumes;
    what the run lacks is absent.
    """
    numbers: dict[str, Any] = {
        "peak_pressure_max_Pa": float(roller.contact.peak_pressure.max()),
        "tilt_max_rad": float(abs(roller.contact.tilt).max()),
        "yaw_max_rad": float(abs(roller.contact.yaw).max()),
    }
    if roller.stability:
        numbers["stability"] = [stability_facts(each) for each in roller.stability]
    if roller.tracks:
        bodies = dict.fromkeys(each.body for each in roller.tracks)
        numbers["tracks"] = [_track_numbers([each for each in roller.tracks if each.body == body]) for body in bodies]
    if roller.volumes:
        numbers["dangerous_volumes"] = [volume_facts(each) for each in roller.volumes]
    return numbers


def _track_numbers(tracks: list[RollerTrack]) -> dict[str, Any]:
    """One body's track at the end, and how far the time acceleration was from every turn ridden."""
    last, errors = tracks[-1], [each.check_error for each in tracks if each.checked > 0.0]
    return {
        "body": last.body, "turns": last.turns, "cycles": last.cycles, "time_acceleration": last.cycles / last.turns,
        "load_max_N": max(float(each.load.max()) for each in tracks), "range_m": last.range,
        "lowered_m": last.lowered, "free_share_last": last.free,
        "waves": int(np.abs(np.fft.rfft(last.height))[1:].argmax()) + 1,
        "time_acceleration_errors": [error if np.isfinite(error) else None for error in errors],
    }  # fmt: skip
