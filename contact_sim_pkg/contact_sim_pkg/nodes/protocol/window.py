"""Back-pressure: how far a source of blocks may run ahead of the simulator and of the logger."""

from __future__ import annotations

AHEAD = 24
"""Blocks. An answer takes the time of several: messages gather, and a process waits for a core. Of the
full bench beside other work two cores did 250 blocks/s with 8, and 450 with 24, the simulator then
never waiting.
"""
LEAST_SECONDS, MOST_SECONDS = 0.001, 0.02  # that messages gather for


class Gather:
    """Time for which a process lets messages gather before it handles them together.

    Two blocks at the present speed: each process of the loop source, simulator, logger is then woken
    every second block, and none waits for another.
    """

    def __init__(self) -> None:
        """No block yet."""
        self._seconds = LEAST_SECONDS
        self._block, self._at = -1, 0.0

    def on_block(self, block: int, now: float) -> float:
        """The time, [s], once all blocks up to this one are done at `now` of the steady clock, [s]."""
        new = block - self._block
        if new > 0:
            each = (now - self._at) / new
            self._seconds = min(MOST_SECONDS, max(LEAST_SECONDS, 2.0 * each))
            self._block, self._at = block, now
        return self._seconds


class BlockWindow:
    """Block k may be sent when k <= (last block done) + ahead and k <= (last block recorded) +
    ahead.

    Without a logger the second condition falls away.
    """

    def __init__(self, blocks: int, *, logged: bool, ahead: int = AHEAD) -> None:
        """Nothing done, nothing recorded, nothing sent."""
        self.blocks, self.ahead, self._logged = blocks, ahead, logged
        self.done = self.recorded = -1
        self.next_block = 0

    def on_done(self, block: int) -> None:
        """The simulator has done all blocks up to this one; an older answer changes nothing."""
        self.done = max(self.done, block)

    def on_recorded(self, block: int) -> None:
        """The logger has all blocks up to this one; an older answer changes nothing."""
        self.recorded = max(self.recorded, block)

    @property
    def answered(self) -> int:
        """The last block that everybody has answered for, -1 before the first."""
        return min(self.done, self.recorded) if self._logged else self.done

    @property
    def open(self) -> bool:
        """Whether the next block may be sent."""
        return self.next_block <= min(self.answered + self.ahead, self.blocks - 1)

    def next_number(self) -> int:
        """The number of the block to send now; the window must be open."""
        if not self.open:
            raise ValueError(
                f"block {self.next_block} may not be sent: answered up to {self.answered}, {self.blocks} blocks"
            )
        self.next_block += 1
        return self.next_block - 1

    @property
    def finished(self) -> bool:
        """Every block of the scene is answered for."""
        return self.answered >= self.blocks - 1
