"""Received excitation blocks: checked against the protocol, kept until their number is due. Without
ROS.

A block is never repeated, ramped, clamped or invented: a bad one is dropped, counted and named, and
the run waits for a good one.
"""

from __future__ import annotations

from collections.abc import Iterable

from contact_sim_pkg.bag.errors import MessageError
from contact_sim_pkg.bag.excitation import DECODERS, Block
from contact_sim_pkg.bag.messages import stamp_of
from contact_sim_pkg.records.messages import VibrationBlock

FARTHEST_AHEAD = 64  # blocks kept per input; the window of a well-behaved source is 24


def _refuse_unfilled(vibration: VibrationBlock, block_length: float) -> None:
    """MessageError where the samples do not fill a block of `block_length` [s]."""
    intervals = len(vibration.acceleration_x) - 1
    if abs(intervals * vibration.sample_period - block_length) > 1e-6 * block_length:
        raise MessageError(
            f"block {vibration.block} has {intervals + 1} samples every {vibration.sample_period} s, which do not fill a block "
            f"of {block_length} s; its last sample lies at the block's end"
        )


def check_block(topic: str, data: bytes, block_length_ns: int, blocks: int) -> Block:
    """The decoded block.

    Raises MessageError where it is malformed, does not fill its time, a value is not finite or absurd, the number is not
    one of the scene, or number and stamp disagree (stamp = number x block length).
    """
    block = DECODERS[topic](data)
    if isinstance(block, VibrationBlock):
        _refuse_unfilled(block, block_length_ns * 1e-9)
    stamp = stamp_of(data)
    if not 0 <= block.block < blocks:
        raise MessageError(f"block {block.block} is none of the scene's blocks 0 to {blocks - 1}")
    if stamp != block.block * block_length_ns:
        raise MessageError(f"block {block.block} is stamped {stamp} ns instead of {block.block * block_length_ns} ns")
    return block


class InputBlocks:
    """The blocks of all inputs of one simulator, in order of their numbers."""

    def __init__(self, topics: Iterable[str], block_length_ns: int, blocks: int) -> None:
        """No block; block 0 is next."""
        self._waiting: dict[str, dict[int, Block]] = {topic: {} for topic in topics}
        self._block_length_ns, self._blocks = block_length_ns, blocks
        self._last = dict.fromkeys(self._waiting, -1)
        self.dropped = dict.fromkeys(self._waiting, 0)
        self.next_block = 0

    def offer(self, topic: str, data: bytes) -> str:
        """Keep a block until its number is due; returns why it was dropped, or an empty text."""
        try:
            block = check_block(topic, data, self._block_length_ns, self._blocks)
        except MessageError as error:
            return self._drop(topic, str(error))
        number, waiting = block.block, self._waiting[topic]
        if number < self.next_block or number in waiting:
            return self._drop(topic, f"block {number} came a second time")
        if number >= self.next_block + FARTHEST_AHEAD:
            return self._drop(
                topic, f"block {number} came while block {self.next_block} is due; at most {FARTHEST_AHEAD} ahead"
            )
        waiting[number] = block
        self._last[topic] = max(self._last[topic], number)
        return ""

    def _drop(self, topic: str, reason: str) -> str:
        self.dropped[topic] += 1
        return f"{topic}: {reason}; dropped ({self.dropped[topic]} so far)"

    def next_blocks(self) -> dict[str, Block] | None:
        """The next block of every input, or None while one is missing."""
        if self.missing():
            return None
        blocks = {topic: waiting.pop(self.next_block) for topic, waiting in self._waiting.items()}
        self.next_block += 1
        return blocks

    def missing(self) -> tuple[str, ...]:
        """Topics of the inputs that lack the next block."""
        return tuple(topic for topic, waiting in self._waiting.items() if self.next_block not in waiting)

    def describe_missing(self) -> str:
        """Sentence on which input lacks which block, and on its last good block."""
        parts = []
        for topic in self.missing():
            last = (
                f"the last good one was block {self._last[topic]}"
                if self._last[topic] >= 0
                else "no good block came at all"
            )
            dropped = f", {self.dropped[topic]} were dropped" if self.dropped[topic] else ""
            parts.append(f"block {self.next_block} of {topic} is missing ({last}{dropped})")
        return "; ".join(parts)
