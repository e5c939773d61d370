"""Dormand and Prince's pairs of orders 5 and 8 with steps even in the root of time beside events;
for the one-mass rigs.

Source: Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, sections 4, 5 and 10 of
chapter II. No step straddles an event: where an event function of the rig changes its sign within a
trial step, the step is taken again up to the change (``integrate/events.py``), so that the state at
the event has the order of the method. Beside an event a step is even in the root of the time from
it (``integrate/time_map.py``), where contact laws are smooth. A rig that crosses free flight in
closed form does so (``integrate/interface.py``).

Contacts repeat: the step that was right behind the last event of a kind is tried behind the next,
and where the last one could be reached in one step from, the next is.
"""

from __future__ import annotations

import numpy

from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.compiled.results import DONE, NOT_FINITE, STEP_TOO_SMALL, TOO_MANY_EVENTS
from contact_sim_pkg.integrate.events import EventSearch, bracket_of_change, guess_of_change, locate
from contact_sim_pkg.integrate.interface import event_functions, free_flight, mode_transition, rate
from contact_sim_pkg.integrate.step import error_of_step, power_of, take_step
from contact_sim_pkg.integrate.time_map import following_step, place, scaled_step, time_map
from contact_sim_pkg.integrate.workspace import COUNTERS, EVENTS, REJECTED, STEPS, RootStepWorkspace, make_workspace

__all__ = [
    "COUNTERS",
    "EVENTS",
    "REJECTED",
    "STEPS",
    "RootStepWorkspace",
    "integrate",
    "make_workspace",
    "set_event_directions",
]

MAXIMUM_EVENTS = 10_000
STATE_LIMIT = 1.0e10
SAFETY = 0.9
LEAST_FACTOR, LARGEST_FACTOR = 0.2, 5.0
# A longer step is rejected more often than not, measured on the seat slap
GROWTH_BESIDE_EVENT = 1.6
NO_EVENT, POSTPONED = -1, -2


@borrowing_kernel
def _set_directions(value, direction, but):
    """Write the sign of each event function but number ``but`` into ``direction``."""
    for j in range(direction.shape[0]):
        if j != but:
            direction[j] = 1.0 if value[j] >= 0.0 else -1.0


@borrowing_kernel
def set_event_directions(rig, drive, mode, time, state, work):
    """Store the sign of each event function; to be called once, at the start of a run."""
    rate(rig, drive, mode, time, state, work.rate_before)
    event_functions(rig, drive, mode, time, state, work.rate_before, work.event_before)
    _set_directions(work.event_before, work.event_direction, NO_EVENT)
    work.last_event[0] = -numpy.inf
    work.first_step[:] = 0.0
    work.reach[:] = 0.0


@borrowing_kernel
def _land(rig, drive, mode, time, state, event, work):
    """Store rate and event directions after a free flight.

    Not the direction of the event that ended it: that event is handled as any other.
    """
    rate(rig, drive, mode, time, state, work.rate_before)
    event_functions(rig, drive, mode, time, state, work.rate_before, work.event_before)
    _set_directions(work.event_before, work.event_direction, event)
    work.counters[STEPS] += 1


@borrowing_kernel
def _kind(event, direction):
    """An event's kind: which function changes, to which sign."""
    return 2 * event + (1 if direction > 0.0 else 0)


@borrowing_kernel
def _handle_event(rig, drive, mode, time, state, event, proposed, work):
    """Mode transition of the rig at event number ``event``, and the rate behind it; returns the
    step in [s] to try next.
    """
    work.counters[EVENTS] += 1
    kind = _kind(event, -work.event_direction[event])
    work.last_kind[0] = kind
    work.last_event[0] = time
    work.expected[0] = numpy.inf
    work.event_direction[event] = mode_transition(rig, drive, mode, time, state, event, -work.event_direction[event])
    work.event_before[event] = 0.0
    rate(rig, drive, mode, time, state, work.rate_before)
    return work.first_step[kind] if work.first_step[kind] > 0.0 else proposed


@borrowing_kernel
def _planned_step(time, end, proposed, work):
    """Step in [s] to try: the proposed one, divided so that an expected event and the end are met
    by steps of some length.
    """
    remaining = end - time
    distance = work.expected[0] - time
    if 1.1 * work.expected_reach[0] < distance < numpy.inf:
        ahead = distance - work.expected_reach[0]
        proposed = min(proposed, ahead if ahead < 0.6 * distance else 0.5 * distance)
    if proposed >= remaining * (1.0 - 1.0e-12):
        return remaining
    return min(proposed, 0.5 * remaining) if proposed > 0.5 * remaining else proposed


@borrowing_kernel
def _step_to_event(rig, drive, mode, search, state, scale, work):
    step, event = locate(rig, drive, mode, search, state, scale, work)
    course = time_map(search.start, step, work.last_event[0], True)
    return course, error_of_step(course, scale, work), event


@borrowing_kernel
def _try_step(rig, drive, mode, time, step, end, state, scale, work):
    """Step into ``work.trial``, cut off at the first event. Returns its course, its error over the
    allowed one, and the event.

    Where an event is found that is too far to be reached in one step, the error is infinite and the
    event ``POSTPONED``.
    """
    distance = work.expected[0] - time
    if distance <= min(1.1 * work.expected_reach[0], end - time):
        outer = min(1.5 * distance, end - time)
        return _step_to_event(rig, drive, mode, EventSearch(time, 0.0, distance, outer), state, scale, work)
    course = time_map(time, step, work.last_event[0], False)
    take_step(rig, drive, mode, course, state, work)
    error = error_of_step(course, scale, work)
    bracket = bracket_of_change(rig, drive, mode, course, error, state, work)
    low, high = bracket
    if high == 0.0:
        return course, error, NO_EVENT
    guess, event = guess_of_change(rig, drive, mode, course, bracket, state, work)
    reach = work.reach[_kind(event, -work.event_direction[event])]
    if guess > 1.1 * reach > 0.0:
        work.expected[0] = time + guess
        work.expected_reach[0] = reach
        return course, numpy.inf, POSTPONED
    inner, outer = place(course, low)[0] - time, place(course, high)[0] - time
    if inner == 0.0 and time == work.last_event[0]:
        # No change is looked for right behind the start unless a whole step shows it: the root just
        # left is there
        guess = outer
    return _step_to_event(rig, drive, mode, EventSearch(time, inner, guess, outer), state, scale, work)


@borrowing_kernel
def _factor(error, work):
    """Ratio of the step that meets the tolerance to the step with ``error`` over the tolerance."""
    if not error < numpy.inf:
        return LEAST_FACTOR
    wanted = SAFETY * max(error, 1.0e-12) ** (-1.0 / power_of(work.pair))
    return min(LARGEST_FACTOR, max(LEAST_FACTOR, wanted))


@borrowing_kernel
def _finite(values):
    finite = True
    for i in range(values.shape[0]):
        finite = finite and abs(values[i]) < numpy.inf
    return finite


@borrowing_kernel
def _reject(course, error, event, proposed, work):
    """Step in [s] to try instead."""
    work.counters[REJECTED] += 1
    if event == POSTPONED:
        return proposed
    factor = _factor(error, work)
    work.expected[0] = numpy.inf
    if event == NO_EVENT:
        return scaled_step(course, factor)
    work.expected[0] = course.start + course.step
    work.expected_reach[0] = course.step * factor**1.5
    return proposed


@borrowing_kernel
def _following(course, error, event, last, proposed, work):
    """Step in [s] to try next, after an accepted one; stores the step that was right beside the
    event.
    """
    factor = _factor(error, work)
    if event >= 0:
        work.reach[_kind(event, -work.event_direction[event])] = course.step * factor**1.5
        return proposed
    if last and course.step < proposed:
        return proposed
    if course.start == work.last_event[0]:
        work.first_step[work.last_kind[0]] = scaled_step(course, factor)
    growth = GROWTH_BESIDE_EVENT if course.root_step > 0.0 else LARGEST_FACTOR
    return min(following_step(course, factor), growth * course.step)


@borrowing_kernel
def _accept(time, state, work):
    """Accept the trial step, which ends at ``time``; whether it is finite."""
    finite = True
    for i in range(state.shape[0]):
        state[i] = work.trial[i]
        work.rate_before[i] = work.rate_after[i]
        finite = finite and abs(state[i]) < STATE_LIMIT
    for j in range(work.event_direction.shape[0]):
        work.event_before[j] = work.event_value[j]
    if time >= work.expected[0]:
        work.expected[0] = numpy.inf
    work.counters[STEPS] += 1
    return finite


@borrowing_kernel
def integrate(rig, drive, mode, end, state, scale, work):
    """Advance ``state`` from ``drive.start`` to ``end`` (within the segment); returns a status of
    ``compiled/results.py``.

    ``scale`` [states]: error allowed per step, in the unit of each state; infinite for what is not
    controlled. ``mode`` [of the rig] and ``state`` change in place. ``work.step`` carries the step
    size along.
    """
    time = drive.start
    proposed = work.step[0] if work.step[0] > 0.0 else end - time
    work.expected[0] = numpy.inf
    rate(rig, drive, mode, time, state, work.rate_before)
    events = 0
    while time < end:
        # Free flight in closed form, where the rig is in one.
        reached, event = free_flight(rig, drive, mode, time, end, state, work.event_direction)
        if reached > time or event >= 0:
            time = reached
            _land(rig, drive, mode, time, state, event, work)
        else:
            # A trial step, cut off at the first event; shorter where its error is too large.
            step = _planned_step(time, end, proposed, work)
            if step <= 1.0e-15 * max(1.0, abs(time)) and step < end - time:
                return STEP_TOO_SMALL
            course, error, event = _try_step(rig, drive, mode, time, step, end, state=state, scale=scale, work=work)
            if not error <= 1.0:
                if not _finite(work.rate_before):
                    return NOT_FINITE
                proposed = _reject(course, error, event, proposed, work)
                continue
            last = event < 0 and course.step == end - time
            time = end if last else time + course.step
            if not _accept(time, state, work):
                return NOT_FINITE
            proposed = _following(course, error, event, last, proposed, work)
        # Mode transition at the event.
        if event >= 0:
            events += 1
            if events > MAXIMUM_EVENTS:
                return TOO_MANY_EVENTS
            proposed = _handle_event(rig, drive, mode, time, state, event, proposed=proposed, work=work)
    work.step[0] = proposed
    return DONE
