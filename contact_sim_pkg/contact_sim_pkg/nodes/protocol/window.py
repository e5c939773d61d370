"""Back-pressure: how far a source of blocks may run ahead of the simulator and of the logger."""

AHEAD = 4  # blocks; with 1 the processes wait for each other (740 instead of 1075-1300 blocks/s)


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
