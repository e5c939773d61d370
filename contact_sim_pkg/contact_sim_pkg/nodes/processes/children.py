"""Child processes of a run: started in a session of their own, watched, ended in reverse order.
Without ROS.
"""

from __future__ import annotations

import signal
import subprocess
import threading
import time
from collections.abc import Callable, Mapping, Sequence

from contact_sim_pkg.nodes.processes.shared_memory import mapped_segments, remove_unused

GRACE_SECONDS = 4.0  # from the signal that asks to the one that kills
KILL_SECONDS = 1.0
LEAST_SECONDS = 0.1  # that a process has to end once it was asked, where an earlier one has used up the time


class ErrorLines:
    """Hands lines of the processes on; errors at the end only, and not those that the failure of
    the run says already.
    """

    def __init__(self, say: Callable[[str], None]) -> None:
        """Nothing held."""
        self._say, self._held = say, list[str]()

    def hear(self, line: str) -> None:
        """One line of a process."""
        severity = line.split(maxsplit=1)[0].strip("[]")
        if severity in ("ERROR", "FATAL") and "Traceback" not in line:
            self._held.append(line)
        else:
            self._say(line)

    def release(self, failure: str) -> None:
        """Hand on the errors held; `failure` is printed by the caller, empty where there is none."""
        for line in self._held:
            text = line.partition(": ")[2] or line
            if not failure or (text not in failure and failure not in line):
                self._say(line)
        self._held.clear()


class Child:
    """One process; what it writes on its standard error is handed on line by line, and the last
    line is kept.
    """

    def __init__(
        self, name: str, command: Sequence[str], environment: Mapping[str, str], say: Callable[[str], None]
    ) -> None:
        """Start the process."""
        self.name = name
        self.last_line = ""
        self.asked_to_end = False
        self.segments: set[str] = set()
        self._say = say
        self.process = subprocess.Popen(
            command,
            env=dict(environment),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
            errors="replace",
            start_new_session=True,
        )
        self._reader = threading.Thread(target=self._read, name=f"stderr of {name}", daemon=True)
        self._reader.start()

    def _read(self) -> None:
        if self.process.stderr is not None:
            with self.process.stderr as stream:
                for line in stream:
                    self._hand_on(line.rstrip())

    def _hand_on(self, line: str) -> None:
        if line:
            self.last_line = line
            self._say(line)

    @property
    def status(self) -> int | None:
        """Exit status, negative for a signal; None while the process lives."""
        return self.process.poll()

    @property
    def fell(self) -> bool:
        """Whether the process ended badly. One that was asked to end may do so before it has learnt
        to catch signals.
        """
        asked_away = self.asked_to_end and self.status == -signal.SIGTERM
        return self.status not in (None, 0) and not asked_away

    def look(self) -> None:
        """Keep in mind which shared memory the process has mapped, so that it can be removed if the
        process is killed.
        """
        if self.status is None:
            self.segments |= mapped_segments(self.process.pid)

    def ask_to_end(self, *, again: bool = False) -> None:
        """SIGTERM, once unless `again`."""
        if self.status is None and (again or not self.asked_to_end):
            self.asked_to_end = True
            self.process.send_signal(signal.SIGTERM)

    def describe_end(self) -> str:
        """Exit status and last line, for a person."""
        status = self.status
        how = (
            f"was ended by {_signal_name(-status)}"
            if status is not None and status < 0
            else f"ended with status {status}"
        )
        self._reader.join(timeout=0.5)
        said = f"; it said last: {self.last_line}" if self.last_line else "; it said nothing"
        return f"{self.name} {how}{said}"


class Children:
    """All processes of a run, in the order in which they were started."""

    def __init__(self, environment: Mapping[str, str], say: Callable[[str], None]) -> None:
        """Nothing started."""
        self._environment, self._say = environment, say
        self._children: list[Child] = []

    def start(self, name: str, command: Sequence[str]) -> Child:
        """Start one more process."""
        child = Child(name, command, self._environment, self._say)
        self._children.append(child)
        return child

    def look(self) -> None:
        """See `Child.look`."""
        for child in self._children:
            child.look()

    def ask(self, *names: str) -> None:
        """Ask these processes to end, or all, in reverse order of the start."""
        for child in reversed(self._children):
            if not names or child.name in names:
                child.ask_to_end(again=True)

    def fallen(self) -> Child | None:
        """A process that ended badly, the first one started of several."""
        return next((child for child in self._children if child.fell), None)

    def all_ended(self) -> bool:
        """Whether no process lives any more."""
        return all(child.status is not None for child in self._children)

    def segments(self) -> set[str]:
        """Shared memory that any of the processes has been seen to use."""
        return set().union(*(child.segments for child in self._children))

    def end(self, grace: float = GRACE_SECONDS) -> list[str]:
        """End what still lives, in reverse order of the start, by SIGTERM, `grace` seconds later by
        SIGKILL.

        Returns the names of those that had to be killed. Shared memory of killed processes is
        removed.
        """
        killed = []
        limit = time.monotonic() + grace
        for child in reversed(self._children):
            child.look()
            child.ask_to_end()
            if not _wait(child, max(LEAST_SECONDS, limit - time.monotonic())):
                child.look()
                child.process.kill()
                _wait(child, KILL_SECONDS)
                killed.append(child.name)
        remove_unused(set().union(*(child.segments for child in self._children if (child.status or 0) < 0)))
        return killed


def _wait(child: Child, seconds: float) -> bool:
    try:
        child.process.wait(timeout=max(0.0, seconds))
    except subprocess.TimeoutExpired:
        return False
    return True


def _signal_name(number: int) -> str:
    try:
        return signal.Signals(number).name
    except ValueError:
        return f"signal {number}"
