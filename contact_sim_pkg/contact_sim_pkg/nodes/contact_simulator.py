"""The node of the simulation: takes a block of every input, advances, publishes what came of it,
reports progress.
"""

from __future__ import annotations

import sys
import time
from functools import partial

from contact_sim_pkg.bag.messages import decode, encode
from contact_sim_pkg.compiled.jit import closed
from contact_sim_pkg.nodes.bench_node import LifecycleBenchNode
from contact_sim_pkg.nodes.clock import SimulatedClock
from contact_sim_pkg.nodes.diagnostics import Diagnostics
from contact_sim_pkg.nodes.parameters import declare, declare_input_timeout, declare_pace, declare_record, declare_scene
from contact_sim_pkg.nodes.processes.process import run
from contact_sim_pkg.nodes.processes.scene_file import block_length_ns, queue_depth, read_scene
from contact_sim_pkg.nodes.protocol.endpoints import numbered_subscription, publisher, publisher_ids, subscription
from contact_sim_pkg.nodes.protocol.input_blocks import InputBlocks
from contact_sim_pkg.nodes.protocol.logger_answers import LoggerAnswers
from contact_sim_pkg.nodes.protocol.pacing import Lateness, Pacer
from contact_sim_pkg.nodes.protocol.peers import Peers
from contact_sim_pkg.nodes.protocol.progress_report import ProgressReport
from contact_sim_pkg.nodes.protocol.source_watch import SourceWatch
from contact_sim_pkg.nodes.protocol.states import DONE, FAULT, RunState
from contact_sim_pkg.nodes.protocol.window import BlockWindow
from contact_sim_pkg.records.messages import BenchRecorded, String
from contact_sim_pkg.run.bag_content import result_names
from contact_sim_pkg.run.block_simulation import BlockResult
from contact_sim_pkg.run.computing import Computing
from contact_sim_pkg.run.rigs import make_simulation

PEERS_SECONDS = 0.01  # between two looks at the graph before ready
CLOSE_SECONDS = 1.0  # for the logger to close its bag, where a block that is computed does not come back
RESULTS_SECONDS = 0.05  # between two looks for other publishers of our results
SAY_SECONDS = 5.0  # between two log lines about who is missing


class ContactSimulatorNode(LifecycleBenchNode):
    """Publishes the results of the scene, `bench/progress`, `bench/scene` and `/clock`; takes
    excitation and `bench/recorded`.
    """

    computes = True

    def __init__(self) -> None:
        """Declare the parameters; everything else is done in `configure`."""
        super().__init__("contact_simulator")
        self._scene_name = declare_scene(self)
        self._logged = declare_record(self)
        self._input_timeout = declare_input_timeout(self)
        self._publish_clock = declare(
            self, "publish_clock", True, "Publish the simulated time on /clock after each block."
        )
        self._report: ProgressReport | None = None
        self._computing = Computing[bool]()
        self._computing.end = self._give_up

    def configure(self) -> None:
        """Compile everything that the scene needs, and create publishers and subscriptions."""
        scene = read_scene(self._scene_name)
        self._period_ns, depth = block_length_ns(scene), queue_depth(scene)
        pace = declare_pace(self, scene.data["pace"])
        self._patience = self._input_timeout + scene.block_length / pace
        self._report = ProgressReport(publisher(self, "bench/progress"), scene)
        self._report.send(RunState.STARTING, "compiling")
        self.announce(f"{scene.name}: compiling")
        self._publishers_by_topic = {name: publisher(self, name, depth) for name in result_names(scene)}
        self._simulated_clock = SimulatedClock(self, wanted=self._publish_clock)
        self._diagnostics = Diagnostics(self)
        self._scene_publisher = publisher(self, "bench/scene")
        self._scene_publisher.publish(encode(String(data=scene.to_yaml())))
        self._simulation = make_simulation(scene)
        self._inputs = InputBlocks(self._simulation.inputs, self._period_ns, self._simulation.blocks)
        self._window = BlockWindow(self._simulation.blocks, logged=self._logged)
        self._pacer = Pacer(pace, scene.block_length)
        self._lateness = Lateness(self._pacer)
        inputs = self._simulation.inputs
        names = {topic: self.resolve_topic_name(topic) for topic in inputs}
        self._sources = SourceWatch(names, self.count_publishers, partial(publisher_ids, self))
        results = {topic: entry.topic_name for topic, entry in self._publishers_by_topic.items()}
        self._results = SourceWatch(results, self.count_publishers, partial(publisher_ids, self))
        self._looked, self._undisturbed = 0.0, True
        entries = {topic: numbered_subscription(self, topic, partial(self._take, topic), depth) for topic in inputs}
        self._recording = LoggerAnswers(self._window, logged=self._logged)
        answers = subscription(self, "bench/recorded", self._on_recorded) if self._logged else None
        supervised = self.supervisor > 0
        self._peers = Peers(
            self, entries, self._publishers_by_topic, self._report.publisher, answers, supervised=supervised
        )
        self._computing.call(self._simulation.prepare)
        self._said = self._advanced = time.monotonic()

    def tick(self, now: float) -> float:
        """Before ready: look for peers. Then: advance; find out who holds up. At the end: wait for
        the logger.
        """
        report = self._report
        if report is None or report.last is None or not self.active:
            return 1.0
        self._diagnostics.report(now, report.last)
        if report.state is RunState.STARTING:
            self._look_for_peers(now, report)
            return PEERS_SECONDS
        if report.state.ended:
            self._leave(now, report)
            return 1.0
        if now - self._looked > RESULTS_SECONDS:  # not each block: 4 us a topic, and the logger tells them apart
            self._looked, self._undisturbed = now, self._results.alone(now)
        if self._undisturbed and self._sources.alone(now):
            self._advance(now, report)
            if time.monotonic() - self._advanced > self._patience and not report.state.ended:
                self.fault(f"{self._recording.who_holds_up(self._inputs)} (waited {self._patience:g} s)", FAULT)
        return (
            self._pacer.wait(self._window.next_block, now) if self._window.open and not self._simulation.inputs else 1.0
        )

    def _look_for_peers(self, now: float, report: ProgressReport) -> None:
        absent = self._peers.missing()
        if not absent:
            self._advanced = now
            self._pacer.start(now)
            self._simulated_clock.start(now)
            self._sources.remember()
            self._results.remember()
            report.send(RunState.READY)
            self.announce("ready")
        elif now - self._said > SAY_SECONDS:
            self._said = now
            self.get_logger().info(f"waiting for {', '.join(absent)}")

    def _take(self, topic: str, data: bytes, number: int | None) -> None:
        if not self._sources.accept(topic, number, time.monotonic()):
            return
        reason = self._inputs.offer(topic, data)
        if reason:
            self._diagnostics.warn(time.monotonic(), reason)
            self.get_logger().warning(reason, throttle_duration_sec=1.0)

    def _advance(self, now: float, report: ProgressReport) -> None:
        """Do every block whose inputs are there; a scene without inputs is held back by the window
        and the pace alone.
        """
        while not report.state.ended and self._may_begin(now) and self._sources.alone(now):
            blocks = self._inputs.take()
            if blocks is None:
                return
            number = self._window.take()
            with closed():
                result = self._computing.call(self._simulation.advance, number, blocks)
            self._publish(number, result, report)

    def _may_begin(self, now: float) -> bool:
        return self._window.open and (
            bool(self._simulation.inputs) or self._pacer.wait(self._window.next_block, now) <= 0.0
        )

    def _publish(self, number: int, result: BlockResult, report: ProgressReport) -> None:
        for topic, _, data in result.messages:
            self._publishers_by_topic[topic].publish(data)
        self._simulated_clock.publish(time.monotonic(), (number + 1) * self._period_ns)
        self._window.on_done(number)
        self._advanced = time.monotonic()
        report.block_done(number, result)
        self._diagnostics.late = self._lateness.block_done(number, self._advanced, report.real_time_factor)
        if report.state.ended:
            self._recording.end(self._advanced)

    def _on_recorded(self, data: bytes) -> None:
        report = self._report
        if report is None or report.state < RunState.READY:
            return
        closed = self._recording.accept(decode(BenchRecorded, data))
        if closed is not None and not report.state.ended:
            self.get_logger().error(f"the logger closed its bag before the end: {closed}")
            self._diagnostics.warn(time.monotonic(), closed)
            self._recording.lost()
            report.send(RunState.STOPPED, closed)

    def _leave(self, now: float, report: ProgressReport) -> None:
        """End the process once the bag is closed, or the wait for it is over."""
        status = self._recording.status_to_leave(now)
        if status is not None:
            if self._recording.deserted:
                self.get_logger().error("the logger has not closed its bag in time after the end")
            report.settle()
            self._diagnostics.settle()
            self.announce(report.describe())
            self.exit_status = status

    def stop(self) -> None:
        """End the run after the block that is done; a second signal does not wait for the logger."""
        if not self._end(RunState.STOPPED, "stopped by the user", DONE):
            self.exit_status = (
                DONE if self._report is None or not self._report.state.ended else self._recording.exit_status
            )

    def abandon(self) -> bool:
        """See `BenchNode`."""
        return bool(self._computing.abandon())

    def _give_up(self) -> bool:
        """The user wants the end, and the block that is computed does not come back."""
        if self._report is not None and self._end(RunState.STOPPED, "stopped by the user", DONE):
            self._report.settle()
            limit = time.monotonic() + CLOSE_SECONDS  # the middleware acknowledges for a process that is there
            while self.count_publishers("bench/recorded") and time.monotonic() < limit:
                time.sleep(PEERS_SECONDS)
        return True

    def fault(self, sentence: str, exit_status: int) -> None:
        """End the run in the named state FAILED, so that the logger closes its bag; before ready,
        end the process.
        """
        self.get_logger().error(sentence)
        if not self._end(RunState.FAILED, sentence, exit_status):
            self.exit_status = exit_status

    def _end(self, state: RunState, sentence: str, exit_status: int) -> bool:
        """End a run under way; False where there is none."""
        if self._report is None or self._report.state not in (RunState.READY, RunState.RUNNING):
            return False
        self._recording.end(time.monotonic(), exit_status, stopped=state is RunState.STOPPED)
        self._report.send(state, sentence)
        return True


def main() -> int:
    """Run the node; returns the exit status."""
    return run(ContactSimulatorNode)


if __name__ == "__main__":
    sys.exit(main())
