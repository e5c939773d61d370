"""The logger's order: messages wait per block, and are released in canonical order once a block is
whole. Without ROS.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from contact_sim_pkg.bag.messages import stamp_of
from contact_sim_pkg.bag.topics import topic_of
from contact_sim_pkg.nodes.protocol.input_blocks import FARTHEST_AHEAD


class BlockMessage(NamedTuple):
    """One message; the tuples sort in canonical order within a block."""

    stamp: int  # [ns]
    rank: int  # of the topic in the table
    sequence: int  # number of the message on its topic
    topic: str
    data: bytes


class RecordOrder:
    """Messages that wait until the simulator reports how many belong to the blocks done so far.

    Blocks 0 ... b are whole when their excitation is there and the simulator's messages stamped
    inside them are as many as it reports to have sent up to b. Topics overtake each other on the
    wire, so no arrival order is assumed.
    """

    def __init__(self, excitation: Iterable[str], block_length_ns: int) -> None:
        """No message; no block whole."""
        self._excitation = {topic: set[int]() for topic in excitation}
        self._block_length_ns = block_length_ns
        self._waiting: dict[int, list[BlockMessage]] = {}
        self._sequence: dict[str, int] = {}
        self._sent = {-1: 0}  # last block done -> messages of the simulator up to it
        self._results: dict[int, int] = {}  # block -> messages of the simulator waiting or released
        self.last_block = -1
        self.released = 0

    def add(self, topic: str, data: bytes) -> bool:
        """Keep one message; False where it belongs to a block that is whole, repeats a block of
        excitation, or is far ahead.
        """
        stamp = stamp_of(data)
        block = stamp // self._block_length_ns
        if block <= self.last_block:
            return False
        if topic in self._excitation:
            if block in self._excitation[topic] or block > self.last_block + FARTHEST_AHEAD:
                return False
            self._excitation[topic].add(block)
        else:
            self._results[block] = self._results.get(block, 0) + 1
        sequence = self._sequence[topic] = self._sequence.get(topic, -1) + 1
        self._waiting.setdefault(block, []).append(BlockMessage(stamp, topic_of(topic).rank, sequence, topic, data))
        return True

    def on_progress(self, block: int, messages_sent: int) -> None:
        """The simulator has done all blocks up to this one, and sent so many messages for them."""
        if block > self.last_block:
            self._sent[block] = messages_sent

    def release_whole(self) -> list[BlockMessage]:
        """The messages of all blocks that are whole now and were not before, in canonical order."""
        target = max((block for block in self._sent if block > self.last_block and self._is_whole(block)), default=None)
        if target is None:
            return []
        messages: list[BlockMessage] = []
        for block in range(self.last_block + 1, target + 1):
            messages += sorted(self._waiting.pop(block, ()))
            for seen in self._excitation.values():
                seen.discard(block)
            self._results.pop(block, None)
        self._sent = {block: sent for block, sent in self._sent.items() if block >= target}
        self.last_block = target
        self.released += len(messages)
        return messages

    def _is_whole(self, block: int) -> bool:
        new = range(self.last_block + 1, block + 1)
        if any(number not in seen for seen in self._excitation.values() for number in new):
            return False
        return sum(self._results.get(number, 0) for number in new) == self._sent[block] - self._sent[self.last_block]

    def missing(self) -> int:
        """Messages that the simulator has sent up to its last report and that are not here."""
        last = max(self._sent)
        if last <= self.last_block:
            return 0
        here = sum(count for number, count in self._results.items() if number <= last)
        lacking = sum(
            number not in seen for seen in self._excitation.values() for number in range(self.last_block + 1, last + 1)
        )
        return self._sent[last] - self._sent[self.last_block] - here + lacking

    def release_rest(self) -> list[BlockMessage]:
        """Everything up to the last block done, whole or not, in canonical order; it is needed
        where messages were lost.
        """
        last = max(self._sent)
        messages = [
            message for block in sorted(self._waiting) if block <= last for message in sorted(self._waiting[block])
        ]
        self._waiting.clear()
        self.released += len(messages)
        self.last_block = max(self.last_block, last)
        return messages
