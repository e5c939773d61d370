"""Values that noise alone makes up are not reported; inertia that no body of the shape has gives a warning."""

import functools

import numpy
import pytest
from tests.identify import motions

from contact_sim_lab.identify.twins.falling_body import FallingBody, fall
from contact_sim_pkg.identify.identify import Setup, identify
from contact_sim_pkg.identify.motion import geometry, wrench
from contact_sim_pkg.identify.motion.rotation import exponential
from contact_sim_pkg.identify.warnings import OUTSIDE, impossible

CUBE = geometry.box([motions.SIDE] * 3)


@pytest.mark.parametrize("force", [1e-4, 1e-3])
def test_a_force_that_noise_hides_tells_no_mass_and_takes_nothing_from_the_inertia(force):
    """1e-4 N moves the body by 20 um, 1e-3 N by 0.2 mm in 0.7 s, where a sample is known to 0.1 mm and 1 mm/s."""
    states = motions.states_of(motions.planar(force=(force, 0.0, 0.0)))
    for seed in range(8):
        noise = motions.noisy(states, seed, 1e-4, 1e-3)
        found = identify(noise, Setup(CUBE, wrench=wrench.constant((force, 0.0, 0.0))))
        inertia, mass = found.parameters
        assert inertia.identified
        assert inertia.deviation < 0.005 * inertia.value
        assert abs(inertia.value - motions.SIDE**2 / 6.0) < 4.0 * inertia.deviation
        assert not mass.identified or mass.deviation < mass.value / 3.0
        assert mass.identified or sum(line.startswith("mass is not identifiable") for line in found.unobservable) == 1


def test_a_force_that_shows_tells_the_mass():
    states = motions.noisy(motions.states_of(motions.planar(force=(1e-2, 0.0, 0.0))), 0, 1e-4, 1e-3)
    found = identify(states, Setup(CUBE, wrench=wrench.constant((1e-2, 0.0, 0.0))))
    mass = found.parameters[1]
    assert mass.identified
    assert abs(mass.value - 1.0 / motions.MASS) < 4.0 * mass.deviation


@functools.cache
def exact(in_space):
    record, lengths = (motions.spatial(), motions.LENGTHS) if in_space else (motions.planar(), [motions.SIDE] * 3)
    return identify(motions.states_of(record), Setup(geometry.box(lengths)))


def said(found, parameters):
    return impossible(found.estimate._replace(parameters=numpy.array(parameters)), found.problem)


@pytest.mark.parametrize(("ratio", "broken"), [(0.99, False), (1.01, True), (0.01, False), (-0.01, True)])
def test_in_a_plane_no_mass_lies_beyond_the_corners(ratio, broken):
    """All mass in the four corners of a square: J/m = s^2/2."""
    assert said(exact(False), [ratio * motions.SIDE**2 / 2.0]) == [OUTSIDE] * broken


@pytest.mark.parametrize(
    ("moments", "broken"),
    [
        ((0.99, 0.99, 0.99), False),  # nearly all in the eight corners
        ((1.02, 0.99, 0.99), True),
        ((0.5, 0.5, 0.01), False),  # nearly a plate
        ((0.5, 0.5, -0.01), True),
    ],
)
def test_in_space_second_moments_lie_within_the_box(moments, broken):
    """int x^2 dm / m <= (length / 2)^2 along each axis; Ixx/m is the sum of those of y and z."""
    second = numpy.array(moments) * (motions.LENGTHS / 2.0) ** 2
    assert said(exact(True), [*(second.sum() - second), 0.0, 0.0, 0.0]) == [OUTSIDE] * broken


def test_two_impacts_half_a_millisecond_apart_are_not_reported_as_one_without_a_warning():
    random = numpy.random.default_rng(34)
    mass, friction = 10.0 ** random.uniform(-2.0, 2.0), random.uniform(0.0, 1.0)
    body = FallingBody(mass, mass * motions.SIDE**2 / 6.0 * numpy.eye(3), motions.SQUARE, friction, 0.6)
    turned = exponential(numpy.array([0.0, random.uniform(-3.0, 3.0), 0.0]))
    velocity = numpy.array([random.uniform(-1.0, 1.0), 0.0, 0.0])
    spin = numpy.array([0.0, random.uniform(-5.0, 5.0), 0.0])
    record = fall(body, numpy.array([0.0, 0.0, 0.3]), turned, velocity, spin, 0.5)
    assert record.bounces[1].time - record.bounces[0].time < 1e-3
    found = identify(motions.noisy(motions.states_of(record), 0, 1e-3, 1e-3, 1e-2), Setup(CUBE))
    assert any(contact.mode for contact in found.contacts)
    assert found.warnings == [OUTSIDE]
