"""Both pairs: the order of a step, and how a step runs through time beside an event."""

import math

import numpy
import pytest
from scipy.integrate import RK45, solve_ivp

from contact_sim_pkg.compiled.results import DONE
from contact_sim_pkg.integrate.order_5 import STAGES, error_of_order_5
from contact_sim_pkg.integrate.root_steps import make_workspace
from contact_sim_pkg.integrate.time_map import following_step, place, scaled_step, time_map
from contact_sim_pkg.laws.one_mass.parameters import PointContact
from contact_sim_pkg.laws.one_mass.single import empty_mode, run
from contact_sim_pkg.laws.parameters import NormalElastic

HERTZ = PointContact(1.0, 9.81, 0.002, 30.0, NormalElastic(2.0e4, 1.5), None)
START = numpy.array([-0.02, 0.05])  # stays in contact


def _one_step(order, length):
    state, work, out = START.copy(), make_workspace(2, 2, order), numpy.zeros((2, 2))
    work.step[0] = length
    assert run(HERTZ, empty_mode(), state, numpy.full(2, 1e300), work, numpy.array([0.0, length]), out) == DONE
    assert work.counters[0] == 1.0
    return out[1]


def _exact(length):
    def rate(t, y):
        return [y[1], 2.0e4 * (0.002 * math.sin(30.0 * t) - y[0]) ** 1.5 - 9.81]

    return solve_ivp(rate, (0.0, length), START, "DOP853", rtol=3e-14, atol=1e-18).y[:, -1]


@pytest.mark.parametrize(("order", "length"), [(5, 0.004), (8, 0.016)])
def test_half_the_step_leaves_the_error_that_the_order_says(order, length):
    whole, half = (abs(_one_step(order, h) - _exact(h)) for h in (length, 0.5 * length))
    assert (whole > 1e-11).all()
    assert order + 0.6 < numpy.log2(whole / half).min() < order + 1.6  # the other state may gain one more


@pytest.mark.parametrize("stage", range(STAGES))
def test_each_stage_counts_in_the_error_of_order_5_by_the_difference_of_the_two_weights(stage):
    """b - b^ of Hairer, Norsett, Wanner I, table II.5.2; for each stage alone, against those of scipy."""
    rates = numpy.zeros((STAGES, 1))
    rates[stage] = 1.0
    error = error_of_order_5(rates, time_map(0.0, 1.0, -math.inf, False), rates[-1], numpy.ones(1))
    assert error == pytest.approx(abs(RK45.E[stage]), rel=1e-14)


def test_a_constant_rate_leaves_no_error_of_order_5():
    rates = numpy.full((STAGES, 1), 3.0)
    assert error_of_order_5(rates, time_map(0.0, 1.0, -math.inf, False), rates[-1], numpy.ones(1)) < 1e-15


def test_an_order_that_there_is_not_is_refused():
    with pytest.raises(ValueError, match="orders 5 and 8, not 4"):
        make_workspace(2, 2, 4)


@pytest.mark.parametrize("ends_at_event", [False, True])
@pytest.mark.parametrize("last_event", [-math.inf, 2.0, 1.7])
def test_a_step_begins_and_ends_where_it_should_and_its_slope_is_the_derivative(last_event, ends_at_event):
    course = time_map(2.0, 0.5, last_event, ends_at_event)
    assert place(course, 0.0)[0] == pytest.approx(2.0, abs=1e-15)
    assert place(course, 1.0)[0] == pytest.approx(2.5, abs=1e-15)
    for part in (0.1, 0.5, 0.8):
        slope = (place(course, part + 1e-6)[0] - place(course, part - 1e-6)[0]) / 2e-6
        assert place(course, part)[1] == pytest.approx(slope, rel=1e-8)


def test_beside_an_event_the_root_of_the_time_since_runs_evenly():
    course = time_map(2.0, 0.5, 2.0, False)
    assert place(course, 0.5)[0] == pytest.approx(2.0 + 0.5 / 4.0)
    assert scaled_step(course, 0.5) == pytest.approx(0.125)
    assert following_step(course, 1.0) == pytest.approx(1.5)


def test_far_from_an_event_time_runs_evenly():
    course = time_map(2.0, 0.5, 1.4, False)
    assert place(course, 0.25)[0] == 2.125
    assert (scaled_step(course, 0.5), following_step(course, 2.0)) == (0.25, 1.0)


def test_towards_an_event_a_step_slows_down():
    course = time_map(2.0, 0.5, -math.inf, True)
    assert place(course, 0.5)[0] == pytest.approx(2.0 + 0.75 * 0.5)
    assert place(course, 1.0)[1] == 0.0
