"""Limits of one's own, on metrics made by hand: who meets them, who misses, and what cannot be said."""

import math
import xml.etree.ElementTree as ElementTree

import pytest

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.files import FileRefusedError
from contact_sim_pkg.records.metric import Band, Metric
from contact_sim_pkg.report.metrics.requirements import exit_code, read_requirements, required
from contact_sim_pkg.report.metrics.views import junit_of, rows_of, verdict_line

USUAL = Band(0.0, 100.0, "usual", "a book")
METRICS = [
    Metric("seat.factor", "SEAT", 58.0, "%", "usual", USUAL, spread=3.0),
    Metric("seat.sink", "deepest sink", 41.0, "mm", "good", USUAL),
    Metric("seat.a_w", "a_w, Wk", 0.34, "m/s²", "usual", USUAL, broken=("too short",)),
    Metric("tire.sink", "rise", math.nan, "mm", "no band", None),
]


def verdicts(*given):
    return {each.key: each.verdict for each in required(METRICS, read_requirements(given))}


@pytest.mark.parametrize(
    ("text", "key", "verdict", "code"),
    [
        ("SEAT < 62 %", "seat.factor", "good", 0),
        ("seat < 50 %", "seat.factor", "outside", 1),
        ("seat.factor <= 60", "seat.factor", "undecided", 3),  # 58 ± 3
        ("SEAT>56%", "seat.factor", "undecided", 3),
        ("seat.sink < 40.5 mm", "seat.sink", "outside", 1),
        ("seat.sink >= -1e2", "seat.sink", "good", 0),
        ("a_w, Wk < 0.5 m/s^2", "seat.a_w", "good", 3),  # an assumption does not hold
        ("rise < 3 mm", "tire.sink", "no band", 3),
    ],
)
def test_a_text_judges_its_metric_and_no_other(text, key, verdict, code):
    found = required(METRICS, read_requirements([text]))
    assert {each.key: each.verdict for each in found} == {each.key: each.verdict for each in METRICS} | {key: verdict}
    assert exit_code(found) == code


def test_nothing_required_is_judged_by_the_bands_alone():
    assert exit_code(METRICS) == 0
    assert exit_code([*METRICS, METRICS[0]._replace(verdict="outside")]) == 1


def test_a_file_holds_ends_units_patterns_and_when(tmp_path):
    file = tmp_path / "wanted.yaml"
    file.write_text(
        "seat.factor: {max: 61.5, unit: '%'}\n"
        "'*.sink': {min: 42, max: 60}\n"
        "seat.a_w: {max: 0.1, when: {seat.factor: [70, 90]}}\n"
    )
    found = {each.key: each for each in required(METRICS, read_requirements([str(file)]))}
    assert found["seat.factor"].verdict == "good"
    assert found["seat.factor"].band == Band(-math.inf, 61.5, "yours", "wanted.yaml")
    assert found["seat.sink"].verdict == "outside"
    assert found["seat.a_w"] == METRICS[2]._replace(remark=found["seat.a_w"].remark)
    assert found["seat.a_w"].remark.endswith("wanted.yaml not required here: seat.factor is 58, not 70 to 90")


def test_two_texts_bound_a_metric_from_both_sides():
    assert verdicts("deepest sink > 45", "deepest sink < 60")["seat.sink"] == "outside"
    assert verdicts("deepest sink < 60", "deepest sink > 45")["seat.sink"] == "outside"
    assert verdicts("deepest sink > 40", "deepest sink < 60")["seat.sink"] == "good"


def test_a_miss_counts_before_what_is_undecided():
    assert verdicts("SEAT < 60", "SEAT > 70")["seat.factor"] == "outside"  # 58 ± 3
    assert verdicts("SEAT > 70", "SEAT < 60")["seat.factor"] == "outside"
    assert verdicts("SEAT < 60", "SEAT > 20")["seat.factor"] == "undecided"
    (found, *_) = required(METRICS, read_requirements(["SEAT < 70", "SEAT > 20"]))
    assert (found.verdict, found.remark) == ("good", "yours")


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("SEAT 60", "is no requirement"), ("< 60", "is no requirement"), ("SEAT < sixty", "is no requirement"),
        ("SEAT < 1e999 %", "is no number"), ("SEAT < 60 kPa", "the metric is in %"), ("crest < 9", "no such metric"),
    ],
)  # fmt: skip
def test_a_text_that_says_nothing_is_refused(text, sentence):
    with pytest.raises(BagError, match=sentence):
        required(METRICS, read_requirements([text]))


@pytest.mark.parametrize(
    "text",
    ["", "- 3", "seat.factor: 60", "seat.factor: {most: 60}", "seat.factor: {unit: '%'}", "seat.factor: {max: yes}",
     "seat.factor: {min: 3, max: 2}", "seat.factor: {max: 3, when: [1, 2]}", "seat.factor: {max: 3, when: {seat.sink: 4}}"],
)  # fmt: skip
def test_a_file_that_is_no_table_of_requirements_is_refused(tmp_path, text):
    file = tmp_path / "wanted.yml"
    file.write_text(text)
    with pytest.raises(BagError, match=r"wanted\.yml"):
        read_requirements([str(file)])


def test_a_file_that_is_not_there_or_long_is_refused(tmp_path):
    with pytest.raises(FileRefusedError):
        read_requirements([str(tmp_path / "none.yaml")])
    (tmp_path / "long.yaml").write_text("#" * 200_000)
    with pytest.raises(FileRefusedError, match="at most 100000 bytes"):
        read_requirements([str(tmp_path / "long.yaml")])


def test_what_is_undecided_is_said_and_is_an_error_of_junit():
    found = required(METRICS[:2], read_requirements(["SEAT < 60 %"]))
    assert verdict_line(rows_of(found)).startswith("UNDECIDED: SEAT 58 ± 3 % (at most 60)")
    suite = ElementTree.fromstring(junit_of("run", found))
    assert (suite.get("errors"), suite.get("failures")) == ("1", "0")


def test_a_file_serves_several_rigs(tmp_path):
    """A metric of another rig is not required where its `when` names that rig, and could not be judged without."""
    file = tmp_path / "wanted.yaml"
    file.write_text("tire.dlc: {max: 0.2, when: {tire.load: [3000, 5000]}}\n")
    assert required(METRICS, read_requirements([str(file)])) == METRICS
    file.write_text("tire.dlc: {max: 0.2}\n")
    *others, absent = required(METRICS, read_requirements([str(file)]))
    assert others == METRICS
    assert (absent.key, absent.verdict, math.isnan(absent.value)) == ("tire.dlc", "no band", True)
    assert exit_code([*others, absent]) == 3
