"""The launch file: what it refuses and how it ends, by the launch of ROS where it is installed, else by a stand-in."""

import importlib.util
import os
import re
import runpy
import signal
import subprocess
import sys
import types
from pathlib import Path
from types import SimpleNamespace

import click
import pytest
from ruamel.yaml import YAML
from tests.bench_process import ENVIRONMENT, LONGEST, PACKAGE, Nodes, bench, needs_ros, resolved, wait_until

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.cli.launched import LaunchedRun, options_of
from contact_sim_pkg.cli.replay import command as replay_command
from contact_sim_pkg.cli.run import command as run_command
from contact_sim_pkg.nodes.processes.scene_file import read_reason
from contact_sim_pkg.run.offline import run_offline

FILE = PACKAGE / "launch" / "bench.launch.py"
REPLAY = FILE.with_name("replay.launch.py")
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
def launch_file(monkeypatch, request):
    """Names of the launch file, run with a stand-in for launch."""
    for name in (*(f"launch{part}" for part in MODULES), "launch_ros", "launch_ros.actions"):
        module = types.ModuleType(name)
        module.__getattr__ = lambda _: Made
        monkeypatch.setitem(sys.modules, name, module)
    return SimpleNamespace(**runpy.run_path(str(request.param if hasattr(request, "param") else FILE)))


def context(launch_file, *, is_shutdown=False, **given):
    defaults = {name: each.default for name, each in launch_file.ARGUMENTS.items()}
    return SimpleNamespace(is_shutdown=is_shutdown, given={**defaults, **given}, launch_configurations=given)


@pytest.mark.parametrize(
    ("launch_file", "command", "without"), [(FILE, "run", {"offline", "json"}), (REPLAY, "replay", set())],
    indirect=["launch_file"],
)  # fmt: skip
def test_every_option_of_the_command_is_an_argument_of_the_launch(launch_file, command, without):
    shown = bench(command, "--help").stdout
    options = set(re.findall(r"^ +(?:-\w, )?--([a-z-]+)", shown, re.MULTILINE)) - {"help"}
    assert len(options) > 6
    names = {option.replace("-", "_") for option in options} - without
    called_with = {"run": "scene", "replay": "bag"}[command]
    assert set(launch_file.ARGUMENTS) == names | {called_with, "namespace", "use_sim_time"}


def test_options_are_read_as_the_command_line_reads_them():
    made = options_of(
        run_command,
        {"scene": "seat_ride", "set": "seat.cushion=null title='two words'", "clock": "False", "strict": "True",
         "duration": "3", "road": "", "check": "false"},
    )  # fmt: skip
    assert made["assignments"] == ("seat.cushion=null", "title=two words")
    assert (made["scene"], made["clock"], made["strict"], made["check"]) == ("seat_ride", False, True, False)
    assert (made["duration"], made["road"]) == ("3", None)
    with pytest.raises(ValueError, match="'fast' is not a valid float"):
        options_of(replay_command, {"bag": "somewhere", "rate": "fast"})
    with pytest.raises(ValueError, match="Missing argument 'BAG'"):
        options_of(replay_command, {"bag": ""})


@pytest.mark.parametrize("launch_file", [REPLAY], indirect=True)
def test_the_launch_of_a_replay_hands_parameters_and_full_names_on(launch_file, tmp_path):
    run_offline(resolved("seat_ride", "duration=0.05"), tmp_path / "bag")
    given = {"bag": str(tmp_path / "bag"), "rate": "2", "topics": "seat/force seat/patch", "loop": "true"}
    (node,) = launch_file.start_node(context(launch_file, remap="seat/force:=left/force", namespace="rig1", **given))
    parameters = node.named["parameters"][0]
    assert (parameters["bag"], parameters["rate"]) == (given["bag"], 2.0)
    assert (parameters["topics"], parameters["loop"]) == ("seat/force,seat/patch", True)
    assert (parameters["clock"], parameters["start_message"]) == (False, 0)
    assert node.named["remappings"] == [("/seat/force", "left/force")]
    assert node.named["namespace"] == "rig1"
    with pytest.raises(BagError, match="tire/force"):
        launch_file.start_node(context(launch_file, remap="tire/force:=left/force", **given))
    ended = SimpleNamespace(returncode=2)
    with pytest.raises(RuntimeError, match="bag_replay ended with status 2"):
        launch_file.on_exit(ended, context(launch_file))
    assert launch_file.on_exit(ended, context(launch_file, is_shutdown=True)) is None


def test_the_arguments_are_declared_and_reach_the_nodes_of_the_plan(launch_file, tmp_path):
    declared = launch_file.generate_launch_description().arguments[0]
    assert {made.arguments[0] for made in declared if made.named.get("description")} == set(launch_file.ARGUMENTS)
    asked = context(
        launch_file,
        scene="seat_ride",
        out=str(tmp_path / "bag"),
        clock="false",
        use_sim_time="True",
        namespace="rig1",
    )
    nodes = launch_file.start_nodes(asked)
    parameters = {node.named["name"]: node.named["parameters"][0] for node in nodes}
    assert list(parameters) == ["bag_logger", "vibration", "contact_simulator"]
    assert parameters["contact_simulator"]["publish_clock"] is False
    assert all(each["use_sim_time"] is True for each in parameters.values())
    assert {node.named["namespace"] for node in nodes} == {"rig1"}
    # on a busy machine an ordinary end takes some seconds: launch's own times, which are longer, hold
    assert not any("sigterm_timeout" in node.named or "sigkill_timeout" in node.named for node in nodes)
    assert not (tmp_path / "bag").exists()


def test_a_bag_that_exists_is_refused_before_a_node_is_started(launch_file, tmp_path):
    with pytest.raises(BagError, match="exists already"):
        launch_file.start_nodes(context(launch_file, scene="seat_ride", out=str(tmp_path)))
    launch_file.start_nodes(context(launch_file, scene="seat_ride", no_record="true"))
    with pytest.raises(click.UsageError, match="--no-record writes none"):
        launch_file.start_nodes(context(launch_file, scene="seat_ride", no_record="true", check="true"))
    with pytest.raises(ValueError, match="durration:= is no argument of this launch file; did you mean duration:="):
        launch_file.start_nodes(context(launch_file, scene="seat_ride", durration="1"))
    launch_file.start_nodes(
        context(launch_file, scene="seat_ride", no_record="true", robot="of the file that includes")
    )
    with pytest.raises(ValueError, match="bag:= is now out:="):
        launch_file.start_nodes(context(launch_file, scene="seat_ride", bag=str(tmp_path)))


NAMED = {1: "ended with status 1", 3: "ended with status 3", -9: "was ended by SIGKILL"}


@pytest.mark.fault("F2")
@pytest.mark.parametrize(
    ("node", "status", "is_shutdown", "fails"),
    [
        ("vibration", 0, False, False),
        ("vibration", 1, False, True),
        ("vibration", 3, True, True),
        ("vibration", -9, False, True),
        ("vibration", -2, True, False),
        ("vibration", 0, True, False),
        ("vibration", -9, True, False),  # did not end, and lost nothing
        ("bag_logger", -9, True, True),
    ],
)
def test_a_node_that_ends_badly_is_an_error_of_the_launch(launch_file, tmp_path, node, status, is_shutdown, fails):
    """The first one of a run is the reason that its bag keeps."""
    scene = tmp_path / "scene.resolved.yaml"
    run = LaunchedRun(scene, tmp_path / "bag", [node, "contact_simulator"])
    on_exit = launch_file.end_of(node, run, tmp_path / "bag")
    ended = SimpleNamespace(returncode=status)
    if fails:
        with pytest.raises(RuntimeError, match=f"{node} {NAMED[status]}; the run has failed"):
            on_exit(ended, context(launch_file))
        with pytest.raises(RuntimeError):
            launch_file.end_of("contact_simulator", run, None)(SimpleNamespace(returncode=1), context(launch_file))
        assert read_reason(str(scene)) == f"{node} {NAMED[status]}"
    else:
        assert on_exit(ended, context(launch_file, is_shutdown=is_shutdown)) == []
        assert read_reason(str(scene)) == ""
    assert not run.finished


def test_a_run_that_all_nodes_have_finished_is_checked_and_judged(launch_file, tmp_path, monkeypatch):
    run = LaunchedRun(tmp_path / "scene.resolved.yaml", tmp_path / "bag", ["vibration", "contact_simulator"])
    ended = SimpleNamespace(returncode=0)
    assert launch_file.end_of("vibration", run, tmp_path, check=True)(ended, context(launch_file)) == []
    (check,) = launch_file.end_of("contact_simulator", run, tmp_path, check=True, strict=True)(
        ended, context(launch_file)
    )
    assert check.named["cmd"][-2:] == ["accuracy", str(tmp_path)]
    monkeypatch.setattr("contact_sim_pkg.cli.launched.open_bag", lambda _: None)
    numbers = {"requested": 1e-2, "estimated": {"tire": {"force": 2e-2}}, "not_below": {}}
    monkeypatch.setattr("contact_sim_pkg.report.summary.summarise", lambda _: {"accuracy": numbers})
    with pytest.raises(RuntimeError, match=r"above the requested accuracy: tire force 2\.?0?e-2"):
        check.named["on_exit"](ended, context(launch_file))
    numbers["estimated"]["tire"]["force"] = 1e-3
    check.named["on_exit"](ended, context(launch_file))


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
        run = LaunchedRun(scene, nodes.bag, started)
        with pytest.raises(RuntimeError, match=f"{victim} was ended by SIGKILL; the run has failed") as raised:
            launch_file.end_of(victim, run, nodes.bag)(SimpleNamespace(returncode=status), context(launch_file))
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
    arguments = [f"{name}:={value}" for name, value in {"scene": "seat_ride", "out": folder / "bag", **given}.items()]
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
@pytest.mark.parametrize(
    ("node", "number", "status"), [("bag_logger", 9, 1), ("contact_simulator", 9, 1), ("", 2, 0), ("bag_logger", 19, 1)]
)
def test_the_status_of_launch_distinguishes_a_killed_node_from_an_interrupt(tmp_path, node, number, status):
    process = start_launch(tmp_path, duration=60)
    try:
        file = tmp_path / "bag" / "bag_0.mcap"
        wait_until(lambda: process.poll() is not None or (file.exists() and file.stat().st_size > 30_000))
        os.kill(process_of(process.pid, node) if node else process.pid, signal.Signals(number))
        if number == signal.SIGSTOP:  # a logger that hangs, and then Ctrl-C
            process.send_signal(signal.SIGINT)
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
