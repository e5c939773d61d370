"""Runs of the bench in processes of their own, for the tests of nodes, faults and command line."""

import os
import signal
import subprocess
import time
from pathlib import Path

import pytest

from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.bag.topics import TOPICS
from contact_sim_pkg.nodes.processes.children import Children
from contact_sim_pkg.nodes.processes.scene_file import write_scene
from contact_sim_pkg.nodes.processes.shared_memory import mapped_segments, remove_unused
from contact_sim_pkg.python_process import python_command
from contact_sim_pkg.scene.load import load_scene
from contact_sim_pkg.scene.overrides import set_value
from contact_sim_pkg.scene.resolve import ResolvedScene, resolve

needs_ros = pytest.mark.ros

PACKAGE = Path(__file__).resolve().parents[1] / "contact_sim_pkg"
LABORATORY = PACKAGE.with_name("contact_sim_lab")
ENVIRONMENT = {
    **os.environ,
    "PYTHONPATH": os.pathsep.join(filter(None, [str(PACKAGE), str(LABORATORY), os.environ.get("PYTHONPATH")])),
    "RCUTILS_CONSOLE_OUTPUT_FORMAT": "{severity} {name}: {message}",
}
LONGEST = 300.0  # [s] for what a test waits for, on a busy machine; kernels of one vehicle may have to be compiled
LONGEST_COMMAND = 900.0  # [s] from start to end; those of a rigid body may have to be


def bench(*arguments: object, cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
    """`bench` with these arguments, to its end."""
    return subprocess.run(
        _command(arguments), env=ENVIRONMENT, capture_output=True, text=True, timeout=LONGEST_COMMAND, cwd=cwd
    )


def start_bench(*arguments: object, environment: dict[str, str] | None = None) -> subprocess.Popen[str]:
    """`bench` with these arguments, in a session of its own."""
    pipe = subprocess.PIPE
    return subprocess.Popen(
        _command(arguments), env=environment or ENVIRONMENT, stdout=pipe, stderr=pipe, text=True, start_new_session=True
    )


def _command(arguments: tuple[object, ...]) -> list[str]:
    return python_command("contact_sim_pkg.cli.main", *map(str, arguments))


def resolved(name: str, *assignments: str) -> ResolvedScene:
    """A shipped scene with some values set."""
    return resolve(load_scene(name, [set_value(assignment) for assignment in assignments]))


class Nodes:
    """Nodes of one run, each in a process of its own; what they say is kept."""

    def __init__(self, scene: ResolvedScene, folder: Path, *remapped: str) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        self.printed: list[str] = []
        self.bag = folder / "bag"
        self._scene = str(write_scene(scene, folder))
        self._children = Children(ENVIRONMENT, self.printed.append)
        self._started = []
        self._remapped = [part for each in remapped for part in ("-r", each)]

    def start(self, node: str, **parameters: object):
        """Start one node."""
        own = {"bag": self.bag} if node == "bag_logger" else {}
        values = {**({} if node == "bag_replay" else {"scene": self._scene}), **own, **parameters}
        arguments = [text for name, value in values.items() for text in ("-p", f"{name}:={value}")]
        command = python_command(f"contact_sim_pkg.nodes.{node}", "--ros-args", "--disable-external-lib-logs")
        self._started.append(self._children.start(node, [*command, *arguments, *self._remapped]))
        return self._started[-1]

    def ended(self) -> bool:
        """Whether no process lives any more."""
        return self._children.all_ended()

    def wait_until(self, condition, seconds: float = LONGEST) -> None:
        """Wait for a condition of a run under way; fails after the time, or once a node has ended badly or all have ended."""

        def over() -> str:
            fallen = self._children.first_failed()
            return fallen.describe_end() if fallen else "all nodes have ended" if self.ended() else ""

        wait_until(condition, seconds, over)

    def wait(self, *names: str, seconds: float = LONGEST) -> dict[str, int]:
        """Exit status of these nodes, or of all, when they have ended."""
        waited = [child for child in self._started if not names or child.name in names]
        wait_until(lambda: all(child.status is not None for child in waited), seconds)
        return {child.name: child.status for child in waited}

    def end(self) -> None:
        """End what still lives, and print what the nodes said: pytest shows it where the test has failed."""
        self._children.end(grace=2.0)
        print(*self.printed, sep="\n")


def wait_until(condition, seconds: float = LONGEST, over=lambda: "") -> None:
    """Wait for a condition; fails after the time, or as soon as `over` says why it will not come true any more."""
    limit = time.monotonic() + seconds
    while not condition():
        why = over()
        assert not why, why
        assert time.monotonic() < limit, "timed out"
        time.sleep(0.02)


def messages(bag: Path) -> list[tuple[str, int, bytes]]:
    """Topic, log time and bytes of every message but those that report wall time, whose bytes are left out."""
    wall = tuple(f"/{name}" for name, topic in TOPICS.items() if topic.wall_time)
    found = open_bag(bag).messages()
    return [(each.topic, each.log_time, b"" if each.topic.endswith(wall) else each.data) for each in found]


def children_of(process: int) -> dict[str, int]:
    """The nodes that a process has started: name -> process number."""
    found = {}
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                parent = int((entry / "stat").read_text().rsplit(")", 1)[1].split()[1])
                command = (entry / "cmdline").read_bytes().split(b"\0")
            except (OSError, IndexError):
                continue
            names = [part.decode() for part in command if part.startswith(b"contact_sim_pkg.nodes.")]
            if parent == process and names:
                found[names[0].rsplit(".", 1)[1]] = int(entry.name)
    return found


def lives(process: int) -> bool:
    """Whether a process is there."""
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    return True


def end(process: subprocess.Popen[str]) -> None:
    """Kill a process of a test that still lives, with its session and its shared memory; print what it said and nobody read."""
    segments: set[str] = set()
    if process.poll() is None:
        nodes = children_of(process.pid).values()
        segments = set().union(*(mapped_segments(each) for each in (process.pid, *nodes)))
        for child in nodes:
            os.kill(child, signal.SIGKILL)
        process.kill()
    print(*process.communicate())
    remove_unused(segments)
