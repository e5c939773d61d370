"""What an identification says where its input is wrong: shape, ground, gravity or wrench other than those of the motion."""

import functools
import importlib.util
from pathlib import Path

import numpy
import pytest

from contact_sim_pkg.identification import geometry, wrench
from contact_sim_pkg.identification.identify import Setup, identify

_spec = importlib.util.spec_from_file_location("motions", Path(__file__).with_name("motions.py"))
motions = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(motions)

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
def test_nothing_is_doubted_where_all_is_right(seed):
    found = right(seed)
    assert found.doubts == []
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
    assert found.doubts[0].startswith("contacts and flights contradict each other")
    assert found.estimate.misfit > 3.0


def test_ground_a_millimetre_too_high_looks_soft_is_told_and_leaves_the_numbers_right():
    """The body goes into the ground as told and comes out again, as on a soft one: the numbers bear it, with a doubt."""
    found = spatial(1, ground=geometry.plane((0.0, 0.0, 1.0), 0.001))
    assert any("check ground and shape" in line for line in found.doubts)
    truth = [*numpy.diag(motions.SPATIAL_INERTIA), 0.0, 0.0, 0.0]
    for parameter, expected in zip(found.parameters, truth, strict=True):
        assert parameter.identified
        assert abs(parameter.value - expected) < 4.0 * parameter.deviation


def test_a_wrong_force_is_doubted_too():
    found = spatial(2, FORCE, wrench=wrench.constant((1.0, 2.0, 0.9)))
    assert found.doubts


def test_a_shape_that_does_not_reach_the_ground_is_told_with_the_number_of_contacts():
    found = spatial(None, shape=geometry.sphere(0.02))
    assert found.doubts == ["4 contacts touch nothing known: check the shape, its axes, and the ground"]


def test_wrong_gravity_leaves_no_flight_and_says_so():
    found = spatial(None, gravity=9.7)
    assert found.doubts == [
        "the body does not move as a free one where it is off the ground: see the notes of the contacts"
    ]


def test_contacts_without_a_flight_beside_them_are_no_reason_to_doubt():
    """The last of the bounces leave no flight of three samples between them: noted, and nothing speaks against the rest."""
    states = motions.states_of(motions.planar())
    thin = [field[::12] for field in states]
    found = identify(type(states)(*thin), Setup(geometry.box([0.1] * 3)))
    assert any(contact.note.startswith("no flight of 3 samples") for contact in found.contacts)
    assert found.doubts == []


def test_a_body_that_rests_below_the_ground_told_is_no_contact():
    states = motions.states_of(motions.planar())
    low = states._replace(position=states.position - [0.0, 0.0, 5.0])
    found = identify(low, Setup(geometry.box([0.1] * 3), gravity=9.0))
    assert "m below the ground" in found.contacts[0].note
    assert found.doubts
