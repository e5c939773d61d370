"""Free flight of one mass over a moving support, in closed form, against a fine scan."""

import math

import numpy
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

from contact_sim_pkg.integrate.drive import Drive
from contact_sim_pkg.integrate.interface import free_flight as flight_of_any
from contact_sim_pkg.laws.one_mass.parameters import PointContact
from contact_sim_pkg.laws.one_mass.point_contact import free_flight
from contact_sim_pkg.laws.parameters import NormalElastic

SEPARATED = numpy.array([-1.0, 1.0])
END = 1.0


def _rig(gravity, amplitude, frequency):
    return PointContact(1.0, gravity, amplitude, frequency, NormalElastic(1e5, 1.5), None)


def _drive():
    return Drive(0.0, END, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


def _fly(rig, height, velocity):
    state = numpy.array([height, velocity])
    reached, event = free_flight(rig, _drive(), numpy.zeros(1, dtype=numpy.int64), 0.0, END, state, SEPARATED)
    return reached, event, state


def _first_touch(rig, height, velocity):
    """First root of the approach on a scan of 20 000 points, None where there is none."""

    def approach(t):
        support = rig.support_amplitude * numpy.sin(rig.support_frequency * t)
        return support - (height + velocity * t - 0.5 * rig.gravity * t * t)

    times = numpy.linspace(0.0, END, 20_001)
    beyond = numpy.flatnonzero(approach(times) > 0.0)
    return None if beyond.size == 0 else brentq(approach, times[beyond[0] - 1], times[beyond[0]], xtol=1e-15)


@settings(max_examples=60)
@given(st.floats(0.0, 20.0), st.floats(1e-4, 0.02), st.floats(5.0, 300.0), st.floats(0.021, 0.3), st.floats(-2.0, 2.0))
def test_the_first_touch_is_found_whatever_the_support_does(gravity, amplitude, frequency, height, velocity):
    rig = _rig(gravity, amplitude, frequency)
    reached, event, state = _fly(rig, height, velocity)
    expected = _first_touch(rig, height, velocity)
    if expected is None:
        # a touch that is shorter than the scan is fine is the flight's to find, and is one
        assert event == -1 or abs(amplitude * math.sin(frequency * reached) - state[0]) < 1e-12
        return
    assert event == 0
    assert reached <= expected + 1e-12
    assert abs(amplitude * math.sin(frequency * reached) - state[0]) < 1e-12
    if reached < expected - 1e-9:  # a graze between two points of the scan
        assert expected - reached > 1e-5
    assert state[1] == pytest.approx(velocity - gravity * reached, rel=1e-13, abs=1e-13)


def test_a_flight_that_meets_nothing_ends_at_the_end():
    reached, event, state = _fly(_rig(0.0, 0.0, 0.0), 0.1, 1.0)
    assert (reached, event) == (END, -1)
    assert state == pytest.approx([1.1, 1.0])


def test_a_mass_that_has_just_left_flies_and_is_not_taken_for_one_that_touches():
    reached, event, _state = _fly(_rig(9.81, 0.0, 0.0), 0.0, 1.0)
    assert event == 0
    assert reached == pytest.approx(2.0 / 9.81, rel=1e-12)


def test_a_mass_in_contact_does_not_fly():
    state = numpy.array([-0.01, 0.0])
    found = free_flight(_rig(9.81, 0.0, 0.0), _drive(), numpy.zeros(1, dtype=numpy.int64), 0.0, END, state, -SEPARATED)
    assert found == (0.0, -1)


def test_a_rig_without_a_closed_form_does_not_fly():
    assert flight_of_any((1.0,), _drive(), None, 0.25, END, numpy.zeros(2), SEPARATED) == (0.25, -1)


def test_a_state_that_is_no_number_does_not_fly():
    reached, event, _state = _fly(_rig(9.81, 0.0, 0.0), math.nan, 0.0)
    assert (reached, event) == (0.0, -1)
