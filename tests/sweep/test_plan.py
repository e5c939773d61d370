"""A plan: what is required of the cases of its sweeps."""

import math
from xml.etree import ElementTree

import pytest
from scipy import stats

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.files import RefusedError
from contact_sim_pkg.records.metric import EVENT, NO_BAND, STATIONARY, Metric
from contact_sim_pkg.report.metrics.views import rows_of
from contact_sim_pkg.scene.load import load_scene
from contact_sim_pkg.sweep.plan import Plan, judge, judged_rows, junit, read_plan, run_plan, shipped_plans, status_of
from contact_sim_pkg.sweep.sweep import try_ends

TEXT = "sweeps: {ride: {scene: seat_ride, vary: ['k=1,2'], require: {seat.SEAT: {max: 60, unit: '%'}}}}"


def planned(tmp_path, text=TEXT):
    path = tmp_path / "plan.yaml"
    path.write_text(text)
    return read_plan(str(path)).sweeps[0]


def metric(value, spread=0.5, basis=STATIONARY, error=math.nan):
    return Metric(
        "seat.SEAT", "SEAT", value, "%", NO_BAND, None, spread=spread, basis=basis, error=error, topic="seat/force"
    )


def case(value, *metrics, seed=None, sentence=""):
    values = {"k": str(value), **({} if seed is None else {"seed": str(seed)})}
    outcome = "failed" if sentence else "finished"
    return values, {"outcome": outcome, "sentence": sentence, "metrics": rows_of(metrics)}


def verdicts(outcomes):
    return [(each.verdict, each.missed, each.case) for each in judged_rows(outcomes)]


def test_all_hold_and_the_worst_is_named_with_its_margin(tmp_path):
    found = judge(planned(tmp_path), [case(1, metric(50.0)), case(2, metric(55.0))])
    (row,) = judged_rows(found)
    assert (row.verdict, row.cases, row.worst, row.case) == ("pass", 2, "55 ± 0.5 %", "k=2")
    assert float(row.margin) == pytest.approx(5.0)
    assert status_of(found) == 0


def test_a_miss_fails_and_says_by_how_much(tmp_path):
    found = judge(planned(tmp_path), [case(1, metric(50.0)), case(2, metric(63.0))])
    (row,) = judged_rows(found)
    assert (row.verdict, row.missed, row.case, status_of(found)) == ("MISS", 1, "k=2", 1)
    assert float(row.margin) == pytest.approx(-3.0)


@pytest.mark.parametrize(
    ("found", "word"),
    [
        (metric(59.8), "more seeds or a longer run"),
        (metric(59.8, spread=0.01, error=0.4), "a smaller accuracy"),
        (metric(50.0, spread=math.nan), "give seeds"),
        (metric(50.0)._replace(broken=("too short",)), "too short"),
    ],
)
def test_what_cannot_be_decided_says_what_would(tmp_path, found, word):
    outcomes = judge(planned(tmp_path), [case(1, found)])
    (row,) = judged_rows(outcomes)
    assert (row.verdict, status_of(outcomes)) == ("undecided", 3)
    assert word in row.remark


def test_an_event_without_a_spread_is_decided(tmp_path):
    assert verdicts(judge(planned(tmp_path), [case(1, metric(50.0, math.nan, EVENT))])) == [("pass", 0, "k=1")]


def test_replications_are_judged_by_their_mean_and_its_interval(tmp_path):
    """Student's t of three seeds, by scipy."""
    numbers = [57.0, 58.0, 59.6]
    cases = [case(1, metric(number), seed=seed) for seed, number in enumerate(numbers)]
    (outcome,) = judge(planned(tmp_path), cases)
    (found,) = outcome.metrics
    low, high = stats.t.interval(0.95, 2, sum(numbers) / 3.0, stats.sem(numbers))
    assert found.value == pytest.approx(sum(numbers) / 3.0)
    assert found.spread == pytest.approx(0.5 * (high - low))
    assert found.verdict == "undecided"  # 58.2 ± 3.3


def test_a_run_that_failed_fails_the_plan(tmp_path):
    found = judge(planned(tmp_path), [case(1, metric(50.0)), case(2, sentence="the tire left the road")])
    assert (status_of(found), found[1].failure) == (1, "the tire left the road")


def test_junit_has_a_failure_an_error_and_a_test_that_passes(tmp_path):
    outcomes = judge(
        planned(tmp_path),
        [case(1, metric(50.0)), case(2, metric(63.0)), case(3, metric(59.9)), case(4, sentence="lost")],
    )
    root = ElementTree.fromstring(junit(Plan("p", "", []), outcomes))
    assert [(each.get("name"), each.get("failures"), each.get("errors")) for each in root] == [
        ("ride k=1", "0", "0"), ("ride k=2", "1", "0"), ("ride k=3", "0", "1"), ("ride k=4", "0", "1"),
    ]  # fmt: skip


@pytest.mark.parametrize("name", shipped_plans())
def test_shipped_plans_ask_what_their_scenes_take(name):
    for each in read_plan(name).sweeps:
        load_scene(each.scene)
        try_ends(each.scene, each.variations, each.values)
        assert each.requirements


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("a: 1", "no key of a plan"), ("description: x", "sweeps is None"), ("sweeps: {a: {vary: []}}", "needs a scene"),
        ("sweeps: {a: {scene: s, vari: []}}", "vari is no key"), ("sweeps: {a: {scene: s, vary: 1}}", "list of texts"),
        ("sweeps: {a: {scene: s, vary: ['k']}}", "not of the form"), ("sweeps: {a: {scene: s, seeds: x}}", "number of"),
        ("sweeps: {a: {scene: s, require: {m: {mux: 1}}}}", "min or max"), ("[1]", "holds no plan"),
    ],
)  # fmt: skip
def test_what_is_no_plan_is_one_sentence(tmp_path, text, word):
    with pytest.raises((BagError, RefusedError), match=word) as refused:
        planned(tmp_path, text)
    assert "\n" not in str(refused.value)
    assert "plan.yaml" in str(refused.value)


def test_a_plan_that_is_not_there_names_those_that_are():
    with pytest.raises(RefusedError, match="tire_standing_stiffness"):
        read_plan("nothing")


def test_a_requirement_of_a_metric_that_no_case_has_is_refused_and_names_those_there_are(tmp_path):
    path = tmp_path / "plan.yaml"
    path.write_text("sweeps: {a: {scene: impact_steel, vary: [impact.mass=0.03], require: {impact.e: {min: 0}}}}")
    with pytest.raises(BagError, match=r"impact\.restitution"):
        run_plan(read_plan(str(path)), tmp_path / "out", jobs=1, notify=lambda _text, _done: None)
