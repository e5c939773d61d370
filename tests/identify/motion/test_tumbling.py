"""Bodies whose inertia is not that of a box along their axes: they tumble in space, and all of it is found."""

import numpy
import pytest
from scipy.spatial.transform import Rotation
from tests.identify import motions

from contact_sim_lab.identify.twins.falling_body import FallingBody, fall
from contact_sim_pkg.identify.identify import Setup, identify
from contact_sim_pkg.identify.motion import geometry
from contact_sim_pkg.identify.motion.flight import FlightModel
from contact_sim_pkg.identify.motion.segments import tumbling_start
from contact_sim_pkg.identify.motion.states import BodyStates, SampleNoise
from contact_sim_pkg.identify.motion.wrench import NO_WRENCH
from contact_sim_pkg.identify.problem import spatial_basis

LENGTHS = numpy.array([0.10, 0.14, 0.20])
CORNERS = 0.5 * LENGTHS * numpy.array([[i, j, k] for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)])
BOX = numpy.diag((LENGTHS @ LENGTHS - LENGTHS**2) / 12.0)
ROD = numpy.diag([0.0002, 0.0024, 0.0024])  # within 0.1 x 0.1 x 0.3 m


def turned_box(angle):
    """Corners and I0/m of the box in axes that are turned, as those of a motion capture are."""
    axes = Rotation.from_rotvec(numpy.radians(angle) * numpy.array([1.0, 2.0, 2.0]) / 3.0).as_matrix()
    return CORNERS @ axes.T, axes @ BOX @ axes.T


def motion_of(corners, inertia, height, duration, seed=1):
    random = numpy.random.default_rng(seed)
    body = FallingBody(1.0, inertia, corners, 0.3, 0.6)
    start = (numpy.array([0.0, 0.0, height]), motions.exponential(random.uniform(-2.0, 2.0, 3)))
    return fall(body, *start, random.uniform(-1.0, 1.0, 3), random.uniform(-8.0, 8.0, 3), duration)


@pytest.mark.parametrize("angle", [0.0, 20.0, 45.0, 60.0, 90.0])
@pytest.mark.parametrize("duration", [0.1, 0.5])
def test_a_flight_in_any_body_axes_tells_all_but_the_size(angle, duration):
    corners, inertia = turned_box(angle)
    found = identify(motions.states_of(motion_of(corners, inertia, 5.0, duration)), Setup(geometry.hull(corners)))
    assert found.converged
    assert found.rank == 5
    assert found.noise.angular_velocity < 1e-10
    assert any(line.startswith("the size of I0/m is not identifiable") for line in found.unobservable)
    told = found.problem.model.inertia(found.estimate.parameters)
    assert told / numpy.trace(told) == pytest.approx(inertia / numpy.trace(inertia), abs=1e-7)


@pytest.mark.parametrize("angle", [45.0, 90.0])
def test_impacts_in_turned_axes_tell_all_six_numbers(angle):
    corners, inertia = turned_box(angle)
    found = identify(motions.states_of(motion_of(corners, inertia, 0.4, 0.7)), Setup(geometry.hull(corners)))
    assert found.rank == 6
    assert found.problem.model.inertia(found.estimate.parameters) == pytest.approx(
        inertia, abs=1e-9 * numpy.trace(inertia)
    )


@pytest.mark.parametrize("noise", [None, (1e-4, 1e-3, 1e-3, 1e-2)])
def test_a_body_unlike_a_homogeneous_one_is_identified(noise):
    """Heavy along its axis: the start, a homogeneous box, has a least moment that is 8 times as large."""
    sides = numpy.array([0.1, 0.1, 0.3])
    corners = 0.5 * sides * numpy.sign(CORNERS)
    states = motions.states_of(motion_of(corners[:, [2, 0, 1]], ROD, 0.4, 0.8))
    states = states if noise is None else motions.noisy(states, 3, *noise)
    found = identify(states, Setup(geometry.box(sides[[2, 0, 1]])))
    assert found.rank == 6
    assert found.warnings == []
    for parameter, expected in zip(found.parameters[:3], numpy.diag(ROD), strict=True):
        allowed = 1e-9 * ROD.max() if noise is None else 4.5 * parameter.deviation
        assert abs(parameter.value - expected) <= allowed


def test_the_start_keeps_the_guess_where_a_body_spins_about_one_axis():
    """About z of a body with Ixz = Iyz = 0: the angular momentum is kept whatever the moments are."""
    states = motions.states_of(motions.spatial(0.1))
    turns = numpy.array([Rotation.from_rotvec([0.0, 0.0, 5.0 * time]).as_matrix() for time in states.time])
    spins = numpy.tile([0.0, 0.0, 5.0], (len(states.time), 1))
    guess = numpy.array([3e-3, 2e-3, 1e-3, 0.0, 0.0, 0.0])
    flight, model = [(0, len(states.time) - 1)], FlightModel(spatial_basis(), False, NO_WRENCH, 9.81)
    rolling = states._replace(rotation=turns, angular_velocity=spins)
    found = tumbling_start(rolling, flight, model, SampleNoise(1e-6, 1e-6, 1e-6, 1e-6), guess)
    assert found == pytest.approx(guess, abs=1e-12)


def test_what_is_open_is_named_parameter_by_parameter():
    """A ball that spins about the vertical and drops: x = y = 0 in w, so that Ixz and Iyz are 0 and the four others open."""
    rate, radius = 500, 0.05
    time = numpy.arange(100) / rate
    turns = numpy.array([Rotation.from_rotvec([0.0, 0.0, 5.0 * at]).as_matrix() for at in time])
    zero = numpy.zeros_like(time)
    place = numpy.stack([zero, zero, 1.0 - 0.5 * 9.81 * time**2], axis=1)
    speed = numpy.stack([zero, zero, -9.81 * time], axis=1)
    spin = numpy.tile([0.0, 0.0, 5.0], (len(time), 1))
    found = identify(BodyStates(time, place, turns, speed, spin), Setup(geometry.sphere(radius), planar=False))
    assert found.rank == 2
    open_ones = [
        line.removeprefix("not identifiable: ") for line in found.unobservable if line.startswith("not identifiable")
    ]
    assert sorted(open_ones) == ["Ixx/m", "Ixy/m", "Iyy/m", "Izz/m"]
