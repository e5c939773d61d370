import math

import numpy
import pytest

from contact_sim_lab.laws.one_mass.belt_slider import BeltSlider
from contact_sim_lab.laws.one_mass.runs import integrate
from contact_sim_pkg.laws.friction import (
    SEPARATED,
    STICK,
    following_deflection,
    friction_force,
    slip_event,
    spring_is_limited,
    stick_event,
)
from contact_sim_pkg.laws.parameters import Friction

LAW = Friction(1.0e4, 50.0, 0.5, 0.4)


def test_sticking_is_a_spring_and_a_damper():
    assert friction_force(LAW, STICK, 100.0, 1e-3, 0.02) == pytest.approx(1.0e4 * 1e-3 + 50.0 * 0.02, rel=1e-15)


@pytest.mark.parametrize("mode", [1, -1])
def test_slipping_gives_the_kinetic_limit_in_the_direction_of_slip(mode):
    assert friction_force(LAW, mode, 100.0, 7.0, -3.0) == mode * 40.0


def test_without_contact_there_is_no_friction():
    assert friction_force(LAW, SEPARATED, 0.0, 1.0, 1.0) == 0.0
    assert friction_force(None, STICK, 100.0, 1.0, 1.0) == 0.0


@pytest.mark.parametrize(
    ("velocity", "deflection"), [(0.0, 4e-3), (0.4, 2e-3), (1.6, -4e-3), (9.0, -4e-3), (-2.0, 1.4e-2)]
)
def test_the_spring_follows_the_slip_and_gives_way_no_more_than_its_limit(velocity, deflection):
    assert following_deflection(LAW, 1, 100.0, velocity) == pytest.approx(deflection, rel=1e-14)
    assert following_deflection(LAW, -1, 100.0, -velocity) == pytest.approx(-deflection, rel=1e-14)


@pytest.mark.parametrize("velocity", [-2.0, -0.01, 0.0, 0.4, 1.59])
def test_the_force_is_continuous_where_slip_ends(velocity):
    deflection = following_deflection(LAW, 1, 100.0, velocity)
    assert friction_force(LAW, STICK, 100.0, deflection, velocity) == pytest.approx(40.0, rel=1e-13)


@pytest.mark.parametrize(
    ("velocity", "held"), [(-0.1, False), (0.0, False), (0.5, False), (1.5, False), (1.6, True), (3.0, True)]
)
def test_the_spring_is_held_where_the_damper_alone_carries_twice_the_limit(velocity, held):
    assert spring_is_limited(LAW, 1, 100.0, velocity) == held
    assert spring_is_limited(LAW, -1, 100.0, -velocity) == held


def test_sticking_ends_at_the_static_limit():
    assert stick_event(LAW, 100.0, 5e-3, 0.0) == pytest.approx(0.0, abs=1e-13)
    assert stick_event(LAW, 100.0, -6e-3, 0.0) == pytest.approx(-10.0)


def test_the_slip_rate_counts_the_following_spring():
    assert slip_event(LAW, 1, 0.5, -3.0, 100.0, 0.0) == pytest.approx(0.5 - 50.0 * 3.0 / 1e4)
    assert slip_event(LAW, 1, -0.1, -3.0, 100.0, -5000.0) == pytest.approx(-0.1 + (0.4 * 5000.0 - 50.0 * 3.0) / 1e4)
    assert slip_event(LAW, 1, -0.1, 0.0, 100.0, -5000.0) == pytest.approx(-0.1 + 0.4 * 5000.0 / 1e4)
    assert slip_event(LAW, 1, 3.0, -1e9, 100.0, -1e9) == 3.0, "held beyond the limit by the damper alone"


def test_the_loop_of_a_slow_oscillation_encloses_four_mu_n_times_the_slip():
    stiffness, load, ratio, amplitude = 1.0e5, 100.0, 0.4, 0.01
    # a heavy mass on a spring swings almost freely; the work of one cycle is 4 mu N (X - mu N / C)
    mass, spring = 1.0e6, 4.0e7
    rig = BeltSlider(mass, spring, 0.0, load, Friction(stiffness, 0.0, ratio, ratio))
    frequency = math.sqrt(spring / mass)
    period = 2.0 * math.pi / frequency
    start = numpy.array([amplitude, 0.0, -ratio * load / stiffness])
    states = integrate(rig, start, numpy.array([1e-2, 1e-1, 1e-4]) * 1e-13, numpy.array([0.0, period])).states
    energy = 0.5 * spring * states[:, 0] ** 2 + 0.5 * mass * states[:, 1] ** 2
    enclosed = 4.0 * ratio * load * (amplitude - ratio * load / stiffness)
    assert energy[0] - energy[1] == pytest.approx(enclosed, rel=2e-3)
