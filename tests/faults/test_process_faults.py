"""Signals, dead nodes, second benches (FAULTS part F; B5, B8, G1)."""

import os
import re
import signal
import time
from pathlib import Path

import pytest
from ruamel.yaml import YAML
from tests.bench_process import (
    ENVIRONMENT,
    LONGEST,
    Nodes,
    children_of,
    end,
    lives,
    messages,
    needs_ros,
    resolved,
    start_bench,
    wait_until,
)

from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.nodes.processes.shared_memory import mapped_segments
from contact_sim_pkg.run.offline import run_offline

pytestmark = needs_ros

LONG = ("run", "seat_ride", "--pace", "realtime", "--duration", "60", "--out")
NODES = {"bag_logger", "contact_simulator", "vibration"}


def recorded_bytes(bag: Path) -> int:
    return sum(entry.stat().st_size for entry in bag.glob("*.mcap"))


def left_of(segments: set[str]) -> set[str]:
    """Those of the segments that are still there, but for ports, which others take over, and this process's own."""
    named = {name for name in segments - mapped_segments(os.getpid()) if re.fullmatch(r"fastrtps_[0-9a-f]+", name)}
    return {name for name in named if Path("/dev/shm", name).exists()}


@pytest.fixture
def running(tmp_path):
    """A run under way: the process, its bag, and the shared memory of its nodes."""
    bag = tmp_path / "bag"
    process = start_bench(*LONG, bag)
    try:
        wait_until(lambda: process.poll() is not None or recorded_bytes(bag) > 30_000)
        assert process.poll() is None, process.communicate()
        yield process, bag
    finally:
        end(process)


@pytest.mark.fault("F1")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_ends_the_run_with_its_bag_closed_and_status_0(running, number):
    """F1."""
    process, bag = running
    nodes = children_of(process.pid)
    process.send_signal(number)
    _, said = process.communicate(timeout=LONGEST)
    assert process.returncode == 0, said
    assert "Traceback" not in said
    assert f"{bag} is closed; its summary follows" in said
    closed = open_bag(bag)
    assert closed.complete
    assert closed.metadata["ended"] == "stopped"
    assert int(closed.metadata["blocks_done"]) == closed.count("platform/vibration") == closed.count("bench/energy")
    assert not any(lives(node) for node in nodes.values())


@pytest.mark.fault("F2", "F3")
@pytest.mark.parametrize("victim", sorted(NODES))
def test_a_killed_node_is_named_and_the_others_end(running, victim):
    """F2, F3: status 1, no process and no shared memory left, what was recorded stays readable."""
    process, bag = running
    nodes = children_of(process.pid)
    assert set(nodes) == NODES
    segments = set().union(*(mapped_segments(node) for node in nodes.values()))
    os.kill(nodes[victim], signal.SIGKILL)
    printed, said = process.communicate(timeout=LONGEST)
    assert process.returncode == 1
    assert f"{victim} was ended by SIGKILL" in said
    assert "Traceback" not in said
    assert not any(lives(node) for node in nodes.values())
    left = open_bag(bag)
    assert left.complete == (victim != "bag_logger")
    assert left.count("seat/force") > 0
    kept = YAML(typ="safe").load((bag / "metadata.yaml").read_text())["rosbag2_bagfile_information"]
    assert kept["message_count"] == left.count()
    assert kept["custom_data"]["ended"] == "failed"
    assert f"{victim} was ended by SIGKILL" in kept["custom_data"]["failure"]
    assert "messages on" not in printed  # numbers of a failed run would keep its user waiting
    if victim == "bag_logger":
        assert said.splitlines()[-1].endswith(f"make it whole: bench recover {bag} {bag}_recovered")
    else:
        assert left.metadata["failure"] == kept["custom_data"]["failure"]
        assert "bench recover" not in said
    assert left_of(segments) == set()


@pytest.mark.fault("F2")
def test_nodes_whose_supervisor_is_killed_end_by_themselves_and_leave_nothing(running):
    process, bag = running
    nodes = children_of(process.pid)
    folder = folder_of(process)
    wait_until(lambda: (folder / "segments").exists())
    segments = set().union(*(mapped_segments(node) for node in (process.pid, *nodes.values())))
    process.kill()
    process.wait()
    wait_until(lambda: not any(lives(node) for node in nodes.values()))
    left = open_bag(bag)
    assert left.complete
    assert left.metadata["ended"] == "failed"
    assert left.metadata["failure"] == f"bench run (process {process.pid}), which watched the nodes, is gone"
    assert not folder.exists()
    assert left_of(segments) == set()


def folder_of(process) -> Path:
    """The temporary folder of a supervisor: what its nodes were given as their scene stands in it."""
    arguments = Path(f"/proc/{next(iter(children_of(process.pid).values()))}/cmdline").read_text().split("\0")
    return Path(next(text for text in arguments if ".resolved.yaml" in text).split("scene:=")[1].strip("'")).parent


@pytest.mark.parametrize("stopped", ["bag_logger", "contact_simulator"])
def test_a_node_that_does_not_answer_does_not_outlive_an_interrupt(running, stopped):
    """After how long it is killed: tests/nodes/processes/test_stop_requests.py."""
    process, bag = running
    nodes = children_of(process.pid)
    os.kill(nodes[stopped], signal.SIGSTOP)
    process.send_signal(signal.SIGINT)
    wait_until(lambda: not any(lives(node) for node in nodes.values()))
    _, said = process.communicate(timeout=LONGEST)
    assert "Traceback" not in said
    if stopped == "bag_logger":
        assert process.returncode == 1
        assert "bench recover" in said.splitlines()[-1]
    else:
        assert open_bag(bag).complete


def test_a_simulator_without_its_logger_ends_at_an_interrupt(tmp_path):
    """The logger is killed, and there is no supervisor to see it; it does not wait for an answer until its input timeout."""
    nodes = Nodes(resolved("seat_ride", "duration=60", "pace=realtime"), tmp_path)
    try:
        started = {name: nodes.start(name, input_timeout=3600.0) for name in ("bag_logger", "contact_simulator")}
        started["vibration"] = nodes.start("vibration")
        nodes.wait_until(lambda: recorded_bytes(nodes.bag) > 30_000)
        logger = started["bag_logger"]
        logger.record_segments()
        logger.process.kill()
        started["contact_simulator"].process.send_signal(signal.SIGINT)
        assert nodes.wait("contact_simulator", "vibration")["contact_simulator"] == 1
    finally:
        nodes.end()
    assert left_of(logger.segments) == set()


def test_a_stopped_logger_is_named_and_loses_nothing_when_it_goes_on(tmp_path):
    """Stopped for longer than the run waits for it: the run ends and names it, and not its source; the bag is whole."""
    nodes = Nodes(resolved("seat_ride", "duration=60", "pace=realtime"), tmp_path)
    try:
        logger = nodes.start("bag_logger")
        nodes.start("contact_simulator", input_timeout=4.0)
        nodes.start("vibration")
        nodes.wait_until(lambda: recorded_bytes(nodes.bag) > 30_000)
        logger.process.send_signal(signal.SIGSTOP)
        wait_until(lambda: any("the logger has not answered for block" in line for line in nodes.printed))
        time.sleep(1.0)
        logger.process.send_signal(signal.SIGCONT)
        assert nodes.wait() == {"bag_logger": 0, "contact_simulator": 1, "vibration": 0}
    finally:
        nodes.end()
    assert not [line for line in nodes.printed if "is missing" in line]
    bag = open_bag(nodes.bag)
    assert bag.complete
    assert "the logger has not answered" in bag.metadata["failure"]
    assert bag.count("platform/vibration") == bag.count("seat/force") == int(bag.metadata["blocks_done"])


@pytest.mark.fault("B5")
def test_a_source_that_is_stopped_for_a_while_costs_nothing_but_time(tmp_path):
    scene = resolved("seat_ride", "duration=1", "pace=realtime")
    nodes = Nodes(scene, tmp_path)
    try:
        nodes.start("bag_logger")
        nodes.start("contact_simulator", input_timeout=60.0)
        source = nodes.start("vibration")
        nodes.wait_until(lambda: recorded_bytes(nodes.bag) > 20_000)
        source.process.send_signal(signal.SIGSTOP)
        time.sleep(2.0)
        source.process.send_signal(signal.SIGCONT)
        assert nodes.wait() == {"bag_logger": 0, "contact_simulator": 0, "vibration": 0}
    finally:
        nodes.end()
    run_offline(scene, tmp_path / "offline")
    assert messages(nodes.bag) == messages(tmp_path / "offline")


@pytest.mark.fault("B8")
def test_a_second_bench_in_the_same_domain_is_refused_and_the_first_goes_on(running, tmp_path):
    """B8: status 2, the cure named, nothing created."""
    process, bag = running
    second = start_bench(*LONG, tmp_path / "second")
    try:
        _, said = second.communicate(timeout=LONGEST)
    finally:
        end(second)
    assert second.returncode == 2, said
    assert "ROS_DOMAIN_ID" in said
    assert "Exception in" not in said
    assert "namespace" not in said.replace("the launch file also takes a namespace", "")
    assert not (tmp_path / "second").exists()
    before = recorded_bytes(bag)
    wait_until(lambda: recorded_bytes(bag) > before)
    assert process.poll() is None


def test_a_signal_while_the_nodes_start_ends_everything_with_status_0(tmp_path):
    process = start_bench(*LONG, tmp_path / "bag")
    try:
        wait_until(lambda: set(children_of(process.pid)) == NODES)
        nodes = children_of(process.pid)
        process.send_signal(signal.SIGTERM)
        _, said = process.communicate(timeout=LONGEST)
    finally:
        end(process)
    assert process.returncode == 0, said
    assert "Traceback" not in said
    assert not any(lives(node) for node in nodes.values())


@pytest.mark.fault("F1")
def test_nodes_without_a_supervisor_close_the_bag_when_all_are_interrupted(tmp_path):
    """F1 as a launch file does it: SIGINT to every process."""
    nodes = Nodes(resolved("seat_ride", "duration=60", "pace=realtime"), tmp_path)
    try:
        started = {name: nodes.start(name) for name in sorted(NODES)}
        nodes.wait_until(lambda: recorded_bytes(nodes.bag) > 30_000)
        for child in started.values():
            child.process.send_signal(signal.SIGINT)
        assert nodes.wait() == dict.fromkeys(sorted(NODES), 0)
    finally:
        nodes.end()
    assert open_bag(nodes.bag).complete
    assert not [line for line in nodes.printed if "Traceback" in line]


@pytest.mark.fault("G1")
def test_discovery_of_every_process_stays_on_this_host(tmp_path):
    """G1: also where the caller has set nothing; the caller's domain is kept and printed."""
    caller = {name: value for name, value in ENVIRONMENT.items() if name != "ROS_AUTOMATIC_DISCOVERY_RANGE"}
    process = start_bench(*LONG, tmp_path / "bag", environment=caller)
    try:
        wait_until(lambda: set(children_of(process.pid)) == NODES)
        found = [Path(f"/proc/{node}/environ").read_bytes().split(b"\0") for node in children_of(process.pid).values()]
        process.send_signal(signal.SIGTERM)
        _, said = process.communicate(timeout=LONGEST)
    finally:
        end(process)
    domain = ENVIRONMENT["ROS_DOMAIN_ID"]
    assert f"ROS_DOMAIN_ID is {domain}" in said
    for environment in found:
        assert b"ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST" in environment
        assert f"ROS_DOMAIN_ID={domain}".encode() in environment
