"""Starts the processes that a scene needs, watches them, and ends them: a whole run without `ros2
launch`.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from contact_sim_pkg.nodes.processes.children import Child, Children, ErrorLines
from contact_sim_pkg.nodes.processes.environment import node_arguments, plugin_environment, set_default_environment
from contact_sim_pkg.nodes.processes.run_folder import RunFolder
from contact_sim_pkg.nodes.processes.run_plan import TOPICS_ALONE, in_processes, planned_nodes
from contact_sim_pkg.nodes.processes.scene_file import descriptions_beside, write_reason, write_scene
from contact_sim_pkg.nodes.processes.shared_memory import mapped_segments
from contact_sim_pkg.nodes.processes.stop_requests import StopRequests
from contact_sim_pkg.nodes.processes.supervised_run import Report, SupervisedRun, report_of
from contact_sim_pkg.nodes.protocol.states import DONE, FAULT, LOSS, REFUSED, NodeError, RunState
from contact_sim_pkg.python_process import python_command
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

if TYPE_CHECKING:
    from contact_sim_pkg.nodes.processes.run_monitor import RunMonitor

LOOK_SECONDS = 0.05  # between two looks at the processes
SEGMENT_SECONDS = 1.0  # between two looks at their shared memory, until the run has settled
SETTLING_SECONDS = 5.0  # after the beginning of the run
LATE_SEGMENT_SECONDS = 20.0  # from then on: a look costs 3 ms a process
END_SECONDS = 40.0  # for the processes to end by themselves once the run has ended


class Supervisor:
    """One run on nodes."""

    def __init__(
        self,
        scene: ResolvedScene,
        directory: Path | None,
        *,
        from_bag: Path | None = None,
        clock: bool = True,
        excitation: str = TOPICS_ALONE,
    ) -> None:
        """Prepare a run of `scene`, recorded in `directory` (None: not recorded), which must not
        exist.

        Args:
            scene: the scene.
            directory: directory of the bag.
            from_bag: bag whose excitation is sent instead of the scene's own.
            clock: publish simulated time on `/clock`, unless somebody else does.
            excitation: one of `EXCITATIONS`.
        """
        self._scene, self._directory, self._from_bag, self._clock = scene, directory, from_bag, clock
        self._excitation = excitation
        self._stops = StopRequests()
        self._failure, self._exit_status = "", DONE

    def stop(self) -> None:
        """The user wants the end; may be called from a signal handler. The second call does not
        wait for the bag.
        """
        self._stops.add()

    def run(self, on_report: Callable[[Report], None], on_line: Callable[[str], None]) -> SupervisedRun:
        """Run to the end; `on_report` gets the state, `on_line` the lines of the nodes."""
        began = time.monotonic()
        set_default_environment()
        on_line(
            f"ROS_DOMAIN_ID is {os.environ.get('ROS_DOMAIN_ID', '0')}, discovery {os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE']}"
        )
        errors = ErrorLines(on_line)
        children = Children({**os.environ, **plugin_environment(self._scene)}, errors.add)
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
        """End the processes left; the logger stores in its bag which one failed, and how."""
        if self._failure:
            write_reason(scene, self._failure)
        failed = children.first_failed()
        if failed is not None and failed.name == "contact_simulator":
            children.request_end()  # all at once: no message is on its way that an order would save
        killed = children.end(self._stops.grace(time.monotonic()))
        bag = self._directory
        unclosed = bag is not None and bag.is_dir() and not (bag / "metadata.yaml").exists()
        if "bag_logger" in killed and unclosed and not self._failure:
            self._fail("bag_logger did not end, and was killed before it had closed its bag", FAULT)

    def _start_all(self, children: Children, scene: Path) -> None:
        nodes = planned_nodes(
            self._scene, scene, self._directory, self._from_bag, clock=self._clock, excitation=self._excitation
        )
        for node in in_processes(nodes):
            arguments = node_arguments({**node.parameters, "supervisor": os.getpid()})
            children.start(node.name, python_command(f"contact_sim_pkg.nodes.{node.name}", *arguments))

    def _watch(
        self, children: Children, monitor: RunMonitor, on_report: Callable[[Report], None], folder: RunFolder
    ) -> None:
        """Until every process has ended, one has ended badly, or the time after the user's signal
        is over.
        """
        look_at, settled_at, ended_at = 0.0, float("inf"), float("inf")
        failed: Child | None = None
        while failed is None and not children.all_ended():
            try:
                monitor.spin(LOOK_SECONDS)
            except NodeError as error:
                self._fail(str(error), error.exit_status)
                return
            now = time.monotonic()
            if monitor.run.state is RunState.RUNNING and settled_at == float("inf"):
                settled_at, look_at = now + SETTLING_SECONDS, now  # at once: a node may be killed any time
            if now >= look_at:
                look_at = now + (LATE_SEGMENT_SECONDS if now > settled_at else SEGMENT_SECONDS)
                children.record_segments()
                folder.keep_segments(children.segments() | mapped_segments(os.getpid()))
            if monitor.run.last is not None:
                on_report(report_of(monitor.run.last, self._scene.block_length))
            self._stops.hand_on(children, now, under_way=monitor.run.state.under_way)
            if self._stops.expired(now):
                return
            ended_at = min(ended_at, now) if monitor.run.state.ended else float("inf")  # a reset begins the next run
            if now - ended_at > END_SECONDS:
                self._fail(f"the nodes did not end {END_SECONDS:g} s after the run", FAULT)
                return
            failed = children.first_failed()
        failed = failed or children.first_failed()
        # However a node reacted to the end of its set-up, nothing was lost.
        set_up_broken_off = self._stops.any and monitor.run.state < RunState.READY
        if failed is not None and not set_up_broken_off:
            self._on_failed(failed, monitor)

    def _fail(self, sentence: str, exit_status: int) -> None:
        self._failure, self._exit_status = sentence, exit_status

    def _on_failed(self, failed: Child, monitor: RunMonitor) -> None:
        """Name the fault that the run reported, or else the process that ended badly."""
        last = monitor.run.last
        reported = last.message if monitor.run.state is RunState.FAILED and last is not None else ""
        status = failed.status if failed.status in (REFUSED, LOSS) and not reported else FAULT
        self._fail(reported or failed.describe_end(), status)

    def _outcome(self, monitor: RunMonitor, began: float, scene: Path) -> SupervisedRun:
        ready = monitor.ready_at or time.monotonic()
        last = monitor.recorded_at if self._directory is not None else monitor.done_at
        found = Path(monitor.recorded.bag) if monitor.recorded.number else self._directory  # of the last run
        bag = found if self._directory is not None and found is not None and found.is_dir() else None
        stopped = self._stops.any or monitor.run.state is RunState.STOPPED
        done = monitor.run.block + 1
        if not self._failure and not stopped and done < self._scene.blocks:
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
