"""The one list of metrics in all its forms."""

import csv
import io
import json
import math
from xml.etree import ElementTree

import pytest

from contact_sim_pkg.compare.estimated import Above
from contact_sim_pkg.records.metric import Band, Metric, judged
from contact_sim_pkg.report.metrics.tiles import doubts_of, metric_table, published_table, tiles_of
from contact_sim_pkg.report.metrics.views import csv_of, junit_of, lines_of, metric_of, row_of, rows_of, verdict_line

LIMIT = Band(-math.inf, 100.0, "limit", "a standard")


def metric(key, value, band=LIMIT, broken=(), spread=math.nan):
    return Metric(
        f"seat.{key}", key, value, "%", judged(value, band), band, "said", broken, spread, 7, "bench/motion", (0.0, 5.0),
        "stationary", 0.125,
    )  # fmt: skip


METRICS = [
    metric("good", 57.25, spread=2.1), metric("bad", 131.0), metric("free", 3.0, band=None),
    metric("doubtful", 50.0, broken=("too short: 3 s, 34 s needed",)), metric("undefined", math.nan),
]  # fmt: skip


def test_a_row_holds_everything_and_is_json():
    rows = json.loads(json.dumps(rows_of(METRICS), allow_nan=False))
    assert [metric_of(row)[:2] for row in rows] == [each[:2] for each in METRICS]
    assert metric_of(rows[1]) == METRICS[1]._replace(spread=metric_of(rows[1]).spread)
    assert rows[4]["value"] is None
    assert (rows[1]["low"], rows[1]["high"], rows[1]["verdict"]) == (None, 100.0, "outside")


def test_each_column_of_a_row_holds_its_own_value():
    band = Band(12.5, 98.5, "usual", "ISO 1", "class C")
    one = Metric(
        "seat.a", "name", 57.25, "mm", "good", band, "said", ("short", "tilted"), 2.125, 7, "tire/force", (0.25, 5.75),
        "event", 0.375,
    )  # fmt: skip
    expected = {
        "key": "seat.a", "name": "name", "value": 57.25, "unit": "mm", "verdict": "good", "low": 12.5, "high": 98.5,
        "kind": "usual", "source": "ISO 1", "conditions": "class C", "remark": "said", "broken": ["short", "tilted"],
        "spread": 2.125, "error": 0.375, "basis": "event", "count": 7,
        "topic": "tire/force", "window_start": 0.25, "window_end": 5.75,
    }  # fmt: skip
    assert row_of(one) == expected
    assert metric_of(row_of(one)) == one
    (row,) = csv.DictReader(io.StringIO(csv_of([one])))
    assert row == {name: str(value) for name, value in expected.items()} | {"broken": "short; tilted"}


def test_csv_has_a_row_a_metric_in_full_precision():
    rows = list(csv.DictReader(io.StringIO(csv_of(METRICS))))
    assert [row["key"] for row in rows] == [each.key for each in METRICS]
    assert float(rows[0]["value"]) == 57.25
    assert rows[3]["broken"] == "too short: 3 s, 34 s needed"


def test_the_terminal_ends_with_what_is_outside_and_what_is_doubtful():
    rows = rows_of(METRICS)
    lines = lines_of(rows)
    assert " ".join(lines[0].split()) == "good 57.2 ± 2.1 % good stationary, error 0.125 at most 100; said"
    assert " ".join(lines[-1].split()) == "undefined – no band stationary at most 100; said"
    assert any(line.strip() == "! too short: 3 s, 34 s needed" for line in lines)
    last = verdict_line(rows)
    assert last.startswith(
        "OUTSIDE: bad 131 % (at most 100) | DOUBTFUL: 1 of 5 metrics, too short: 3 s, 34 s needed | the rest "
    )
    assert verdict_line(rows_of(METRICS[:1])) == "nothing outside its band: 1 good"
    above = Above("estimated above the requested 1e-2: tire force 3e-2", is_doubtful=True)
    assert verdict_line(rows_of(METRICS[:1]), above) == f"DOUBTFUL: {above.text} | the rest 1 good"
    by_an_effect = above._replace(is_doubtful=False)
    assert verdict_line(rows_of(METRICS[:1]), by_an_effect) == f"{above.text} | nothing outside its band: 1 good"


def test_junit_counts_failures_errors_and_what_is_skipped():
    suite = ElementTree.fromstring(junit_of("bag", METRICS))
    assert {key: suite.get(key) for key in ("tests", "failures", "errors", "skipped")} == {
        "tests": "5", "failures": "1", "errors": "1", "skipped": "2",
    }  # fmt: skip
    (failure,) = suite.iter("failure")
    assert "bad: 131 %" in failure.get("message")
    assert [each.text for each in suite.iter("system-out")][:2] == [
        "57.2 ± 2.1 %; stationary, error 0.125", "131 %; stationary, error 0.125",
    ]  # fmt: skip


def test_a_run_that_failed_is_the_first_case_of_junit():
    suite = ElementTree.fromstring(junit_of("bag", METRICS[:1], ["bag: the run ended before its last block: failed"]))
    first, second = suite.iter("testcase")
    assert (suite.get("errors"), first.get("name"), second.get("name")) == ("1", "bag", "seat.good")
    assert first.find("error").get("message").endswith("failed")


def test_tiles_say_the_same():
    tiles = tiles_of(METRICS)
    assert [(tile.value, tile.verdict) for tile in tiles[:2]] == [("57.2", "good"), ("131", "OUTSIDE")]
    assert doubts_of(METRICS) == ["too short: 3 s, 34 s needed (doubtful)"]
    assert tiles[3].tone == "doubtful"
    assert tiles[0].spread.replace("\N{NO-BREAK SPACE}", " ") == "± 0.125 numerical, ± 2.1 random"


def test_a_bar_has_its_band_and_the_value_on_one_scale():
    """Of at most 100 the scale begins at 0 and reaches a third beyond, or to a value further out."""
    good, bad = tiles_of(METRICS)[:2]
    assert good.bar == pytest.approx((0.0, 75.0, 100.0 * 57.25 / (400.0 / 3.0)), abs=0.06)
    assert good.bar.mark < good.bar.width < bad.bar.mark


def test_tables_have_what_the_tiles_leave_out():
    rows = {row[0]: row for row in metric_table(METRICS).rows}
    assert len(rows) == len(METRICS)
    assert rows["good"][-1] == "said"
    assert {row[-1] for row in published_table(METRICS).rows} == {"a standard"}


@pytest.mark.parametrize(
    ("low", "high", "text"), [(-math.inf, 9.0, "at most 9"), (1.0, math.inf, "at least 1"), (1.0, 2.0, "1 to 2")]
)
def test_bands_in_words(low, high, text):
    assert Band(low, high, "usual", "").text == text
    assert row_of(metric("x", 1.0, Band(low, high, "usual", "s")))["source"] == "s"
