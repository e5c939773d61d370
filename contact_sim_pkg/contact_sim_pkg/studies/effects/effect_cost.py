"""Cost of an absent effect: a rig with its dissipation absent, and the same rig written
without it.
"""

from __future__ import annotations

import math
import statistics
import time
from typing import NamedTuple

import numpy

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import kernel
from contact_sim_pkg.integrate.interface import register_rig
from contact_sim_pkg.integrate.root_steps import REJECTED, STEPS, make_workspace
from contact_sim_pkg.laws.one_mass.parameters import PointContact
from contact_sim_pkg.laws.one_mass.point_contact import free_flight
from contact_sim_pkg.laws.one_mass.single import empty_mode, run
from contact_sim_pkg.laws.parameters import NormalDissipative, NormalElastic

__all__ = ["HandWritten", "absent_effect_cost", "bounce"]

PAIRS = 9
END = 20.0  # [s]


class HandWritten(NamedTuple):
    """`PointContact` written for a Hertz contact without dissipation on a moving base; state [z,
    v].
    """

    mass: float
    gravity: float
    support_amplitude: float
    support_frequency: float
    coefficient: float


@kernel
def _rate(rig, drive, mode, time, state, out):  # type: ignore[no-untyped-def]
    force = 0.0
    approach = rig.support_amplitude * math.sin(rig.support_frequency * time) - state[0]
    if approach > 0.0:
        force = rig.coefficient * approach * math.sqrt(approach)
    out[0] = state[1]
    out[1] = force / rig.mass - rig.gravity


@kernel
def _event_functions(rig, drive, mode, time, state, derivative, out):  # type: ignore[no-untyped-def]
    out[0] = rig.support_amplitude * math.sin(rig.support_frequency * time) - state[0]
    out[1] = 1.0


@kernel
def _mode_transition(rig, drive, mode, time, state, event, direction):  # type: ignore[no-untyped-def]
    return direction


@kernel
def _need_rate(rig, mode):  # type: ignore[no-untyped-def]
    return False


register_rig(HandWritten, _rate, _event_functions, _mode_transition, _need_rate, free_flight)


def bounce(rig: PointContact | HandWritten) -> tuple[Vector, float]:
    """States at 1001 instants of 20 s of bouncing from 5 cm, and the cost of a step [ns].

    States: [instants, 2], height [m] and velocity [m/s].
    """
    times: Vector = numpy.linspace(0.0, END, 1001, dtype=numpy.float64)
    out, work, state = numpy.zeros((1001, 2)), make_workspace(2, 2), numpy.array([0.05, 0.0])
    began = time.perf_counter()
    run(rig, empty_mode(), state, numpy.array([1e-11, 1e-8]), work, times, out)
    seconds = time.perf_counter() - began
    return out, 1e9 * seconds / float(work.counters[STEPS] + work.counters[REJECTED])


def rigs() -> tuple[PointContact, PointContact, HandWritten]:
    """The same bounce with dissipation, with it absent, and written by hand."""
    law = NormalElastic(1.0e6, 1.5)
    absent = PointContact(1.0, 9.81, 0.0, 0.0, law, None)
    return absent._replace(dissipative=NormalDissipative(1e-3)), absent, HandWritten(1.0, 9.81, 0.0, 0.0, 1.0e6)


def absent_effect_cost() -> tuple[float, float, float]:
    """Cost of a step [ns] with dissipation, with it absent, and by hand: medians of alternating
    runs.
    """
    costs: list[list[float]] = [[], [], []]
    cases: tuple[PointContact | HandWritten, ...] = rigs()
    for rig in cases:
        bounce(rig)
    for _ in range(PAIRS):
        for place, rig in enumerate(cases):
            costs[place].append(bounce(rig)[1])
    with_effect, absent, by_hand = (statistics.median(group) for group in costs)
    return with_effect, absent, by_hand
