"""The node of the simulation."""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Mapping
from functools import partial
from typing import TYPE_CHECKING

from rclpy.lifecycle import LifecycleState, TransitionCallbackReturn

from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.compiled.jit import closed
from contact_sim_pkg.nodes.bench_node import LifecycleBenchNode
from contact_sim_pkg.nodes.live_parameters import LiveParameters
from contact_sim_pkg.nodes.parameters import declare, declare_input_timeout, declare_pace, declare_record, declare_scene
from contact_sim_pkg.nodes.processes.on_use import provide
from contact_sim_pkg.nodes.processes.process import run as run_process
from contact_sim_pkg.nodes.processes.process import use_usual_policy
from contact_sim_pkg.nodes.processes.run_plan import EXCITATIONS, INSIDE, TOPICS_ALONE
from contact_sim_pkg.nodes.processes.scene_file import queue_depth, read_scene, write_description
from contact_sim_pkg.nodes.protocol.endpoints import newest, numbered_subscription, subscription
from contact_sim_pkg.nodes.protocol.logger_answers import CLOSE_SECONDS as LOGGER_SECONDS
from contact_sim_pkg.nodes.protocol.peers import Peers
from contact_sim_pkg.nodes.protocol.progress_report import ProgressReport
from contact_sim_pkg.nodes.protocol.simulated_run import SimulatedRun
from contact_sim_pkg.nodes.protocol.states import DONE, REFUSED, STOPPED_BY_USER, NodeError, RunState
from contact_sim_pkg.nodes.simulator_publishers import SimulatorPublishers
from contact_sim_pkg.records.messages import BenchRecorded
from contact_sim_pkg.run.block_simulation import BlockSimulation, cautions_of
from contact_sim_pkg.run.compilation import note_computation
from contact_sim_pkg.run.computing import Computing
from contact_sim_pkg.run.live_parameters import STEERING, ParameterError
from contact_sim_pkg.run.rigs import make_simulation
from contact_sim_pkg.steering.machine import Steering, SteeringState
from contact_sim_pkg.steering.own_excitation import OwnExcitation

if TYPE_CHECKING:
    from contact_sim_pkg.nodes.steering_services import SteeringServices

EXCITATION_TEXT = (
    "Where blocks come from: topics (other nodes), inside (this node, which then takes steps, resets, live keys)."
)
INTERFACES = "simulation_interfaces"
CLOCK_TEXT = "Publish the simulated time on /clock after each block."
PEERS_SECONDS = 0.01  # between two looks at the graph before ready
CLOSE_SECONDS = 1.0  # for the logger to close its bag, where the computation of a block does not return


class ContactSimulatorNode(LifecycleBenchNode):
    """Subscribes to excitation and `bench/recorded`; publishes what `SimulatorPublishers` lists. Its lifecycle is that of
    `Steering`: active while it plays, inactive while it is paused or stopped.
    """

    computes = True

    def __init__(self) -> None:
        """Declare the parameters; everything else is done in `configure`."""
        super().__init__("contact_simulator")
        self.scene_name = declare_scene(self)
        self._logged = declare_record(self)
        self._input_timeout = declare_input_timeout(self)
        self._publish_clock = declare(self, "publish_clock", True, CLOCK_TEXT)
        self._excitation = declare(self, "excitation", TOPICS_ALONE, EXCITATION_TEXT)
        if self._excitation not in EXCITATIONS:
            raise NodeError(
                f"parameter excitation is {self._excitation!r}, allowed are {', '.join(EXCITATIONS)}", REFUSED
            )
        self._released: ProgressReport | None = None  # of a run whose followers wait for the next `configure`
        self._run: SimulatedRun | None = None
        self._steering: Steering | None = None
        self._own: OwnExcitation | None = None
        self._offered: list[SteeringServices | LiveParameters] = []
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
        self._own = OwnExcitation(scene) if self._excitation == INSIDE else None
        made = (*self._own.topics, STEERING) if self._own is not None else ()
        self._out = out = SimulatorPublishers(self, scene, made, clock=self._publish_clock, report=self._released)
        self._released = None
        with out.compiling():
            simulation: BlockSimulation = make_simulation(scene) if self._own is None else self._own
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
            self._steering = Steering(run)
            if self._own is not None:
                self._offer(run, self._own, self._steering)
        for sentence in cautions_of(simulation):
            self.get_logger().warning(sentence)

    def _offer(self, run: SimulatedRun, own: OwnExcitation, steering: Steering) -> None:
        """What others steer the run by."""
        for topic, description in own.describe().items():
            write_description(self.scene_name, topic, description)

        def change(values: Mapping[str, float]) -> None:
            if reason := run.why_over():
                raise ParameterError(reason)
            self._computing.call(own.change, run.window.next_block, values)

        self._offered = [LiveParameters(self, lambda: own.parameters, change)]
        reason = provide(INTERFACES, building=partial(note_computation, f"building {INTERFACES}, once, up to a minute"))
        note_computation("")
        if reason:
            self.get_logger().warning(f"no services to steer the run: {reason}")
            return
        from contact_sim_pkg.nodes.steering_services import SteeringServices

        self._offered.append(SteeringServices(self, steering, self._follow_steering, self._on_answer))

    def tick(self, now: float) -> float:
        """Look for peers before ready; advance until the end, but for pauses; then leave once the bag is closed."""
        run = self._run
        if run is None or run.report.last is None:
            return 1.0
        self._out.diagnostics.report(now, run.report.last)
        if run.state is RunState.RESET:
            self._begin_anew(run, now)
            return PEERS_SECONDS
        if run.state.ended:
            self._leave(run, now)
            return 1.0
        if run.state is RunState.STARTING and (self.active or self._own is not None):
            if self._out.clock.claim(now) and self._peers.complete(now):
                self._out.progress.settle()  # matched on this side only, a follower could hear of a later block first
                self._out.clock.start(now)
                run.start(time.monotonic())
                if not self.active:
                    run.pause(time.monotonic())
                self.announce("ready")
            return PEERS_SECONDS
        if not self.active:
            return self._step(run, now)
        if self._peers.alone(now):
            self._advance(run, now)
            run.refuse_standstill(time.monotonic())
        return min(1.0, run.wait(now))

    def _on_answer(self) -> None:
        self._answered = time.monotonic()

    def _follow_steering(self) -> None:
        """Bring the lifecycle to the state that a service has chosen."""
        steering = self._steering
        if steering is None:
            return
        if steering.state is SteeringState.QUITTING:
            if self._run is not None and not self._run.state.ended:
                self.trigger_shutdown()
        elif steering.plays and not self.active:
            self.trigger_activate()
        elif self.active and not steering.plays:
            self.trigger_deactivate()

    def _step(self, run: SimulatedRun, now: float) -> float:
        """Do a block of a step; the longest wait for the next one, [s]."""
        if self._steering is None or not self._steering.steps:
            return 1.0
        if run.may_step() and self._peers.alone(now):
            self._advance_block(run)
        return 0.0 if self._steering.steps and run.may_step() else 1.0

    def _begin_anew(self, run: SimulatedRun, now: float) -> None:
        """Begin the next run once the logger has closed the bag of the last one."""
        if run.logger.deserted:
            if run.logger.status_to_leave(now) is not None:  # the wait is over
                self._leave(run, now)
            return
        self._computing.call(run.begin_anew, time.monotonic())
        for each in self._offered:
            if isinstance(each, LiveParameters):
                each.show()
        if self._steering is not None:
            self._steering.on_begun_anew()
        self.announce(f"run {run.report.number} is at its start")

    def _on_input(self, run: SimulatedRun, topic: str, data: bytes, number: int | None) -> None:
        """Keep a block of the run's own source until its turn; warn of one that is refused."""
        now = time.monotonic()
        if self._peers.sources.accept(topic, number, now) and (reason := run.inputs.offer(topic, data)):
            self._out.diagnostics.warn(now, reason)
            self.get_logger().warning(reason, throttle_duration_sec=1.0)

    def _advance(self, run: SimulatedRun, now: float) -> None:
        """Compute and publish every block whose inputs are there; one of a run that others steer, whose requests are
        handled between two blocks.
        """
        while run.may_begin(now) and self._peers.sources.alone(now):
            if not self._advance_block(run) or self._own is not None:
                return

    def _advance_block(self, run: SimulatedRun) -> bool:
        """Compute and publish the next block; whether its inputs were there."""
        block = run.next_block()
        if block is None:
            return False
        with closed():
            result = self._computing.call(run.simulation.advance, *block)
        self._out.publish(block[0], result, () if self._own is None else self._own.excitation)
        run.on_done(block[0], result, time.monotonic())
        self._out.diagnostics.late = run.late
        if self._steering is not None:
            self._steering.on_block_done()
        return True

    def _on_recorded(self, run: SimulatedRun, data: bytes) -> None:
        if reason := run.on_recorded(decode(BenchRecorded, data), time.monotonic()):
            self.get_logger().error(f"the logger closed its bag before the end: {reason}")
            self._out.diagnostics.warn(time.monotonic(), reason)

    def _leave(self, run: SimulatedRun, now: float) -> None:
        """End the process once the bag is closed, or the wait for it is over."""
        if self._steering is not None:
            self._steering.on_end(run.why_over())
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
        if self._steering is not None:
            self._steering.set_state(SteeringState.PLAYING)
        return super().on_activate(state)

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Pause a run under way: the others hear PAUSED, and wait."""
        if self._steering is not None and self._steering.plays:
            self._steering.set_state(SteeringState.PAUSED)
        return super().on_deactivate(state)

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Release a run; one that has begun ends as at a reset, and `configure` begins the next one."""
        run = self._run
        if run is not None and run.state.under_way:
            if not run.reset(time.monotonic()):
                self._out.settle()
                self._wait_for_bag(run)
                run.report.begin_anew()
            self._released = run.report
            self._endpoints_before.append(run.report.publisher)  # by which its followers hear of the end
        return super().on_cleanup(state)

    def _wait_for_bag(self, run: SimulatedRun) -> None:
        """Until the logger has closed the bag of a run that ends, and can hear of the next one."""
        limit = time.monotonic() + LOGGER_SECONDS
        while self._logged and time.monotonic() < limit:
            answer = newest(self, "bench/recorded", PEERS_SECONDS)
            if answer is not None and answer.run >= run.report.number and answer.closed:
                return

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """End the run for all of its nodes, also before it has begun."""
        if self._steering is not None:
            self._steering.set_state(SteeringState.QUITTING)
        if self._run is not None and self._run.state is RunState.STARTING:
            self._run.report.send(RunState.STOPPED, STOPPED_BY_USER)
            self._out.settle()
        return super().on_shutdown(state)

    def refusal(self, transition: str) -> str:
        """See `LifecycleBenchNode`."""
        run, steering = self._run, self._steering
        is_busy = run is not None and steering is not None and (steering.steps or run.state is RunState.RESET)
        if transition in ("activate", "cleanup") and is_busy:
            return "a step or a reset is under way; one command at a time"
        if transition == "cleanup" and run is not None and run.state >= RunState.READY and self._own is None:
            return "logger and sources of the run wait for its end; end it by shutdown"
        return ""

    def close(self) -> None:
        """Forget the run, whose publishers are destroyed next."""
        self._run = self._steering = self._own = None
        for each in reversed(self._offered):
            each.destroy()
        self._offered = []

    def stop(self) -> None:
        """End the run after the block done last; a second signal does not wait for the logger."""
        if self._released is not None:
            self._released.send(RunState.STOPPED, STOPPED_BY_USER)
            self._released.settle()
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
