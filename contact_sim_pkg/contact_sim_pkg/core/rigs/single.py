"""Compiled entries of the one-mass rigs: integrate from event to event or over a time, for tests and studies."""

from __future__ import annotations

from typing import Any

import numpy

from ..jit import entry, kernel, kernel_overload
from ..parameters import Drive, ImpactWorks, Modes, PointContact, Vector
from ..solvers.dormand_prince import Workspace, integrate, set_sides
from ..vectors import copy_row
from . import belt_slider, impact_works, point_contact

__all__ = ["belt_slider", "empty_mode", "impact_works", "longest_piece", "point_contact", "run"]


def longest_piece(rig: Any) -> float:
    """Longest stretch in [s] that is integrated at once: in free flight no error bounds a step, only the support does."""
    if isinstance(rig, ImpactWorks):
        return longest_piece(rig.contact)
    return point_contact.longest_piece(rig) if isinstance(rig, PointContact) else numpy.inf


@kernel_overload(longest_piece)
def _longest_piece(rig):
    if getattr(rig, "instance_class", None) is PointContact:
        return lambda rig: point_contact.longest_piece(rig)
    if getattr(rig, "instance_class", None) is ImpactWorks:
        return lambda rig: point_contact.longest_piece(rig.contact)
    return lambda rig: numpy.inf


@kernel
def _run_piecewise(rig, mode, start, end, state, scale, work):
    pieces = max(1, int(numpy.ceil((end - start) / longest_piece(rig))))
    status = 0
    for i in range(pieces):
        first = start + (end - start) * i / pieces
        last = end if i + 1 == pieces else start + (end - start) * (i + 1) / pieces
        drive = Drive(first, last - first, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
        status = integrate(rig, drive, mode, last, state, scale, work)
        if status != 0:
            break
    return status


@entry
def run(rig: Any, mode: Modes, state: Vector, scale: Vector, work: Workspace, times: Vector, out: Vector) -> int:
    """Integrate ``rig`` from ``times[0]`` through all ``times`` in [s]; row i of ``out`` is the state at ``times[i]``.

    ``rig``: any that is registered (``rigs/interface.py``). ``state`` [states] is the start and changes in place; ``scale``
    [states] the error allowed per step. Returns the status of ``core/results.py``; rows after a failure keep what they held.
    """
    drive = Drive(times[0], times[-1] - times[0], 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    set_sides(rig, drive, mode, times[0], state, work)
    copy_row(state, out[0])
    status = 0
    for i in range(times.shape[0] - 1):
        status = _run_piecewise(rig, mode, times[i], times[i + 1], state, scale, work)
        if status != 0:
            return status
        copy_row(state, out[i + 1])
    return status


def empty_mode() -> Modes:
    """Mode array of a rig with one friction contact, sticking."""
    return numpy.zeros(1, dtype=numpy.int64)
