"""The part of the page on a roller on its shaft; what the run lacks is absent. And its numbers of the summary."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from contact_sim_pkg.records.messages import RollerTrack
from contact_sim_pkg.report.drawing import Picture
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.report.tables import Table
from contact_sim_pkg.rigs.roller.forecast import stability_facts
from contact_sim_pkg.rigs.roller.report.figures import (
    contact_over_time,
    load_spectrogram,
    motion_over_time,
    stability_map,
    track_pictures,
)
from contact_sim_pkg.rigs.roller.report.figures_programme import programme_over_time
from contact_sim_pkg.rigs.roller.report.figures_stress import stress_pictures
from contact_sim_pkg.rigs.roller.report.series import RollerSeries
from contact_sim_pkg.rigs.roller.report.tables import stability_table, volume_facts, volume_tables
from contact_sim_pkg.rigs.roller.report.warnings import roller_warnings

ROLLER = "roller"
"""Name of the contact that this part belongs to."""


class RollerPart(NamedTuple):
    """Pictures and tables of one section."""

    key: str
    title: str
    pictures: list[Picture]
    tables: list[Table]


def roller_parts(recording: Recording) -> list[RollerPart]:
    """Call inside `drawing.style()`; empty where the bag holds no roller."""
    roller = recording.roller
    if roller is None:
        return []
    scene = recording.scene
    first = [
        programme_over_time(roller, scene), contact_over_time(roller), motion_over_time(roller), load_spectrogram(roller),
    ]  # fmt: skip
    stable, told = stability_map(roller, scene), stability_table(roller.stability, float(scene["block_length"]))
    return [
        RollerPart("roller", "Rolling contact", [each for each in first if each is not None], []),
        RollerPart("stability", "Stability of tilt and yaw", [stable] if stable else [], [told] if told else []),
        RollerPart("track", "Track", track_pictures(roller), []),
        RollerPart(
            "stress", "Stress and dangerous volumes", stress_pictures(roller, scene), volume_tables(roller.volumes)
        ),
    ]


def roller_numbers(roller: RollerSeries) -> dict[str, Any]:
    """Largest pressure, stability as told, track at the end, dangerous volumes; what the run lacks is absent."""
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
    if warned := roller_warnings(roller):
        numbers["warnings"] = warned
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
