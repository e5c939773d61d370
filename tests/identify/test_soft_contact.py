"""Identification from contacts that last over several samples: motions on a soft ground, made by scipy."""

import numpy
import pytest
from scipy.spatial.transform import Rotation
from tests.identify import soft_motions as soft

from contact_sim_pkg.identify.identify import Setup, identify
from contact_sim_pkg.identify.motion import geometry, wrench
from contact_sim_pkg.identify.motion.states import BodyStates

SQUARE = Setup(geometry.box([0.1] * 3))


def inertia(found):
    """Ratio of J/m to the true s^2/6 less 1, and its standard deviation."""
    return found.parameters[0].value * 600.0 - 1.0, found.parameters[0].deviation * 600.0


@pytest.mark.parametrize(
    ("stiffness", "rate", "allowed"),
    [(1e4, 5000.0, 1e-7), (1e5, 1000.0, 1e-5), (1e5, 5000.0, 1e-7), (1e6, 1000.0, 2e-4), (1e6, 5000.0, 5e-6)],
)
def test_impacts_of_many_samples_tell_the_inertia(stiffness, rate, allowed):
    found = identify(soft.bouncing_square(stiffness, rate), SQUARE)
    error, deviation = inertia(found)
    assert abs(error) < min(allowed, 4.0 * deviation)
    assert found.warnings == []


def test_their_impulse_is_what_the_velocities_changed_by_less_gravity():
    states = soft.bouncing_square(1e5)
    found = identify(states, SQUARE)
    for contact in found.contacts:
        first, last = numpy.searchsorted(states.time, [contact.begin, contact.end])
        passed = states.time[last] - states.time[first - 1]
        expected = states.velocity[last] - states.velocity[first - 1] + [0.0, 0.0, 9.81 * passed]
        assert contact.push == pytest.approx(expected, abs=1e-7)
        assert "the body turned by" in contact.note


@pytest.mark.parametrize(("stiffness", "rate"), [(1e5, 200.0), (1e6, 200.0), (1e7, 200.0), (1e7, 1000.0)])
@pytest.mark.parametrize("noise", [0.0, 1.0])
def test_too_few_samples_are_told_and_the_deviation_grows(stiffness, rate, noise):
    found = identify(noisy(soft.bouncing_square(stiffness, rate), noise), SQUARE)
    error, deviation = inertia(found)
    assert abs(error) < 3.0 * deviation < 0.3
    if stiffness > 1e5:
        assert any("record faster" in line for line in found.warnings)


@pytest.mark.parametrize(("stiffness", "rate"), [(1e4, 1000.0), (1e4, 5000.0), (1e5, 1000.0), (1e6, 1000.0)])
def test_noise_leaves_the_truth_within_its_deviations(stiffness, rate):
    error, deviation = inertia(identify(noisy(soft.bouncing_square(stiffness, rate), 1.0), SQUARE))
    assert abs(error) < 3.5 * deviation < 0.04


def test_a_known_force_tells_the_mass_on_soft_ground_too():
    force = (1.3, 0.0, 0.7)
    states = soft.bouncing_square(1e5, 1000.0, force)
    found = identify(states, SQUARE._replace(wrench=wrench.constant(force)))
    assert 1.0 / found.parameters[1].value == pytest.approx(1.3, rel=1e-6)
    error, deviation = inertia(found)
    assert abs(error) < 4.0 * deviation < 5e-3


def test_a_box_in_space_tells_all_six_moments_on_soft_ground():
    lengths = numpy.array([0.10, 0.14, 0.20])
    moments = (lengths @ lengths - lengths**2) / 12.0
    corners = geometry.box(lengths).points
    start = ((0.0, 0.0, 0.3), numpy.linalg.qr([[1.0, 0.2, -0.4], [0.3, 1.0, 0.1], [0.2, -0.2, 1.0]])[0], (0.5, 0.1, 0.0),
             (1.0, 2.0, 3.0))  # fmt: skip
    turned = start[1] * numpy.sign(numpy.linalg.det(start[1]))
    states = soft.soft_fall(
        2.1, 2.1 * numpy.diag(moments), corners, (1e5, 0.2, 0.3), (start[0], turned, *start[2:]), 0.45, 2000.0
    )
    found = identify(states, Setup(geometry.box(lengths)))
    assert found.rank == 6
    for parameter, expected in zip(found.parameters, [*moments, 0.0, 0.0, 0.0], strict=True):
        assert abs(parameter.value - expected) < 4.0 * parameter.deviation + 1e-9
        assert parameter.value == pytest.approx(expected, abs=1e-3 * moments.sum())


def noisy(states, size):
    """0.1 mm, 1 mrad, 1 mm/s, 10 mrad/s, times `size`."""
    if not size:
        return states
    draw = numpy.random.default_rng(0).normal
    shape = states.position.shape
    position, velocity = (spread * size * draw(size=shape) for spread in (1e-4, 1e-3))
    turn, spin = (spread * size * draw(size=shape) for spread in (1e-3, 1e-2))
    rotation = Rotation.from_rotvec(turn).as_matrix() @ states.rotation
    return BodyStates(
        states.time, states.position + position, rotation, states.velocity + velocity, states.angular_velocity + spin
    )
