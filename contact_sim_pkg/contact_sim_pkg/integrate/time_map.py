"""How a step runs through time: evenly, or in the root of the time beside an event, where the
motion is smooth in another variable.

Behind a touch the contact force grows with a power of the time since, ``t**(3/2)`` for Hertz, which
no step size makes smooth. In ``s = sqrt(t - t_event)`` all half powers are whole ones, so that a
step that is even in s keeps the order of the method (and other powers double their smoothness).
Contact ends as it begins, mirrored in time: the step that ends at an event slows down towards its
end in the same way. A step is a map of its part c in [0, 1] to time, and its stages are rates over
c.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from contact_sim_pkg.compiled.jit import borrowing_kernel


class TimeMap(NamedTuple):
    """``t = start + step c``, or ``t = event + (root + root_step c)**2`` where ``root_step`` > 0;
    mirrored: c (2 - c) for c.
    """

    start: float  # [s]
    step: float  # [s]
    event: float  # [s]
    root: float  # [s^(1/2)]
    root_step: float  # [s^(1/2)]
    ends_at_event: bool


@borrowing_kernel
def time_map(start, step, last_event, ends_at_event):
    """Map of a step from ``start``: even in the root of the time since ``last_event`` where that is
    less than the step.
    """
    since = start - last_event
    if 0.0 <= since < step:
        root = math.sqrt(since)
        return TimeMap(start, step, last_event, root, math.sqrt(since + step) - root, ends_at_event)
    return TimeMap(start, step, last_event, 0.0, 0.0, ends_at_event)


@borrowing_kernel
def place(course, part):
    """Time in [s] at ``part`` of the step, and its slope over the part."""
    slope = 1.0
    if course.ends_at_event:
        slope = 2.0 * (1.0 - part)
        part = part * (2.0 - part)
    if course.root_step > 0.0:
        root = course.root + course.root_step * part
        return course.event + root * root, slope * 2.0 * root * course.root_step
    return course.start + course.step * part, slope * course.step


@borrowing_kernel
def scaled_step(course, factor):
    """Step in [s] from the same start, ``factor`` times as long in the variable in which the step
    is even.
    """
    if course.root_step > 0.0:
        grown = factor * course.root_step
        return grown * (2.0 * course.root + grown)
    return factor * course.step


@borrowing_kernel
def following_step(course, factor):
    """Step in [s] from the end of this one, ``factor`` times as long in the variable in which the
    step is even.
    """
    if course.root_step > 0.0:
        grown = factor * course.root_step
        return grown * (2.0 * (course.root + course.root_step) + grown)
    return factor * course.step
