"""Many cases of a scene, and their table."""

import csv
import importlib.util
import io
import json
import math

import pytest

from contact_sim_pkg import SceneError, load_scene, open_bag, run, sweep
from contact_sim_pkg.files import FileRefusedError
from contact_sim_pkg.run.work import estimated_work
from contact_sim_pkg.sweep.case import case_name, scene_of
from contact_sim_pkg.sweep.cost import cost_of
from contact_sim_pkg.sweep.kept import read_kept
from contact_sim_pkg.sweep.variation import SweepError

TIMES = ("wall_s", "cpu_s")


def swept(folder, *varied, scene="impact_steel", **named):
    return sweep(scene, folder, *varied, progress=False, **named)


def without_times(table):
    return [{key: value for key, value in row.items() if key not in TIMES} for row in table]


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    folder = tmp_path_factory.mktemp("sweep") / "out"
    return folder, swept(folder, "impact.mass=0.03:0.06:3", jobs=2, keep_bags="all")


def test_a_row_has_the_metrics_of_the_same_run(found, tmp_path):
    _, table = found
    bag = run(load_scene("impact_steel", "impact.mass=0.045"), tmp_path / "bag", progress=False)
    for metric in bag.metrics():
        assert repr(float(table[metric.key][1])) == repr(float(metric.value))


def test_the_kept_bag_is_that_of_its_row(found):
    folder, table = found
    bag = open_bag(folder / "bags" / table[0]["case"])
    for metric in bag.metrics():
        assert repr(float(table[metric.key][0])) == repr(float(metric.value))


def test_one_process_gives_the_same_bits_as_two(found, tmp_path):
    _, table = found
    again = swept(tmp_path / "one", "impact.mass=0.03:0.06:3", jobs=1)
    assert str(without_times(again)) == str(without_times(table))


def test_the_table_is_written_and_reads_back(found):
    folder, table = found
    rows = list(csv.DictReader(io.StringIO((folder / "table.csv").read_text())))
    assert [float(row["impact.mass"]) for row in rows] == [0.03, 0.045, 0.06]
    name = next(each for each in table.columns if each.startswith("impact.") and each.endswith("[N]"))
    assert [float(row[name]) for row in rows] == list(table[name])


def test_cases_that_ran_do_not_run_again(found):
    folder, table = found
    kept = {path: path.stat().st_mtime_ns for path in (folder / "cases").iterdir()}
    more = swept(folder, "impact.mass=0.03,0.045,0.06,0.09")
    assert len(more) == 4
    assert str(without_times(more)[:3]) == str(without_times(table))
    after = {path: path.stat().st_mtime_ns for path in (folder / "cases").iterdir()}
    assert len(after) == 4
    assert all(after[path] == when for path, when in kept.items())


def test_a_damaged_row_is_made_again(found):
    folder, table = found
    path = folder / "cases" / f"{table[0]['case']}.json"
    path.write_text('{"number": 0, "outc')
    assert str(without_times(swept(folder, "impact.mass=0.03,0.06"))[0]) == str(without_times(table)[0])


def test_an_impossible_combination_is_a_row_that_says_so(tmp_path):
    """Each value is allowed beside the first of the others; a duration shorter than a block is not."""
    table = swept(tmp_path / "out", "duration=1,0.01", "block_length=0.01,0.1", jobs=1)
    assert [row["outcome"] for row in table] == ["finished", "finished", "finished", "refused"]
    assert "duration" in table[3]["sentence"]
    assert table.failed == [table[3]]


def test_a_key_that_is_none_and_a_value_that_is_refused_are_said_before_anything_runs(tmp_path):
    for varied, word in (
        ("impact.mas=1,2", "impact.mas"),
        ("impact.mass=0.03:-1:2", "low below high"),
        ("impact.mass=0.03,-1", "-1"),
    ):
        with pytest.raises((SceneError, SweepError), match=word):
            swept(tmp_path / "out", varied)
    assert not (tmp_path / "out").exists()


def test_a_folder_that_is_none_of_a_sweep_is_left_alone(tmp_path):
    (tmp_path / "thesis.txt").write_text("mine")
    with pytest.raises(FileRefusedError, match="something else"):
        swept(tmp_path, "impact.mass=0.03,0.06")
    assert [path.name for path in tmp_path.iterdir()] == ["thesis.txt"]


def test_the_name_of_a_case_is_that_of_its_physics():
    """Keys that no number follows from do not change it, a number does, and other sources do."""
    one = case_name(scene_of("impact_steel", ()), "a")
    assert case_name(scene_of("impact_steel", ("pace=2.0",)), "a") == one
    others = case_name(scene_of("impact_steel", ("seed=2",)), "a"), case_name(scene_of("impact_steel", ()), "b")
    assert len({one, *others}) == 3


def test_what_a_metric_does_over_the_cases_and_what_it_follows(found):
    """The largest force of a Hertzian impact grows with the mass, as m**(3/5) at one speed."""
    folder, _ = found
    table = swept(folder, "impact.mass=0.03,0.06,0.09")
    force = next(each for each in table.ranges() if each.metric.endswith("force") or each.unit == "N")
    assert force.largest / force.smallest == pytest.approx(3.0**0.6, rel=0.01)
    assert force.moved_by == "impact.mass (+1.00)"
    assert json.loads(json.dumps(force._asdict()))["largest_in"] == 2


def test_the_bags_of_the_worst_stay(found):
    """The force of a Hertzian impact grows with the mass: the heaviest are the worst, of a lower limit the lightest."""
    folder, _ = found
    for keep, masses in (
        ("worst:1:impact.force", {0.08}),
        ("worst:2:impact.force > 10", {0.08, 0.05}),
    ):
        out = folder.parent / f"worst{len(masses)}"
        table = swept(out, "impact.mass=0.05,0.08,0.1" if len(masses) == 2 else "impact.mass=0.05,0.08", keep_bags=keep)
        kept = {path.name for path in (out / "bags").iterdir()}
        assert {row["impact.mass"] for row in table if row["case"] in kept} == masses


@pytest.mark.parametrize("text", ["some", "worst", "worst:3", "worst:0:m", "worst:x:m", "worst:3:m <", "worst:3:m < x"])
def test_bags_to_keep_that_are_none_are_one_sentence(text, tmp_path):
    with pytest.raises(SweepError, match="--keep-bags") as refused:
        swept(tmp_path / "out", "impact.mass=0.03,0.06", keep_bags=text)
    assert "\n" not in str(refused.value)
    assert not (tmp_path / "out").exists()


def test_a_metric_of_the_worst_that_no_case_has_leaves_the_table(tmp_path):
    with pytest.raises(SweepError, match=r"impact\.nothing"):
        swept(tmp_path / "out", "impact.mass=0.03,0.06", keep_bags="worst:1:impact.nothing", jobs=1)
    assert (tmp_path / "out" / "table.csv").is_file()


def test_the_cost_is_that_of_the_cases_that_ran(found):
    folder, _ = found
    values = [{"impact.mass": str(each)} for each in (0.03, 0.045, 0.06, 0.09, 0.1)]
    rows = [json.loads(path.read_text()) for path in (folder / "cases").iterdir()]
    cost = cost_of("impact_steel", values, ("impact.mass=0.03",), read_kept("none"), folder)
    mean = sum(row["cpu"] for row in rows) / len(rows)
    assert (cost.cases, cost.measured) == (5, len(rows))
    assert cost.cpu == pytest.approx(5 * mean)
    kept = cost_of("impact_steel", values, ("impact.mass=0.03",), read_kept("all"), folder)
    bags = [sum(file.stat().st_size for file in bag.rglob("*")) for bag in (folder / "bags").iterdir()]
    assert kept.disk - cost.disk == pytest.approx(5 * sum(bags) / len(bags), rel=0.01)


def test_the_cost_without_a_case_is_that_of_the_scene():
    values = [{"duration": "1"}, {"duration": "2"}]
    cost = cost_of("impact_steel", values, ("duration=1",), read_kept("none"), None)
    parts = estimated_work(scene_of("impact_steel", ("duration=1",)))
    assert cost.cpu == pytest.approx(2 * sum(part.seconds for part in parts))
    assert math.isnan(cost.disk)
    assert cost.measured == 0


@pytest.mark.skipif(importlib.util.find_spec("pyarrow") is None, reason="pyarrow is not installed")
def test_the_parquet_table_is_the_same(found):
    from pyarrow import parquet

    folder, _ = found
    table = swept(folder, "impact.mass=0.03:0.06:3")
    read = parquet.read_table(folder / "table.parquet")
    assert read.column_names == table.columns
    for row, given in zip(read.to_pylist(), table, strict=True):
        for name, value in given.items():
            assert row[name] == value or (row[name] is None and math.isnan(value))
