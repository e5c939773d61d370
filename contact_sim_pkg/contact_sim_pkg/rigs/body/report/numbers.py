"""What the motion and the force of a rigid body over the ground are summed up by."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from contact_sim_pkg.report.series import ContactSeries, MotionSeries

BLOCK = "block"
"""Name of the contact."""

REST_SPEED = 1.0e-12
"""In [m/s] and [rad/s]: a slower body rests: rounding may leave some 1e-17 where one has come to rest.
"""


def rest_from(motion: MotionSeries) -> float | None:
    """Instant in [s] of the first sample after the last move; None where it moves in the last one."""
    moves = np.flatnonzero(np.any([np.abs(values) > REST_SPEED for values in motion.velocity.values()], axis=0))
    if len(moves) == 0:
        return float(motion.time[0])
    return float(motion.time[moves[-1]] + motion.sample_period) if moves[-1] < len(motion.time) - 1 else None


class Burst(NamedTuple):
    """A run of samples with a force."""

    start: float
    """[s]"""
    impulse: float
    """[N s], normal"""


def bursts(contact: ContactSeries, rests: float | None = None) -> list[Burst]:
    """Each run of samples with a force, up to the instant in [s] from which the body ``rests``: what it weighs after it
    is no impulse of an impact.
    """
    moving = np.ones(contact.time.size, bool) if rests is None else contact.time < rests - 0.5 * contact.sample_period
    carries = np.concatenate([[False], (contact.normal > 0.0) & moving, [False]])
    edges = np.flatnonzero(np.diff(carries.astype(np.int8)))
    sums = np.concatenate([[0.0], np.cumsum(contact.normal)]) * contact.sample_period
    return [Burst(float(contact.time[first]), float(sums[last] - sums[first])) for first, last in edges.reshape(-1, 2)]
