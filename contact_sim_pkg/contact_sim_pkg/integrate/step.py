"""One step of the integrator by the pair that its workspace holds: its result, its error, and the
state inside it.

Source: Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, II.4 to II.6.
"""

from __future__ import annotations

from typing import Any

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import borrowing_kernel, kernel_overload
from contact_sim_pkg.integrate.interface import rate
from contact_sim_pkg.integrate.order_5 import POWER as POWER_5
from contact_sim_pkg.integrate.order_5 import Order5, error_of_order_5, step_of_order_5
from contact_sim_pkg.integrate.order_8 import POWER as POWER_8
from contact_sim_pkg.integrate.order_8 import error_of_order_8, step_of_order_8
from contact_sim_pkg.integrate.time_map import place


def compute_stages(pair: Any, rig: Any, drive: Any, mode: Any, course: Any, state: Vector, out: Vector) -> None:
    """Step from ``state`` along ``course`` into ``out`` by ``pair``, the first of whose stages must
    be there.

    state, out: [states]; the stages: [stages, states], rates over the part of the step.
    """
    stages_of = step_of_order_5 if isinstance(pair, Order5) else step_of_order_8
    stages_of(pair.stages, rig, drive, mode, course, state, out)


@kernel_overload(compute_stages)
def _compute_stages(pair, rig, drive, mode, course, state, out):
    stages_of = step_of_order_5 if pair.instance_class is Order5 else step_of_order_8
    return lambda pair, rig, drive, mode, course, state, out: stages_of(
        pair.stages, rig, drive, mode, course, state, out
    )


def estimate(pair: Any, course: Any, end_rate: Vector, scale: Vector) -> float:
    """Largest error of a state over ``scale`` that ``pair`` estimates for the step just taken along
    ``course``.

    end_rate, scale: [states]; the result [1] is at most 1 where the step is within the tolerance.
    """
    if isinstance(pair, Order5):
        return float(error_of_order_5(pair.stages, course, end_rate, scale))
    return float(error_of_order_8(pair.stages, course, scale))


@kernel_overload(estimate)
def _estimate(pair, course, end_rate, scale):
    if pair.instance_class is Order5:
        return lambda pair, course, end_rate, scale: error_of_order_5(pair.stages, course, end_rate, scale)
    return lambda pair, course, end_rate, scale: error_of_order_8(pair.stages, course, scale)


def power_of(pair: Any) -> float:
    """Power [1] of the step size with which the error that ``pair`` estimates scales."""
    return POWER_5 if isinstance(pair, Order5) else POWER_8


@kernel_overload(power_of)
def _power_of(pair):
    power = POWER_5 if pair.instance_class is Order5 else POWER_8
    return lambda pair: power


@borrowing_kernel
def take_step(rig, drive, mode, course, state, work):
    """Step from ``state`` along ``course`` into ``work.trial``, from ``work.rate_before``; fills
    ``work.rate_after``.
    """
    _start, slope = place(course, 0.0)
    for i in range(state.shape[0]):
        work.pair.stages[0, i] = slope * work.rate_before[i]
    compute_stages(work.pair, rig, drive, mode, course, state, work.trial)
    rate(rig, drive, mode, course.start + course.step, work.trial, work.rate_after)


@borrowing_kernel
def error_of_step(course, scale, work):
    """Largest error of a state over ``scale``, which is infinite for what is not controlled."""
    return estimate(work.pair, course, work.rate_after, scale)


@borrowing_kernel
def state_inside(course, part, state, work):
    """State at ``part`` of the step just taken into ``work.inside``: cubic Hermite."""
    _start, start_slope = place(course, 0.0)
    _end, end_slope = place(course, 1.0)
    for i in range(state.shape[0]):
        change = work.trial[i] - state[i]
        start = start_slope * work.rate_before[i] - change
        end = change - end_slope * work.rate_after[i]
        work.inside[i] = state[i] + part * (change + (1.0 - part) * (start * (1.0 - part) + end * part))
