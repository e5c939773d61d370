"""`bench effects`: the scenes that misled static rules, the written scene, the answer.

Those of a tire take longer: `bench hard --effects` has all of them.
"""

import itertools
import json
import math
import time

import pytest
from click.testing import CliRunner

from contact_sim_lab.hard import effect_cases, effect_table
from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.cli.effects import command
from contact_sim_pkg.compare import span
from contact_sim_pkg.records.metric import Metric
from contact_sim_pkg.scene.resolve import load_resolved
from contact_sim_pkg.studies.effects import effects_study, effects_table, event_runs, of_metrics, reduced, verdicts

QUICK = (
    "slip angle of 1e-9 rad", "sliding of 1e-12 m", "ride without loss", "rubber at 256 K", "0.01 K apart",
    "ring on a flat road", "softening on noise", "map of a ride", "recorded ride without friction",
    "stress of an impact", "shift in a room",
)  # fmt: skip

WITHOUT_LOSS = ("normal_dissipative", "surface_waves", "history")  # and what needs it


def silent(_line):
    """Progress that nobody reads."""


@pytest.mark.parametrize(
    "case", [case for case in effect_cases.CASES if case.name in QUICK], ids=lambda case: case.name
)
def test_the_verdict_is_the_expected_one(case):
    ((row,),) = effect_table.study(silent, [case])
    assert row["verdict"] == case.expected, row


def test_there_are_forty_cases_of_effects_that_exist():
    assert len(effect_cases.CASES) == 40
    assert len({case.name for case in effect_cases.CASES}) == 40


@pytest.mark.parametrize(
    ("expected", "verdict", "mark"),
    [
        ("needed", "needed", "right"), ("not needed", "needed", "needless"), ("off but needed", "a figure", "missed"),
        ("not needed", "within the accuracy", "other"),
    ],
)  # fmt: skip
def test_both_kinds_of_mistake_have_a_mark(expected, verdict, mark):
    assert effect_table.mark_of(expected, verdict) == mark


def test_verdicts_do_not_depend_on_the_clock(monkeypatch):
    """As on a machine that is a thousand times slower, and slower in each block."""
    scene = load_resolved("seat_shock")
    usual = effects_study.study_of(scene, silent, "backrest.normal_dissipative")
    slow = itertools.accumulate(itertools.count(10.0))
    monkeypatch.setattr(span.time, "process_time", lambda: next(slow))
    slowed = effects_study.study_of(scene, silent, "backrest.normal_dissipative")
    monkeypatch.undo()
    assert time.process_time() < slowed.cost
    assert slowed.rows[0].changes == usual.rows[0].changes
    assert slowed.rows[0].verdict == usual.rows[0].verdict == verdicts.NEEDED


def test_the_written_scene_has_what_the_scene_calls_for(tmp_path):
    path = tmp_path / "lean.yaml"
    given = ["impact_rubber_drop", "--write", str(path), "--without-observers", "--json"]
    facts = json.loads(CliRunner().invoke(command, given, catch_exceptions=False).stdout)
    assert set(load_resolved(str(path)).data["effects"]["impact"]) == {"normal_elastic", "normal_dissipative"}
    assert facts["written"]["saving"] > 0.0
    assert all(each["size"] == 0.0 for each in facts["written"]["changes"])
    assert facts["answer"].startswith(
        "impact_rubber_drop at 1e-3: every effect that acts is needed; its data call for none that is off, though shift "
    )
    assert "only observing: " in facts["answer"]
    by_name = {row["effect"]: row for row in facts["rows"]}
    assert by_name["normal_elastic"]["verdict"] == verdicts.CARRIES
    assert by_name["gauge_noise"]["verdict"] == "would observe"
    again = CliRunner().invoke(command, given)
    assert "exists already" in str(again.exception)


def test_an_effect_that_observes_keeps_its_word_beside_the_law_that_comes_with_it():
    scene = load_resolved("impact_rubber_drop", *(f"effects.impact.{each}=null" for each in WITHOUT_LOSS))
    study = effects_study.study_of(scene, silent, "impact.surface_waves")
    (row,) = study.rows
    assert (row.verdict, row.added) == (verdicts.WOULD_OBSERVE, ("normal_dissipative",))
    assert row.largest is not None, "of the loss"
    assert effects_table.table(study)[0].rows[0]["effect"] == "impact surface_waves with normal_dissipative"


def test_from_all_that_can_act_together_only_what_acts_is_measured():
    given = ["impact_rubber_drop", "--from", "all", "--json"]
    facts = json.loads(CliRunner().invoke(command, given, catch_exceptions=False).stdout)
    assert all(row["on"] for row in facts["rows"])
    assert {"normal_dissipative", "shift"} <= {row["effect"] for row in facts["rows"]}
    assert "that is off" not in facts["answer"]


def test_what_is_left_out_is_what_changes_less_than_requested():
    scene = load_resolved("seat_shock", "vibration.amplitude=1.0e-9")
    study = effects_study.study_of(scene, silent, "backrest.normal_dissipative")
    found = reduced.reduced(study, silent)
    assert [row.effect.name for row in found.left_out] == ["normal_dissipative"]
    text = reduced.text_of("seat_shock", ["vibration.amplitude=1.0e-9"], found, 1e-3)
    assert "# Left out: backrest normal_dissipative: changes " in text
    assert "normal_dissipative:" not in text.split("effects:")[1].split("#")[0].replace(
        "normal_dissipative: changes", ""
    )
    assert effects_table.answer(study).startswith("seat_shock at 1e-3: on but not needed: normal_dissipative")


def test_a_sum_that_changes_too_much_puts_the_last_one_back(monkeypatch):
    scene = load_resolved("impact_rubber_drop")
    study = effects_study.study_of(scene, silent)
    sizes = iter((2.0, 0.1))

    def measured(base, _scene, _notify):
        return (verdicts.Change("impact", "force", next(sizes) * base.request, 0.0, "normal", 0.0),), 1.0

    monkeypatch.setattr(event_runs.Base, "measured", measured)
    found = reduced.reduced(study, silent, observers=False)
    cheapest_last = sorted(study.with_verdict(verdicts.OBSERVES), key=lambda row: study.cost_of(row), reverse=True)
    assert [row.effect.name for row in found.left_out] == [row.effect.name for row in cheapest_last[:-1]]
    assert [row.effect.name for row in found.put_back] == [cheapest_last[-1].effect.name]


def test_a_metric_says_what_it_needs():
    """Without its map a ride has the SEAT of before to the bit and no pressure; without loss another SEAT."""
    scene = load_resolved("seat_ride_full", "duration=4", "accuracy=1e-2")
    study = effects_study.study_of(scene, silent, "seat.contact_field", off=False, metrics=["seat: SEAT"])
    assert study.rows[0].verdict == verdicts.NOT_NEEDED
    assert [each.size for each in study.rows[0].changes] == [0.0]
    assert effects_table.answer(study).startswith(
        "seat_ride_full at 1e-2, seat: SEAT: on but not needed: contact_field"
    )
    pressed = effects_study.study_of(scene, silent, "seat.contact_field", off=False, metrics=["seat: mean pressure"])
    assert pressed.rows[0].verdict == verdicts.NEEDED
    assert verdicts.shown(pressed.rows[0].changes[0]) == "leaves no seat: mean pressure"
    lossless = effects_study.study_of(scene, silent, "seat.foam_hysteresis", off=False, metrics=["seat.factor"])
    assert lossless.rows[0].verdict == verdicts.NEEDED
    assert math.isnan(lossless.rows[0].changes[0].time)


@pytest.mark.parametrize(
    ("values", "size", "error"),
    [((2.0, 2.02), 0.01, 0.0), ((0.0, 0.0), 0.0, 0.0), ((0.0, 3.0), 1.0, 0.0), ((4.0, math.nan), math.inf, 0.0)],
)
def test_a_metric_changes_over_its_own_value(values, size, error):
    before, after = (Metric("seat.a", "a", each, "", "no band", None) for each in values)
    found = of_metrics._change(before, after, 0.0)
    assert (found.size, found.error) == pytest.approx((size, error))
    unsure = of_metrics._change(before._replace(error=0.03), after._replace(error=0.04), 0.0)
    assert unsure.error == pytest.approx(0.05 / (abs(values[0]) or abs(values[1]) or math.inf)) or math.isinf(size)


def test_an_unknown_metric_is_refused_with_the_nearest():
    scene = load_resolved("seat_shock", "duration=0.4")
    with pytest.raises(BagError, match="--metric restitutoin: the list has no such metric"):
        effects_study.study_of(scene, silent, metrics=["restitutoin"])
