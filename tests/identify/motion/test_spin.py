"""Spins that contradict the rotations, and flights that a torque turns which nobody told."""

import numpy
import pytest
from tests.identify import motions

from contact_sim_pkg.identify.contact.noise import first_guess
from contact_sim_pkg.identify.errors import IdentificationError
from contact_sim_pkg.identify.identify import Setup, identify
from contact_sim_pkg.identify.motion import geometry
from contact_sim_pkg.identify.motion.rotation import exponential
from contact_sim_pkg.identify.turning import missing_spin_rate, rate_of_turn, spin_scale

NOISES = {"exact": None, "fine": (1e-4, 1e-3, 1e-3, 1e-2), "coarse": (5e-4, 3.5e-3, 1e-2, 5e-2)}
SQUARE = Setup(geometry.box([motions.SIDE] * 3))


def sampled(record, noise):
    states = motions.states_of(record)
    return states if NOISES[noise] is None else motions.noisy(states, 4, *NOISES[noise])


@pytest.mark.parametrize("noise", NOISES)
@pytest.mark.parametrize("torque", [-0.02, 0.005])
def test_a_torque_that_was_not_told_is_the_spin_rate_that_is_missing(torque, noise):
    """T / J, whatever the search has made of the impacts."""
    found = identify(sampled(motions.planar(0.6, (0.0, 0.0, 0.0), (0.0, torque, 0.0)), noise), SQUARE)
    missing = missing_spin_rate(found.estimate, found.problem)
    expected = torque / (motions.MASS * motions.SIDE**2 / 6.0)
    assert missing.value[1] == pytest.approx(expected, abs=max(5.0 * missing.deviation, 0.05 * abs(expected)))
    assert any("check the torque" in line for line in found.warnings)


@pytest.mark.parametrize("noise", NOISES)
@pytest.mark.parametrize("told", [0.95, 1.02])
@pytest.mark.parametrize("space", [False, True])
def test_a_spin_in_a_wrong_scale_is_told_with_its_scale(space, told, noise):
    states = sampled(motions.spatial() if space else motions.planar(), noise)
    states = states._replace(angular_velocity=told * states.angular_velocity)
    setup = SQUARE._replace(shape=geometry.box(motions.LENGTHS)) if space else SQUARE
    found = identify(states, setup)
    scale = spin_scale(found.estimate, found.problem)
    first_order = 0.1 * abs(1.0 / told - 1.0) if space else 1e-9  # where the axis of the spin turns
    assert 1.0 + scale.excess == pytest.approx(1.0 / told, abs=max(5.0 * scale.deviation, first_order))
    assert any("as fast as the spin says" in line for line in found.warnings)


@pytest.mark.parametrize("noise", NOISES)
def test_spins_in_degrees_are_refused_before_anything_starts(noise):
    states = sampled(motions.spatial(), noise)
    told = states._replace(angular_velocity=numpy.degrees(states.angular_velocity))
    assert rate_of_turn(told, first_guess(told).angular_velocity) == pytest.approx(numpy.pi / 180.0, rel=0.05)
    with pytest.raises(IdentificationError, match=r"turn 0\.017\d* times as fast .* give these in rad/s"):
        identify(told, Setup(geometry.box(motions.LENGTHS)))


def test_the_rate_of_a_body_that_hardly_turns_is_open():
    states = sampled(motions.planar(), "coarse")
    still = states._replace(angular_velocity=0.001 * states.angular_velocity)
    assert rate_of_turn(still, first_guess(still).angular_velocity) is None


@pytest.mark.parametrize("turn", [0.05, 0.5])
def test_a_single_rotation_that_is_wrong_is_refused_by_its_number(turn):
    states = sampled(motions.planar(), "fine")
    states.rotation[250] = exponential(numpy.array([0.0, turn, 0.0])) @ states.rotation[250]
    with pytest.raises(IdentificationError, match=r"the rotation jumps by 0.* rad between samples 2(49|50) and"):
        identify(states, SQUARE)


def test_noise_within_the_plane_alone_is_found_as_large_as_it_is():
    """A camera sees x, z and the pitch; what is across is a constant, which has no noise to average over."""
    exact, noise = motions.states_of(motions.planar()), NOISES["fine"]
    noisy = motions.noisy(exact, 2, *noise)
    generator = numpy.random.default_rng(3)
    pitch = numpy.zeros((len(exact.time), 3))
    pitch[:, 1] = noise[1] * generator.normal(size=len(exact.time))
    for field in ("position", "velocity"):
        getattr(noisy, field)[:, 1] = getattr(exact, field)[:, 1]
    noisy.angular_velocity[:, [0, 2]] = exact.angular_velocity[:, [0, 2]]
    found = identify(noisy._replace(rotation=exponential(pitch) @ exact.rotation), SQUARE)
    assert found.noise == pytest.approx((noise[0], noise[1], noise[2], noise[3]), rel=0.12)
    assert found.warnings == []
