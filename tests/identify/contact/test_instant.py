"""The instant of an impact is not known better than the flights: its error is in all standard deviations."""

import functools

import numpy
import pytest
from scipy.stats import chi2
from tests.identify import motions

from contact_sim_pkg.identify.contact.balance import Side, balance
from contact_sim_pkg.identify.contact.instant import impact_balance, instant
from contact_sim_pkg.identify.identify import Setup, identify
from contact_sim_pkg.identify.motion import geometry, wrench
from contact_sim_pkg.identify.motion.flight import FlightModel, FlightState, moved, rates, state_at
from contact_sim_pkg.identify.motion.rotation import exponential, logarithm
from contact_sim_pkg.identify.problem import spatial_basis

MODEL = FlightModel(spatial_basis(), True, wrench.constant((1.0, 2.0, 0.3), (0.01, -0.005, 0.002)), 9.81)
PARAMETERS = numpy.array([4e-3, 3e-3, 2e-3, 3e-4, -2e-4, 1e-4, 0.8])
BOX, GROUND, POINT = geometry.hull(geometry.box(motions.LENGTHS).points, 0.01), geometry.plane(height=0.2), 3
PUSH, DRAWS = (0.4, -0.2, 1.5), 60


def impact():
    """Motion before and after an impact of POINT at t = 0: what the impulse does to the spin is `S w' = r x pi`."""
    random = numpy.random.default_rng(4)
    rotation, velocity, spin = exponential(random.normal(size=3)), numpy.array([0.3, -0.1, -1.2]), random.normal(size=3)
    reach, push = geometry.arm(BOX, GROUND, rotation, POINT), numpy.array(PUSH)
    position = (GROUND.height - GROUND.normal @ reach) * GROUND.normal
    inertia = rotation @ MODEL.inertia(PARAMETERS) @ rotation.T
    turned = spin + numpy.linalg.solve(inertia, numpy.cross(reach, push))
    return FlightState(0.0, position, velocity, rotation, spin), FlightState(
        0.0, position, velocity + push, rotation, turned
    )


def sides(ends):
    return [Side(end, numpy.eye(12), numpy.zeros((12, 7))) for end in ends]


def test_the_rates_of_a_flight_match_finite_differences():
    state, step = impact()[1], 3e-6
    behind, ahead = (state_at(state, PARAMETERS, MODEL, time) for time in (-step, step))
    found = rates(state, PARAMETERS, MODEL)
    expected = numpy.concatenate([
        ahead.position - behind.position, ahead.velocity - behind.velocity,
        logarithm(ahead.rotation @ behind.rotation.T), ahead.angular_velocity - behind.angular_velocity,
    ]) / (2.0 * step)  # fmt: skip
    assert found == pytest.approx(expected, rel=1e-7, abs=1e-7)


@pytest.mark.parametrize("early", [1e-4, -1e-4, 1e-3])
def test_flights_taken_too_early_balance_at_the_root_of_the_gap(early):
    """What is left is of second order, 1e-3 of the moment at 1 ms; what the root takes away is 2e-2 of it."""
    found = sides(state_at(end, PARAMETERS, MODEL, -early) for end in impact())
    known = (*found, PARAMETERS, MODEL, BOX, GROUND, POINT)
    moment = numpy.linalg.norm(numpy.cross(geometry.arm(BOX, GROUND, impact()[0].rotation, POINT), PUSH))
    assert instant(found[0], BOX, GROUND, POINT).later == pytest.approx(early, rel=10.0 * abs(early))
    assert numpy.linalg.norm(impact_balance(*known).value) <= 2e3 * early**2 * moment
    assert numpy.linalg.norm(balance(*known).value) >= 10.0 * abs(early) * moment


def test_derivatives_at_the_root_match_finite_differences():
    def value(change_before, change_after):
        ends = [moved(state, change) for state, change in zip(impact(), (change_before, change_after), strict=True)]
        return impact_balance(*sides(ends), PARAMETERS, MODEL, BOX, GROUND, POINT)

    zero = numpy.zeros(12)
    found = value(zero, zero)
    for column in range(12):
        step = 1e-6 * numpy.eye(12)[column]
        for derivative, slots in ((found.by_before, (1, 0)), (found.by_after, (0, 1))):
            ahead, behind = (value(sign * slots[0] * step, sign * slots[1] * step).value for sign in (1, -1))
            assert derivative[:, column] == pytest.approx((ahead - behind) / 2e-6, rel=1e-5, abs=1e-7)


@functools.cache
def draws():
    """Identifications of the square under 1 mm, 1 mrad, 1 mm/s and 10 mrad/s, each with its own noise."""
    states = motions.states_of(motions.planar())
    return [
        identify(motions.noisy(states, seed, 1e-3, 1e-3), Setup(geometry.box([motions.SIDE] * 3)))
        for seed in range(DRAWS)
    ]


def assert_of_unit_deviation(errors):
    """The sum of n squares of normal errors in standard deviations lies between the 0.001 and 0.999 quantiles of chi^2_n."""
    low, high = chi2.ppf([1e-3, 1.0 - 1e-3], len(errors))
    assert low <= numpy.sum(numpy.square(errors)) <= high


def test_errors_of_the_inertia_are_as_large_as_told():
    found = [draw.parameters[0] for draw in draws()]
    assert all(parameter.identified for parameter in found)
    assert_of_unit_deviation([(each.value - motions.SIDE**2 / 6.0) / each.deviation for each in found])


@pytest.mark.parametrize("place", [0, 1, 2])
def test_errors_of_the_impulses_are_as_large_as_told(place):
    true = motions.planar().bounces[place].impulse / motions.MASS
    used = [draw.contacts[place] for draw in draws() if draw.contacts[place].mode is not None]
    assert len(used) == DRAWS
    assert_of_unit_deviation([(each.mode.normal - true[2]) / each.normal_deviation for each in used])
    assert_of_unit_deviation([(each.mode.tangential - abs(true[0])) / each.tangential_deviation for each in used])


def test_noise_alone_is_no_contradiction():
    assert [draw.warnings for draw in draws()] == [[]] * DRAWS
