"""Hidden values of the bench's own finer runs, fitted: what is true is known by construction."""

import pytest
from scipy import stats

from contact_sim_lab.twins.fit_twins import KINDS, PAIRS, REFUSED, is_named, refused, twins
from contact_sim_pkg.sweep.pool import Workers


def test_intervals_hold_hidden_values_of_a_slapping_back():
    """Of 5 twins with two keys, as many as a binomial of 0.9 has but once in a thousand."""
    with Workers(1) as workers:
        found = [*twins(KINDS["slap"], 5, workers)]
    assert all(each.found.follows for each in found)
    assert sum(sum(each.inside) for each in found) >= stats.binom.ppf(1e-3, 10, 0.9)
    for each in found:
        for truth, key in zip(each.truth, each.found.parameters, strict=True):
            assert (key.high - key.low) < 0.02 * truth


def test_restitution_is_not_told_apart_from_its_speed():
    kind, count = PAIRS["damping"]
    with Workers(1) as workers:
        (twin,) = twins(kind, 1, workers)
    assert is_named(count, twin.found)


@pytest.mark.parametrize("what", REFUSED)
def test_a_recording_that_the_scene_cannot_follow_is_refused(what):
    with Workers(1) as workers:
        assert not refused(what, workers, 0).follows
