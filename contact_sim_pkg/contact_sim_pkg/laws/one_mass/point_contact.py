"""One mass over a support that may move: free impact, drop, slap. The smallest rig, and the
yardstick of the integrator.

``m z'' = F(x, x') - m g``, ``x = A sin(w t) - z``. State [z, v]; event functions: the approach x,
and the tension margin.

Source: Driver and Seat eqs 7, 8, 10 and 11.
"""

from __future__ import annotations

import math

from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.integrate.interface import register_rig
from contact_sim_pkg.laws.normal_force import normal_force, tension_event
from contact_sim_pkg.laws.one_mass.parameters import PointContact

STATES = 2
EVENT_FUNCTIONS = 2
APPROACH, TENSION = 0, 1
FLIGHT_ITERATIONS = 1000


@borrowing_kernel
def approach_of(rig, time, state):
    phase = rig.support_frequency * time
    approach = rig.support_amplitude * math.sin(phase) - state[0]
    approach_rate = rig.support_amplitude * rig.support_frequency * math.cos(phase) - state[1]
    return approach, approach_rate


@borrowing_kernel
def _rate(rig, drive, mode, time, state, out):
    approach, approach_rate = approach_of(rig, time, state)
    out[0] = state[1]
    force = normal_force(rig.elastic, rig.dissipative, approach, approach_rate, 1.0)
    out[1] = force / rig.mass - rig.gravity


@borrowing_kernel
def _event_functions(rig, drive, mode, time, state, derivative, out):
    approach, approach_rate = approach_of(rig, time, state)
    out[0] = approach
    out[1] = tension_event(rig.elastic, rig.dissipative, approach, approach_rate, 1.0)


@borrowing_kernel
def _mode_transition(rig, drive, mode, time, state, event, direction):
    return direction


@borrowing_kernel
def _need_rate(rig, mode):
    return False


@borrowing_kernel
def _time_to_zero(value, slope, bend):
    """Time in [s] before which a function at ``value`` <= 0 with second derivative up to ``bend``
    >= 0 cannot reach zero.
    """
    root = math.sqrt(max(0.0, slope * slope - 2.0 * bend * value))
    if slope > 0.0:
        return -2.0 * value / (slope + root)
    return (root - slope) / bend if bend > 0.0 else math.inf


@borrowing_kernel
def free_flight(rig, drive, mode, time, end, state, side):
    """Parabola of the mass, and the touch of the support's sine from below: by steps within which
    none can be, so none is missed.

    The steps end as Newton's, from one side; the mass stands at the last instant before the touch.
    """
    if side[APPROACH] > 0.0:
        return time, -1
    height, velocity = state[0], state[1]
    bend = abs(rig.support_amplitude) * rig.support_frequency * rig.support_frequency + rig.gravity
    reached = time
    event = -1
    for _ in range(FLIGHT_ITERATIONS):
        approach, approach_rate = approach_of(rig, reached, state)
        ahead = _time_to_zero(approach, approach_rate, bend)
        if approach != approach or ahead != ahead:  # not a number
            break
        if (approach >= 0.0 and approach_rate > 0.0) or reached + ahead <= reached:
            event = APPROACH
            break
        reached = min(end, reached + ahead)
        flown = reached - time
        state[0] = height + (velocity - 0.5 * rig.gravity * flown) * flown
        state[1] = velocity - rig.gravity * flown
        if reached == end:
            break
    return reached, event


register_rig(PointContact, _rate, _event_functions, _mode_transition, _need_rate, free_flight)
