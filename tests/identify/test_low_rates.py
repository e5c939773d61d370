"""Samples so far apart that impacts hide between them: bodies that tumble to rest at 50 to 200 samples a second."""

import pytest
from tests.identify import motions

from contact_sim_pkg.identify.identify import Setup, identify
from contact_sim_pkg.identify.motion import geometry


def deviations(seed, rate, *, noise):
    """The identification, and how many standard deviations its numbers are off."""
    states, sides, inertia = motions.random_box(seed, rate)
    if noise:
        states = motions.noisy(states, seed, 1e-4, 1e-3)
    found = identify(states, Setup(geometry.box(sides)))
    pairs = zip(found.parameters, [*inertia, 0.0, 0.0, 0.0], strict=True)
    return found, [abs(each.value - truth) / each.deviation for each, truth in pairs if each.identified]


@pytest.mark.parametrize(("seed", "rate"), [(0, 100.0), (10, 200.0)])
def test_a_contact_that_hides_two_impacts_is_left_out_though_few_others_are_there(seed, rate):
    """Of three contacts one, of two one, where flights that tumble tell which. Used, it left 354 deviations, or no fit at all."""
    found, off = deviations(seed, rate, noise=True)
    assert found.rank == 6
    assert max(off) < 4.5
    assert [line[:40] for line in found.warnings] == ["1 contacts contradict the others and are"]


@pytest.mark.parametrize(("seed", "rate"), [(15, 100.0), (18, 50.0)])
def test_coarse_steps_of_a_rest_that_fit_nothing_are_left_out(seed, rate):
    """They ended in a refusal, or in a search that had not converged."""
    found, off = deviations(seed, rate, noise=True)
    assert found.warnings == []
    assert found.converged
    assert not off


@pytest.mark.parametrize("seed", range(4))
def test_without_noise_low_rates_tell_the_inertia_within_its_deviation(seed):
    found, off = deviations(seed, 50.0, noise=False)
    assert off
    assert max(off) < 4.5
    assert found.warnings == []


def test_residuals_of_the_steps_of_a_rest_give_no_warning_about_the_flights():
    """At 100 Hz the impacts of a square are two samples apart: coarse steps of a lasting contact are left, and no number."""
    exact = motions.coming_to_rest(100.0)
    for states in (exact, *(motions.noisy(exact, seed, 1e-4, 1e-3) for seed in range(3))):
        found = identify(states, Setup(geometry.box([motions.SIDE] * 3)))
        assert not found.parameters[0].identified
        assert found.warnings == []
