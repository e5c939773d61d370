"""Where an event function of the rig changes its sign within a step.

Source: Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, II.6.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.integrate.interface import event_functions, event_functions_need_rate, rate
from contact_sim_pkg.integrate.step import error_of_step, state_inside, take_step
from contact_sim_pkg.integrate.time_map import place, time_map

# Event functions are evaluated at 1/5 ... 4/5 of a step on which one may come near zero
INSIDE_POINTS = 4
# A trial step with a larger error over the allowed one is not worth looking for events
STRADDLING_ERROR = 1.0e4
LOCATE_ITERATIONS = 60
INTERPOLATED_ITERATIONS = 12
NEARBY = 1.0e-7  # part of the step over which the slope of an event function is taken


class EventSearch(NamedTuple):
    """Steps among which the one to an event is searched for."""

    start: float  # [s]
    inner: float  # [s] step after which no event function has changed its sign
    guess: float  # [s] step to try first
    outer: float  # [s] longest step


@borrowing_kernel
def _event_values_inside(rig, drive, mode, course, part, state, work):
    """Event functions at ``part`` of the step just taken into ``work.event_inside``, from the
    interpolated state.
    """
    time, _slope = place(course, part)
    state_inside(course, part, state, work)
    if event_functions_need_rate(rig, mode):
        rate(rig, drive, mode, time, work.inside, work.inside_rate)
    event_functions(rig, drive, mode, time, work.inside, work.inside_rate, work.event_inside)


@borrowing_kernel
def _farthest_beyond(value, direction):
    """Number of the event function that lies farthest beyond its sign; -1 where none does."""
    event = -1
    lowest = 0.0
    for j in range(direction.shape[0]):
        signed = value[j] * direction[j]
        if signed < lowest:
            lowest = signed
            event = j
    return event


@borrowing_kernel
def _stays_clear(work):
    """Whether parabolas through start, middle and end of a step keep away from zero by three times
    their sagitta.
    """
    for j in range(work.event_direction.shape[0]):
        start, middle, end = work.event_before[j], work.event_inside[j], work.event_value[j]
        sagitta = 0.125 * abs(start - 2.0 * middle + end)
        if (
            not min(start * work.event_direction[j], middle * work.event_direction[j], end * work.event_direction[j])
            > 4.0 * sagitta
        ):
            return False
    return True


@borrowing_kernel
def bracket_of_change(rig, drive, mode, course, error, state, work):
    """Parts of the step just taken between which an event function is seen to change its sign; 0, 0
    where none does.

    Where the ``error`` is above the allowed one, the states inside are not accurate, and only the
    end is examined.
    """
    if not error < STRADDLING_ERROR:
        return 0.0, 0.0
    event_functions(rig, drive, mode, course.start + course.step, work.trial, work.rate_after, work.event_value)
    changed = _farthest_beyond(work.event_value, work.event_direction) >= 0
    if error > 1.0:
        return 0.0, 1.0 if changed else 0.0
    return _bracket_inside(rig, drive, mode, course, changed, state, work)


@borrowing_kernel
def _bracket_inside(rig, drive, mode, course, changed, state, work):
    """Neighbours of 0, 1/5 ... 4/5, 1 of the step between which an event function first changes its
    sign; 0, 0 where none does.

    ``changed``: whether one has at the end of the step.
    """
    _event_values_inside(rig, drive, mode, course, 0.5, state, work)
    if _stays_clear(work):
        return 0.0, 0.0
    before = 0.0
    for point in range(1, INSIDE_POINTS + 1):
        part = point / (INSIDE_POINTS + 1.0)
        _event_values_inside(rig, drive, mode, course, part, state, work)
        if _farthest_beyond(work.event_inside, work.event_direction) >= 0:
            return before, part
        before = part
    return (before, 1.0) if changed else (0.0, 0.0)


@borrowing_kernel
def _interpolated_change(rig, drive, mode, course, bracket, state, work):
    """Part of the step at which the event function that has changed at the end of ``bracket`` is
    zero.

    From the interpolated states; also the number of that function.
    """
    low, high = bracket
    # Event function that has changed, and its value at the upper end.
    event = -1
    if high < 1.0:
        _event_values_inside(rig, drive, mode, course, high, state, work)
        event = _farthest_beyond(work.event_inside, work.event_direction)
        high_value = work.event_inside[event] * work.event_direction[event]
    else:
        event = _farthest_beyond(work.event_value, work.event_direction)
        high_value = work.event_value[event] * work.event_direction[event]
    # Regula falsi on the interpolated states.
    low_value = numpy.nan
    middle = 0.5 * (low + high)
    for _ in range(INTERPOLATED_ITERATIONS):
        _event_values_inside(rig, drive, mode, course, middle, state, work)
        value = work.event_inside[event] * work.event_direction[event]
        if value <= 0.0:
            high, high_value = middle, value
        else:
            low, low_value = middle, value
        if high - low < 1.0e-3:
            break
        middle = 0.5 * (low + high)
        if low_value > 0.0:
            middle = low + (high - low) * low_value / (low_value - high_value)
            middle = min(max(middle, low + 4.0e-4), high - 4.0e-4)
    return middle, event


@borrowing_kernel
def guess_of_change(rig, drive, mode, course, bracket, state, work):
    """Step in [s] after which an event function passes zero, by the interpolated states of the step
    just taken.
    """
    change, event = _interpolated_change(rig, drive, mode, course, bracket, state, work)
    return place(course, change)[0] - course.start, event


@borrowing_kernel
def _correction(rig, drive, mode, end, step, event, work):
    """Change of the step in [s] that brings event function ``event`` to zero, by its slope right
    before the step's ``end``.

    NaN where it does not fall there: it has jumped, and the change lies before.
    """
    back = NEARBY * step
    for i in range(work.trial.shape[0]):
        work.inside[i] = work.trial[i] - back * work.rate_after[i]
    if event_functions_need_rate(rig, mode):
        rate(rig, drive, mode, end - back, work.inside, work.inside_rate)
    event_functions(rig, drive, mode, end - back, work.inside, work.inside_rate, work.event_inside)
    slope = (work.event_value[event] - work.event_inside[event]) / back
    if slope * work.event_direction[event] < 0.0:
        return -work.event_value[event] / slope
    return numpy.nan


@borrowing_kernel
def _nearest(work):
    """Event function that lies farthest beyond its sign, or nearest to zero; and whether it has
    changed, as zero has.
    """
    event = 0
    value = numpy.inf
    for j in range(work.event_direction.shape[0]):
        signed = work.event_value[j] * work.event_direction[j]
        if signed < value:
            value = signed
            event = j
    return event, value <= 0.0


@borrowing_kernel
def locate(rig, drive, mode, search, state, scale, work):
    """Shortest whole step after which an event function has changed its sign, within ``search``.

    Newton's method on whole steps, bisection where it leaves the bracket. The step found ends just
    beyond the change, and its result is in ``work.trial``. Returns the step and the number of the
    event, -1 where none changes up to ``search.outer``. Where the error of the first step is too
    large, that one is returned.
    """
    time, low, step, outer = search
    high = outer
    seen = False  # whether a change before ``high`` has been seen on whole steps
    for iteration in range(LOCATE_ITERATIONS):
        course = time_map(time, step, work.last_event[0], True)
        take_step(rig, drive, mode, course, state, work)
        event_functions(rig, drive, mode, time + step, work.trial, work.rate_after, work.event_value)
        event, changed = _nearest(work)
        resolution = max(4.0e-16 * (abs(time) + step), 1.0e-14 * outer)
        if iteration == 0 and not error_of_step(course, scale, work) <= 1.0:
            return step, event
        correction = _correction(rig, drive, mode, time + step, step, event, work)
        if changed:
            high = step
            seen = True
            if abs(correction) <= resolution or high - low <= resolution:
                return step, event
        else:
            low = step
            if step == outer:
                return step, -1
        step += correction + 0.5 * resolution
        if high - low <= resolution or (not seen and not step < high):
            step = high
        elif not low < step < high or iteration % 4 == 3:
            step = 0.5 * (low + high)
    take_step(rig, drive, mode, time_map(time, high, work.last_event[0], True), state, work)
    event_functions(rig, drive, mode, time + high, work.trial, work.rate_after, work.event_value)
    return high, _nearest(work)[0]
