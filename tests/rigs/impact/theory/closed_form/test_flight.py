"""Flights of drop tower and pendulum against closed forms and a slow integration."""

import math

import numpy
import pytest
from scipy.integrate import solve_ivp

from contact_sim_pkg.rigs.impact.theory.closed_form.flight import Drop, Pendulum, fall, rebound
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError


def test_a_drop_is_a_parabola():
    flight = rebound(Drop(9.81), 1.5)
    assert flight.duration == pytest.approx(3.0 / 9.81, rel=1e-15)
    times = numpy.linspace(0.0, flight.duration, 9)
    approach, rate = flight.at(times)
    assert approach == pytest.approx(-1.5 * times + 0.5 * 9.81 * times**2, abs=1e-15)
    assert rate == pytest.approx(-1.5 + 9.81 * times, abs=1e-14)


@pytest.mark.parametrize("machine", [Drop(9.81), Pendulum(9.81, 0.5), Pendulum(1.62, 0.9)])
def test_a_fall_begins_at_rest_and_ends_at_the_requested_speed(machine):
    flight = fall(machine, 1.2)
    approach, rate = flight.at(numpy.array([0.0, flight.duration]))
    assert rate[0] == pytest.approx(0.0, abs=1e-7)
    assert (approach[1], rate[1]) == pytest.approx((0.0, 1.2), abs=1e-12)
    assert flight.potential(approach)[0] == pytest.approx(0.5 * 1.2**2, rel=1e-13)


@pytest.mark.parametrize("speed", [0.01, 1.0, 3.13])
def test_a_pendulum_swings_as_its_equation_of_motion_says(speed):
    flight = rebound(Pendulum(9.81, 0.5), speed)
    times = numpy.linspace(0.0, flight.duration, 11)
    slow = solve_ivp(
        lambda _t, y: [y[1], -9.81 * math.sin(y[0] / 0.5)], (0.0, flight.duration), [0.0, -speed], method="DOP853",
        rtol=1e-12, atol=1e-14, t_eval=times,
    )  # fmt: skip
    approach, rate = flight.at(times)
    assert approach == pytest.approx(slow.y[0], abs=1e-9 * speed)
    assert rate == pytest.approx(slow.y[1], abs=2e-8 * speed)


def test_a_pendulum_beyond_the_horizontal_and_a_standing_sphere_are_refused():
    with pytest.raises(ImpactError, match=r"reaches 3\.132 m/s from the horizontal"):
        fall(Pendulum(9.81, 0.5), 3.2)
    with pytest.raises(ImpactError, match="a finite number above 0"):
        rebound(Drop(9.81), 0.0)
