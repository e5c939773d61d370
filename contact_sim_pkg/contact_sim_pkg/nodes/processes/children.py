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

GRACE_SECONDS = 4.0  # from SIGTERM to SIGKILL
KILL_SECONDS = 1.0
LEAST_SECONDS = 0.1  # from SIGTERM to SIGKILL where an earlier process has used up the time


class ErrorLines:
    """Hands lines of the processes on; errors at the end only, and without those that the failure
    of the run names already.
    """

    def __init__(self, on_line: Callable[[str], None]) -> None:
        """No line yet."""
        self._on_line, self._errors = on_line, list[str]()

    def add(self, line: str) -> None:
        """One line of a process."""
        severity = line.split(maxsplit=1)[0].strip("[]")
        if severity in ("ERROR", "FATAL") and "Traceback" not in line:
            self._errors.append(line)
        else:
            self._on_line(line)

    def release(self, failure: str) -> None:
        """Hand on the errors; `failure` is printed by the caller, empty where there is none."""
        for line in self._errors:
            text = line.partition(": ")[2] or line
            if not failure or (text not in failure and failure not in line):
                self._on_line(line)
        self._errors.clear()


class Child:
    """One process; what it writes on its standard error is handed on line by line, and the last
    line is kept.
    """

    def __init__(
        self, name: str, command: Sequence[str], environment: Mapping[str, str], on_line: Callable[[str], None]
    ) -> None:
        """Start the process."""
        self.name = name
        self.last_line = ""
        self.end_requested = False
        self.segments: set[str] = set()
        self._on_line = on_line
        # a session of its own: Ctrl-C in the terminal reaches the supervisor alone
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
            self._on_line(line)

    @property
    def status(self) -> int | None:
        """Exit status, negative for a signal; None while the process runs."""
        return self.process.poll()

    @property
    def failed(self) -> bool:
        """Whether the process ended badly. One that was requested to end may do so before it
        catches signals.
        """
        ended_on_request = self.end_requested and self.status == -signal.SIGTERM
        return self.status not in (None, 0) and not ended_on_request

    def record_segments(self) -> None:
        """Store which shared memory the process has mapped, so that it can be removed if the
        process is killed.
        """
        if self.status is None:
            self.segments |= mapped_segments(self.process.pid)

    def request_end(self, *, again: bool = False) -> None:
        """SIGTERM, once unless `again`."""
        if self.status is None and (again or not self.end_requested):
            self.end_requested = True
            self.process.send_signal(signal.SIGTERM)

    def describe_end(self) -> str:
        """Exit status and last line, for a person."""
        self._reader.join(timeout=0.5)
        said = f"; it said last: {self.last_line}" if self.last_line else "; it said nothing"
        return f"{how_ended(self.name, self.status)}{said}"


class Children:
    """All processes of a run, in the order in which they were started."""

    def __init__(self, environment: Mapping[str, str], on_line: Callable[[str], None]) -> None:
        """Nothing started."""
        self._environment, self._on_line = environment, on_line
        self._children: list[Child] = []

    def start(self, name: str, command: Sequence[str]) -> Child:
        """Start one more process."""
        child = Child(name, command, self._environment, self._on_line)
        self._children.append(child)
        return child

    def record_segments(self) -> None:
        """See `Child.record_segments`."""
        for child in self._children:
            child.record_segments()

    def request_end(self, *names: str) -> None:
        """Request these processes to end, or all, in reverse order of the start."""
        for child in reversed(self._children):
            if not names or child.name in names:
                child.request_end(again=True)

    def first_failed(self) -> Child | None:
        """A process that ended badly, the first one started of several."""
        return next((child for child in self._children if child.failed), None)

    def all_ended(self) -> bool:
        """Whether every process has ended."""
        return all(child.status is not None for child in self._children)

    def segments(self) -> set[str]:
        """Shared memory that any of the processes has been seen to use."""
        return set().union(*(child.segments for child in self._children))

    def end(self, grace: float = GRACE_SECONDS) -> list[str]:
        """End the processes left, in reverse order of the start, by SIGTERM, `grace` seconds later
        by SIGKILL.

        Returns the names of those that had to be killed. Shared memory of killed processes is
        removed.
        """
        killed = []
        limit = time.monotonic() + grace
        for child in reversed(self._children):
            child.record_segments()
            child.request_end()
            if not _wait(child, max(LEAST_SECONDS, limit - time.monotonic())):
                child.record_segments()
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


def how_ended(name: str, status: int | None) -> str:
    """Sentence on the end of a process by its exit status, negative for a signal."""
    if status is not None and status < 0:
        return f"{name} was ended by {_signal_name(-status)}"
    return f"{name} ended with status {status}"


def _signal_name(number: int) -> str:
    try:
        return signal.Signals(number).name
    except ValueError:
        return f"signal {number}"
