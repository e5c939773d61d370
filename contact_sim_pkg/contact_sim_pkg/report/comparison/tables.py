"""Tables of a comparison: in which values of their scenes the runs differ, and their main numbers
side by side.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from contact_sim_pkg.report.comparison.figures import Run
from contact_sim_pkg.report.comparison.scene_differences import Difference
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.report.signal.episodes import durations, slaps_of
from contact_sim_pkg.report.signal.loops import area_ratio
from contact_sim_pkg.report.tables import Table
from contact_sim_pkg.report.tiles import number

NONE = "–"


def difference_table(recordings: Sequence[Recording], found: Sequence[Difference]) -> Table:
    """One row a run: its bag, and the values that are not the same in all scenes."""
    rows = [(each.name, *(one.values[place] for one in found)) for place, each in enumerate(recordings)]
    caption = "Values in which the scenes differ." if found else "The scenes are the same."
    return Table(caption, ("bag", *(one.key for one in found)), rows)


def number_table(runs: Sequence[Run], summaries: Sequence[dict[str, Any]]) -> Table:
    """One column a run; what no run has has no row."""
    rows: list[tuple[str, ...]] = []
    for name in runs[0].recording.contacts:
        rows += [
            (f"{name}: {label}", *(read(each["contacts"][name]) for each in summaries)) for label, read in _CONTACT
        ]
    rows += [(label, *(read(run) for run in runs)) for label, read in _EPISODES]
    scopes = {each.get("energy", {}).get("of", "") for each in summaries} - {""}
    of = f" ({', '.join(sorted(scopes))})" if scopes else ""
    rows += [(f"largest energy residual over throughput{of}", *(_residual(each) for each in summaries))]
    kept = [row for row in rows if any(value != NONE for value in row[1:])]
    return Table("Main numbers of the whole runs.", ("", *(run.label for run in runs)), kept)


def _number_of(key: str, factor: float = 1.0) -> Callable[[dict[str, Any]], str]:
    def read(contact: dict[str, Any]) -> str:
        value = contact.get(key)
        return NONE if value is None else number(value * factor)

    return read


_CONTACT = (
    ("load, mean, N", _number_of("load_mean_N")),
    ("load, largest, N", _number_of("load_max_N")),
    ("without load, %", _number_of("lifted_share", 100.0)),
    ("peak pressure, kPa", _number_of("peak_pressure_Pa", 1e-3)),
)


def _slap_count(run: Run) -> str:
    return NONE if run.recording.episodes is None else str(slaps_of(run.recording.episodes).start.size)


def _slap_restitution(run: Run) -> str:
    values = slaps_of(run.recording.episodes).restitution
    return f"{values.min():.4g} to {values.max():.4g}" if values.size else NONE


def _slap_duration(run: Run) -> str:
    lasted = durations(slaps_of(run.recording.episodes)) * 1e3
    return f"{lasted.min():.4g} to {lasted.max():.4g}" if lasted.size else NONE


def _largest_area(run: Run) -> str:
    if run.recording.episodes is None:
        return NONE
    areas = [area_ratio(field) for field in run.recording.fields.values()]
    return next((number(float(area.ratio.max())) for area in areas if area is not None), NONE)


_EPISODES = (
    ("largest area of the contact domain, S/S_ref", _largest_area),
    ("slaps", _slap_count),
    ("restitution", _slap_restitution),
    ("duration of a slap, ms", _slap_duration),
)


def _residual(summary: dict[str, Any]) -> str:
    value = summary.get("energy", {}).get("residual_relative")
    return NONE if value is None else number(value)
