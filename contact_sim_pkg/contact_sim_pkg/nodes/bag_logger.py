"""The node of the recording: holds back what comes until a block is whole, writes it in canonical
order, answers.
"""

from __future__ import annotations

import sys
import time
from collections import Counter
from contextlib import suppress
from functools import partial
from pathlib import Path

from rclpy.duration import Duration

from contact_sim_pkg.bag.errors import BagError, MessageError
from contact_sim_pkg.bag.messages import decode, encode
from contact_sim_pkg.bag.metadata import recorded_topics
from contact_sim_pkg.bag.names import new_directory
from contact_sim_pkg.bag.writer import BagWriter
from contact_sim_pkg.nodes.bench_node import LifecycleBenchNode
from contact_sim_pkg.nodes.endpoints import numbered_subscription, publisher, subscription
from contact_sim_pkg.nodes.parameters import declare, declare_input_timeout, declare_scene
from contact_sim_pkg.nodes.processes.process import run
from contact_sim_pkg.nodes.processes.scene_file import (
    block_length_ns,
    count_blocks,
    queue_depth,
    read_descriptions,
    read_reason,
    read_scene,
)
from contact_sim_pkg.nodes.protocol.input_blocks import check_block
from contact_sim_pkg.nodes.protocol.record_order import HeldMessage, RecordOrder
from contact_sim_pkg.nodes.protocol.record_outcome import outcome_of
from contact_sim_pkg.nodes.protocol.single_source import SingleSource
from contact_sim_pkg.nodes.protocol.states import DONE, FAULT, LOSS, REFUSED, Follower, NodeError, RunState
from contact_sim_pkg.records.messages import BenchProgress, BenchRecorded, String
from contact_sim_pkg.run.bag_content import attachments, input_names, recorded_names, result_names

BAG_TEXT = "Directory of the bag, which must not exist. Empty: bags/SCENE_TIME_RANDOM of the current directory."
GATHER_SECONDS = 0.002  # that messages gather for; the window leaves room for it
STOP_SECONDS = 0.5  # that a signal waits for the simulator's last word
SETTLE_SECONDS = 1.0  # for the last answer to be acknowledged


class BagLoggerNode(LifecycleBenchNode):
    """Takes every recorded topic of the scene as it came; answers on `bench/recorded`."""

    gather = GATHER_SECONDS

    def __init__(self) -> None:
        """Declare the parameters; everything else is done in `configure`."""
        super().__init__("bag_logger")
        self._scene_name = declare_scene(self)
        self._directory = declare(self, "bag", "", BAG_TEXT)
        self._patience = declare_input_timeout(self)
        self._writer: BagWriter | None = None
        self._closed = True

    def configure(self) -> None:
        """Subscribe to what the scene records. The bag is created when the run is ready, so a
        refused run leaves none.
        """
        scene = read_scene(self._scene_name)
        self._period_ns, self._blocks, depth = block_length_ns(scene), count_blocks(scene), queue_depth(scene)
        self._path = new_directory(Path(self._directory) if self._directory else None, str(scene.data["name"]))
        self._scene = scene
        self._order = RecordOrder(input_names(scene), self._period_ns)
        self._left_out = Counter[str]()
        self._sources = {name: SingleSource() for name in (*result_names(scene), *input_names(scene))}
        self._inputs = set(input_names(scene))
        self._answers = publisher(self, "bench/recorded")
        kept = [numbered_subscription(self, name, partial(self._take, name), depth) for name in self._sources]
        self._kept = [*kept, subscription(self, "bench/progress", self._on_progress)]
        self._writer, self._closed, self._leave_at = None, False, float("inf")
        self._run, self._block, self._news = Follower(), -1, time.monotonic()

    def _take(self, topic: str, data: bytes, number: int | None) -> None:
        """Of one publisher a topic. Excitation is checked as the simulator does: what it drops
        takes no good block's place.
        """
        if not self._sources[topic].accept(number, self.count_publishers(self.resolve_topic_name(topic))):
            self._left_out[f"foreign {topic}"] += 1
            self.get_logger().warning(
                f"{topic}: another node publishes here too; its messages are not recorded", throttle_duration_sec=1.0
            )
            return
        try:
            if topic in self._inputs:
                check_block(topic, data, self._period_ns, self._blocks)
        except MessageError as error:
            self._left_out[f"dropped {topic}"] += 1
            self.get_logger().warning(f"{topic}: {error}; not recorded", throttle_duration_sec=1.0)
            return
        self._hold(topic, data)

    def _hold(self, topic: str, data: bytes) -> None:
        """Also before *ready* is heard: on the wire, block 0 may overtake it. What there is no
        place for is counted.
        """
        if not self._closed and not self._order.hold(topic, data):
            self._left_out[f"dropped {topic}"] += 1

    def _on_progress(self, data: bytes) -> None:
        progress = decode(BenchProgress, data)
        if self._closed or not self._run.accept(progress):
            return
        self._news = time.monotonic()
        if self._run.state >= RunState.READY and self._writer is None:
            self._open()
        self._order.on_progress(progress.block, progress.messages_sent)

    def _open(self) -> None:
        topics = recorded_topics(recorded_names(self._scene), self.resolve_topic_name)
        texts = attachments(self._scene, read_descriptions(self._scene_name, self._scene))
        try:
            self._writer = BagWriter(self._path, topics, texts)
        except BagError as error:
            raise NodeError(str(error), REFUSED) from None
        self.announce(f"recording to {self._path}")
        self._writer.write("bench/scene", 0, encode(String(data=self._scene.to_yaml())))

    def _write_whole(self) -> None:
        self._write(self._order.take_whole())
        if self._order.last_block > self._block:
            self._block = self._order.last_block
            self._answer()

    def _write(self, messages: list[HeldMessage]) -> None:
        if self._writer is not None:
            for message in messages:
                self._writer.write(message.topic, message.stamp, message.data)

    def _answer(self, *, closed: bool = False, sentence: str = "") -> None:
        stamp = (self._block + 1) * self._period_ns
        held = self._order.given_out + (self._writer is not None)  # the scene's text is one message
        self._answers.publish(
            encode(
                BenchRecorded(block=self._block, messages=held, closed=closed, bag=str(self._path), message=sentence),
                stamp,
            )
        )

    def tick(self, now: float) -> float:
        """Write what is whole. Close when the run has ended and all is here, when the wait for it
        is over, or when asked to.
        """
        if not self.active or self._closed:
            return 1.0
        self._write_whole()
        lacking = self._order.missing()
        if self._run.state.ended and not lacking:
            self._end("")
        elif now > self._leave_at:
            self._end("stopped")
        elif self._run.state.ended and now - self._news > self._patience:
            self._end(f"{lacking} messages never came")
        return 1.0

    def _end(self, sentence: str) -> None:
        self.exit_status = LOSS if self._close_bag(sentence) else DONE

    def stop(self) -> None:
        """Wait shortly for what the simulator has still sent, then close."""
        if self._writer is None or self._leave_at < float("inf"):
            self._leave_at = 0.0
            self.close()
            self.exit_status = DONE
        else:
            self._leave_at = time.monotonic() + STOP_SECONDS

    def fault(self, sentence: str, exit_status: int) -> None:
        """Say what failed, close the bag with what is whole, end the process."""
        self.get_logger().error(sentence)
        recording = self._writer is not None and not self._closed
        self._close_bag(sentence)
        self.exit_status = LOSS if recording and exit_status == FAULT else exit_status

    def close(self) -> None:
        """Close the bag with what is whole; the second time nothing happens."""
        self._close_bag("")

    def _close_bag(self, sentence: str) -> bool:
        """Close the bag, answer, and give the answer time to arrive; whether something was lost."""
        if self._closed or self._writer is None:
            self._closed = True
            return False
        self._closed = True
        lacking = self._order.missing() if self._run.state.ended else 0
        with suppress(BagError):  # where the bag itself is what failed; its summary says so
            self._write_whole()
            if self._run.state.ended:
                self._write(self._order.take_rest())
        reason = read_reason(self._scene_name)
        outcome = outcome_of(self._run, self._block + 1, reason=reason, lacking=lacking, counts=self._left_out)
        summary = self._writer.close(outcome)
        said = "" if sentence in summary.sentence else sentence
        reasons = "; ".join(text for text in (said, summary.sentence) if text)
        self._answer(closed=True, sentence=reasons)
        self._answers.wait_for_all_acked(Duration(seconds=SETTLE_SECONDS))
        self.announce(f"bag: {self._path}, {summary.messages} messages")
        if not summary.complete:
            self.get_logger().error(summary.sentence)
        return bool(lacking) or not summary.complete


def main() -> int:
    """Run the node; returns the exit status."""
    return run(BagLoggerNode)


if __name__ == "__main__":
    sys.exit(main())
