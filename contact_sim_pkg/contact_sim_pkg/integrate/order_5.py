"""Dormand and Prince's pair of orders 5 and 4: inexpensive steps.

Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, 2nd ed., chapter II, table 5.2.
"""

from __future__ import annotations

from typing import NamedTuple

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.integrate.stage import evaluate
from contact_sim_pkg.integrate.time_map import place

STAGES = 7
POWER = 5.0


class Order5(NamedTuple):
    """Stages of the pair: rates over the part of the step."""

    stages: Vector  # [7, states]


@borrowing_kernel
def step_of_order_5(stages, rig, drive, mode, course, state, out):
    """Step from ``state`` along ``course`` into ``out``; the first row of ``stages`` must hold the
    rate at its start.
    """
    # Stages 2 to 6 at their nodes, then the result with the weights of order 5.
    k = stages
    n = state.shape[0]
    for i in range(n):
        out[i] = state[i] + 1.0 / 5.0 * k[0, i]
    evaluate(rig, drive, mode, course, 1.0 / 5.0, out, k[1])
    for i in range(n):
        out[i] = state[i] + (3.0 / 40.0 * k[0, i] + 9.0 / 40.0 * k[1, i])
    evaluate(rig, drive, mode, course, 3.0 / 10.0, out, k[2])
    for i in range(n):
        out[i] = state[i] + (44.0 / 45.0 * k[0, i] - 56.0 / 15.0 * k[1, i] + 32.0 / 9.0 * k[2, i])
    evaluate(rig, drive, mode, course, 4.0 / 5.0, out, k[3])
    for i in range(n):
        out[i] = state[i] + (
            19372.0 / 6561.0 * k[0, i]
            - 25360.0 / 2187.0 * k[1, i]
            + 64448.0 / 6561.0 * k[2, i]
            - 212.0 / 729.0 * k[3, i]
        )
    evaluate(rig, drive, mode, course, 8.0 / 9.0, out, k[4])
    for i in range(n):
        out[i] = state[i] + (
            9017.0 / 3168.0 * k[0, i] - 355.0 / 33.0 * k[1, i] + 46732.0 / 5247.0 * k[2, i] + 49.0 / 176.0 * k[3, i]
            - 5103.0 / 18656.0 * k[4, i]
        )  # fmt: skip
    evaluate(rig, drive, mode, course, 1.0, out, k[5])
    for i in range(n):
        out[i] = state[i] + (
            35.0 / 384.0 * k[0, i] + 500.0 / 1113.0 * k[2, i] + 125.0 / 192.0 * k[3, i] - 2187.0 / 6784.0 * k[4, i]
            + 11.0 / 84.0 * k[5, i]
        )  # fmt: skip


@borrowing_kernel
def error_of_order_5(stages, course, end_rate, scale):
    """Largest difference of the two orders over ``scale``, with the rate at the step's end."""
    k = stages
    _end, slope = place(course, 1.0)
    worst = 0.0
    for i in range(scale.shape[0]):
        difference = (
            71.0 / 57600.0 * k[0, i] - 71.0 / 16695.0 * k[2, i] + 71.0 / 1920.0 * k[3, i] - 17253.0 / 339200.0 * k[4, i]
            + 22.0 / 525.0 * k[5, i] - 1.0 / 40.0 * slope * end_rate[i]
        )  # fmt: skip
        ratio = abs(difference) / scale[i]
        if not ratio <= worst:  # also true for NaN
            worst = ratio
    return worst
