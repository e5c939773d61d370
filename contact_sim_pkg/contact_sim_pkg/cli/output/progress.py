"""Live progress of a run, a replay or a report on standard error."""

from __future__ import annotations

import sys
import threading
import time
from types import TracebackType
from typing import Protocol

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

from contact_sim_pkg.files import printable_lines

PLAIN_SECONDS = 3.0  # between two lines where standard error is no terminal


class DisplayedProgress(Protocol):
    """State of a run, on nodes or without."""

    @property
    def simulated(self) -> float:
        """Simulated time, [s]."""

    @property
    def real_time_factor(self) -> float:
        """Simulated time over wall time."""

    @property
    def load(self) -> float:
        """Largest normal force of the last block, [N]."""

    @property
    def peak_pressure(self) -> float:
        """Largest pressure of the last block, [Pa]; 0 without contact and where no field is
        computed.
        """

    @property
    def message(self) -> str:
        """Before the first block, and in a pause: what is being done."""


class RunDisplay:
    """A bar on a terminal; elsewhere a line at the start, at the first block, and every three
    seconds. Lines of the nodes go above the bar.
    """

    def __init__(self, duration: float, begin: str = "starting", item: str = "block") -> None:
        """Prepare for a run or a replay of `duration` simulated seconds, or for so many sections of
        a report; nothing is shown before it is entered.

        `begin` is shown before the first update; `item` is named where nothing moves.
        """
        self._duration = duration
        self._console = Console(file=sys.stderr, highlight=False)
        self._printed = self._moved = time.monotonic()
        self._completed, self._text, self._item = 0.0, begin, item
        self._over = threading.Event()
        columns = (BarColumn(24), TextColumn("{task.description}"), TimeRemainingColumn())
        self._bar = Progress(
            *columns,
            console=self._console,
            transient=True,
            disable=not self._console.is_terminal,
            redirect_stdout=False,
        )
        self._task = self._bar.add_task(begin, total=None)

    def show(self, progress: DisplayedProgress) -> None:
        """Show the state of the run."""
        if progress.simulated <= 0.0:
            if progress.message:
                self.show_set_up(progress.message)
            return
        text = (
            f"{progress.simulated:.2f} of {self._duration:g} s, {progress.real_time_factor:.2f}x real time, "
            f"load {progress.load:.0f} N"
        )
        if progress.peak_pressure > 0.0:
            text += f", peak {progress.peak_pressure / 1e3:.1f} kPa"
        if progress.message:
            text += f", {progress.message}"
        self.update(progress.simulated, text)

    def show_set_up(self, text: str) -> None:
        """Show what is done before the first block."""
        self.update(0.0, text)

    def update(self, completed: float, text: str) -> None:
        """Show how much of the duration is done, [s], and a text."""
        now = time.monotonic()
        first = self._completed == 0.0 < completed
        if completed != self._completed or (completed == 0.0 and text != self._text):
            self._moved = now
        self._completed, self._text = completed, text
        held = now - self._moved
        if held > PLAIN_SECONDS:
            text += f"; no further {self._item} for {held:.0f} s" if completed else f" (for {held:.0f} s)"
        if self._console.is_terminal:
            # without a total the bar moves to and fro
            total = self._duration if completed else None
            self._bar.update(self._task, total=total, completed=completed, description=text)
        elif first or now - self._printed > PLAIN_SECONDS:
            self._printed = now
            self.print_line(text)

    def _repeat(self) -> None:
        """Repeat the text while a block, or a section, lasts long."""
        while not self._over.wait(0.5):
            self.update(self._completed, self._text)

    def print_line(self, line: str) -> None:
        """Print one line, of a node or of the progress."""
        self._console.print(printable_lines(line), markup=False, soft_wrap=True)

    def __enter__(self) -> RunDisplay:
        """Start the bar."""
        self._bar.start()
        if not self._console.is_terminal:
            self.print_line(self._text)
        threading.Thread(target=self._repeat, daemon=True).start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Remove the bar."""
        self._over.set()
        self._bar.stop()
