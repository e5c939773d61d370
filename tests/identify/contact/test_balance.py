"""Derivatives, free rotation, and the counting of single steps under a known wrench."""

import numpy
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from contact_sim_pkg.identify.contact.balance import Side, balance, lasting_balance
from contact_sim_pkg.identify.contact.stacked import estimate
from contact_sim_pkg.identify.motion import geometry, wrench
from contact_sim_pkg.identify.motion.flight import FlightModel, FlightState, motion, moved, plain_motion, turn
from contact_sim_pkg.identify.motion.rotation import exponential
from contact_sim_pkg.identify.motion.states import BodyStates, SampleNoise
from contact_sim_pkg.identify.problem import (
    ContactSpan,
    IdentificationProblem,
    ImpulseMoment,
    planar_basis,
    spatial_basis,
    starting_parameters,
)

SIDE, MASS, STEP = 0.1, 1.3, 1e-3
AXIS = numpy.array([0.0, 1.0, 0.0])
SQUARE = geometry.flattened(geometry.box([SIDE] * 3), AXIS)
BOX = geometry.box([0.10, 0.14, 0.20])
PUSHED = wrench.constant((1.0, 2.0, 0.3), (0.01, -0.005, 0.002))
PARAMETERS = numpy.array([4e-3, 3e-3, 2e-3, 3e-4, -2e-4, 1e-4, 0.8])
SCALE = numpy.array([3e-3] * 6 + [0.8])


def state_of(random, time=0.0):
    return FlightState(
        time, *random.normal(size=(2, 3)), exponential(random.normal(size=3)), 3.0 * random.normal(size=3)
    )


def test_derivatives_of_a_flight_match_finite_differences():
    state, model = state_of(numpy.random.default_rng(1)), FlightModel(spatial_basis(), True, PUSHED, 9.81)
    times = numpy.array([-0.01, 0.07])
    found = motion(state, PARAMETERS, SCALE, model, times)
    for column in range(12):
        step = 1e-4 * numpy.eye(12)[column]
        ahead, behind = (plain_motion(moved(state, sign * step), PARAMETERS, model, times) for sign in (1, -1))
        for rows, place in ((0, slice(0, 3)), (1, slice(3, 6)), (3, slice(9, 12))):
            assert found.by_state[:, place, column] == pytest.approx(
                (ahead[rows] - behind[rows]) / 2e-4, rel=1e-5, abs=1e-7
            )


def check_derivatives(value):
    """Of `value(change of the state before, of the state after, parameters)`, a balance, against finite differences."""
    zero = numpy.zeros(12)
    found = value(zero, zero, PARAMETERS)
    for column in range(12):
        step = 1e-6 * numpy.eye(12)[column]
        for derivative, slots in ((found.by_before, (1, 0)), (found.by_after, (0, 1))):
            ahead, behind = (
                value(sign * slots[0] * step, sign * slots[1] * step, PARAMETERS).value for sign in (1, -1)
            )
            assert derivative[:, column] == pytest.approx((ahead - behind) / 2e-6, rel=1e-6, abs=1e-8)
    for column in range(7):
        step = 1e-6 * numpy.eye(7)[column]
        ahead, behind = (value(zero, zero, PARAMETERS + sign * step).value for sign in (1, -1))
        assert found.by_parameters[:, column] == pytest.approx((ahead - behind) / 2e-6, rel=1e-6, abs=1e-8)


def sides(before, after):
    return [Side(state, numpy.eye(12), numpy.zeros((12, 7))) for state in (before, after)]


def test_derivatives_of_the_balance_match_finite_differences():
    random = numpy.random.default_rng(3)
    before = state_of(random)
    after = moved(
        before, numpy.concatenate([random.normal(size=6), 1e-9 * random.normal(size=3), random.normal(size=3)])
    )
    model = FlightModel(spatial_basis(), True, PUSHED, 9.81)

    def value(change_before, change_after, parameters):
        ends = sides(moved(before, change_before), moved(after, change_after))
        return balance(*ends, parameters, model, BOX, geometry.plane(), 3)

    check_derivatives(value)


def test_derivatives_of_a_balance_that_lasts_match_finite_differences():
    random = numpy.random.default_rng(4)
    before, after = state_of(random), state_of(random, 0.02)
    model = FlightModel(spatial_basis(), True, PUSHED, 9.81)
    # Made at the state before, where the derivatives hold
    swept = ImpulseMoment(*random.normal(size=(2, 3)), before.velocity, 0.0, 0.0, 3)

    def value(change_before, change_after, parameters):
        ends = sides(moved(before, change_before), moved(after, change_after))
        return lasting_balance(*ends, parameters, model, BOX, geometry.plane(), 3, swept)

    check_derivatives(value)


@settings(max_examples=25)
@given(st.integers(0, 100_000), st.floats(0.01, 1.0), st.floats(1.0, 30.0))
def test_free_rotation_keeps_energy_and_angular_momentum(seed, ratio, speed):
    random = numpy.random.default_rng(seed)
    axes = exponential(random.normal(size=3))
    inertia = axes @ numpy.diag([1.0, 0.5 * (1.0 + ratio), max(ratio, 0.51 * (1.0 - ratio))]) @ axes.T * 1e-3
    rotation, spin = exponential(random.normal(size=3)), speed * random.normal(size=3)
    turned, spins = turn(
        rotation[None], spin[None], inertia[None], numpy.zeros(1), wrench.NO_WRENCH, 0.0, numpy.linspace(-0.1, 0.4, 7)
    )
    momentum = numpy.einsum("nij,jk,nlk,nl->ni", turned[0], inertia, turned[0], spins[0])
    expected = rotation @ inertia @ rotation.T @ spin
    assert abs(momentum - expected).max() <= 1e-12 * numpy.linalg.norm(expected) * max(1.0, speed)
    energy = numpy.einsum("ni,ni->n", momentum, spins[0])
    assert energy == pytest.approx(expected @ spin, rel=1e-11)


def step_problem(steps, force, torque):
    """Planar steps of one corner: (angle, tangential, normal impulse in [N s]); the balance makes the spin after."""
    known, rows = wrench.constant(force, torque), []
    for angle, tangential, normal in steps:
        middle = exponential(numpy.array([0.0, angle, 0.0]))
        corner = (middle @ SQUARE.points.T)[2].argmin()
        reach, push = middle @ SQUARE.points[corner], numpy.array([tangential, 0.0, normal])
        moment = numpy.cross(reach, push) + STEP * numpy.array(torque or (0, 0, 0))
        change = moment / (MASS * SIDE**2 / 6.0)
        speed_change = (push + STEP * numpy.array(force or (0, 0, 0))) / MASS - STEP * 9.81 * geometry.UP
        turning = exponential(-0.25 * STEP * change)
        rows += [(middle @ turning.T @ turning, numpy.zeros(3), numpy.zeros(3)), (middle, speed_change, change)]
    time = numpy.concatenate([[10.0 * k, 10.0 * k + STEP] for k in range(len(steps))])
    rotation, velocity, spin = (numpy.array(column) for column in zip(*rows, strict=True))
    half = 0.25 * STEP * spin[1::2]
    rotation[0::2], rotation[1::2] = exponential(-half) @ rotation[0::2], exponential(half) @ rotation[1::2]
    states = BodyStates(time, numpy.zeros((len(time), 3)), rotation, velocity, spin)
    points = [int((rotation[2 * k] @ SQUARE.points.T)[2].argmin()) for k in range(len(steps))]
    contacts = [ContactSpan(2 * k, 2 * k + 1, time[2 * k], time[2 * k + 1], points[k]) for k in range(len(steps))]
    model = FlightModel(planar_basis(), True, known, 9.81)
    flights = [(place, place) for place in range(len(time))]
    return IdentificationProblem(
        states, flights, contacts, SQUARE, geometry.plane(), model, SampleNoise(1e-12, 1e-12, 1e-12, 1e-12), AXIS
    )


def solved(problem):
    return estimate(problem, *starting_parameters(problem.shape, problem.model, AXIS, 0.5))


FORCE, TORQUE = (30.0, 0.0, 5.0), (0.0, 2.0, 0.0)
ONE = [(0.3, 0.02, 0.10)]
TWO = [*ONE, (0.5, -0.03, 0.05)]


@pytest.mark.parametrize(("force", "torque"), [(FORCE, None), (None, TORQUE)])
def test_a_single_step_under_a_known_wrench_is_one_equation_for_two_unknowns(force, torque):
    found = solved(step_problem(ONE, force, torque))
    assert found.directions.rank == 1
    assert abs(found.directions.missing[0]).min() > 1e-6  # mass and inertia move together


@pytest.mark.parametrize(("force", "torque"), [(FORCE, None), (None, TORQUE), (FORCE, TORQUE)])
def test_two_steps_whose_wrench_is_in_another_ratio_to_the_impulse_tell_mass_and_inertia(force, torque):
    found = solved(step_problem(TWO, force, torque))
    assert found.directions.rank == 2
    assert found.parameters == pytest.approx([SIDE**2 / 6.0, 1.0 / MASS], rel=1e-7)
