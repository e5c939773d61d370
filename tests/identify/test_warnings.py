"""What an identification says where its input is wrong: shape, ground, gravity or wrench other than those of the motion."""

import functools

import numpy
import pytest
from tests.identify import motions

from contact_sim_pkg.identify import turning as free_fall
from contact_sim_pkg.identify.errors import IdentificationError
from contact_sim_pkg.identify.identify import Setup, identify
from contact_sim_pkg.identify.motion import geometry, wrench

FORCE = (1.0, 2.0, 0.3)


@functools.cache
def right(seed=None):
    """Identification of the box of the tests, all said of it right."""
    return spatial(seed)


def spatial(seed=None, force=(0.0, 0.0, 0.0), **known):
    """Identification of the box of the tests from exact samples, or with noise; `known` is what the user says of it."""
    states = motions.states_of(motions.spatial(0.52 if any(force) else 0.5, force))
    if seed is not None:
        states = motions.noisy(states, seed, 1e-4, 1e-3)
    return identify(states, Setup(**{"shape": geometry.box(motions.LENGTHS), **known}))


@pytest.mark.parametrize("seed", [None, 0, 1, 2])
def test_no_warning_where_all_is_right(seed):
    found = right(seed)
    assert found.warnings == []
    assert found.estimate.misfit < 1.6  # of 36 equations, in standard deviations


def test_the_misfit_of_right_data_is_one_in_the_mean():
    """30 equations beyond the unknowns and more: the mean square of 4 draws is 1 within four of its deviations."""
    squares = [right(seed).estimate.misfit ** 2 for seed in range(4)]
    freedom = right(0).estimate.freedom
    assert numpy.mean(squares) == pytest.approx(1.0, abs=4.0 * numpy.sqrt(2.0 / (4.0 * freedom)))


@pytest.mark.parametrize(
    "wrong",
    [
        {"shape": geometry.box([0.10, 0.14, 0.202])},  # 1 % too long
        {"gravity": 9.7},
    ],
    ids=["shape", "gravity"],
)
def test_under_noise_a_contradiction_is_told_and_the_deviations_are_called_too_small(wrong):
    found = spatial(1, **wrong)
    assert found.warnings[0].startswith("contacts and flights contradict each other")
    assert found.estimate.misfit > 3.0


def test_ground_a_millimetre_too_high_looks_soft_is_told_and_leaves_the_numbers_right():
    """The body goes into the ground and comes out again, as on a soft one: the numbers hold, with a warning."""
    found = spatial(1, ground=geometry.plane((0.0, 0.0, 1.0), 0.001))
    assert any("check ground and shape" in line for line in found.warnings)
    truth = [*numpy.diag(motions.SPATIAL_INERTIA), 0.0, 0.0, 0.0]
    for parameter, expected in zip(found.parameters, truth, strict=True):
        assert parameter.identified
        assert abs(parameter.value - expected) < 4.0 * parameter.deviation


def test_a_wrong_force_gives_a_warning():
    found = spatial(2, FORCE, wrench=wrench.constant((1.0, 2.0, 0.9)))
    assert found.warnings


def test_a_shape_that_does_not_reach_the_ground_is_told_with_the_number_of_contacts():
    found = spatial(None, shape=geometry.sphere(0.02))
    assert found.warnings == ["4 contacts touch no known surface: check the shape, its axes, and the ground"]


def test_wrong_gravity_leaves_no_flight_and_says_so():
    """Without noise each interval contradicts it: there is nothing to begin with, and the 0.11 m/s^2 are told."""
    with pytest.raises(
        IdentificationError, match=r"no free motion, up to 0\.\d* m above .* by \(.*, -0\.11\) m/s\^2 more than gravity"
    ):
        spatial(None, gravity=9.7)


def test_contacts_without_a_flight_beside_them_give_no_warning():
    """The last of the bounces leave no flight of three samples between them: noted, and nothing speaks against the rest."""
    states = motions.states_of(motions.planar())
    thin = [field[::12] for field in states]
    found = identify(type(states)(*thin), Setup(geometry.box([0.1] * 3)))
    assert any(contact.note.startswith("no flight of 3 samples") for contact in found.contacts)
    assert found.warnings == []


def test_a_body_that_rests_below_the_ground_told_is_no_contact():
    states = motions.states_of(motions.planar())
    low = states._replace(position=states.position - [0.0, 0.0, 5.0])
    found = identify(low, Setup(geometry.box([0.1] * 3), gravity=9.0))
    assert "m below the ground" in found.contacts[0].note
    assert found.warnings


NOISES = {
    "exact": None,
    "fine": (1e-5, 1e-4, 1e-4, 1e-3),
    "middle": (1e-4, 1e-3, 1e-3, 1e-2),
    "coarse": (1e-3, 1e-3, 1e-3, 1e-2),
}


def square(noise, force=(0.0, 0.0, 0.0), **known):
    """Identification of the square of the tests; `known` is what the user says of it."""
    states = motions.states_of(motions.planar(0.6 if any(force) else 0.75, force))
    if NOISES[noise] is not None:
        states = motions.noisy(states, 0, *NOISES[noise])
    return identify(states, Setup(**{"shape": geometry.box([motions.SIDE] * 3), **known}))


@pytest.mark.parametrize("noise", NOISES)
def test_the_square_gives_no_warning_where_all_is_right(noise):
    assert square(noise).warnings == []


@pytest.mark.parametrize("noise", NOISES)
@pytest.mark.parametrize("share", [0.9, 0.98, 1.02, 1.1])
def test_a_shape_specified_too_small_or_too_large_gives_a_warning(noise, share):
    """One too large goes into the ground before its impact: where one interval holds all of the push, that is no soft contact."""
    found = square(noise, shape=geometry.box([share * motions.SIDE] * 3))
    assert any("check the shape" in line for line in found.warnings)


def test_impacts_that_happen_below_the_ground_by_less_than_one_tells_are_told_by_their_mean():
    """The box is 2 % too large: its corners lie 1 mm times cos and sin of the pitch further out, under 1 mm of noise."""
    found = square("coarse", shape=geometry.box([1.02 * motions.SIDE] * 3))
    (line,) = [line for line in found.warnings if line.startswith("impacts happen")]
    assert "below the ground in the mean" in line


@pytest.mark.parametrize("noise", ["middle", "coarse"])
@pytest.mark.parametrize("gravity", [0.0, 1.62, 9.8, 20.0])
def test_under_noise_a_gravity_that_is_wrong_is_told_with_the_acceleration_that_is_missing(noise, gravity):
    found = square(noise, gravity=gravity)
    missing = free_fall.missing_acceleration(found.estimate, found.problem)
    assert any(line.startswith("the flights accelerate by") for line in found.warnings)
    assert abs(missing.value - [0.0, 0.0, gravity - 9.81]).max() < 4.5 * missing.deviation


@pytest.mark.parametrize("noise", ["middle", "coarse"])
def test_a_force_that_is_not_told_is_seen_as_the_acceleration_it_gives(noise):
    force = (1.3, 0.0, 0.7)
    found = square(noise, force)
    missing = free_fall.missing_acceleration(found.estimate, found.problem)
    assert any(line.startswith("the flights accelerate by") for line in found.warnings)
    assert abs(missing.value - numpy.array(force) / motions.MASS).max() < 4.0 * missing.deviation < 0.1


def test_the_deviation_of_the_missing_acceleration_is_that_of_many_draws():
    """Of the right gravity: its mean square over its variance is 1 within four of its deviations, of 20 draws in 3 directions."""
    states, setup = motions.states_of(motions.planar()), Setup(geometry.box([motions.SIDE] * 3))
    squares = []
    for seed in range(20):
        found = identify(motions.noisy(states, seed, 1e-4, 1e-3), setup)
        missing = free_fall.missing_acceleration(found.estimate, found.problem)
        squares.append(float(numpy.mean((missing.value / missing.deviation) ** 2)))
    assert numpy.mean(squares) == pytest.approx(1.0, abs=4.0 * numpy.sqrt(2.0 / 60.0))


def test_a_force_that_swings_faster_than_the_flights_last_is_told_by_what_they_leave():
    """200 rad/s: no mean acceleration, but the velocities swing by far more than neighbouring samples differ."""
    states = motions.noisy(motions.states_of(motions.planar()), 0, 1e-5, 1e-4, 1e-4, 1e-3)
    swing = 0.05 * numpy.sin(200.0 * states.time)
    way = 0.05 / 200.0 * (1.0 - numpy.cos(200.0 * states.time))
    shaken = states._replace(
        velocity=states.velocity + numpy.outer(swing, [0.0, 1.0, 0.0]),
        position=states.position + numpy.outer(way, [0.0, 1.0, 0.0]),
    )
    found = identify(shaken, Setup(geometry.box([motions.SIDE] * 3), planar=False))
    assert any("times what neighbouring samples differ by" in line for line in found.warnings)


def test_a_force_of_the_wrong_sign_gives_a_warning_and_is_not_called_faint():
    """Exact, and 0.1 mm, 1 mrad: the body goes where the known force does not push it."""
    exact = motions.states_of(motions.planar(0.6, (1.0, 0.0, 0.0)))
    for states in (exact, motions.noisy(exact, 0, 1e-4, 1e-3)):
        found = identify(states, Setup(geometry.box([motions.SIDE] * 3), wrench=wrench.constant((-1.0, 0.0, 0.0))))
        assert not found.parameters[-1].identified
        assert any(line.startswith("the body moves against the known wrench") for line in found.warnings)
        assert not any("no trace" in line for line in found.unobservable)


def test_a_flight_that_an_untold_force_bends_is_no_contact_that_tells_a_friction():
    """Without noise each interval contradicts free motion: all of the record looked like a slide. (3, 0, 1.5) N on 1.3 kg."""
    states = motions.states_of(motions.planar(0.6, (3.0, 0.0, 1.5)))
    with pytest.raises(
        IdentificationError, match=r"no free motion, .* by \(2\.31, 0, 1\.15\) m/s\^2 more than gravity"
    ):
        identify(states, Setup(geometry.box([motions.SIDE] * 3)))
