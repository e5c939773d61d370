"""The node of the simulation."""

from __future__ import annotations

import math
import sys
import time
from functools import partial

from rclpy.lifecycle import LifecycleState, TransitionCallbackReturn

from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.compiled.jit import closed
from contact_sim_pkg.nodes.bench_node import LifecycleBenchNode
from contact_sim_pkg.nodes.parameters import declare, declare_input_timeout, declare_pace, declare_record, declare_scene
from contact_sim_pkg.nodes.processes.process import run as run_process
from contact_sim_pkg.nodes.processes.process import use_usual_policy
from contact_sim_pkg.nodes.processes.scene_file import queue_depth, read_scene
from contact_sim_pkg.nodes.protocol.endpoints import numbered_subscription, subscription
from contact_sim_pkg.nodes.protocol.peers import Peers
from contact_sim_pkg.nodes.protocol.simulated_run import SimulatedRun
from contact_sim_pkg.nodes.protocol.states import DONE, STOPPED_BY_USER, RunState
from contact_sim_pkg.nodes.simulator_publishers import SimulatorPublishers
from contact_sim_pkg.records.messages import BenchRecorded
from contact_sim_pkg.run.block_simulation import cautions_of
from contact_sim_pkg.run.computing import Computing
from contact_sim_pkg.run.rigs import make_simulation

CLOCK_TEXT = "Publish the simulated time on /clock after each block."
PEERS_SECONDS = 0.01  # between two looks at the graph before ready
CLOSE_SECONDS = 1.0  # for the logger to close its bag, where the computation of a block does not return


class ContactSimulatorNode(LifecycleBenchNode):
    """Subscribes to excitation and `bench/recorded`; publishes what `SimulatorPublishers` lists."""

    computes = True

    def __init__(self) -> None:
        """Declare the parameters; everything else is done in `configure`."""
        super().__init__("contact_simulator")
        self.scene_name = declare_scene(self)
        self._logged = declare_record(self)
        self._input_timeout = declare_input_timeout(self)
        self._publish_clock = declare(self, "publish_clock", True, CLOCK_TEXT)
        self._run: SimulatedRun | None = None
        self._computing = Computing[bool]()
        self._computing.end = self._leave_computation

    def configure(self) -> None:
        """Create publishers and subscriptions, and compile all kernels while the nodes are matched."""
        self._run = None
        scene = read_scene(self.scene_name)
        pace, depth = declare_pace(self, scene.data["pace"]), queue_depth(scene)
        if math.isfinite(pace):
            use_usual_policy(everywhere=True)
        self.announce(f"{scene.name}: compiling")
        self._out = out = SimulatorPublishers(self, scene, clock=self._publish_clock)
        with out.compiling():
            simulation = make_simulation(scene)
            self._run = run = SimulatedRun(
                simulation, out.progress, scene, pace, logged=self._logged, input_timeout=self._input_timeout
            )
            inputs = {
                name: numbered_subscription(self, name, partial(self._on_input, run, name), depth)
                for name in simulation.inputs
            }
            answers = subscription(self, "bench/recorded", partial(self._on_recorded, run)) if self._logged else None
            progress = out.progress.publisher
            self._peers = Peers(self, inputs, out.results, progress, answers, supervised=self.supervisor > 0)
            self._computing.call(simulation.prepare)
        for sentence in cautions_of(simulation):
            self.get_logger().warning(sentence)

    def tick(self, now: float) -> float:
        """Look for peers before ready; advance until the end, but for pauses; then leave once the bag is closed."""
        run = self._run
        if run is None or run.report.last is None:
            return 1.0
        self._out.diagnostics.report(now, run.report.last)
        if run.state.ended:
            self._leave(run, now)
            return 1.0
        if not self.active:
            return 1.0
        if run.state is RunState.STARTING:
            if self._out.clock.claim(now) and self._peers.complete(now):
                self._out.progress.settle()  # matched on this side only, a follower could hear of a later block first
                self._out.clock.start(now)
                run.start(time.monotonic())
                self.announce("ready")
            return PEERS_SECONDS
        if self._peers.alone(now):
            self._advance(run, now)
            run.refuse_standstill(time.monotonic())
        return min(1.0, run.wait(now))

    def _on_input(self, run: SimulatedRun, topic: str, data: bytes, number: int | None) -> None:
        """Keep a block of the run's own source until its turn; warn of one that is refused."""
        now = time.monotonic()
        if self._peers.sources.accept(topic, number, now) and (reason := run.inputs.offer(topic, data)):
            self._out.diagnostics.warn(now, reason)
            self.get_logger().warning(reason, throttle_duration_sec=1.0)

    def _advance(self, run: SimulatedRun, now: float) -> None:
        """Compute and publish every block whose inputs are there."""
        while run.may_begin(now) and self._peers.sources.alone(now):
            block = run.next_block()
            if block is None:
                return
            with closed():
                result = self._computing.call(run.simulation.advance, *block)
            self._out.publish(block[0], result)
            run.on_done(block[0], result, time.monotonic())
            self._out.diagnostics.late = run.late

    def _on_recorded(self, run: SimulatedRun, data: bytes) -> None:
        if reason := run.on_recorded(decode(BenchRecorded, data), time.monotonic()):
            self.get_logger().error(f"the logger closed its bag before the end: {reason}")
            self._out.diagnostics.warn(time.monotonic(), reason)

    def _leave(self, run: SimulatedRun, now: float) -> None:
        """End the process once the bag is closed, or the wait for it is over."""
        status = run.logger.status_to_leave(now)
        if status is not None:
            if run.logger.deserted:
                self.get_logger().error("the logger has not closed its bag in time after the end")
            else:  # one that is gone acknowledges nothing, and the others have heard the end long ago
                self._out.settle()
            self.announce(run.report.describe())
            self.exit_status = status

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Let the run begin, or go on at its pace."""
        if self._run is not None:
            self._run.resume(time.monotonic())
        return super().on_activate(state)

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Pause a run under way: the others hear PAUSED, and wait."""
        if self._run is not None:
            self._run.pause(time.monotonic())
        return super().on_deactivate(state)

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """End the run for all of its nodes, also before it has begun."""
        if self._run is not None and self._run.state is RunState.STARTING:
            self._run.report.send(RunState.STOPPED, STOPPED_BY_USER)
            self._out.settle()
        return super().on_shutdown(state)

    def refusal(self, transition: str) -> str:
        """See `LifecycleBenchNode`."""
        if transition == "cleanup" and self._run is not None and self._run.state >= RunState.READY:
            return "logger and sources of the run wait for its end; end it by shutdown"
        return ""

    def close(self) -> None:
        """Forget the run, whose publishers are destroyed next."""
        self._run = None

    def stop(self) -> None:
        """End the run after the block done last; a second signal does not wait for the logger."""
        self.exit_status = DONE if self._run is None else self._run.stop(time.monotonic())

    def fault(self, sentence: str, exit_status: int) -> None:
        """End the run as FAILED: the logger closes its bag; before ready, end the process."""
        self.get_logger().error(sentence)
        if self._run is None or not self._run.end(RunState.FAILED, sentence, time.monotonic(), exit_status):
            self.exit_status = exit_status

    def abandon(self) -> bool:
        """See `BenchNode`."""
        return bool(self._computing.abandon())

    def _leave_computation(self) -> bool:
        """End the run at the user's request, where the computation of a block does not return."""
        if self._run is not None and self._run.stop(time.monotonic()) is None:
            self._run.report.settle()
            limit = time.monotonic() + CLOSE_SECONDS  # the middleware acknowledges for a process that is there
            while self.count_publishers("bench/recorded") and time.monotonic() < limit:
                time.sleep(PEERS_SECONDS)
        return True


def main() -> int:
    """Run the node; returns the exit status."""
    return run_process(ContactSimulatorNode)


if __name__ == "__main__":
    sys.exit(main())
