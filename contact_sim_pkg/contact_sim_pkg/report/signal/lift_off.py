"""When a contact carries no load."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from contact_sim_pkg.report.series import ContactSeries


def lifted_intervals(contact: ContactSeries) -> NDArray[np.float64]:
    """Start and end [s] of each interval without load, [intervals, 2]; it ends at the first sample
    with load again.
    """
    separated = np.concatenate([[False], contact.normal <= 0.0, [False]])
    changes = np.flatnonzero(separated[1:] != separated[:-1]).reshape(-1, 2)
    ends = np.append(contact.time, contact.time[-1] + contact.sample_period)
    intervals: NDArray[np.float64] = ends[changes]
    return intervals
