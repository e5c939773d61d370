"""Work and precision on the seat slap: error after 4 s and time, for each tolerance, ours beside
scipy's LSODA and DOP853.

60 kg on a one-sided foam law over a floor at 5 Hz and 1.3 g, 20 touches (`one_mass.seat_slap`).
Times are wall times on one thread over 4 simulated seconds; ours is compiled, scipy's right-hand
side is Python, which is most of its time. scipy takes steps of at most 10 ms, without which it
steps over touches at loose tolerances.
"""

from __future__ import annotations

import math
from functools import partial
from typing import Any, NamedTuple

import numpy
from scipy.integrate import solve_ivp

from contact_sim_lab.laws import hard_cases_impact as impacts_of
from contact_sim_lab.laws.one_mass import runs as one_mass
from contact_sim_lab.records.goal import median_time
from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.laws.one_mass.parameters import PointContact

__all__ = ["END", "SlapCost", "cheapest", "own_work", "scipy_work"]

END = 4.0  # [s]
TOLERANCES = tuple(10.0 ** (-0.5 * half) for half in range(8, 25))  # 1e-4 to 1e-12
PEER_TOLERANCES = tuple(10.0**-power for power in range(4, 13))
PEER_REPEATS = 3
LONGEST_STEP = 0.01  # [s]


class SlapCost(NamedTuple):
    """One run of one solver."""

    solver: str
    tolerance: float
    error: float  # [m] of the position after 4 s
    cost: float  # [µs] per simulated second


def own_work() -> list[SlapCost]:
    """Our runs, tolerance 1e-4 to 1e-12; error against scipy's DOP853 at 3e-14 from event to
    event.
    """
    rig, start, scales = one_mass.seat_slap()
    exact, times = _exact(rig, start), numpy.array([0.0, END])
    found = []
    for tolerance in TOLERANCES:
        call = partial(one_mass.integrate, rig, start, scales * tolerance, times)
        error = abs(float(call().states[-1, 0]) - exact)
        found.append(SlapCost("ours", tolerance, error, 1e6 * median_time(call) / END))
    return found


def scipy_work(method: str) -> list[SlapCost]:
    """scipy's runs with `method`, relative tolerance 1e-4 to 1e-12, absolute a hundredth of it."""
    rig, start, _scales = one_mass.seat_slap()
    exact = _exact(rig, start)
    found = []
    for tolerance in PEER_TOLERANCES:
        call = partial(_by_scipy, rig, start, method, tolerance)
        error = abs(float(call().y[0, -1]) - exact)
        found.append(SlapCost(method, tolerance, error, 1e6 * median_time(call, PEER_REPEATS) / END))
    return found


def cheapest(work: list[SlapCost], error: float) -> SlapCost | None:
    """The cheapest run whose error, and that of all tighter ones, is at most `error` [m]; None
    where none is.

    `work` goes from loose to tight: one run that is right by chance does not count.
    """
    missed = [i for i, run in enumerate(work) if not run.error <= error]
    enough = work[missed[-1] + 1 :] if missed else work
    return min(enough, key=lambda run: run.cost) if enough else None


def _exact(rig: PointContact, start: Vector) -> float:
    return float(impacts_of.slap_reference(rig, start)[0])


def _by_scipy(rig: PointContact, start: Vector, method: str, tolerance: float) -> Any:
    law, amplitude, frequency = rig.elastic, rig.support_amplitude, rig.support_frequency

    def rate(t: float, y: Any) -> list[float]:
        approach = amplitude * math.sin(frequency * t) - y[0]
        if approach <= 0.0:
            return [y[1], -rig.gravity]
        closing = amplitude * frequency * math.cos(frequency * t) - y[1]
        force = law.coefficient * approach**law.exponent * max(0.0, 1.0 + closing)
        return [y[1], force / rig.mass - rig.gravity]

    return solve_ivp(rate, (0.0, END), start, method, rtol=tolerance, atol=1e-2 * tolerance, max_step=LONGEST_STEP)
