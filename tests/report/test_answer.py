"""The first sentence of the page, and which metrics are its tiles."""

import math

import pytest
from tests.report import synthetic_bag as known

from contact_sim_pkg.records.metric import CLOSED_FORM, LIMIT, OUTSIDE, SELF_CHECK, STATIONARY, Band, Metric, judged
from contact_sim_pkg.report.answer import MOST_PHRASES, answer_of, first_metrics
from contact_sim_pkg.report.metrics.listing import metrics_of
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.run.outputs import Estimate

AT_MOST_100 = Band(-math.inf, 100.0, LIMIT, "s")


def metric(key, value=1.0, band=None, basis=STATIONARY, **others):
    return Metric(key, key, value, "", judged(value, band), band, basis=basis, **others)


@pytest.fixture(scope="module")
def recording(tmp_path_factory):
    return read_recording(known.seat_bag(tmp_path_factory.mktemp("seat") / "seat"))


@pytest.mark.parametrize(
    ("factor", "word"),
    [
        (metric("seat.factor", 57.0, AT_MOST_100), "Good"),
        (metric("seat.factor", 131.0, AT_MOST_100), "Outside"),
        (metric("seat.factor", 57.0, AT_MOST_100, broken=("too short: 3 s, 34 s needed",)), "Doubtful"),
        (metric("seat.factor", 57.0), "Measured"),
    ],
)
def test_the_worst_that_holds_comes_first(recording, factor, word):
    answer = answer_of(recording, [factor])
    assert answer.word == word
    assert "SEAT " in answer.text
    assert ("too short" in answer.text) == (word == "Doubtful")


def test_two_phrases_stand_open_and_the_others_are_folded(recording):
    found = [*metrics_of(recording)]
    answer = answer_of(recording, found)
    assert len(answer.text.split("; ")) <= 1 + MOST_PHRASES
    assert answer.more
    assert not any(text in answer.text for text in answer.more)


def test_a_run_that_failed_says_so_before_its_numbers(recording):
    failed = recording._replace(metadata={"ended": "failed", "failure": "the solver stopped"})
    answer = answer_of(failed, [metric("seat.factor", 57.0, AT_MOST_100)])
    assert (answer.word, answer.tone) == ("Not finished", "outside")
    assert "the solver stopped" in answer.text


def test_a_run_that_errs_by_more_than_requested_is_doubtful(recording):
    estimates = [Estimate("seat/force.normal", 30.0, 1000.0)]
    scene = {**recording.scene, "accuracy": 1e-2}
    answer = answer_of(recording._replace(estimates=estimates, scene=scene), [metric("seat.factor", 57.0, AT_MOST_100)])
    assert (answer.word, answer.tone) == ("Doubtful", "doubtful")
    assert "estimated above the requested 1e-2: seat force 3e-2" in answer.text
    enough = answer_of(
        recording._replace(estimates=estimates, scene={**scene, "accuracy": 5e-2}),
        [metric("seat.factor", 57.0, AT_MOST_100)],
    )
    assert enough.word == "Good"


def test_what_lies_outside_is_the_first_tile_and_self_checks_only_fill(recording):
    check = Band(0.0, 2.0, CLOSED_FORM, "s")
    many = [
        metric("energy.residual", band=check, basis=SELF_CHECK),
        *(metric(f"seat.{name}") for name in "abcdefghi"),
        metric("seat.late", 131.0, AT_MOST_100),
        metric("seat.a_w"),
    ]
    tiles = [each.key for each in first_metrics(recording, many)]
    assert len(tiles) == 8
    assert tiles[0] == "seat.late"
    assert "seat.a_w" in tiles  # the answer names it
    assert "energy.residual" not in tiles
    assert "energy.residual" in [each.key for each in first_metrics(recording, many[:4])]
    assert many[-2].verdict == OUTSIDE
