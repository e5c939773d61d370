"""Compiled entries of the one-mass rigs: integrate from event to event or over a time, for tests and studies."""

from __future__ import annotations

import numpy

from ..jit import entry
from ..parameters import Drive
from ..solvers.dormand_prince import integrate, set_sides
from . import belt_slider, point_contact

__all__ = ["belt_slider", "point_contact", "run"]


@entry
def run(rig, mode, state, scale, work, times, out):  # type: ignore[no-untyped-def]
    """Integrate ``rig`` from ``times[0]`` through all ``times`` in [s]; row i of ``out`` is the state at ``times[i]``.

    ``state`` [states] is the start and changes in place; ``scale`` [states] the error allowed per step. Returns the status of
    ``core/results.py``; rows after a failure keep what they held.
    """
    drive = Drive(times[0], times[-1] - times[0], 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    set_sides(rig, drive, mode, times[0], state, work)
    out[0, :] = state
    status = 0
    for i in range(times.shape[0] - 1):
        piece = Drive(times[i], times[i + 1] - times[i], 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
        status = integrate(rig, piece, mode, times[i + 1], state, scale, work)
        if status != 0:
            return status
        out[i + 1, :] = state
    return status


def empty_mode() -> numpy.ndarray:
    """Mode array of a rig with one friction contact, sticking."""
    return numpy.zeros(1, dtype=numpy.int64)
