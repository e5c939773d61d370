"""An event that only the look inside a step sees, which is an interpolation, is none."""

from typing import NamedTuple

import numpy
import pytest

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.compiled.results import DONE
from contact_sim_pkg.integrate.dormand_prince import EVENTS, integrate, make_workspace, set_event_directions
from contact_sim_pkg.integrate.drive import Drive
from contact_sim_pkg.integrate.interface import register_rig

DURATION = 1.0


class Circle(NamedTuple):
    """y = cos t, sin t, and how far from the circle it may lie before that counts as an event."""

    room: Vector  # [1]


@borrowing_kernel
def _rate(rig, drive, mode, time, state, out):
    out[0], out[1] = -state[1], state[0]


@borrowing_kernel
def _event_functions(rig, drive, mode, time, state, derivative, out):
    out[0] = rig.room[0] - abs(state[0] * state[0] + state[1] * state[1] - 1.0)


@borrowing_kernel
def _mode_transition(rig, drive, mode, time, state, event, direction):
    mode[0] += 1
    return direction


@borrowing_kernel
def _need_rate(rig, mode):
    return False


register_rig(Circle, _rate, _event_functions, _mode_transition, _need_rate)


@pytest.mark.parametrize(("room", "events"), [(1e-7, 0), (1e-12, 1)])
def test_an_event_counts_where_a_whole_step_shows_it(room, events):
    """At a tolerance of 1e-8 whole steps lie within 1e-7 of the circle, and the cubic between them does not."""
    mode, state, work = numpy.zeros(1, numpy.int64), numpy.array([1.0, 0.0]), make_workspace(2, 1)
    rig, drive = Circle(numpy.array([room])), Drive(0.0, DURATION, *numpy.zeros(8))
    set_event_directions(rig, drive, mode, 0.0, state, work)
    assert integrate(rig, drive, mode, DURATION, state, numpy.full(2, 1e-8), work) == DONE
    assert state == pytest.approx([numpy.cos(DURATION), numpy.sin(DURATION)], abs=1e-7)
    assert (mode[0] > 0) == (work.counters[EVENTS] > 0) == (events > 0)
