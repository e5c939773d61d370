"""The launch file: what it refuses and how it ends, by the launch of ROS where it is installed, else by a stand-in."""

import importlib.util
import os
import runpy
import signal
import subprocess
import sys
import types
from pathlib import Path
from types import SimpleNamespace

import pytest
from ruamel.yaml import YAML
from tests.bench_process import ENVIRONMENT, LONGEST, PACKAGE, Nodes, needs_ros, resolved, wait_until

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.nodes.processes.scene_file import read_reason

FILE = PACKAGE / "launch" / "bench.launch.py"
MODULES = ("", ".actions", ".event_handlers", ".events", ".events.process", ".substitutions")
LAUNCH = """
import sys
from launch import LaunchDescription, LaunchService
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
given = [tuple(text.split(":=")) for text in sys.argv[2:]]
service = LaunchService(noninteractive=True)
source = PythonLaunchDescriptionSource(sys.argv[1])
service.include_launch_description(LaunchDescription([IncludeLaunchDescription(source, launch_arguments=given)]))
sys.exit(service.run())
"""  # what `ros2 launch` does with a launch file
needs_launch = pytest.mark.skipif(
    importlib.util.find_spec("launch_ros") is None, reason="launch_ros cannot be imported: it is not on PyPI"
)


class Made:
    """What the stand-in makes of every class of launch: its arguments."""

    def __init__(self, *arguments, **named):
        self.arguments, self.named = arguments, named

    def perform(self, context):
        return context.given[self.arguments[0]]


@pytest.fixture
def launch_file(monkeypatch):
    """Names of the launch file, run with a stand-in for launch."""
    for name in (*(f"launch{part}" for part in MODULES), "launch_ros", "launch_ros.actions"):
        module = types.ModuleType(name)
        module.__getattr__ = lambda _: Made
        monkeypatch.setitem(sys.modules, name, module)
    return SimpleNamespace(**runpy.run_path(str(FILE)))


def context(launch_file, *, is_shutdown=False, **given):
    defaults = {name: value for name, (value, _) in launch_file.ARGUMENTS.items()}
    return SimpleNamespace(is_shutdown=is_shutdown, given={**defaults, **given})


def test_the_arguments_are_declared_and_reach_the_nodes_of_the_plan(launch_file, tmp_path):
    declared = launch_file.generate_launch_description().arguments[0]
    assert {made.arguments[0] for made in declared if made.named.get("description")} == set(launch_file.ARGUMENTS)
    asked = context(
        launch_file,
        scene="seat_ride",
        bag=str(tmp_path / "bag"),
        publish_clock="false",
        use_sim_time="True",
        namespace="rig1",
    )
    nodes = launch_file.start_nodes(asked)
    parameters = {node.named["name"]: node.named["parameters"][0] for node in nodes}
    assert list(parameters) == ["bag_logger", "vibration", "contact_simulator"]
    assert parameters["contact_simulator"]["publish_clock"] is False
    assert all(each["use_sim_time"] is True for each in parameters.values())
    assert {node.named["namespace"] for node in nodes} == {"rig1"}
    assert not (tmp_path / "bag").exists()


def test_a_bag_that_exists_is_refused_before_a_node_is_started(launch_file, tmp_path):
    with pytest.raises(BagError, match="exists already"):
        launch_file.start_nodes(context(launch_file, scene="seat_ride", bag=str(tmp_path)))
    launch_file.start_nodes(context(launch_file, scene="seat_ride", bag=str(tmp_path), record="false"))


NAMED = {1: "ended with status 1", 3: "ended with status 3", -9: "was ended by SIGKILL"}


@pytest.mark.fault("F2")
@pytest.mark.parametrize(
    ("status", "is_shutdown", "fails"),
    [(0, False, False), (1, False, True), (3, True, True), (-9, False, True), (-2, True, False), (0, True, False)],
)
def test_a_node_that_ends_badly_is_an_error_of_the_launch(launch_file, tmp_path, status, is_shutdown, fails):
    """The first one of a run is the reason that its bag keeps."""
    scene = tmp_path / "scene.resolved.yaml"
    on_exit = launch_file.end_of("vibration", scene, tmp_path / "bag")
    ended = SimpleNamespace(returncode=status)
    if fails:
        with pytest.raises(RuntimeError, match=f"vibration {NAMED[status]}; the run has failed"):
            on_exit(ended, context(launch_file))
        with pytest.raises(RuntimeError):
            launch_file.end_of("contact_simulator", scene, None)(ended, context(launch_file))
        assert read_reason(str(scene)) == f"vibration {NAMED[status]}"
    else:
        assert on_exit(ended, context(launch_file, is_shutdown=is_shutdown)) == []
        assert read_reason(str(scene)) == ""


@pytest.mark.fault("F2")
@needs_ros
@pytest.mark.parametrize("victim", ["bag_logger", "contact_simulator", "vibration"])
def test_the_bag_names_a_killed_node_where_launch_has_started_them(launch_file, tmp_path, victim):
    """As launch does it: `end_of` at the end of a node, then SIGINT to the others."""
    nodes = Nodes(resolved("seat_ride", "duration=60", "pace=realtime"), tmp_path)
    scene = tmp_path / "scene.resolved.yaml"
    try:
        started = {name: nodes.start(name) for name in ("bag_logger", "vibration", "contact_simulator")}
        file = nodes.bag / "bag_0.mcap"
        nodes.wait_until(lambda: file.exists() and file.stat().st_size > 30_000)
        started[victim].process.kill()
        status = started[victim].process.wait()
        with pytest.raises(RuntimeError, match=f"{victim} was ended by SIGKILL; the run has failed") as raised:
            launch_file.end_of(victim, scene, nodes.bag)(SimpleNamespace(returncode=status), context(launch_file))
        for child in started.values():
            if child.name != victim:
                child.process.send_signal(signal.SIGINT)
        nodes.wait()
    finally:
        nodes.end()
    told = YAML(typ="safe").load((nodes.bag / "metadata.yaml").read_text())["rosbag2_bagfile_information"]
    assert told["custom_data"]["ended"] == "failed"
    assert told["custom_data"]["failure"] == f"{victim} was ended by SIGKILL"
    assert told["message_count"] == open_bag(nodes.bag).count() > 0
    if victim == "bag_logger":
        assert str(raised.value).endswith(f"make it whole: bench recover {nodes.bag} {nodes.bag}_recovered")
    else:
        assert open_bag(nodes.bag).complete


def start_launch(folder: Path, **given: object) -> subprocess.Popen[str]:
    arguments = [f"{name}:={value}" for name, value in {"scene": "seat_ride", "bag": folder / "bag", **given}.items()]
    environment = {**ENVIRONMENT, "HOME": str(folder)}  # launch keeps its logs there
    return subprocess.Popen(
        [sys.executable, "-c", LAUNCH, str(FILE), *arguments],
        env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True,
    )  # fmt: skip


def process_of(parent: int, node: str) -> int | None:
    """Number of the process of a node that `parent` has started."""
    for children in Path(f"/proc/{parent}/task").glob("*/children"):
        for child in children.read_text().split():
            if f"/{node}\0" in Path(f"/proc/{child}/cmdline").read_text():
                return int(child)
    return None


@needs_ros
@needs_launch
def test_launch_logs_the_progress_and_ends_with_0_and_then_refuses_the_bag(tmp_path):
    ended = [start_launch(tmp_path, duration=0.3, pace="max").communicate(timeout=LONGEST)[0] for _ in range(2)]
    for sentence in ("compiling", "ready", f"bag: {tmp_path / 'bag'}", "finished after 0.3 s"):
        assert sum(sentence in line for line in ended[0].splitlines()) == 1, ended[0]
    assert "exists already" in ended[1]
    assert "process started" not in ended[1]


@pytest.mark.fault("F2")
@needs_ros
@needs_launch
@pytest.mark.parametrize(("node", "number", "status"), [("bag_logger", 9, 1), ("contact_simulator", 9, 1), ("", 2, 0)])
def test_the_status_of_launch_distinguishes_a_killed_node_from_an_interrupt(tmp_path, node, number, status):
    process = start_launch(tmp_path, duration=60)
    try:
        file = tmp_path / "bag" / "bag_0.mcap"
        wait_until(lambda: process.poll() is not None or (file.exists() and file.stat().st_size > 30_000))
        os.kill(process_of(process.pid, node) if node else process.pid, signal.Signals(number))
        printed, _ = process.communicate(timeout=LONGEST)
    finally:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
    assert process.returncode == status, printed
    assert (f"{node} was ended by SIGKILL; the run has failed" in printed) == bool(node)
    assert open_bag(tmp_path / "bag").count("seat/force") > 0
    told = YAML(typ="safe").load((tmp_path / "bag" / "metadata.yaml").read_text())["rosbag2_bagfile_information"]
    assert told["custom_data"]["failure"] == (f"{node} was ended by SIGKILL" if node else "")
    assert ("bench recover" in printed) == (node == "bag_logger")
