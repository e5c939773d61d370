"""What the page of several runs says first, and its tiles."""

import math

import pytest

from contact_sim_pkg.compare.side_by_side import ComparedMetric
from contact_sim_pkg.records.metric import EVENT, LIMIT, SELF_CHECK, STATIONARY, Band
from contact_sim_pkg.report.comparison.verdict import answer_of_runs, moved_tiles

NAMES = ["A: soft", "B: firm", "C: hard"]
AT_MOST = Band(-math.inf, 100.0, LIMIT, "s")


def side(key, *values, spread=math.nan, limit=None, basis=EVENT, broken=()):
    spreads = (spread,) * len(values)
    broken = tuple(broken) if broken and isinstance(broken[0], tuple) else (broken,) * len(values) if broken else ()
    return ComparedMetric(
        key, key, "%", values, ("good",) * len(values), broken, basis, (math.nan,) * len(values), spreads, limit
    )


@pytest.mark.parametrize(
    ("sides", "tone", "word", "text"),
    [
        ([side("SEAT", 60.0, 50.0, spread=3.0, limit=AT_MOST)], "good", "B is better", "SEAT 60 → 50 % (-10 ± 4.24)."),
        ([side("SEAT", 60.0, 70.0, limit=AT_MOST)], "good", "A is better", "SEAT 60 → 70 % (+10)."),
        ([side("x", 1.0, 2.0), side("SEAT", 60.0, 62.0, spread=3.0, limit=AT_MOST)], "usual", "B: no difference beyond ±",
         "SEAT 60 → 62 % (+2 ± 4.24)."),
        ([side("x", 1.0, 2.0, limit=AT_MOST), side("SEAT", 60.0, 62.0, spread=3.0, limit=AT_MOST)], "usual",
         "B: no difference beyond ±", "SEAT 60 → 62 % (+2 ± 4.24); worse by x."),
        ([side("SEAT", 60.0, 50.0, limit=AT_MOST), side("a_w", 3.0, 4.0, limit=AT_MOST)], "usual", "B better and worse",
         "better by SEAT 60 → 50 % (-10); worse by a_w 3 → 4 % (+1)."),
        ([side("SEAT", 60.0, 50.0, limit=AT_MOST, basis=STATIONARY, broken=("too short",))], "doubtful", "B undecided",
         "the spread is not known of SEAT 60 → 50 % (-10) (too short)."),
        ([side("x", 60.0, 50.0)], "usual", "B differs", "most moved x 60 → 50 % (-10); no limit says which run is better."),
        ([side("x", 60.0, 50.0), side("SEAT", 0.0, 0.0, limit=AT_MOST), side("a_w", 3.0, 3.1, spread=1.0)], "usual", "B differs",
         "most moved x 60 → 50 % (-10); no limit says which run is better."),
        ([side("x", 60.0, 60.0)], "usual", "B is the same", "no metric differs from A."),
    ],
)  # fmt: skip
def test_one_sentence_says_which_is_better_and_by_what(sides, tone, word, text):
    assert answer_of_runs(NAMES[:2], sides, {"SEAT", "a_w"})[:3] == (tone, word, text)


def test_each_of_three_is_held_against_the_first():
    found = answer_of_runs(NAMES, [side("SEAT", 60.0, 50.0, 70.0, limit=AT_MOST)], {"SEAT"})
    assert found[:2] == ("good", "Against A")
    assert found.more == ("B is better: SEAT 60 → 50 % (-10).", "C: A is better: SEAT 60 → 70 % (+10).")
    assert [each[:3] for each in found.runs] == [
        ("good", "B is better", "SEAT 60 → 50 % (-10)"), ("good", "C: A is better", "SEAT 60 → 70 % (+10)"),
    ]  # fmt: skip


def test_each_run_has_its_own_reasons_of_doubt_and_those_of_the_first():
    short = (("too short: 20 s",), (), ("too short: 4 s",))
    found = answer_of_runs(NAMES, [side("SEAT", 60.0, 50.0, 70.0, limit=AT_MOST, broken=short)], {"SEAT"})
    assert found.more == (
        "B is better: SEAT 60 → 50 % (-10) (A: too short: 20 s).",
        "C: A is better: SEAT 60 → 70 % (+10) (A: too short: 20 s; C: too short: 4 s).",
    )
    assert [each.tone for each in found.runs] == ["doubtful", "doubtful"]
    last = (("lost",), ("lost",), ("lost", "late"))
    found = answer_of_runs(NAMES, [side("SEAT", 60.0, 50.0, 70.0, limit=AT_MOST, broken=last)], {"SEAT"})
    assert found.more[0].endswith("(lost).")
    assert found.more[1].endswith("(lost; C: late).")


def test_a_tile_of_several_runs_has_the_colour_of_the_worst():
    better_and_worse = side("SEAT", 60.0, 50.0, 70.0, limit=AT_MOST)
    same = side("SEAT", 60.0, 50.0, 60.0, limit=AT_MOST)
    tones = [moved_tiles(NAMES, [each], ())[0].tone for each in (better_and_worse, same)]
    assert tones == ["outside", "good"]


def test_a_run_that_ended_early_is_said_first():
    assert answer_of_runs(NAMES[:2], [], (), ["B: stopped by you."])[:3] == (
        "outside",
        "Not finished",
        "B: stopped by you.",
    )


def test_tiles_are_what_moved_most_with_the_leading_ones_and_no_self_check():
    sides = [side(str(k), 1.0, 2.0) for k in range(10)] + [
        side("F_z", 4.0, 4.0),
        side("check", 1.0, 3.0, basis=SELF_CHECK),
    ]
    assert [each.label for each in moved_tiles(NAMES[:2], sides, {"F_z"})] == ["0", "1", "2", "3", "4", "5", "6", "F_z"]


def test_the_number_of_a_leading_tile_is_not_shown_again():
    sides = [
        side("F_z", 4.0, 5.0),
        side("load, largest", 4.0, 5.0),
        side("load, smallest", 0.0, 0.0),
        side("lift", 0.0, 0.0),
    ]
    shown = moved_tiles(NAMES[:2], sides, {"F_z", "lift"})
    assert [each.label for each in shown] == ["F_z", "load, smallest", "lift"]


def test_a_tile_has_values_change_and_a_word_of_each_run():
    (tile,) = moved_tiles(NAMES, [side("SEAT", 60.0, 50.0, math.nan, spread=3.0, limit=AT_MOST)], ())
    assert (tile.letter, tile.value, tile.unit) == ("A", "60", "%")
    assert tile.moved[0] == ("B", "50", "", "-10 ± 4.24", "-16.7 %", "better", "good")
    assert tile.moved[1] == ("C", "–", "", "", "", "absent", "usual")
    (plain,) = moved_tiles(NAMES[:2], [side("x", 1.0, 2.0)], ())
    assert plain.moved[0][5:] == ("higher", "no-band")
    event = side("F_z", 1.0, 2.0)._replace(instants=("at 0.990 s", ""))
    (shown,) = moved_tiles(NAMES[:2], [event], ())
    assert (shown.instant, shown.moved[0].instant) == ("at 0.990 s", "")
