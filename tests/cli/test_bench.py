"""The command line: refusals, tables, one JSON object on standard output, exit statuses."""

import json
import os
import signal
import time

import pytest
from tests.bench_process import ENVIRONMENT, LONGEST, bench, end, needs_ros, start_bench, wait_until

from contact_sim_pkg.bag.errors import BagWriteError
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.bag.writer import BagWriter
from contact_sim_pkg.cli.main import COMMANDS, LABORATORY
from contact_sim_pkg.cli.main import main as bench_main
from contact_sim_pkg.rigs.vehicle.simulation import Simulation
from contact_sim_pkg.run.errors import RunError

OFFLINE = ["--offline", "--duration", "0.2"]


def refused(capsys, *arguments):
    status = bench_main([str(argument) for argument in arguments])
    out, said = capsys.readouterr()
    assert out == ""
    assert "Traceback" not in said
    return status, said


@pytest.mark.parametrize("command", [*COMMANDS, *LABORATORY])
def test_every_command_has_a_help_text(capsys, command):
    assert bench_main([command, "--help"]) == 0
    assert "Usage: bench" in capsys.readouterr().out


def test_list_shows_the_scenes_smallest_first(capsys):
    assert bench_main(["list", "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)["rows"]
    scenes = [row["scene"] for row in rows]
    assert (scenes[0], scenes[-1]) == ("seat_ride", "car_full_bench")
    assert scenes.index("seat_slap") < scenes.index("tire_bump") < scenes.index("tire_texture")
    assert all(row["description"] for row in rows)


def test_show_prints_a_scene_that_runs_again(capsys, tmp_path):
    assert bench_main(["show", "seat_ride", "--duration", "0.2"]) == 0
    text = capsys.readouterr().out
    (tmp_path / "again.yaml").write_text(text)
    assert bench_main(["show", str(tmp_path / "again.yaml")]) == 0
    assert capsys.readouterr().out == text


def test_a_run_with_json_prints_one_object_for_scripts(capsys, tmp_path):
    out = tmp_path / "bag"
    assert bench_main(["run", "seat_ride", *OFFLINE, "--out", str(out), "--json"]) == 0
    facts = json.loads(capsys.readouterr().out)
    assert list(facts) == [
        "scene", "effects", "accuracy", "ended", "failure", "simulated_s", "startup_s", "wall_s", "real_time_factor",
        "excitation", "bag", "summary",
    ]  # fmt: skip
    assert (facts["ended"], facts["failure"]) == ("finished", None)
    assert (facts["scene"], facts["simulated_s"], facts["bag"]) == ("seat_ride", 0.2, str(out))
    assert facts["real_time_factor"] == pytest.approx(facts["simulated_s"] / facts["wall_s"], rel=1e-3)
    assert sum(facts["summary"]["messages"].values()) == open_bag(out).count()


def test_a_write_that_fails_during_a_run_ends_it_with_status_3_and_a_sentence(capsys, tmp_path, monkeypatch):
    written = BagWriter.write_all

    def write_all(self, messages):
        if self.messages > 20:
            raise BagWriteError("no space left on device")
        written(self, messages)

    monkeypatch.setattr(BagWriter, "write_all", write_all)
    assert bench_main(["run", "seat_ride", *OFFLINE, "--out", str(tmp_path / "bag"), "--json"]) == 3
    out, said = capsys.readouterr()
    facts = json.loads(out)
    assert (facts["ended"], facts["failure"]) == ("stopped", "no space left on device")
    assert "no space left on device" in said


@pytest.mark.fault("F1")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_skips_the_summary_whose_bag_is_closed(capsys, tmp_path, monkeypatch, number):
    """A first one stops the run, another one comes while it is summed up."""
    from contact_sim_pkg.report import summary
    from contact_sim_pkg.run import offline

    run, bag = offline.run_offline, tmp_path / "bag"
    closed = []

    def never_ends(opened):
        closed.append(opened.complete)
        os.kill(os.getpid(), number)
        time.sleep(LONGEST)

    def stopped_after_a_block(scene, directory, on_progress, stop, *others):
        return run(scene, directory, lambda each: stop.on_signal(), stop, *others)

    monkeypatch.setattr(summary, "summarise", never_ends)
    monkeypatch.setattr(offline, "run_offline", stopped_after_a_block)
    assert bench_main(["run", "seat_ride", *OFFLINE, "--out", str(bag), "--json"]) == 0
    out, said = capsys.readouterr()
    facts = json.loads(out)
    assert (facts["ended"], facts["summary"], facts["bag"]) == ("stopped", {}, str(bag))
    assert closed == [True]
    assert f"{bag} is closed; its summary follows, another signal skips it" in said
    assert signal.getsignal(signal.SIGTERM) is signal.SIG_DFL


def test_a_run_that_fails_has_its_failure_in_its_json(capsys, tmp_path, monkeypatch):
    advanced = Simulation.advance

    def advance(self, block, inputs):
        if block > 3:
            raise RunError("the tire fell off")
        return advanced(self, block, inputs)

    monkeypatch.setattr(Simulation, "advance", advance)
    assert bench_main(["run", "seat_ride", *OFFLINE, "--out", str(tmp_path / "bag"), "--json"]) == 1
    facts = json.loads(capsys.readouterr().out)
    assert (facts["ended"], facts["failure"]) == ("failed", "the tire fell off")


def test_a_recorded_vibration_shorter_than_the_scene_is_refused_before_the_start(capsys, tmp_path):
    rows = "".join(f"{0.01 * i:.2f},0,{i % 3},{9.8 + i % 2}\n" for i in range(50))
    (tmp_path / "short.csv").write_text("time,x,y,z\n" + rows)
    arguments = ["run", "seat_ride", "--offline", "--vibration", tmp_path / "short.csv", "--rate", "100"]
    arguments += ["--out", tmp_path / "bag", "--duration", "2", "--set", "vibration.beyond=refuse"]
    status, said = refused(capsys, *arguments)
    assert status == 2
    assert "the recording ends after 0.49 s, the scene lasts 2 s" in said
    assert not (tmp_path / "bag").exists()


def test_a_run_without_recording_creates_nothing(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert bench_main(["run", "seat_ride", *OFFLINE, "--no-record", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["bag"] is None
    assert list(tmp_path.iterdir()) == []


@pytest.fixture
def clipped_recording(tmp_path):
    """A recording at 476 Hz with bias on x, three samples in a row at 2 g on z."""
    z = [9.81 + (index % 7 - 3.0) for index in range(476)]
    z[100:103] = [19.61] * 3
    rows = [f"{0.2 + 0.1 * (index % 5 - 2)},{value}" for index, value in enumerate(z)]
    path = tmp_path / "floor.csv"
    path.write_text("\n".join(["x,z", *rows]) + "\n")
    return path


@pytest.mark.parametrize("record", [True, False])
def test_a_run_reports_the_findings_in_its_recording(capsys, tmp_path, clipped_recording, record):
    kept = ["--out", str(tmp_path / "bag")] if record else ["--no-record"]
    arguments = ["run", "seat_ride", "--vibration", str(clipped_recording), "--rate", "476", *OFFLINE, *kept]
    assert bench_main(arguments) == 0
    out, said = capsys.readouterr()
    lines = [line for line in said.splitlines() if line.startswith("platform/vibration: ")]
    assert any("3 of 476 samples of z lie at the full scale of 19.61 m/s^2" in line for line in lines)
    assert any("degrees off the vertical axis; the tilt was not corrected" in line for line in lines)
    assert "full scale" not in out


def test_the_findings_of_a_recording_stand_in_the_json_object(capsys, clipped_recording):
    vibration = ["--vibration", str(clipped_recording), "--rate", "476"]
    assert bench_main(["run", "seat_ride", *vibration, *OFFLINE, "--no-record", "--json"]) == 0
    out, said = capsys.readouterr()
    found = json.loads(out)["excitation"]["platform/vibration"]
    assert found["axes"]["z"]["clipped_samples"] == 3
    assert found["axes"]["x"]["bias_m_per_s2"] == pytest.approx(0.2, abs=1e-3)
    assert any("full scale" in note for note in found["notes"])
    assert "full scale" not in said


def test_a_value_that_is_set_reaches_the_bag(capsys, tmp_path):
    out = tmp_path / "bag"
    assert bench_main(["run", "seat_ride", *OFFLINE, "--set", "seed=7", "--out", str(out)]) == 0
    assert f"bag: {out}" in capsys.readouterr().out
    assert "seed: 7" in open_bag(out).scene


def test_the_scene_of_a_bag_runs_again_with_a_value_changed(capsys, tmp_path):
    first, again = tmp_path / "first", tmp_path / "again"
    bench_main(["run", "seat_ride", *OFFLINE, "--out", str(first)])
    assert bench_main(["run", "--offline", "--from-bag", str(first), "--set", "name=again", "--out", str(again)]) == 0
    capsys.readouterr()
    excitation = [[each.data for each in open_bag(bag).messages("platform/vibration")] for bag in (first, again)]
    assert excitation[0] == excitation[1]


@pytest.mark.parametrize("assignment", ["seed=7", "vibration.sample_rate=500", "block_length=0.02"])
def test_the_keys_of_a_recorded_excitation_cannot_be_changed(capsys, tmp_path, assignment):
    first, again = tmp_path / "first", tmp_path / "again"
    bench_main(["run", "seat_ride", *OFFLINE, "--out", str(first)])
    capsys.readouterr()
    status, said = refused(capsys, "run", "--offline", "--from-bag", first, "--set", assignment, "--out", again)
    assert status == 2
    assert f"the excitation comes from the bag, and {assignment.partition('=')[0]} is not as it was recorded" in said
    assert not again.exists()


def test_the_excitation_of_a_bag_does_not_drive_another_rig(capsys, tmp_path):
    first = tmp_path / "first"
    bench_main(["run", "seat_ride", *OFFLINE, "--out", str(first)])
    capsys.readouterr()
    status, said = refused(capsys, "run", "tire_bump", "--from-bag", first, "--out", tmp_path / "again")
    assert status == 2
    assert "the excitation comes from the bag, and rig, road" in said


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["run", "seat_rid"], "did you mean seat_ride?"),
        (["run", "seat_ride", "--set", "effects.seat.frcition=1"], "frcition"),
        (["run", "seat_ride", "--set", "no equals sign"], "is not of the form a.b.c=value"),
        (["run", "seat_ride", "--duration", "-1"], "duration"),
        (["run", "seat_ride", "--pace", "fast"], "pace"),
        (["run", "seat_ride", "--vibration", "no such file.csv", "--rate", "476"], "no such file.csv"),
        (["run", "tire_bump", "--road", "no such file.crg"], "no such file.crg"),
        (["run"], "Missing argument 'SCENE'"),
        (["run", "--from-bag", "no such bag"], "no such bag"),
        (["report", "no such bag"], "no such bag"),
        (["replay", "no such bag", "--rate", "0"], "--rate"),
        (["replay", "no such bag", "--rate", "-1"], "--rate"),
        (["replay", "no such bag", "--rate", "nan"], "--rate"),
        (["replay", "no such bag", "--start-offset", "-1"], "--start-offset"),
        (["recover", "no such bag", "target"], "no such bag"),
        (["frobnicate"], "No such command 'frobnicate'.\n"),
        (["lst"], "No such command 'lst'. Did you mean 'list'?"),
        (["Report", "bag"], "Did you mean 'report'?"),
        (["run", "TIRE_BUMP"], "did you mean tire_bump?"),
        (["run", "seat_ride", "--no-record", "--out", "y"], "--out y names a bag and --no-record writes none"),
    ],
)
def test_bad_input_is_refused_with_status_2_and_a_sentence_and_creates_nothing(
    capsys, tmp_path, monkeypatch, arguments, sentence
):
    monkeypatch.chdir(tmp_path)
    status, said = refused(capsys, *arguments, *(["--json"] if arguments[0] == "run" else []))
    assert status == 2
    assert sentence in said
    assert list(tmp_path.iterdir()) == []


def test_a_directory_that_exists_is_never_written_to(capsys, tmp_path):
    (tmp_path / "mine").write_text("mine")
    status, said = refused(capsys, "run", "seat_ride", *OFFLINE, "--out", tmp_path)
    assert status == 2
    assert "exists already" in said
    assert [entry.name for entry in tmp_path.iterdir()] == ["mine"]


def test_a_report_is_written_and_its_path_printed(capsys, tmp_path):
    bag = tmp_path / "bag"
    bench_main(["run", "seat_ride", "--offline", "--duration", "1", "--out", str(bag)])
    capsys.readouterr()
    assert bench_main(["report", str(bag)]) == 0
    assert capsys.readouterr().out == f"report: {bag / 'report.html'}\n"
    assert "seat_ride" in (bag / "report.html").read_text(encoding="utf-8")


def test_a_cut_bag_is_recovered_with_status_3(capsys, tmp_path):
    bag = tmp_path / "bag"
    bench_main(["run", "seat_ride", *OFFLINE, "--out", str(bag)])
    capsys.readouterr()
    assert bench_main(["recover", str(bag), str(tmp_path / "whole")]) == 0
    file = next(bag.glob("*.mcap"))
    file.write_bytes(file.read_bytes()[: file.stat().st_size // 2])
    assert bench_main(["recover", str(bag), str(tmp_path / "half")]) == 3
    assert open_bag(tmp_path / "half").complete


def signalled(process, number, ready):
    """What a run writes that gets a signal as soon as it is ``ready``, and that then ends with status 0."""
    try:
        wait_until(lambda: process.poll() is not None or ready())
        process.send_signal(number)
        out, said = process.communicate(timeout=LONGEST)
    finally:
        end(process)
    assert process.returncode == 0, said
    assert "Traceback" not in said
    return out


def test_a_signal_ends_an_offline_run_with_its_bag_closed_and_status_0(tmp_path):
    bag = tmp_path / "bag"
    process = start_bench("run", "car_full_bench", "--offline", "--duration", "1000", "--out", bag)
    signalled(process, signal.SIGTERM, lambda: any(bag.glob("*.mcap")))
    assert open_bag(bag).metadata["ended"] == "stopped"
    assert open_bag(bag).complete


@pytest.mark.parametrize("motion", ["block.velocity=[1,0,0]", "block.angular_velocity=[0,20,0]"])
def test_a_ball_that_is_on_the_ground_from_the_start_runs(motion):
    """All that it calls is compiled before the run, in a process that has compiled nothing else."""
    placed = ("--set", "block.position=[0,0,0.05]", "--set", motion)
    ended = bench("run", "block_zeno", "--offline", "--no-record", "--duration", "0.05", *placed)
    assert ended.returncode == 0, ended.stderr


def test_a_signal_breaks_off_the_set_up_of_an_offline_run_before_anything_is_created(tmp_path):
    """Its kernels take half a minute to compile, in some 290 files; it does not wait for them."""
    cache, bag = tmp_path / "cache", tmp_path / "bag"
    environment = {**ENVIRONMENT, "CONTACT_BENCH_CACHE": str(cache)}
    process = start_bench("run", "box_3d_tumble", "--offline", "--out", bag, environment=environment)
    assert "stopped after 0 s" in signalled(process, signal.SIGINT, lambda: any(cache.rglob("*.py3*")))
    assert not bag.exists()
    assert len(list(cache.rglob("*.py3*"))) < 60


@needs_ros
def test_a_replay_that_would_begin_after_the_end_of_its_bag_is_refused(tmp_path):
    bench_main(["run", "seat_ride", *OFFLINE, "--out", str(tmp_path / "bag")])
    ended = bench("replay", tmp_path / "bag", "--start-offset", "5")
    assert ended.returncode == 2
    assert "start_offset is 5 s" in ended.stderr + ended.stdout
    assert "begin before its end" in ended.stderr + ended.stdout
