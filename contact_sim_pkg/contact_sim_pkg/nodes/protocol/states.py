"""States of a run and the rules by which a node follows `bench/progress`, without ROS."""

from __future__ import annotations

import struct
from enum import IntEnum

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.nodes.protocol.window import AHEAD
from contact_sim_pkg.records.messages import BenchProgress, BenchRecorded


class NodeError(Exception):
    """A fault that ends a node: one sentence, and the exit status that belongs to it."""

    def __init__(self, sentence: str, exit_status: int = 1) -> None:
        """Keep the exit status beside the sentence."""
        super().__init__(sentence)
        self.exit_status = exit_status


class RunState(IntEnum):
    """The constants of `BenchProgress.msg`."""

    IDLE = BenchProgress.IDLE
    STARTING = BenchProgress.STARTING
    READY = BenchProgress.READY
    RUNNING = BenchProgress.RUNNING
    FINISHED = BenchProgress.FINISHED
    STOPPED = BenchProgress.STOPPED
    FAILED = BenchProgress.FAILED
    PAUSED = BenchProgress.PAUSED
    RESET = BenchProgress.RESET

    @property
    def ended(self) -> bool:
        """No further block will be done."""
        return self in (RunState.FINISHED, RunState.STOPPED, RunState.FAILED, RunState.RESET)

    @property
    def under_way(self) -> bool:
        """Ready and not ended."""
        return self in (RunState.READY, RunState.RUNNING, RunState.PAUSED)

    @property
    def stage(self) -> int:
        """Order within a run, in which PAUSED stands beside RUNNING."""
        return int(RunState.RUNNING if self is RunState.PAUSED else self)


MALFORMED = (BagError, ArithmeticError, LookupError, TypeError, ValueError, struct.error)
"""What decoding and converting raise where the bytes or values of a message are none that the bench sends."""
STOPPED_BY_USER = "stopped by the user"  # message of whoever ends a run; of the logger also a request to the simulator
REFUSED, LOSS, FAULT, DONE = 2, 3, 1, 0  # exit statuses


class Follower:
    """A run as a node follows it on `bench/progress`.

    A node is a peer that *ready* waits for, and without its answers the run does not get further
    than the window. Whatever is further on, before *ready* was seen, belongs to another bench.
    Later on, a report that lies behind an earlier one comes from another bench that is
    starting on the same topics, and is ignored. A run with a higher number follows a reset.
    """

    def __init__(self, *, answers: bool = True) -> None:
        """No report yet; `answers`: the run waits for this node's answers or blocks."""
        self.state = RunState.IDLE
        self.block = -1
        self.number = 0  # of the run
        self.last: BenchProgress | None = None
        self._answers = answers

    def accept(self, progress: BenchProgress) -> bool:
        """Whether this report belongs to the run and is news.

        Raises NodeError (refused) where it is that of another bench's run under way.
        """
        # a run under way that this node did not see begin is that of another bench
        state = RunState(progress.state)
        if self.state is RunState.IDLE:
            foreign = progress.block >= 0 or state > RunState.READY or progress.run > 0
        else:
            foreign = self._answers and self.state is RunState.STARTING and progress.block >= AHEAD
        if foreign:
            raise NodeError(
                f"another bench (scene {progress.scene}, block {progress.block} of {progress.blocks}) runs on "
                "bench/progress; end it, or give this one a ROS_DOMAIN_ID of its own",
                REFUSED,
            )
        if progress.run != self.number:
            if progress.run < self.number:
                return False
            self.number, self.state, self.block, self.last = progress.run, state, progress.block, progress
            return True
        if state.stage < self.state.stage or progress.block < self.block or self.state.ended:
            return False
        self.state, self.block, self.last = state, progress.block, progress
        return True


class RecordedFollower:
    """Answers of `bench/recorded` as a node follows them; one that lies behind an earlier one is
    ignored.
    """

    def __init__(self, number: int = 0) -> None:
        """No answer yet; ``number`` of the run that is recorded."""
        self.number = number
        self.block = -1
        self.messages = 0
        self.closed = False
        self.bag = ""
        self.message = ""

    def accept(self, recorded: BenchRecorded) -> bool:
        """Whether this answer is news."""
        if recorded.run > self.number:
            self.number, self.block, self.messages, self.closed = recorded.run, -1, 0, False
        if (
            recorded.run < self.number
            or recorded.block < self.block
            or recorded.messages < self.messages
            or self.closed
        ):
            return False
        self.block, self.messages, self.closed = recorded.block, recorded.messages, recorded.closed
        self.bag, self.message = recorded.bag, recorded.message
        return True
