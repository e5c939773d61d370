"""Numbers of the summary on a rigid body over the ground."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact_sim_pkg.report.series import ContactSeries, MotionSeries, Recording

BLOCK = "block"
"""Name of the contact."""

REST_SPEED = 1.0e-12
"""In [m/s] and [rad/s]: a slower body rests. The scheme `stepping` leaves its rounding, some 1e-17,
where one has come to rest.
"""


def block_numbers(recording: Recording) -> dict[str, Any]:
    """Section `block` of the summary; none without motion.

    Runs of samples in contact, largest impulse of one, when the body moved last, where it ends;
    speeds at the end.
    """
    contact, moving = recording.contacts.get(BLOCK), recording.motion
    if contact is None or moving is None:
        return {}
    bursts = _bursts(contact)
    moves = np.flatnonzero(np.any([np.abs(values) > REST_SPEED for values in moving.velocity.values()], axis=0))
    # at rest: nothing moves in the last sample
    resting = len(moves) == 0 or moves[-1] < len(moving.time) - 1
    numbers = {
        "contacts": len(bursts),
        "impulse_max_Ns": max(bursts, default=0.0),
        "impulse_total_Ns": float(contact.normal.sum()) * contact.sample_period,
        "at_rest_from_s": _rest(moving, moves) if resting else None,
        "end": {name: float(values[-1]) for name, values in moving.position.items()},
        "end_velocity": {name: float(values[-1]) for name, values in moving.velocity.items()},
    }
    return {"block": numbers}


def _rest(moving: MotionSeries, moves: NDArray[np.intp]) -> float:
    """Instant in [s] of the first sample after the last move."""
    return float(moving.time[moves[-1]] + moving.sample_period) if len(moves) else float(moving.time[0])


def _bursts(contact: ContactSeries) -> list[float]:
    """Normal impulse in [N s] of each run of samples with a force."""
    carries = np.concatenate([[False], contact.normal > 0.0, [False]])
    edges = np.flatnonzero(np.diff(carries.astype(np.int8)))
    sums = np.concatenate([[0.0], np.cumsum(contact.normal)]) * contact.sample_period
    return [float(sums[last] - sums[first]) for first, last in edges.reshape(-1, 2)]
