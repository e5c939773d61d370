"""The bag of a run while it is recorded: messages kept until their block is whole, then written.
Without ROS.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any, NamedTuple

from contact_sim_pkg.bag.errors import BagError, MessageError
from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.bag.metadata import recorded_topics
from contact_sim_pkg.bag.writer import BagSummary, BagWriter
from contact_sim_pkg.nodes.protocol.input_blocks import check_block
from contact_sim_pkg.nodes.protocol.record_order import BlockMessage, RecordOrder
from contact_sim_pkg.nodes.protocol.record_outcome import outcome_of
from contact_sim_pkg.nodes.protocol.single_source import SingleSource
from contact_sim_pkg.nodes.protocol.states import REFUSED, Follower, NodeError
from contact_sim_pkg.records.messages import BenchRecorded, String
from contact_sim_pkg.run.bag_content import attachments, input_names, recorded_names, result_names
from contact_sim_pkg.run.live_parameters import STEERING
from contact_sim_pkg.scene.resolved_scene import ResolvedScene


class ClosedBag(NamedTuple):
    """End of a recording."""

    summary: BagSummary
    lacking: int  # messages of the blocks done that never came

    def describe(self, sentence: str) -> str:
        """Why the bag is closed: `sentence`, and what the bag itself reports beyond it."""
        reason = "" if sentence in self.summary.sentence else sentence
        return "; ".join(text for text in (reason, self.summary.sentence) if text)

    @property
    def lossy(self) -> bool:
        """Whether something was lost."""
        return bool(self.lacking) or not self.summary.complete


class BagRecording:
    """Messages of a run in canonical order, and the bag that they are written to."""

    def __init__(self, path: Path, scene: ResolvedScene, block_length_ns: int, number: int = 0) -> None:
        """No message yet; the bag `path` is not created before `open`; block length in [ns]; `number` of the run."""
        self.number = number
        self.path, self._scene, self._block_length_ns = path, scene, block_length_ns
        self._inputs, self._blocks = set(input_names(scene)), scene.blocks
        self._sources = {name: SingleSource() for name in (*result_names(scene), *self._inputs, STEERING)}
        self.order = RecordOrder(input_names(scene), block_length_ns)
        self.left_out = Counter[str]()
        self.block = -1
        self.closed = False
        self._writer: BagWriter | None = None

    @property
    def is_open(self) -> bool:
        """Whether there is a bag that is not closed."""
        return self._writer is not None and not self.closed

    @property
    def created(self) -> bool:
        """Whether the bag was created."""
        return self._writer is not None

    @property
    def topics(self) -> tuple[str, ...]:
        """Topics whose messages are recorded."""
        return tuple(self._sources)

    def accept(self, topic: str, data: bytes, number: int | None, count: Callable[[], int]) -> str:
        """Keep a message, also before the bag is created: on the wire, block 0 may overtake
        *ready*.

        One publisher a topic is accepted, by the rule of `SingleSource.accept`. Excitation is
        checked as the simulator does: a block that it drops must not replace a good one. Messages
        left out are counted in `left_out`.

        Returns:
            Why the message is not recorded; empty where it is, or where its block is already whole.
        """
        # a foreign message is left out before its content counts for anything
        if not self._sources[topic].accept(number, count):
            self.left_out[f"foreign {topic}"] += 1
            return f"{topic}: another node publishes here too; its messages are not recorded"
        try:
            if topic in self._inputs:
                check_block(topic, data, self._block_length_ns, self._blocks)
        except MessageError as error:
            self.left_out[f"dropped {topic}"] += 1
            return f"{topic}: {error}; not recorded"
        if not self.closed and not self.order.add(topic, data):
            self.left_out[f"dropped {topic}"] += 1
        return ""

    def open(self, resolve_name: Callable[[str], str], descriptions: dict[str, dict[str, Any]]) -> None:
        """Create the bag, with the scene as its first message; NodeError (refused) where that
        fails.

        Args:
            resolve_name: full name in the graph of a topic.
            descriptions: findings in the excitation and their treatment, by topic.
        """
        topics = recorded_topics(recorded_names(self._scene), resolve_name)
        self._steering = recorded_topics([STEERING], resolve_name)[0]
        try:
            self._writer = BagWriter(self.path, topics, attachments(self._scene, descriptions))
        except BagError as error:
            raise NodeError(str(error), REFUSED) from None
        self._writer.write("bench/scene", 0, encode(String(data=self._scene.to_yaml())))

    def write_whole(self) -> bool:
        """Write the blocks that are whole; whether there was one."""
        self._write(self.order.release_whole())
        grown = self.order.last_block > self.block
        self.block = max(self.block, self.order.last_block)
        return grown

    def _write(self, messages: list[BlockMessage]) -> None:
        if self._writer is not None:
            if any(message.topic == STEERING for message in messages):  # a bag without changes has no such topic
                self._writer.add_topic(self._steering)
            self._writer.write_all((message.topic, message.stamp, message.data) for message in messages)

    def answer(self, *, closed: bool = False, sentence: str = "") -> bytes:
        """The bytes of `bench/recorded` at the last block that is whole."""
        count = self.order.released + self.created  # the scene's text is one message
        value = BenchRecorded(
            run=self.number, block=self.block, messages=count, closed=closed, bag=str(self.path), message=sentence
        )  # fmt: skip
        return encode(value, (self.block + 1) * self._block_length_ns)

    def close(self, run: Follower, reason: str, on_block: Callable[[], None]) -> ClosedBag | None:
        """Close the bag with what is whole, or with every message of an ended run; None without an
        open bag.

        Args:
            run: the run as the logger has followed it.
            reason: why the supervisor ended it; empty where it did not.
            on_block: called where a further block was written.
        """
        writer, was_open, self.closed = self._writer, self.is_open, True
        if writer is None or not was_open:
            return None
        lacking = self.order.missing() if run.state.ended else 0
        with suppress(BagError):  # where the bag itself is what failed; its summary says so
            if self.write_whole():
                on_block()
            if run.state.ended:
                self._write(self.order.release_rest())
        outcome = outcome_of(run, self.block + 1, reason=reason, lacking=lacking, counts=self.left_out)
        return ClosedBag(writer.close(outcome), lacking)
