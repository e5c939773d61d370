"""States of a run that others steer, and their commands: one at a time, carried out between two blocks. Without ROS.

States, codes and rules are those of `simulation_interfaces` 2.1; a step is a block.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from enum import IntEnum
from typing import NamedTuple, Protocol

__all__ = ["Answer", "Code", "Command", "Steered", "Steering", "SteeringState"]

TIME, STATE, ALL = 1, 2, 255
"""Scopes of a reset; those of time and state are one, for a state of the bench has its time."""


class SteeringState(IntEnum):
    """Numbers of `SimulationState.msg`."""

    STOPPED = 0
    PLAYING = 1
    PAUSED = 2
    QUITTING = 3


WORLDS = (4, 5)
"""States of a simulator that loads worlds."""


class Code(IntEnum):
    """Numbers of `Result.msg` and `SetSimulationState.srv`."""

    UNSUPPORTED = 0
    OK = 1
    INCORRECT_STATE = 3
    FAILED = 4
    ALREADY = 101
    INCORRECT_TRANSITION = 103


class Answer(NamedTuple):
    """How a command has ended; the sentence is empty where all is well."""

    code: Code
    sentence: str = ""


class Command:
    """A command from its request to its answer."""

    def __init__(self, answer: Answer | None = None) -> None:
        """A command with its ``answer``, where there is one at once."""
        self.answer = answer
        self._listeners: list[Callable[[Answer], None]] = []

    def when_done(self, call: Callable[[Answer], None]) -> None:
        """Call once there is an answer: now, where it is there."""
        if self.answer is None:
            self._listeners.append(call)
        else:
            call(self.answer)

    def end(self, answer: Answer) -> None:
        """The answer; a second one changes nothing."""
        if self.answer is None:
            self.answer = answer
            for call in self._listeners:
                call(answer)


class Steered(Protocol):
    """The run that is steered. Times are of the steady clock, [s]."""

    @property
    def blocks_left(self) -> int:
        """Blocks of the scene that are not done."""

    def why_over(self) -> str:
        """Why the run takes no further command; empty where it does."""

    def pause(self, now: float) -> None:
        """Begin no further block."""

    def resume(self, now: float) -> None:
        """Go on at the pace; nothing is caught up."""

    def reset(self, now: float) -> bool:
        """Begin anew; whether it is at its start already. Else `Steering.on_begun_anew` follows."""


class Steering:
    """The machine: STOPPED, PLAYING, PAUSED, QUITTING.

    Requests come between two blocks, on the thread that computes them; each returns at once with a command, whose answer
    may follow.
    """

    def __init__(self, run: Steered, clock: Callable[[], float] = time.monotonic) -> None:
        """STOPPED, at the start of a run."""
        self.state = SteeringState.STOPPED
        self._run, self._clock = run, clock
        self._command: Command | None = None  # under way
        self._steps = self._left = 0
        self._on_step: Callable[[int, int], None] | None = None

    @property
    def plays(self) -> bool:
        """Whether blocks follow each other."""
        return self.state is SteeringState.PLAYING

    @property
    def steps(self) -> bool:
        """Whether a block of a step is due."""
        return self._left > 0

    def set_state(self, wanted: int) -> Command:
        """Go to another state."""
        if wanted in WORLDS:
            return _refused(Code.UNSUPPORTED, "the bench loads no worlds; its scene is given at the start")
        if wanted not in set(SteeringState):
            return _refused(Code.INCORRECT_TRANSITION, f"no state has the number {wanted}")
        if wanted == self.state:
            return _refused(Code.ALREADY, f"the state is {self.state.name} already")
        if self.state is SteeringState.QUITTING:
            return _refused(Code.INCORRECT_TRANSITION, "the simulator quits")
        if wanted == SteeringState.QUITTING:
            self.state = SteeringState.QUITTING
            self.on_end("the simulator quits")
            return Command(Answer(Code.OK))
        if reason := self._why_not():
            return _refused(Code.INCORRECT_STATE, reason)
        if wanted == SteeringState.STOPPED:
            return self.reset()
        self.state = SteeringState(wanted)
        (self._run.resume if self.plays else self._run.pause)(self._clock())
        return Command(Answer(Code.OK))

    def step(self, count: int, on_step: Callable[[int, int], None] | None = None) -> Command:
        """Do ``count`` blocks of a paused run, as fast as it can; ``on_step`` gets the blocks done and left after each."""
        if self.state is not SteeringState.PAUSED:
            return _refused(Code.FAILED, f"the state is {self.state.name}; a step needs PAUSED")
        if reason := self._why_not():
            return _refused(Code.INCORRECT_STATE, reason)
        if not 1 <= count <= self._run.blocks_left:
            return _refused(Code.FAILED, f"steps is {count}; the scene has blocks for 1 to {self._run.blocks_left}")
        self._command = Command()
        self._steps = self._left = count
        self._on_step = on_step
        return self._command

    def cancel(self, command: Command) -> None:
        """End a step that is under way after the block done last; one that has ended stays as it is."""
        if command is self._command and self.steps:
            self._end(Answer(Code.FAILED, f"cancelled after {self._steps - self._left} of {self._steps} steps"))

    def reset(self, scope: int = ALL) -> Command:
        """Begin anew, STOPPED: the next run, of the scene as it was at first."""
        if scope not in (0, ALL) and scope & ~(TIME | STATE):
            return _refused(
                Code.UNSUPPORTED, f"scope is {scope}; the bench spawns nothing: 0, {TIME}, {STATE}, 3 or {ALL}"
            )
        if self.state is SteeringState.QUITTING:
            return _refused(Code.INCORRECT_STATE, "the simulator quits")
        if reason := self._why_not():
            return _refused(Code.INCORRECT_STATE, reason)
        self.state = SteeringState.STOPPED
        now = self._clock()
        self._run.pause(now)
        if self._run.reset(now):
            return Command(Answer(Code.OK))
        self._command = Command()
        return self._command

    def on_block_done(self) -> None:
        """A block is done, and all of its messages are sent."""
        if not self.steps:
            return
        self._left -= 1
        if self._on_step is not None:
            self._on_step(self._steps - self._left, self._left)
        if not self._left:
            self._end(Answer(Code.OK))

    def on_begun_anew(self) -> None:
        """The next run is at its start."""
        self._end(Answer(Code.OK))

    def on_end(self, sentence: str) -> None:
        """No further block follows; a command under way has failed."""
        self._end(Answer(Code.FAILED, sentence))

    def _end(self, answer: Answer) -> None:
        command, self._command, self._steps, self._left, self._on_step = self._command, None, 0, 0, None
        if command is not None:
            command.end(answer)

    def _why_not(self) -> str:
        """Why no command can be carried out; empty where one can."""
        if self.steps:
            return f"{self._steps - self._left} of {self._steps} steps are done; one command at a time"
        return "a reset is under way; one command at a time" if self._command else self._run.why_over()


def _refused(code: Code, sentence: str) -> Command:
    return Command(Answer(code, sentence))
