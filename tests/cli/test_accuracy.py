"""`bench accuracy` with the name of a rig, a scene or a bag, and `bench run --check`."""

import json

import pytest
from click.testing import CliRunner

from contact_sim_lab.accuracy import rig_study, scene_study, work_precision
from contact_sim_lab.cases import RigStudies, rig_studies
from contact_sim_lab.records.work_precision import WorkPrecision
from contact_sim_lab.rigs.vehicle.work_precision import road as work_precision_road
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.cli.accuracy import command
from contact_sim_pkg.cli.main import main
from contact_sim_pkg.records.table import number_of
from contact_sim_pkg.scene.errors import SceneError


@pytest.fixture
def one_study(monkeypatch):
    monkeypatch.setattr(work_precision, "studies_of", lambda _rig: work_precision_road.WORK_PRECISION)


def test_a_rig_is_a_table_for_people_and_rows_for_scripts(one_study, tmp_path):
    picture = tmp_path / "tire.png"
    shown = CliRunner().invoke(command, ["tire", "--plot", str(picture)], catch_exceptions=False)
    assert "road: class C" in shown.stdout
    assert "ms a call" in shown.stdout
    assert "error against: integral of ISO 8608's spectrum" in shown.stdout
    assert picture.stat().st_size > 10_000
    rows = json.loads(CliRunner().invoke(command, ["tire", "--json"], catch_exceptions=False).stdout)["rows"]
    assert {"rig", "part", "quantity", "level", "error", "solver_error", "grid_error", "ms_per_call"} <= set(rows[0])
    assert {row["level"] for row in rows} == {"20 sines", "400 sines", "inverse FFT"}


@pytest.mark.parametrize(
    ("picture", "told"),
    [
        ("nowhere/x.png", "its directory is not there; make it first"),
        ("x.gif", "ends in one of eps, jpeg, jpg"),
        ("x", "ends in one of"),
        ("y.png", "is a directory"),
    ],
)
def test_a_picture_that_cannot_be_written_is_refused_before_the_work(monkeypatch, capsys, tmp_path, picture, told):
    study = WorkPrecision("never", lambda: pytest.fail("the work began"))
    monkeypatch.setattr(work_precision, "studies_of", lambda _rig: [study])
    (tmp_path / "y.png").mkdir()
    assert main(["accuracy", "tire", "--plot", str(tmp_path / picture)]) == 2
    assert told in capsys.readouterr().err


def test_the_table_is_printed_even_if_the_picture_fails(one_study, monkeypatch, tmp_path):
    monkeypatch.setattr(rig_study, "write_plot", lambda rows, path, **_: 1 / 0)
    shown = CliRunner().invoke(command, ["tire", "--plot", str(tmp_path / "x.png")])
    assert isinstance(shown.exception, ZeroDivisionError)
    assert "ms a call" in shown.stdout


def test_a_name_that_is_no_rig_is_read_as_a_scene():
    with pytest.raises(SceneError, match="tyre"):
        CliRunner().invoke(command, ["tyre"], catch_exceptions=False)


def test_each_study_of_the_tire_is_there():
    parts = [entry.part for entry in work_precision.studies_of("tire")]
    assert len(parts) == len(set(parts)) == 9


def test_a_scene_of_a_rig_that_is_not_measured_is_refused_with_the_way_out(monkeypatch):
    without = {**rig_studies(), "backrest": RigStudies()}
    monkeypatch.setattr(scene_study, "rig_studies", lambda: without)
    with pytest.raises(SceneError, match=r"not for backrest; compare runs with --set integrator\.relative_tolerance"):
        CliRunner().invoke(command, ["seat_slap", "--parts"], catch_exceptions=False)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["tire", "--deep"], "--deep is for a scene, not for a rig"),
        (["BAG", "--parts"], "--parts is for a scene, not for a bag"),
        (["BAG", "--plot", "x.png"], "a bag has one accuracy and no picture of several"),
        (["tire_bump", "--whole"], "--whole is for the bag of a recorded run"),
        (["tire_bump", "--deep", "--parts"], "--parts has tables of its own"),
        (["tire", "tire_bump"], "several names are scenes at first look; give tire alone"),
        (["nowhere/bag.mcap"], "cannot be opened"),
        (["BAG", "--within", "SEAT=1%"], "--within is for one scene"),
        (["tire_bump", "--within", "SEAT"], "'SEAT' is no request: write METRIC=0.5%"),
    ],
)
def test_an_option_without_a_meaning_is_refused_before_the_work(capsys, tmp_path, arguments, said):
    named = [str(tmp_path) if argument == "BAG" else argument for argument in arguments]
    assert main(["accuracy", *named]) == 2
    assert said in capsys.readouterr().err


def test_a_check_needs_a_recording(capsys):
    assert main(["run", "block_slope", "--offline", "--no-record", "--check"]) == 2
    assert "--check compares the bag with a finer run" in capsys.readouterr().err


def test_requests_of_metrics_stand_in_place_of_an_accuracy(capsys):
    assert main(["run", "block_slope", "--offline", "--no-record", "--within", "x=1%", "--set", "accuracy=1e-3"]) == 2
    assert "--within finds an accuracy, and --set accuracy gives one" in capsys.readouterr().err


def test_a_run_has_the_dials_that_its_metrics_need(capsys, tmp_path):
    bag = tmp_path / "bag"
    arguments = ["run", "block_slope", "--offline", "--duration", "0.05", "--out", str(bag)]
    assert main([*arguments, "--within", "block.speed=2%", "--within", "block.slip=4e-4"]) == 0
    assert "accuracy 0.0004 for the steps" in capsys.readouterr().err
    text = open_bag(bag).scene
    assert text is not None
    assert "accuracy: 0.0004" in text


def test_a_run_and_its_bag_are_checked_alike(capsys, tmp_path):
    bag = tmp_path / "bag"
    arguments = ["run", "block_slope", "--offline", "--duration", "0.1", "--out", str(bag)]
    assert main([*arguments, "--check", "--json"]) == 0
    check = json.loads(capsys.readouterr().out)["check"]
    assert main(["accuracy", str(bag), "--json"]) == 0
    again = json.loads(capsys.readouterr().out)
    assert check["requested"] == 1e-3
    assert {row["kind"] for row in check["delivered"]} == {"force", "motion"}
    assert again["delivered"] == check["delivered"]
    assert main(["accuracy", str(bag)]) == 0
    assert "block force: requested 1e-3, delivered " in capsys.readouterr().out


def test_a_page_has_what_a_check_found(capsys, tmp_path):
    """Beside what was requested: the largest error of each kind, of the bodies that of the worst."""
    bag, page = tmp_path / "bag", tmp_path / "page.html"
    assert main(["run", "block_slope", "--offline", "--duration", "0.1", "--out", str(bag)]) == 0
    assert main(["report", str(bag), "--out", str(page)]) == 0
    assert "not checked" in page.read_text(encoding="utf-8")
    assert main(["report", str(bag), "--out", str(page), "--check"]) == 0
    text = page.read_text(encoding="utf-8")
    capsys.readouterr()
    assert main(["accuracy", str(bag), "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)["delivered"]
    assert "not checked" not in text
    for kind in ("force", "motion"):
        worst = number_of(max(row["error"] for row in rows if row["kind"] == kind))
        assert f"<td>{worst}</td>" in text
    assert main(["report", str(bag), str(bag), "--check"]) == 2
    assert "--check is of one BAG" in capsys.readouterr().err


def test_a_run_ends_with_its_estimate_and_strict_makes_a_miss_a_failure(tmp_path, capsys):
    run = [
        "run",
        "tire_bump",
        "--offline",
        "--duration",
        "0.05",
        "--strict",
        "--set",
        "expect=null",
    ]  # the bump comes later
    assert main([*run, "--out", str(tmp_path / "fine"), "--set", "accuracy=0.1"]) == 0
    shown = capsys.readouterr()
    assert "  tire force: requested 1e-1, estimated " in shown.out
    assert "above the requested" not in shown.err
    # A field of so few cells has no area to a hundredth
    coarse = ["--set", "effects.tire.contact_field={rows: 36, cols: 24}", "--set", "accuracy=1e-2"]
    assert main([*run, "--out", str(tmp_path / "coarse"), *coarse]) == 1
    assert "bench: estimated above the requested 1e-2: tire" in capsys.readouterr().err


def test_strict_without_a_recording_is_refused(capsys):
    assert main(["run", "tire_bump", "--offline", "--strict", "--no-record"]) == 2
    assert "--strict needs the estimates in the bag" in capsys.readouterr().err
