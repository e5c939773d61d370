"""Base of the two excitation nodes: numbered blocks, sent as far as answers and pace allow."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from pathlib import Path

from rclpy.duration import Duration
from rclpy.node import Node

from contact_sim_pkg.bag.messages import decode, encode
from contact_sim_pkg.nodes.bench_node import SUPERVISOR_TEXT
from contact_sim_pkg.nodes.parameters import declare, declare_pace, declare_record, declare_scene
from contact_sim_pkg.nodes.processes.process import use_usual_policy
from contact_sim_pkg.nodes.processes.scene_file import queue_depth, read_scene, write_description
from contact_sim_pkg.nodes.protocol.endpoints import publisher, subscription
from contact_sim_pkg.nodes.protocol.pacing import Pacer
from contact_sim_pkg.nodes.protocol.states import REFUSED, Follower, NodeError, RecordedFollower, RunState
from contact_sim_pkg.nodes.protocol.window import BlockWindow, Gather
from contact_sim_pkg.records.messages import BenchProgress, BenchRecorded
from contact_sim_pkg.run.sources import Source
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

FROM_BAG_TEXT = "Directory of a bag whose excitation is sent instead of the scene's own. Empty: the scene's own."
LINGER_SECONDS = {
    RunState.STOPPED: 1.0,
    RunState.FAILED: 10.0,
}  # for the logger to close its bag, as the simulator waits for it
ACKNOWLEDGE_SECONDS = 0.3  # after a signal, for what was sent to arrive
MakeSource = Callable[[ResolvedScene], Source]


class ExcitationNode(Node):
    """Sends the blocks of one excitation topic, in order, and ends when the run has ended."""

    exit_status: int | None = None
    gather = 0.0
    computes = False

    def __init__(self, name: str, topic: str, make_source: MakeSource) -> None:
        """Make the source of the scene, or open the bag, and wait for the simulator."""
        super().__init__(name)
        self.supervisor = declare(self, "supervisor", 0, SUPERVISOR_TEXT)
        self.scene_name = declare_scene(self)
        scene = read_scene(self.scene_name)
        bag = declare(self, "from_bag", "", FROM_BAG_TEXT)
        self._source = _source_of_bag(topic, bag, scene) if bag else make_source(scene)
        write_description(self.scene_name, topic, self._source.describe())
        self._block_length_ns = scene.block_length_ns
        logged = declare_record(self)
        self._listeners = 1 + logged  # simulator, logger
        self._window = BlockWindow(scene.blocks, logged=logged)
        pace = declare_pace(self, scene.data["pace"])
        self._pacer = Pacer(pace, scene.block_length)
        self._gather, self._at_full_speed = Gather(), math.isinf(pace)
        if not self._at_full_speed:
            use_usual_policy(everywhere=True)
        self._run, self._recorded = Follower(), RecordedFollower()
        self._leave_at = math.inf
        self._publisher = publisher(self, topic, queue_depth(scene))
        self._subscriptions_kept = [subscription(self, "bench/progress", self._on_progress)]
        if logged:
            self._subscriptions_kept.append(subscription(self, "bench/recorded", self._on_recorded))

    def start(self) -> None:
        """Nothing is left to set up."""

    def tick(self, now: float) -> float:
        """Send what is due; end when every block is answered for, or the run was ended."""
        wait = float("inf")
        if self._run.state in (RunState.READY, RunState.RUNNING):
            wait = self._send_due(now) if self._is_matched(now) else 0.005
        if self._window.finished or self._ended(now):
            self.exit_status = 0
        return wait

    def _ended(self, now: float) -> bool:
        """Whether nobody needs this node any more: its last messages are delivered only as long as
        it is there.
        """
        if self._run.state not in LINGER_SECONDS:
            return False
        self._leave_at = min(self._leave_at, now + LINGER_SECONDS[self._run.state])
        return self._listeners < 2 or self._recorded.closed or now > self._leave_at

    def _is_matched(self, now: float) -> bool:
        """Whether everybody who needs block 0 is matched with this publisher; the simulator cannot
        see that.
        """
        if self._window.next_block > 0 or self._publisher.get_subscription_count() >= self._listeners:
            self._pacer.start(now)
            return True
        return False

    def _send_due(self, now: float) -> float:
        while self._window.open:
            wait = self._pacer.wait(self._window.next_block, now)
            if wait > 0.0:
                return wait
            number = self._window.next_number()
            self._publisher.publish(encode(self._source.block(number), number * self._block_length_ns))
        return float("inf")

    def _on_progress(self, data: bytes) -> None:
        progress = decode(BenchProgress, data)
        if self._run.accept(progress):
            now = time.monotonic()
            self._window.on_done(progress.block)
            (self._pacer.pause if self._run.state is RunState.PAUSED else self._pacer.resume)(now)
            if self._at_full_speed:
                self.gather = self._gather.on_block(progress.block, now)

    def _on_recorded(self, data: bytes) -> None:
        recorded = decode(BenchRecorded, data)
        if self._run.state >= RunState.READY and self._recorded.accept(recorded):
            self._window.on_recorded(recorded.block)

    def stop(self) -> None:
        """End as soon as what was sent has arrived: what was not sent will not be done."""
        self._publisher.wait_for_all_acked(Duration(seconds=ACKNOWLEDGE_SECONDS))
        self.exit_status = 0

    def fault(self, sentence: str, exit_status: int) -> None:
        """Log the failure and end the process."""
        self.get_logger().error(sentence)
        self.exit_status = exit_status


def _source_of_bag(topic: str, bag: str, scene: ResolvedScene) -> Source:
    from contact_sim_pkg.run.from_bag import STEERED, refuse_steered, sources_from_bag

    refuse_steered(Path(bag), STEERED)
    sources = sources_from_bag(Path(bag), scene)
    if topic not in sources:
        raise NodeError(f"bag {bag} holds no {topic}, which the scene calls for", REFUSED)
    return sources[topic]
