"""The same scene gives the same bits offline and on nodes, whatever the scheduler and the order of the start do."""

import json
import subprocess
import sys

import pytest
from tests.bench_process import Nodes, bench, messages, needs_ros, resolved

from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.report.summary import summarise
from contact_sim_pkg.run.from_bag import sources_from_bag
from contact_sim_pkg.run.offline import run_offline

pytestmark = needs_ros


@pytest.fixture(scope="module")
def seat():
    return resolved("seat_ride", "duration=0.3", "pace=max")


@pytest.fixture(scope="module")
def offline_seat(seat, tmp_path_factory):
    bag = tmp_path_factory.mktemp("offline") / "bag"
    run_offline(seat, bag)
    return messages(bag)


@pytest.mark.fault("F4")
@pytest.mark.parametrize(
    "order",
    [
        ("bag_logger", "vibration", "contact_simulator"),
        ("contact_simulator", "bag_logger", "vibration"),
        ("vibration", "contact_simulator", "bag_logger"),
    ],
)
def test_nodes_started_in_any_order_record_the_same_bits_as_offline(seat, offline_seat, tmp_path, order):
    nodes = Nodes(seat, tmp_path)
    try:
        for node in order:
            nodes.start(node)
        assert nodes.wait() == dict.fromkeys(order, 0)
    finally:
        nodes.end()
    assert messages(nodes.bag) == offline_seat
    assert [line for line in nodes.printed if "Traceback" in line or "ERROR" in line] == []


def test_the_full_bench_on_five_processes_under_load_records_the_same_bits_as_offline(tmp_path):
    load = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(2)]
    try:
        ended = bench("run", "car_full_bench", "--pace", "max", "--duration", "0.3", "--out", tmp_path / "nodes")
    finally:
        for process in load:
            process.kill()
            process.wait()
    assert ended.returncode == 0, ended.stderr
    run_offline(resolved("car_full_bench", "duration=0.3", "pace=max"), tmp_path / "offline")
    on_nodes, offline = messages(tmp_path / "nodes"), messages(tmp_path / "offline")
    assert {topic for topic, _, _ in on_nodes} >= {"/road/patch", "/platform/vibration", "/tire/patch", "/seat/patch"}
    assert on_nodes == offline
    kept = open_bag(tmp_path / "nodes").metadata, open_bag(tmp_path / "offline").metadata
    described, offline_described = (json.loads(each["excitation"]) for each in kept)
    publishers = {topic: values.pop("published by") for topic, values in described.items()}
    assert publishers == {"platform/vibration": "/vibration", "road/patch": "/road_profile"}
    assert described == offline_described
    assert kept[0]["scene"] == kept[1]["scene"]


@pytest.mark.parametrize("carried", ["{inflation: {}", "{normal_elastic: {}, envelopment: {}"])
def test_a_tire_with_every_effect_records_the_same_bits_as_offline(tmp_path, carried):
    effects = [
        "normal_dissipative",
        "contact_field",
        "rigid_ring",
        "brush",
        "tread_viscoelasticity",
        "asperity_impulses",
    ]
    values = ("duration=0.2", "pace=max", f"effects.tire={carried}, {', '.join(f'{name}: {{}}' for name in effects)}}}")
    options = [part for value in values for part in ("--set", value)]
    ended = bench("run", "tire_braking", *options, "--out", tmp_path / "nodes")
    assert ended.returncode == 0, ended.stderr
    run_offline(resolved("tire_braking", *values), tmp_path / "offline")
    on_nodes = messages(tmp_path / "nodes")
    assert {topic for topic, _, _ in on_nodes} >= {"/tire/shear", "/tire/patch", "/tire/wrench"}
    assert on_nodes == messages(tmp_path / "offline")


def test_a_back_that_slaps_and_slips_records_the_same_bits_as_offline(tmp_path):
    values = ("duration=0.6", "pace=max", "vibration.amplitude=14.715")
    options = [part for value in values for part in ("--set", value)]
    ended = bench("run", "seat_slip", *options, "--out", tmp_path / "nodes")
    assert ended.returncode == 0, ended.stderr
    run_offline(resolved("seat_slip", *values), tmp_path / "offline")
    on_nodes = messages(tmp_path / "nodes")
    assert {topic for topic, _, _ in on_nodes} >= {"/backrest/points", "/backrest/patch", "/bench/episodes"}
    assert on_nodes == messages(tmp_path / "offline")


def test_a_rig_without_excitation_records_the_same_bits_as_offline(tmp_path):
    values = ("duration=0.5", "pace=max")
    options = [part for value in values for part in ("--set", value)]
    ended = bench("run", "impact_rubber_drop", *options, "--out", tmp_path / "nodes")
    assert ended.returncode == 0, ended.stderr
    run_offline(resolved("impact_rubber_drop", *values), tmp_path / "offline")
    on_nodes = messages(tmp_path / "nodes")
    assert {topic for topic, _, _ in on_nodes} >= {"/impact/events", "/impact/course", "/impact/wave", "/impact/force"}
    assert on_nodes == messages(tmp_path / "offline")


def test_a_bag_has_the_names_of_the_graph_and_drives_and_is_reported_as_any_other(seat, offline_seat, tmp_path):
    shown = {"/seat/force": "/rig1/pan/load", "/platform/vibration": "/shaker"}
    nodes = Nodes(seat, tmp_path, "__ns:=/rig1", "seat/force:=pan/load", "platform/vibration:=/shaker")
    try:
        for node in ("bag_logger", "vibration", "contact_simulator"):
            nodes.start(node)
        assert set(nodes.wait().values()) == {0}
    finally:
        nodes.end()
    expected = [(shown.get(topic, f"/rig1{topic}"), stamp, data) for topic, stamp, data in offline_seat]
    assert messages(nodes.bag) == expected
    assert "seat.lift_off" in {row["key"] for row in summarise(open_bag(nodes.bag))["metrics"]}
    run_offline(seat, tmp_path / "again", sources=sources_from_bag(nodes.bag, seat))
    assert messages(tmp_path / "again") == offline_seat


def test_a_run_without_recording_ends_by_itself_and_leaves_nothing(seat, tmp_path):
    nodes = Nodes(seat, tmp_path)
    try:
        nodes.start("contact_simulator", record="false")
        nodes.start("vibration", record="false")
        assert nodes.wait() == {"contact_simulator": 0, "vibration": 0}
    finally:
        nodes.end()
    assert not nodes.bag.exists()


def test_the_blocks_of_an_earlier_bag_drive_the_nodes_to_the_same_bits(offline_seat, tmp_path, seat):
    run_offline(seat, tmp_path / "first")
    ended = bench("run", "--from-bag", tmp_path / "first", "--out", tmp_path / "again")
    assert ended.returncode == 0, ended.stderr
    assert messages(tmp_path / "again") == offline_seat
