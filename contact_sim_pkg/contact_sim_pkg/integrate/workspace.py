"""Arrays of the integrator, made once a run."""

from __future__ import annotations

from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Modes, Vector
from contact_sim_pkg.integrate import order_5, order_8

__all__ = ["COUNTERS", "EVENTS", "REJECTED", "STEPS", "RootStepWorkspace", "make_workspace"]

STEPS, REJECTED, EVENTS, COUNTERS = 0, 1, 2, 3


class RootStepWorkspace(NamedTuple):
    """Arrays of the integrator, and the pair of orders that it steps with."""

    pair: order_5.Order5 | order_8.Order8
    rate_before: Vector  # [states], at the start of the step
    rate_after: Vector  # [states], at its end
    trial: Vector  # [states]
    inside: Vector  # [states]
    inside_rate: Vector  # [states]
    event_direction: Vector  # [event functions], sign of each event function
    event_value: Vector  # [event functions], at the end of the step
    event_before: Vector  # [event functions], at its start
    event_inside: Vector  # [event functions]
    step: Vector  # [1], the step that the error control proposes; carried from segment to segment
    first_step: (
        # [2 event functions], the step in [s] that was right behind the last event of each kind; 0:
        # none yet
        Vector
    )
    # [2 event functions], the step in [s] that was right up to the last event of each kind; 0: none
    # yet
    reach: Vector
    last_kind: (
        # [1], kind of the last event: twice its number, plus 1 where the event function has become
        # positive
        Modes
    )
    expected: Vector  # [1], time in [s] at which an event is thought to lie; infinite: none
    expected_reach: Vector  # [1], time in [s] before it from which one step may lead to it
    last_event: Vector  # [1], time of the last event in [s]
    counters: Vector  # [COUNTERS], accepted steps, rejected steps, events


def make_workspace(states: int, event_count: int, order: int = 5) -> RootStepWorkspace:
    """Workspace for a rig with ``states`` state variables and ``event_count`` event functions.

    ``order`` 5 has inexpensive steps, for drives that change within milliseconds; 8 long steps to
    tight tolerances. Raises ValueError for any other order.
    """

    def zeros(*shape: int) -> Vector:
        return numpy.zeros(shape)

    # The stages belong to the Runge-Kutta pair
    if order == 5:
        pair: order_5.Order5 | order_8.Order8 = order_5.Order5(zeros(order_5.STAGES, states))
    elif order == 8:
        pair = order_8.Order8(zeros(order_8.STAGES, states))
    else:
        raise ValueError(f"the integrator has pairs of orders 5 and 8, not {order}")
    return RootStepWorkspace(
        pair=pair,
        rate_before=zeros(states),
        rate_after=zeros(states),
        trial=zeros(states),
        inside=zeros(states),
        inside_rate=zeros(states),
        event_direction=zeros(event_count),
        event_value=zeros(event_count),
        event_before=zeros(event_count),
        event_inside=zeros(event_count),
        step=zeros(1),
        first_step=zeros(2 * event_count),
        reach=zeros(2 * event_count),
        last_kind=numpy.zeros(1, dtype=numpy.int64),
        # No event so far, none expected
        expected=numpy.full(1, numpy.inf),
        expected_reach=zeros(1),
        last_event=numpy.full(1, -numpy.inf),
        counters=zeros(COUNTERS),
    )
