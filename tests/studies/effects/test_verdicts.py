"""Verdicts of effects by thirds of the requested accuracy."""

import pytest

from contact_sim_pkg.compare.judgement import Judgement
from contact_sim_pkg.studies.effects import verdicts

REQUEST = 3e-2


def change(size, error=0.0, kind="force"):
    return verdicts.Change("tire", kind, size, error, "tire normal", 0.1)


@pytest.mark.parametrize(
    ("sizes", "verdict"),
    [
        ((0.031,), verdicts.NEEDED),
        ((0.001, 0.031), verdicts.NEEDED),
        ((0.03,), verdicts.WITHIN),
        ((0.011,), verdicts.WITHIN),
        ((0.0099, 0.0), verdicts.NOT_NEEDED),
        ((), verdicts.NOT_NEEDED),
    ],
)
def test_an_effect_that_is_on_is_weighed_in_thirds_of_the_request(sizes, verdict):
    assert verdicts.verdict_on([change(size) for size in sizes], REQUEST) == verdict


def test_below_the_error_of_its_numbers_a_change_says_nothing():
    assert verdicts.verdict_on([change(0.05, error=0.06)], REQUEST) == verdicts.NUMBERS
    assert verdicts.verdict_on([change(0.05, error=0.04)], REQUEST) == verdicts.NEEDED
    assert verdicts.verdict_on([change(0.009, error=0.5)], REQUEST) == verdicts.NOT_NEEDED, "a third is not reached"
    assert verdicts.verdict_on([change(0.05, 0.06, "peak"), change(0.04)], REQUEST) == verdicts.NEEDED


@pytest.mark.parametrize(
    ("size", "called_for", "verdict"),
    [
        (0.05, "slip", verdicts.OFF_NEEDED),
        (0.05, "", "would change force 5 %"),
        (0.02, "slip", "would change force 2 %"),
        (0.0, "slip", "would change nothing"),
    ],
)
def test_an_effect_that_is_off_is_needed_where_the_data_call_for_it_too(size, called_for, verdict):
    assert verdicts.verdict_off([change(size)], REQUEST, called_for) == verdict


def test_resolved_changes_come_first_and_an_effect_has_its_own_least_error():
    judged = [
        Judgement("tire", "peak", 0.4, "tire peak", 0.1),
        Judgement("tire", "force", 0.012, "tire normal", 0.2),
        Judgement("wheel_z", "motion", 0.1, "wheel_z velocity", 0.3),
    ]
    found = verdicts.changes_of(judged, {("tire", "peak"): 0.5}, {"force": 1.5e-2})
    assert [(each.kind, each.resolved) for each in found] == [("motion", True), ("peak", False), ("force", False)]
    assert verdicts.largest(found).column == "wheel_z velocity"


def test_rounding_is_no_change():
    judged = [Judgement("seat", "force", 5e-16, "seat normal", 0.1)]
    found = verdicts.changes_of(judged, {}, {})
    assert verdicts.verdict_off(found, REQUEST, "slip") == "would change nothing"
    assert verdicts.shown(found[0]) == "nothing"


def test_a_change_is_shown_in_per_cent():
    assert verdicts.shown(change(2.3449)) == "force 234 %"
    assert verdicts.shown(change(0.997)) == "force 100 %"
    assert verdicts.shown(change(0.0123, kind="peak")) == "peak pressure 1.2 %"
