"""Compiled entries of the one-mass rigs: integrate from event to event or over a time, for tests
and studies.

Source: Driver and Seat eqs 7 to 11.
"""

from __future__ import annotations

from typing import Any

import numpy

from contact_sim_pkg.compiled.arrays import Modes, Vector
from contact_sim_pkg.compiled.jit import borrowing_kernel, entry
from contact_sim_pkg.compiled.vectors import copy_row
from contact_sim_pkg.integrate.drive import Drive
from contact_sim_pkg.integrate.root_steps import RootStepWorkspace, integrate, set_event_directions
from contact_sim_pkg.laws.one_mass import point_contact

__all__ = ["empty_mode", "point_contact", "run", "undriven"]


@borrowing_kernel
def undriven(start, end):
    """Segment from ``start`` to ``end`` in [s] in which nothing moves the rig."""
    return Drive(
        start=start,
        length=end - start,
        height_0=0.0,
        height_1=0.0,
        cushion_0=0.0,
        cushion_1=0.0,
        acceleration_x_0=0.0,
        acceleration_x_1=0.0,
        acceleration_z_0=0.0,
        acceleration_z_1=0.0,
    )


@entry
def run(
    rig: Any, mode: Modes, state: Vector, scale: Vector, work: RootStepWorkspace, times: Vector, out: Vector
) -> int:
    """Integrate ``rig`` from ``times[0]`` through all ``times`` in [s]; row i of ``out`` is the
    state at ``times[i]``.

    ``rig``: any that is registered (``integrate/interface.py``). ``state`` [states] is the start
    and changes in place; ``scale`` [states] the error allowed per step. Returns the status of
    ``compiled/results.py``; rows after a failure keep what they held.
    """
    drive = undriven(times[0], times[-1])
    set_event_directions(rig, drive, mode, times[0], state, work)
    copy_row(state, out[0])
    # One segment between two output times after the other; events do not end a segment
    status = 0
    for i in range(times.shape[0] - 1):
        drive = undriven(times[i], times[i + 1])
        status = integrate(rig, drive, mode, times[i + 1], state, scale, work)
        if status != 0:
            return status
        copy_row(state, out[i + 1])
    return status


def empty_mode() -> Modes:
    """Mode array of a rig with one friction contact, sticking."""
    return numpy.zeros(1, dtype=numpy.int64)
