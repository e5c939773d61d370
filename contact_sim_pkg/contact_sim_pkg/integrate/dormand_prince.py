"""Dormand and Prince's pair of orders 5 and 4, with error control and located contact events; one
for all rigs.

Source: Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, chapter II, sections 4
and 5. No step straddles an event: where an event function of the rig changes its sign within a
trial step, the step is repeated up to the change, found by regula falsi (Illinois) on whole steps,
so that the state at the event has the order of the method. Event functions are also evaluated
inside each step (cubic Hermite), so that a touch and a release within one step are found.

Behind a touch the force grows as a broken power t**p of the time since (p = 3/2 for Hertz), which
no step size makes smooth, and there the pair's error estimate is too small: of one step from the
touch the true error is 11 times the estimate for p = 3/2, 19 times for p towards 1, and equal to it
once the touch lies half a step back. ``_underestimate`` corrects that.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.compiled.results import DONE, NOT_FINITE, STEP_TOO_SMALL, TOO_MANY_EVENTS
from contact_sim_pkg.integrate.interface import event_functions, event_functions_need_rate, mode_transition, rate

MAXIMUM_EVENTS = 10_000
STATE_LIMIT = 1.0e10
# True error over estimate of a step that starts at a touch, for any power of the force above 1
UNDERESTIMATE = 20.0
INSIDE_POINTS = 4  # event functions are evaluated at 1/5 ... 4/5 of each step
LOCATE_ITERATIONS = 100
ONE_SIDED = 4  # times in succession that regula falsi may move the same end

STEPS, REJECTED, EVENTS, COUNTERS = 0, 1, 2, 3

STAGES = 7
# Of the step, where each stage lies
PARTS = numpy.array([0.0, 1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0, 1.0])
WEIGHTS = numpy.array([
    [0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [1.0 / 5.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
    [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0, 0.0, 0.0],
    [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0, 0.0],
    [35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
])  # fmt: skip


class DormandPrinceWorkspace(NamedTuple):
    """Arrays of the integrator, made once a run by ``make_workspace``."""

    stages: Vector  # [STAGES, states]
    trial: Vector  # [states]
    inside: Vector  # [states]
    inside_rate: Vector  # [states]
    event_direction: Vector  # [event functions], sign of each event function
    event_value: Vector  # [event functions]
    # [2], the step that the error control proposes, carried from segment to segment; most steps of
    # a call, 0: any
    step: Vector
    last_event: Vector  # [1], time of the last event in [s]
    counters: Vector  # [COUNTERS], accepted steps, rejected steps, events


def make_workspace(states: int, event_count: int) -> DormandPrinceWorkspace:
    """Workspace for a rig with ``states`` state variables and ``event_count`` event functions.

    Its arrays: [states] or [event functions].
    """

    def zeros(*shape: int) -> Vector:
        return numpy.zeros(shape)

    return DormandPrinceWorkspace(
        stages=zeros(STAGES, states),
        trial=zeros(states),
        inside=zeros(states),
        inside_rate=zeros(states),
        event_direction=zeros(event_count),
        event_value=zeros(event_count),
        step=zeros(2),
        # No event so far
        last_event=numpy.full(1, -numpy.inf),
        counters=zeros(COUNTERS),
    )


@borrowing_kernel
def _stages(rig, drive, mode, time, step, state, work):
    """One step from ``state`` into ``work.trial``.

    ``work.stages[0]`` must hold the rate at the start; afterwards ``work.stages[6]`` holds that at
    the end.
    """
    k, out = work.stages, work.trial
    for stage in range(1, STAGES):
        for i in range(state.shape[0]):
            change = 0.0
            for earlier in range(stage):
                change += WEIGHTS[stage, earlier] * k[earlier, i]
            out[i] = state[i] + step * change
        rate(rig, drive, mode, time + PARTS[stage] * step, out, k[stage])


@borrowing_kernel
def _error(step, k, scale):
    """Largest difference of the two orders over ``scale``, which is infinite for what is not
    controlled.
    """
    worst = 0.0
    for i in range(scale.shape[0]):
        difference = step * (
            71.0 / 57600.0 * k[0, i] - 71.0 / 16695.0 * k[2, i] + 71.0 / 1920.0 * k[3, i] - 17253.0 / 339200.0 * k[4, i]
            + 22.0 / 525.0 * k[5, i] - 1.0 / 40.0 * k[6, i]
        )  # fmt: skip
        ratio = abs(difference) / scale[i]
        if not ratio <= worst:  # also true for NaN
            worst = ratio
    return worst


@borrowing_kernel
def _underestimate(step, since):
    """True error over estimated error, at most, of a step in [s] that starts ``since`` [s] after an
    event.

    1 where the event lies half a step back or more.
    """
    if not 0.0 <= 2.0 * since < step:
        return 1.0
    return 1.0 + (UNDERESTIMATE - 1.0) * (1.0 - 2.0 * since / step) ** 3


@borrowing_kernel
def _state_inside(step, part, state, work):
    """State at ``part`` of the step just taken into ``work.inside`` (cubic Hermite); at 1 its end,
    and the rate there.
    """
    k = work.stages
    for i in range(state.shape[0]):
        change = work.trial[i] - state[i]
        start = step * k[0, i] - change
        end = change - step * k[6, i]
        work.inside[i] = state[i] + part * (change + (1.0 - part) * (start * (1.0 - part) + end * part))
        if part == 1.0:
            work.inside[i] = work.trial[i]
            work.inside_rate[i] = k[6, i]


@borrowing_kernel
def _first_change(rig, drive, mode, time, step, state, work):
    """Part of the step after which an event function has changed sign, 0 where none has: 1/5 ...
    4/5, 1.
    """
    with_rate = event_functions_need_rate(rig, mode)
    for point in range(1, INSIDE_POINTS + 2):
        part = point / (INSIDE_POINTS + 1.0)
        _state_inside(step, part, state, work)
        if with_rate and part < 1.0:
            rate(rig, drive, mode, time + part * step, work.inside, work.inside_rate)
        event_functions(rig, drive, mode, time + part * step, work.inside, work.inside_rate, work.event_value)
        for j in range(work.event_direction.shape[0]):
            if work.event_value[j] * work.event_direction[j] < 0.0:
                return part
    return 0.0


@borrowing_kernel
def _farthest_beyond(work):
    """Event function that lies farthest beyond its sign: its number, and its value counted negative
    when beyond.
    """
    event = -1
    value = numpy.inf
    for j in range(work.event_direction.shape[0]):
        signed = work.event_value[j] * work.event_direction[j]
        if signed < value:
            value = signed
            event = j
    return event, value


@borrowing_kernel
def _locate(rig, drive, mode, time, bracket, state, work):
    """Shortest whole step after which an event function has changed sign.

    ``bracket``: steps in [s] after which none has changed, and after which one is seen to have.

    Bisection on "has any changed", sped up by regula falsi on the one that is farthest beyond;
    bisection again where that moves the same end. Leaves the step's result in ``work.trial``;
    returns the step, and the number of the event, -1 where none has changed after the longest: the
    state inside the step is an interpolation.
    """
    k = work.stages
    low, high = bracket
    outer = high
    low_value = numpy.nan
    high_value = numpy.nan
    event = -1
    step = outer
    repeated = 0
    found = False
    for iteration in range(LOCATE_ITERATIONS + 1):
        _stages(rig, drive, mode, time, step, state, work)
        event_functions(rig, drive, mode, time + step, work.trial, k[6], work.event_value)
        number, value = _farthest_beyond(work)
        if found:
            return step, number if event < 0 and value <= 0.0 else event
        # Zero counts as changed: an event function may jump, and be zero by chance beyond its jump
        if value <= 0.0:
            if number != event:
                low_value = numpy.nan
            high, high_value, event = step, value, number
            if repeated < 0:
                low_value *= 0.5
            repeated = min(repeated, 0) - 1
        else:
            low = step
            low_value = numpy.nan if event < 0 else work.event_value[event] * work.event_direction[event]
            if repeated > 0:
                high_value *= 0.5
            repeated = max(repeated, 0) + 1
        resolution = max(4.0e-16 * (abs(time) + high), 1.0e-14 * outer)
        found = high - low <= resolution or iteration == LOCATE_ITERATIONS - 1
        if found:
            step = high
        elif low_value == low_value and high_value == high_value and low_value > 0.0 and abs(repeated) < ONE_SIDED:
            step = low + (high - low) * low_value / (low_value - high_value)
            # never nearer to an end than the resolution: the other end follows in one step, not by
            # bisection
            step = min(max(step, low + 0.5 * resolution), high - 0.5 * resolution)
        else:
            step = 0.5 * (low + high)
            repeated = 0
    return high, event


@borrowing_kernel
def set_event_directions(rig, drive, mode, time, state, work):
    """Store the sign of each event function; to be called once, at the start of a run."""
    rate(rig, drive, mode, time, state, work.stages[0])
    event_functions(rig, drive, mode, time, state, work.stages[0], work.event_value)
    for j in range(work.event_direction.shape[0]):
        work.event_direction[j] = 1.0 if work.event_value[j] >= 0.0 else -1.0
    work.last_event[0] = -numpy.inf


@borrowing_kernel
def integrate(rig, drive, mode, end, state, scale, work):  # noqa: C901
    """Advance ``state`` from ``drive.start`` to ``end`` (within the segment); returns a status of
    ``compiled/results.py``.

    ``scale`` [states]: error allowed per step, in the unit of each state; infinite for what is not
    controlled. ``mode`` [int array of the rig] and ``state`` change in place. ``work.step`` carries
    the step size along.
    """
    time = drive.start
    proposed = work.step[0] if work.step[0] > 0.0 else end - time
    k = work.stages
    events = 0
    tries = 0
    rate_stored = False  # whether k[0] holds the rate
    while time < end:
        # A trial step, whose length divides what remains.
        if not rate_stored:
            rate(rig, drive, mode, time, state, k[0])
            rate_stored = True
        tries += 1
        remaining = end - time
        last = proposed >= remaining * (1.0 - 1.0e-12)
        step = remaining if last else min(proposed, 0.5 * remaining if proposed > 0.5 * remaining else proposed)
        if (step <= 1.0e-15 * max(1.0, abs(time)) and not last) or 0.0 < work.step[1] < tries:
            return STEP_TOO_SMALL
        _stages(rig, drive, mode, time, step, state, work)
        underestimate = _underestimate(step, time - work.last_event[0])
        error = underestimate * _error(step, k, scale)
        # Too large an error: a shorter step.
        if not error <= 1.0:
            if error != error or error == numpy.inf:
                for i in range(state.shape[0]):
                    if not abs(k[0, i]) < numpy.inf:
                        return NOT_FINITE
                proposed = 0.1 * step
            else:
                # Behind a touch the error scales with step**(1 + p)
                power = -0.2 if underestimate == 1.0 else -0.4
                proposed = step * max(0.1, 0.9 * error**power)
            work.counters[REJECTED] += 1
            continue
        # An event within the step: the step up to it.
        event, part = -1, _first_change(rig, drive, mode, time, step, state, work)
        if part > 0.0:
            inner = max(0.0, part - 1.0 / (INSIDE_POINTS + 1.0)) * step
            step, event = _locate(rig, drive, mode, time, (inner, part * step), state, work)
            # Contact ends as it begins: mirrored in time
            error = UNDERESTIMATE * _error(step, k, scale)
            if error > 1.0:
                proposed = step * max(0.1, 0.9 * error**-0.4)
                work.counters[REJECTED] += 1
                continue
            last = False
        else:
            factor = 5.0 if error < 1.0e-4 else min(5.0, 0.9 * error**-0.2)
            if not last or step >= proposed:
                proposed = step * max(0.2, factor)
        # Accept.
        for i in range(state.shape[0]):
            state[i] = work.trial[i]
            if not abs(state[i]) < STATE_LIMIT:
                return NOT_FINITE
        time = end if last else time + step
        work.counters[STEPS] += 1
        if event >= 0:
            events += 1
            work.counters[EVENTS] += 1
            work.last_event[0] = time
            if events > MAXIMUM_EVENTS:
                return TOO_MANY_EVENTS
            work.event_direction[event] = mode_transition(
                rig, drive, mode, time, state, event, -work.event_direction[event]
            )
            rate_stored = False
        else:
            for i in range(state.shape[0]):
                k[0, i] = k[6, i]
    work.step[0] = proposed
    return DONE
