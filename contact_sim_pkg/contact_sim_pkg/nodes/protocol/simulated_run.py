"""The simulator's side of a run: when a block may begin, what is reported after it, what ends the
run. Without ROS.
"""

from __future__ import annotations

import math

from contact_sim_pkg.bag.excitation import Block
from contact_sim_pkg.nodes.protocol.input_blocks import InputBlocks
from contact_sim_pkg.nodes.protocol.logger_answers import LoggerAnswers
from contact_sim_pkg.nodes.protocol.pacing import Lateness, Pacer
from contact_sim_pkg.nodes.protocol.progress_report import ProgressReport
from contact_sim_pkg.nodes.protocol.states import DONE, FAULT, STOPPED_BY_USER, NodeError, RunState
from contact_sim_pkg.nodes.protocol.window import BlockWindow
from contact_sim_pkg.records.messages import BenchRecorded
from contact_sim_pkg.run.block_simulation import BlockResult, BlockSimulation
from contact_sim_pkg.scene.resolved_scene import ResolvedScene


class SimulatedRun:
    """One run as its simulator advances it, from *ready* to the exit status."""

    def __init__(
        self, simulation: BlockSimulation, report: ProgressReport, scene: ResolvedScene, pace: float,
        *, logged: bool, input_timeout: float,
    ) -> None:  # fmt: skip
        """A run before *ready*.

        Args:
            simulation: advances the blocks.
            report: publishes the state of the run.
            scene: the scene of the simulation.
            pace: simulated seconds per second, > 0; infinity: as fast as it can.
            logged: the run has a logger.
            input_timeout: longest wait for a block that is due, [s].
        """
        self.simulation, self.report = simulation, report
        self._scene, self._pace, self._logged = scene, pace, logged
        self._timeout = input_timeout + scene.block_length / pace
        self._begin()

    def _begin(self) -> None:
        scene, blocks = self._scene, self.simulation.blocks
        self.inputs = InputBlocks(self.simulation.inputs, scene.block_length_ns, blocks)
        self.window = BlockWindow(blocks, logged=self._logged)
        self.logger = LoggerAnswers(self.window, logged=self._logged, number=self.report.number)
        self.late = ""  # sentence about a run behind its pace; empty where it is not
        self._pacer = Pacer(self._pace, scene.block_length)
        self._lateness = Lateness(self._pacer)
        self._advanced = math.inf

    @property
    def state(self) -> RunState:
        """State of the run as reported last."""
        return self.report.state

    def start(self, now: float) -> None:
        """Report READY; time counts from `now` of the steady clock, [s]."""
        self._advanced = now
        self._pacer.start(now)
        self.report.send(RunState.READY)

    @property
    def blocks_left(self) -> int:
        """Blocks of the scene that are not done."""
        return self.window.blocks - self.window.next_block

    def why_over(self) -> str:
        """Why no block follows; empty where one can."""
        return f"the run has ended: {self.report.describe()}" if self.state.ended else ""

    def reset(self, now: float) -> bool:
        """Begin anew, at `now` of the steady clock, [s]; whether the run is at its start already. Else report RESET:
        `begin_anew` follows once the logger has closed its bag.
        """
        if self.window.next_block == 0 and not getattr(self.simulation, "has_changed", False):
            return True
        self.end(RunState.RESET, "reset", now)
        return False

    def begin_anew(self, now: float) -> None:
        """The next run at its start, paused; `now`: steady clock, [s]. Its simulation can `reset`."""
        self.simulation.reset()  # type: ignore[attr-defined]
        self.report.begin_anew()
        self._begin()
        self.start(now)
        self.pause(now)

    def wait(self, now: float) -> float:
        """Time until pace alone allows the next block, [s]; infinity where a message decides."""
        if self.simulation.inputs or not self.window.open:
            return math.inf
        return self._pacer.wait(self.window.next_block, now)

    def may_step(self) -> bool:
        """Whether the window allows the next block of a paused run."""
        return self.state is RunState.PAUSED and self.window.open

    def may_begin(self, now: float) -> bool:
        """Whether window and pace allow the next block at `now` of the steady clock, [s].

        A scene with inputs has its pace from their sources.
        """
        return not self.state.ended and self.window.open and (bool(self.simulation.inputs) or self.wait(now) <= 0.0)

    def next_block(self) -> tuple[int, dict[str, Block]] | None:
        """Number and inputs of the next block; None while an input is missing."""
        blocks = self.inputs.next_blocks()
        return None if blocks is None else (self.window.next_number(), blocks)

    def on_done(self, number: int, result: BlockResult, now: float) -> None:
        """Report a block whose messages are published; `now`: steady clock, [s]."""
        self.window.on_done(number)
        self._advanced = now
        if self.state is RunState.PAUSED:
            self._pacer.step()
        self.report.block_done(number, result)
        self.late = self._lateness.block_done(number, now, self.report.real_time_factor)
        if self.state.ended:
            self.logger.end(now)

    def refuse_standstill(self, now: float) -> None:
        """Raise NodeError (fault) where no block was done for too long at `now` of the steady
        clock, [s].
        """
        if now - self._advanced > self._timeout and not self.state.ended:
            raise NodeError(f"{self.logger.cause_of_delay(self.inputs)} (waited {self._timeout:g} s)", FAULT)

    def pause(self, now: float) -> None:
        """Begin no further block from `now` of the steady clock, [s], on, and report PAUSED; only a run under way."""
        if self.state in (RunState.READY, RunState.RUNNING):
            self._pacer.pause(now)
            self.report.send(RunState.PAUSED, "paused")

    def resume(self, now: float) -> None:
        """Go on at the pace from `now` of the steady clock, [s], on, and report RUNNING; only a paused run."""
        if self.state is RunState.PAUSED:
            self._pacer.resume(now)
            self._advanced = now
            self.report.send(RunState.RUNNING)

    def on_recorded(self, recorded: BenchRecorded, now: float) -> str:
        """Accept an answer of the logger, at `now` of the steady clock, [s].

        The logger may be asked to end in place of the simulator, and hands that on. Returns the
        reason why it closed its bag before the end, otherwise empty.
        """
        is_request = recorded.message == STOPPED_BY_USER
        if self.state < RunState.READY:
            if is_request and recorded.closed and recorded.block < 0:  # before there is a bag; of no run under way
                self.logger.accept(recorded)
                self.report.send(RunState.STOPPED, STOPPED_BY_USER)
            return ""
        reason = self.logger.accept(recorded)
        if is_request:
            self.stop(now)
        if reason is None or self.state.ended:
            return ""
        self.logger.lost()
        self.report.send(RunState.STOPPED, reason)
        return reason

    def stop(self, now: float) -> int | None:
        """End a run under way at the user's request, `now` of the steady clock, [s].

        Returns the exit status where nothing is left to end, so that the process may leave at once.
        """
        return None if self.end(RunState.STOPPED, STOPPED_BY_USER, now) else self.logger.exit_status

    def end(self, state: RunState, sentence: str, now: float, exit_status: int = DONE) -> bool:
        """End a run under way at `now` of the steady clock, [s]; False where there is none."""
        if not self.state.under_way:
            return False
        self.logger.end(now, exit_status, stopped=state is RunState.STOPPED)
        self.report.send(state, sentence)
        return True
