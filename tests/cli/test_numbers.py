"""`bench metrics`, `compare` and `export` on the command line: forms, exit codes, sentences."""

import csv
import io
import json
from xml.etree import ElementTree

import pytest

from contact_sim_pkg.cli.main import main


@pytest.fixture(scope="module")
def bag(car):
    return str(car.path.parent)


def printed(capsys, *arguments):
    status = main([*map(str, arguments)])
    out, err = capsys.readouterr()
    return status, out, err


def test_the_list_ends_with_its_verdict(capsys, bag):
    status, out, _ = printed(capsys, "metrics", bag)
    assert status == 1
    assert out.splitlines()[-1].startswith("OUTSIDE: tire: time off the road ")
    assert "DOUBTFUL: " in out.splitlines()[-1]


def test_json_csv_and_junit_hold_the_same_metrics(capsys, bag):
    keys = [row["key"] for row in json.loads(printed(capsys, "metrics", bag, "--json")[1])["metrics"]]
    assert [row["key"] for row in csv.DictReader(io.StringIO(printed(capsys, "metrics", bag, "--csv")[1]))] == keys
    suite = ElementTree.fromstring(printed(capsys, "metrics", bag, "--junit")[1])
    assert [case.get("name") for case in suite.iter("testcase")] == keys


def test_all_adds_the_mat(capsys, bag):
    whole = json.loads(printed(capsys, "metrics", bag, "--all", "--json")[1])["metrics"]
    spd = next(row for row in whole if row["key"] == "tire.map_spd")
    assert spd["unit"] == "%"
    assert sum(row["value"] for row in whole if ".zone_" in row["key"]) == pytest.approx(100.0)


def test_a_bag_equals_itself_and_misses_nothing(capsys, bag, tmp_path):
    tolerances = tmp_path / "tolerances.yaml"
    tolerances.write_text("'*': {absolute: 0}\n")
    status, out, _ = printed(capsys, "compare", bag, bag, "--tolerances", tolerances)
    assert (status, out.splitlines()[-1]) == (0, "all 1 tolerances hold")


def test_a_miss_ends_with_1_and_says_by_how_much(capsys, bag, tmp_path):
    from tests.report.synthetic_bag import car_bag

    other = car_bag(tmp_path / "other", blocks=800).path.parent
    tolerances = tmp_path / "tolerances.yaml"
    tolerances.write_text("seat.dose: {relative: 1e-4}\ntire.load: {relative: 0.5}\n")
    status, out, _ = printed(capsys, "compare", bag, other, "--tolerances", tolerances)
    assert status == 1
    (miss,) = [line for line in out.splitlines() if line.startswith("MISSED ")]
    assert miss.startswith("MISSED B: other: seat: VDV of 8 h is ")
    assert " allowed" in miss
    status, out, _ = printed(capsys, "compare", bag, other, "--tolerances", tolerances, "--junit")
    suite = ElementTree.fromstring(out)
    assert (status, suite.get("tests"), suite.get("failures")) == (1, "2", "1")


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("compare", "{bag}", "{bag}", "--junit"), "--junit needs --tolerances"),
        (("compare", "{bag}"), "a comparison needs at least two bags, 1 given"),
        (("compare", "{bag}", "{bag}", "--tolerances", "none.yaml"), "none.yaml: No such file"),
        (("metrics", "no_bag"), "no_bag"),
        (("metrics", "{bag}", "--require", "none.yaml"), "none.yaml: No such file"),
        (("metrics", "{bag}", "--require", "crest 9"), "is no requirement"),
        (("metrics", "{bag}", "--unit", "g"), "--unit: for a bag of anybody"),
        (("export", "{bag}"), "Missing --csv, --parquet, --ros-std, --format, --wall-time or --fmu"),
    ],
)  # fmt: skip
def test_bad_input_is_one_sentence_and_status_2(capsys, bag, tmp_path, monkeypatch, arguments, words):
    monkeypatch.chdir(tmp_path)
    status, out, err = printed(capsys, *(each.format(bag=bag) for each in arguments))
    assert (status, out) == (2, "")
    assert words in err
    assert list(tmp_path.iterdir()) == []
