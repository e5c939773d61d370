"""The node of the recording: writes the messages of whole blocks in canonical order."""

from __future__ import annotations

import sys
import time
from functools import partial
from pathlib import Path
from typing import Any

from rclpy.duration import Duration
from rclpy.lifecycle import LifecycleState, TransitionCallbackReturn

from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.bag.names import new_directory
from contact_sim_pkg.nodes.bench_node import LifecycleBenchNode
from contact_sim_pkg.nodes.parameters import declare, declare_input_timeout, declare_scene
from contact_sim_pkg.nodes.processes.process import run
from contact_sim_pkg.nodes.processes.scene_file import queue_depth, read_descriptions, read_reason, read_scene
from contact_sim_pkg.nodes.protocol.endpoints import numbered_subscription, publisher, publisher_ids, subscription
from contact_sim_pkg.nodes.protocol.recording import BagRecording
from contact_sim_pkg.nodes.protocol.states import DONE, FAULT, LOSS, STOPPED_BY_USER, Follower, RunState
from contact_sim_pkg.nodes.protocol.window import Gather
from contact_sim_pkg.records.messages import BenchProgress
from contact_sim_pkg.run.bag_content import described_by_publishers, input_names

BAG_TEXT = "Directory of the bag, which must not exist. Empty: bags/SCENE_TIME_RANDOM of the current directory."
STOP_SECONDS = 0.5  # from a signal of the supervisor to closing, for the simulator's last messages
UNHURRIED_SECONDS = 3.0  # the same where no supervisor kills what takes long
SETTLE_SECONDS = 1.0  # for the last answer to be acknowledged
DEAD_SETTLE_SECONDS = 0.2  # for the same once a process of the run has died


class BagLoggerNode(LifecycleBenchNode):
    """Subscribes to every recorded topic of the scene; answers on `bench/recorded`."""

    def __init__(self) -> None:
        """Declare the parameters; everything else is done in `configure`."""
        super().__init__("bag_logger")
        self.scene_name = declare_scene(self)
        self._directory = declare(self, "bag", "", BAG_TEXT)
        self._patience = declare_input_timeout(self)
        self._recording: BagRecording | None = None
        self._request = ""  # to the simulator; in every answer from then on, for only the last one is kept
        self._stop_seconds = STOP_SECONDS if self.supervisor else UNHURRIED_SECONDS
        self._gather = Gather()

    def configure(self) -> None:
        """Subscribe to what the scene records. The bag is created when the run is ready, so a
        refused run leaves none.
        """
        scene = read_scene(self.scene_name)
        self._path = path = new_directory(Path(self._directory) if self._directory else None, scene.name)
        self._run, self._news, self._leave_at = Follower(), time.monotonic(), float("inf")
        self._request = ""
        self._scene, self._recording = scene, BagRecording(path, scene, scene.block_length_ns)
        self._answers = publisher(self, "bench/recorded")
        kept = [
            numbered_subscription(self, name, partial(self._on_message, name), queue_depth(scene))
            for name in self._recording.topics
        ]
        self._kept = [*kept, subscription(self, "bench/progress", self._on_progress)]

    def _on_message(self, topic: str, data: bytes, number: int | None) -> None:
        recording = self._recording
        if recording is not None and (reason := recording.accept(topic, data, number, partial(self._count, topic))):
            self.get_logger().warning(reason, throttle_duration_sec=1.0)

    def _count(self, topic: str) -> int:
        return int(self.count_publishers(self.resolve_topic_name(topic)))

    def _on_progress(self, data: bytes) -> None:
        recording, progress = self._recording, decode(BenchProgress, data)
        if recording is None or recording.closed or not self._run.accept(progress):
            return
        if self._run.number > recording.number:  # the report of the reset was overwritten
            self._close_bag("")
            recording = self._recording = self._recording_of(self._run.number)
        self._news = time.monotonic()
        never_began = self._run.state is RunState.STOPPED and progress.block < 0
        if self._run.state >= RunState.READY and not never_began and not recording.created:
            recording.open(self.resolve_topic_name, self._descriptions())
            self.announce(f"recording to {recording.path}")
        recording.order.on_progress(progress.block, progress.messages_sent)
        self.gather = self._gather.on_block(progress.block, self._news)

    def _descriptions(self) -> dict[str, dict[str, Any]]:
        """What each excitation found and did, and which node publishes it."""
        names = {topic: [*publisher_ids(self, topic).values()] for topic in input_names(self._scene)}
        publishers = {topic: found[0] for topic, found in names.items() if found and found[0]}
        return described_by_publishers(read_descriptions(self.scene_name, self._scene), publishers)

    def tick(self, now: float) -> float:
        """Write whole blocks; close once the run has ended and all is here, or no wait is left."""
        recording = self._recording
        if recording is None or recording.closed or recording.number > self._run.number:
            return 1.0
        if self._run.state.ended and not recording.created:
            self._leave_without_bag("")
            return 1.0
        if not (self.active or self._run.state.ended or self._leave_at < float("inf")):
            return 1.0
        if recording.write_whole():
            self._answers.publish(recording.answer(sentence=self._request))
        lacking = recording.order.missing()
        if self._run.state.ended and not lacking:
            self._end("")
        elif now > self._leave_at:
            self._end(STOPPED_BY_USER)
        elif self._run.state.ended and now - self._news > self._patience:
            self._end(f"{lacking} messages never came")
        return 1.0

    def _end(self, sentence: str) -> None:
        lossy = self._close_bag(sentence)
        if self._run.state is RunState.RESET and not lossy and not sentence:
            self._recording = self._recording_of(self._run.number + 1)
        else:
            self.exit_status = LOSS if lossy else DONE

    def _recording_of(self, number: int) -> BagRecording:
        """The recording of a run behind the first one: DIRECTORY_2, DIRECTORY_3, …"""
        path = new_directory(self._path.with_name(f"{self._path.name}_{number + 1}"), self._scene.name)
        return BagRecording(path, self._scene, self._scene.block_length_ns, number)

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """End the run for all of its nodes, also before it has begun."""
        if self._recording is not None and not self._recording.created:
            self._leave_without_bag(STOPPED_BY_USER)
        self._stop_seconds = UNHURRIED_SECONDS
        return super().on_shutdown(state)

    def _leave_without_bag(self, sentence: str) -> None:
        """End a run that never began: its simulator learns that it waits for nothing."""
        if self._recording is not None:
            self._answers.publish(self._recording.answer(closed=True, sentence=sentence))
            self._answers.wait_for_all_acked(Duration(seconds=SETTLE_SECONDS))
        self.exit_status = DONE

    def refusal(self, transition: str) -> str:
        """See `LifecycleBenchNode`."""
        if transition in ("deactivate", "cleanup") and self._recording is not None and self._recording.is_open:
            return "the run waits for its recording; deactivate contact_simulator for a pause, end the run by shutdown"
        return ""

    def stop(self) -> None:
        """Ask the simulator for its end and wait shortly for its last messages, then close."""
        recording = self._recording
        if recording is None or not recording.created or self._leave_at < float("inf"):
            self._leave_at = 0.0
            self.close()
            self.exit_status = DONE
        else:
            self._leave_at = time.monotonic() + self._stop_seconds
            self._request = STOPPED_BY_USER
            self._answers.publish(recording.answer(sentence=self._request))

    def fault(self, sentence: str, exit_status: int) -> None:
        """Log the failure, close the bag with the whole blocks, end the process."""
        self.get_logger().error(sentence)
        recording = self._recording is not None and self._recording.is_open
        self._close_bag(sentence)
        self.exit_status = LOSS if recording and exit_status == FAULT else exit_status

    def close(self) -> None:
        """Close the bag with the whole blocks; the second time nothing happens."""
        self._close_bag("")

    def _close_bag(self, sentence: str) -> bool:
        """Close the bag, answer, and wait for the answer to arrive; whether something was lost."""
        recording = self._recording
        if recording is None:
            return False
        reason = read_reason(self.scene_name) if recording.is_open else ""
        end = recording.close(self._run, reason, lambda: self._answers.publish(recording.answer()))
        if end is None:
            return False
        summary = end.summary
        self._answers.publish(recording.answer(closed=True, sentence=end.describe(sentence)))
        # a node that has died acknowledges nothing
        self._answers.wait_for_all_acked(Duration(seconds=DEAD_SETTLE_SECONDS if reason else SETTLE_SECONDS))
        self.announce(f"bag: {recording.path}, {summary.messages} messages")
        if not summary.complete:
            self.get_logger().error(summary.sentence)
        return end.lossy


def main() -> int:
    """Run the node; returns the exit status."""
    return run(BagLoggerNode)


if __name__ == "__main__":
    sys.exit(main())
