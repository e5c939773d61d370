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
