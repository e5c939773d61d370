"""Starts the processes that a scene needs, watches them, and ends them: a whole run without `ros2
launch`.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from contact_sim_pkg.nodes.processes.children import GRACE_SECONDS, Child, Children, ErrorLines
from contact_sim_pkg.nodes.processes.run_folder import RunFolder
from contact_sim_pkg.nodes.processes.run_plan import planned_nodes
from contact_sim_pkg.nodes.processes.scene_file import count_blocks, descriptions_beside, write_reason, write_scene
from contact_sim_pkg.nodes.processes.shared_memory import mapped_segments
from contact_sim_pkg.nodes.protocol.states import DONE, FAULT, LOSS, REFUSED, NodeError, RunState
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

if TYPE_CHECKING:
    from contact_sim_pkg.nodes.processes.run_monitor import RunMonitor

DEFAULT_ENVIRONMENT = {  # each only where the caller has not set it
    "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
    "NUMBA_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
    "RCUTILS_CONSOLE_OUTPUT_FORMAT": "{severity} {name}: {message}",
}
LOOK_SECONDS = 0.05  # between two looks at the processes
SEGMENT_SECONDS = 1.0  # between two looks at their shared memory
END_SECONDS = 15.0  # for the processes to end by themselves once the run has ended
ASK_SECONDS = 0.9  # after the user's signal, for the simulator to end the run; then every process is asked
STOP_SECONDS = 1.7  # after the user's signal, for all processes to end; then they are killed
LEAST_GRACE = 0.1  # from asking a process to killing it


class Report(NamedTuple):
    """Where a supervised run stands, for the display."""

    state: str
    block: int  # blocks done
    blocks: int
    simulated: float  # [s]
    real_time_factor: float
    load: float  # [N]
    peak_pressure: float  # [Pa]


class SupervisedRun(NamedTuple):
    """How a supervised run ended."""

    blocks: int  # done
    startup: float  # [s] from the call to ready
    wall: float  # [s] from ready to the last message recorded
    bag: Path | None  # None where nothing was recorded
    stopped: bool  # ended by the user before the last block
    failure: str  # sentence of the fault that ended it; empty where there is none
    exit_status: int
    excitation: dict[str, dict[str, Any]]  # by topic, what was found in it and done about it


class Supervisor:
    """One run on nodes."""

    def __init__(
        self, scene: ResolvedScene, directory: Path | None, *, from_bag: Path | None = None, clock: bool = True
    ) -> None:
        """Prepare a run of `scene`, recorded in `directory` (None: not recorded), which must not
        exist.

        Args:
            scene: the scene.
            directory: directory of the bag.
            from_bag: bag whose excitation is sent instead of the scene's own.
            clock: publish simulated time on `/clock`, unless somebody else does.
        """
        self._scene, self._directory, self._from_bag, self._clock = scene, directory, from_bag, clock
        self._stop_count = 0
        self._asked, self._asked_at = 0, float("inf")
        self._failure, self._exit_status = "", DONE

    def stop(self) -> None:
        """The user wants the end; may be called from a signal handler. The second call does not
        wait for the bag.
        """
        self._stop_count += 1

    def run(self, on_report: Callable[[Report], None], say: Callable[[str], None]) -> SupervisedRun:
        """Run to the end; `on_report` hears where the run stands, `say` what the nodes say, a line
        at a time.
        """
        began = time.monotonic()
        set_default_environment()
        say(
            f"ROS_DOMAIN_ID is {os.environ.get('ROS_DOMAIN_ID', '0')}, discovery {os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE']}"
        )
        errors = ErrorLines(say)
        children = Children(os.environ, errors.hear)
        with RunFolder() as folder:
            try:
                scene = write_scene(self._scene, folder.path)
                self._start_all(children, scene)
                from contact_sim_pkg.nodes.processes.run_monitor import (
                    RunMonitor,  # the nodes start while this process loads ROS
                )

                with RunMonitor() as monitor:
                    self._watch(children, monitor, on_report, folder)
                    self._end_all(children, scene)
                    return self._outcome(monitor, began, scene)
            finally:
                children.end()
                errors.release(self._failure)

    def _end_all(self, children: Children, scene: Path) -> None:
        """End what still lives; the logger keeps in its bag who died of what."""
        if self._failure:
            write_reason(scene, self._failure)
        killed = children.end(max(LEAST_GRACE, min(GRACE_SECONDS, self._asked_at + STOP_SECONDS - time.monotonic())))
        bag = self._directory
        unclosed = bag is not None and bag.is_dir() and not (bag / "metadata.yaml").exists()
        if "bag_logger" in killed and unclosed and not self._failure:
            self._fail("bag_logger did not end, and was killed before it had closed its bag", FAULT)

    def _start_all(self, children: Children, scene: Path) -> None:
        for node in planned_nodes(self._scene, scene, self._directory, self._from_bag, clock=self._clock):
            arguments = node_arguments({**node.parameters, "supervisor": os.getpid()})
            children.start(node.name, [sys.executable, "-m", f"contact_sim_pkg.nodes.{node.name}", *arguments])

    def _watch(
        self, children: Children, monitor: RunMonitor, on_report: Callable[[Report], None], folder: RunFolder
    ) -> None:
        """Until every process has ended, one has ended badly, or the time after the user's signal
        is over.
        """
        looked, ended_at = 0.0, float("inf")
        fallen: Child | None = None
        while fallen is None and not children.all_ended():
            try:
                monitor.spin(LOOK_SECONDS)
            except NodeError as error:
                self._fail(str(error), error.exit_status)
                return
            now = time.monotonic()
            if now - looked > SEGMENT_SECONDS:
                looked = now
                children.look()
                folder.keep_segments(children.segments() | mapped_segments(os.getpid()))
            if monitor.run.last is not None:
                on_report(self._report(monitor))
            self._hand_on_stop(children, monitor, now)
            if now > self._asked_at + STOP_SECONDS:
                return
            if monitor.run.state.ended:
                ended_at = min(ended_at, now)
            if now - ended_at > END_SECONDS:
                self._fail(f"the nodes did not end {END_SECONDS:g} s after the run", FAULT)
                return
            fallen = children.fallen()
        fallen = fallen or children.fallen()
        set_up_broken_off = (
            self._asked > 0 and monitor.run.state < RunState.READY
        )  # however a node took it, nothing was lost
        if fallen is not None and not set_up_broken_off:
            self._on_fallen(fallen, monitor)

    def _hand_on_stop(self, children: Children, monitor: RunMonitor, now: float) -> None:
        """A run under way is ended by its simulator, so that the bag gets whole; otherwise every
        process is asked to end.
        """
        if self._asked == 1 and now > self._asked_at + ASK_SECONDS:
            self._stop_count += 1
        if self._stop_count > self._asked:
            self._asked, self._asked_at = self._stop_count, min(self._asked_at, now)
            under_way = monitor.run.state in (RunState.READY, RunState.RUNNING) and self._asked == 1
            children.ask(*(("contact_simulator",) if under_way else ()))

    def _fail(self, sentence: str, exit_status: int) -> None:
        self._failure, self._exit_status = sentence, exit_status

    def _on_fallen(self, fallen: Child, monitor: RunMonitor) -> None:
        """Name the fault that the run reported, or else the process that ended badly."""
        last = monitor.run.last
        reported = last.message if monitor.run.state is RunState.FAILED and last is not None else ""
        status = fallen.status if fallen.status in (REFUSED, LOSS) and not reported else FAULT
        self._fail(reported or fallen.describe_end(), status)

    def _report(self, monitor: RunMonitor) -> Report:
        last = monitor.run.last
        assert last is not None
        simulated = (last.block + 1) * float(self._scene.data["block_length"])
        values = (last.real_time_factor, last.load, last.peak_pressure)
        return Report(RunState(last.state).name.lower(), last.block + 1, last.blocks, simulated, *values)

    def _outcome(self, monitor: RunMonitor, began: float, scene: Path) -> SupervisedRun:
        ready = monitor.ready_at or time.monotonic()
        last = monitor.recorded_at if self._directory is not None else monitor.done_at
        bag = self._directory if self._directory is not None and self._directory.is_dir() else None
        stopped = self._asked > 0 or monitor.run.state is RunState.STOPPED
        done = monitor.run.block + 1
        if not self._failure and not stopped and done < count_blocks(self._scene):
            self._fail(f"the run ended after {done} blocks without a word", FAULT)
        return SupervisedRun(
            blocks=done,
            startup=ready - began,
            wall=max(0.0, last - ready),
            bag=bag,
            stopped=stopped,
            failure=self._failure,
            exit_status=self._exit_status,
            excitation=descriptions_beside(scene),
        )


def set_default_environment() -> None:
    """What every process of the bench wants from its environment, where the caller has not set it."""
    for name, value in DEFAULT_ENVIRONMENT.items():
        os.environ.setdefault(name, value)


def node_arguments(parameters: Mapping[str, str | float | bool]) -> list[str]:
    """The ROS arguments that give a node these parameters; nothing is logged into the user's home."""
    arguments = ["--ros-args", "--disable-external-lib-logs"]
    for name, value in parameters.items():
        arguments += ["-p", f"{name}:={_yaml(value)}"]
    return arguments


def _yaml(value: str | float | bool) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    return "'" + value.replace("'", "''") + "'" if isinstance(value, str) else repr(value)
