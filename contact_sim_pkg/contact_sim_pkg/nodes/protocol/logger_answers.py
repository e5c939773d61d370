"""Answers of the logger as the simulator uses them: how far it may go, who delays the run, when it
may leave. Without ROS.
"""

from __future__ import annotations

from contact_sim_pkg.nodes.protocol.input_blocks import InputBlocks
from contact_sim_pkg.nodes.protocol.states import DONE, FAULT, LOSS, RecordedFollower
from contact_sim_pkg.nodes.protocol.window import BlockWindow
from contact_sim_pkg.records.messages import BenchRecorded

CLOSE_SECONDS = 30.0  # for the logger to close its bag after the last block, on a busy machine too
STOP_SECONDS = 4.0  # for the same after a signal; `ros2 launch` sends a second one after 5 s


class LoggerAnswers:
    """The logger as the simulator knows it from `bench/recorded`."""

    def __init__(self, window: BlockWindow, *, logged: bool, number: int = 0) -> None:
        """No answer yet; `logged`: the run has a logger; `number` of the run."""
        self._window, self._logged = window, logged
        self._follower = RecordedFollower(number)
        self._leave_at = float("inf")
        self.exit_status = DONE  # of the run, once it has ended

    def accept(self, recorded: BenchRecorded) -> str | None:
        """Accept an answer; why the logger has closed its bag, None while it has not."""
        if not self._follower.accept(recorded):
            return None
        self._window.on_recorded(recorded.block)
        return (recorded.message or "no reason given") if recorded.closed else None

    @property
    def deserted(self) -> bool:
        """There is a logger, and it has not closed its bag."""
        return self._logged and not self._follower.closed

    def lost(self) -> None:
        """The logger closed its bag before the end."""
        self.exit_status = LOSS

    def end(self, now: float, exit_status: int = DONE, *, stopped: bool = False) -> None:
        """The run has ended, at `now` of the steady clock, [s]; after a signal the logger is waited
        for shortly.
        """
        self.exit_status = exit_status
        self._leave_at = now + (STOP_SECONDS if stopped else CLOSE_SECONDS)

    def status_to_leave(self, now: float) -> int | None:
        """The exit status when the simulator may leave after the end; None while it waits for the
        bag to be closed.
        """
        if not self.deserted:
            return self.exit_status
        return (self.exit_status or FAULT) if now > self._leave_at else None

    def cause_of_delay(self, inputs: InputBlocks) -> str:
        """Sentence on who delays the next block. A source waits for the logger as the simulator
        does.
        """
        if inputs.missing() and self._window.open:
            return inputs.describe_missing()
        return (
            f"the logger has not answered for block {self._window.recorded + 1}, and nobody may get further than "
            f"{self._window.ahead} blocks ahead of it: it is stopped, or its disk is slow"
        )
