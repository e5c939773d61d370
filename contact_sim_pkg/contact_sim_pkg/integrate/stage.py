"""A stage of a step: the rate of the rig at one part of it."""

from __future__ import annotations

from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.integrate.interface import rate
from contact_sim_pkg.integrate.time_map import place


@borrowing_kernel
def evaluate(rig, drive, mode, course, part, state, out):
    """Write the rate of ``state`` over the part of the step, at ``part`` of ``course``, into
    ``out``.
    """
    time, slope = place(course, part)
    rate(rig, drive, mode, time, state, out)
    for i in range(out.shape[0]):
        out[i] *= slope
