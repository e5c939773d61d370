"""The contact episodes of a run: each slap with its works, restitution, force and depth."""

from __future__ import annotations

from typing import Any

import numpy as np

from contact_sim_pkg.report.series import EpisodeSeries, FloatArray


def episode_series(columns: dict[str, Any]) -> EpisodeSeries:
    """Series from the columns of a topic, one row of each a message."""
    return EpisodeSeries(
        *(np.concatenate([np.zeros(0), *columns[name]]).astype(np.float64) for name in EpisodeSeries._fields)
    )


def slaps_of(episodes: EpisodeSeries | None) -> EpisodeSeries:
    """The slaps of the whole contact; none where the bag has no episodes."""
    return EpisodeSeries(*(np.zeros(0) for _ in EpisodeSeries._fields)) if episodes is None else episodes.slaps()


def durations(slaps: EpisodeSeries) -> FloatArray:
    """Durations [s] of slaps, from first contact to the last loss of force, [slaps]."""
    lasted: FloatArray = slaps.end - slaps.start
    return lasted


def slap_numbers(episodes: EpisodeSeries) -> dict[str, Any]:
    """Number of slaps, and of each: start and end [s], restitution, works [J], largest force [N]
    and approach [m].
    """
    slaps = episodes.slaps()
    count = len(slaps.start)
    return {
        "count": count,
        "restitution_mean": float(slaps.restitution.mean()) if count else None,
        "restitution_min": float(slaps.restitution.min()) if count else None,
        "restitution_max": float(slaps.restitution.max()) if count else None,
        "restitution": slaps.restitution.tolist(),
        "start_s": slaps.start.tolist(),
        "end_s": slaps.end.tolist(),
        "compression_work_J": slaps.compression_work.tolist(),
        "restitution_work_J": slaps.restitution_work.tolist(),
        "peak_force_N": slaps.peak_force.tolist(),
        "largest_approach_m": slaps.largest_approach.tolist(),
    }
