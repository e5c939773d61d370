"""Every command has the same of a foreign bag, whatever it was written by and with."""

from pathlib import Path

import pytest
from tests.bag import foreign
from tests.bench_process import bench, needs_ros

from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.cli.main import main
from contact_sim_pkg.nodes.protocol.player import Player

BAGS = (*foreign.FOREIGN, foreign.ros1)


def run(capsys, *arguments: object) -> tuple[int, str]:
    """Exit status of `bench`, and what it printed."""
    status = main([str(each) for each in arguments])
    return status, capsys.readouterr().out


def tables(folder: Path) -> dict[str, bytes]:
    return {file.name: file.read_bytes() for file in folder.iterdir()}


@pytest.fixture(scope="module")
def plain(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("plain")
    return foreign.chunked(folder)


@pytest.mark.parametrize("make", BAGS, ids=lambda make: make.__name__)
def test_metrics_export_and_replay_are_those_of_the_plain_bag(make, plain, tmp_path, capsys, monkeypatch):
    bag = plain
    monkeypatch.chdir(tmp_path)
    (tmp_path / "in").mkdir()
    other = make(tmp_path / "in")
    found = []
    for number, each in enumerate((bag, other)):
        status, listed = run(capsys, "metrics", each, "--csv")
        assert status == 1  # beyond a limit
        assert run(capsys, "export", each, "--csv", "--out", f"tables_{number}")[0] == 0
        assert run(capsys, "export", each, "--wall-time", "--out", f"wall_{number}")[0] == 0
        opened = open_bag(each)
        player, sent = Player(opened, list(opened.topics), [], rate=1e9), []
        player.resume(0.0)
        while message := player.next_due(1.0):
            sent.append((message.topic, message.log_time, message.data))
        wall = [(each.topic, each.log_time, each.data) for each in open_bag(Path(f"wall_{number}")).messages()]
        found.append((listed, tables(Path(f"tables_{number}")), sent, wall))
    first, second = found
    assert second[0] == first[0]
    assert {*first[1]} == {"imu.csv", "note.csv"}
    assert second[1] == first[1]
    assert second[2] == first[2] == foreign.ROWS
    assert second[3] == first[3]


@pytest.mark.fault("E13")
def test_what_cannot_be_read_is_named_and_left_out_and_the_rest_is_whole(plain, tmp_path, capsys):
    bag = plain
    strangers = foreign.with_strangers(tmp_path)
    main(["export", str(bag), "--csv", "--out", str(tmp_path / "plain")])
    capsys.readouterr()
    status = main(["export", str(strangers), "--csv", "--out", str(tmp_path / "tables")])
    said = capsys.readouterr().err
    assert status == 3
    for topic in ("/light/_service_event", "/odd", "/json"):
        assert f"{topic} is left out (5 messages)" in said
    assert tables(tmp_path / "tables") == tables(tmp_path / "plain")
    assert run(capsys, "metrics", strangers, "--csv") == run(capsys, "metrics", bag, "--csv")
    assert main(["recover", str(strangers), str(tmp_path / "recovered")]) == 0
    kept = [(each.topic, each.data) for each in open_bag(tmp_path / "recovered").messages()]
    assert kept == [(each.topic, each.data) for each in open_bag(strangers).messages()]
    # a topic that is asked for is refused
    assert main(["export", str(strangers), "--csv", "--topic", "/odd", "--out", str(tmp_path / "odd")]) == 2
    assert not (tmp_path / "odd").exists()


@needs_ros
def test_a_replay_leaves_out_what_is_not_installed(tmp_path):
    strangers = foreign.with_strangers(tmp_path, json=False)  # what is not CDR is refused
    ended = bench("replay", strangers, "--rate", "100", "--delay", "0")
    assert ended.returncode == 3, ended.stderr
    assert f"{len(foreign.ROWS)} of {len(foreign.ROWS)} messages went out" in ended.stderr
    for topic in ("/light/_service_event", "/odd"):
        assert f"{topic} is left out (5 messages)" in ended.stderr
    assert bench("replay", strangers, "--topics", "/odd").returncode == 2
