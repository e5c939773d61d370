"""Contacts that contradict the others: impacts that were two within a sample, under noise that hides it."""

import numpy
import pytest
from tests.identify import motions

from contact_sim_lab.identify.twins.falling_body import FallingBody, fall
from contact_sim_pkg.identify.identify import Setup, identify
from contact_sim_pkg.identify.motion import geometry
from contact_sim_pkg.identify.motion.states import BodyStates

COARSE = {"position": 1e-3, "rotation": 1e-3, "velocity": 1e-3, "spin": 1e-2}
LENGTHS = numpy.array([0.11, 0.07, 0.23])
INERTIA = numpy.diag((LENGTHS @ LENGTHS - LENGTHS**2) / 12.0)


def bouncing(seed):
    """A long box that bounces for a second; both of its ends come down within a few milliseconds now and then."""
    random = numpy.random.default_rng(seed)
    corners = 0.5 * LENGTHS * numpy.array([[i, j, k] for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)])
    body = FallingBody(1.0, INERTIA, corners, random.uniform(0.0, 1.0), random.uniform(0.5, 0.9))
    start = (numpy.array([0.0, 0.0, 0.4]), motions.exponential(random.uniform(-2.0, 2.0, 3)))
    return fall(body, *start, random.uniform(-1.0, 1.0, 3), random.uniform(-6.0, 6.0, 3), 1.0)


def thinned(states, step):
    return BodyStates(*(field[::step] for field in states))


def found_in(seed):
    states = thinned(motions.states_of(bouncing(seed)), 5)
    return identify(motions.noisy(states, seed, **COARSE), Setup(geometry.box(LENGTHS)))


@pytest.mark.parametrize(("seed", "doubles"), [(0, 0), (1, 0), (3, 2), (11, 1), (20, 3)])
def test_two_impacts_within_a_sample_spoil_no_moment_of_inertia(seed, doubles):
    """At 200 samples a second and 1 mm of noise. All used, they left the moments of 3, 11 and 20 500 deviations off."""
    found = found_in(seed)
    truth = [*numpy.diag(INERTIA), 0.0, 0.0, 0.0]
    assert found.rank == 6
    for parameter, expected in zip(found.parameters, truth, strict=True):
        assert abs(parameter.value - expected) < 4.5 * parameter.deviation < 0.02 * INERTIA.max()
    left_out = [contact for contact in found.contacts if contact.note.startswith("contradicts the other contacts")]
    assert len(left_out) == doubles
    assert sum(line.startswith(f"{doubles} contacts contradict the others") for line in found.warnings) == bool(doubles)


def test_what_is_left_out_was_two_impacts():
    times = numpy.array([bounce.time for bounce in bouncing(20).bounces])
    left_out = [each for each in found_in(20).contacts if each.note.startswith("contradicts the other contacts")]
    for contact in left_out:
        assert numpy.sum((times > contact.begin - 1e-9) & (times < contact.end + 1e-9)) == 2


def test_where_most_contradict_all_are_used_and_it_is_told():
    states = motions.noisy(motions.states_of(motions.planar()), 0, **COARSE)
    found = identify(states, Setup(geometry.box([0.98 * motions.SIDE] * 3)))
    assert found.warnings[0].startswith("contacts and flights contradict each other")
    assert len([contact for contact in found.contacts if contact.mode is not None]) == 4
