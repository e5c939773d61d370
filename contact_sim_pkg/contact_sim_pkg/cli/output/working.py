"""What a command does while it prints nothing: shown on standard error after its first second, as long as that lasts."""

from __future__ import annotations

import os
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from contact_sim_pkg.cli.output.progress import RunDisplay

__all__ = ["displayed_elsewhere", "doing", "hush", "working"]

SWITCH = "CONTACT_BENCH_PROGRESS"
PATIENCE = 1.0  # [s] without output before the progress is shown on a terminal
IN_A_FILE = 2.0  # [s] the same where standard error is a file or a pipe: there it stays
REPEATED = 3.0  # [s] the same where a line has said it already
LOOK = 0.1  # [s] between two looks at the clock


class _State:
    """Of this process: a command is one."""

    def __init__(self) -> None:
        self.lock = threading.RLock()
        self.text = ""
        self.printed = False
        self.since = 0.0  # the last word
        self.elsewhere = 0  # displays of a run, a replay or a report that are open
        self.display: RunDisplay | None = None


_STATE = _State()


@contextmanager
def working(text: str) -> Iterator[None]:
    """While a command runs: say what it does where it has been silent for a second, unless the environment has
    `CONTACT_BENCH_PROGRESS=off`.
    """
    if os.environ.get(SWITCH) == "off":
        yield
        return
    over = threading.Event()
    doing(text)
    watch = threading.Thread(target=_watch, args=(over,), daemon=True)
    watch.start()
    try:
        yield
    finally:
        over.set()
        watch.join()
        hush()


def doing(text: str, completed: float = 0.0, *, printed: bool = False) -> None:
    """What is being done now, how much of it is done in [0, 1], and whether a line has printed it already."""
    with _STATE.lock:
        _STATE.text, _STATE.printed = text, printed
        if _STATE.display is not None:
            _STATE.display.update(completed, text)


def hush() -> None:
    """Take the display away: something is printed."""
    with _STATE.lock:
        _STATE.since = time.monotonic()
        if _STATE.display is not None:
            _STATE.display.__exit__(None, None, None)
            _STATE.display = None


@contextmanager
def displayed_elsewhere() -> Iterator[None]:
    """While a run, a replay or a report has a display of its own."""
    hush()
    with _STATE.lock:
        _STATE.elsewhere += 1
    try:
        yield
    finally:
        with _STATE.lock:
            _STATE.elsewhere -= 1
            _STATE.since = time.monotonic()


def _watch(over: threading.Event) -> None:
    while not over.wait(LOOK):
        with _STATE.lock:
            silent = time.monotonic() - _STATE.since
            if _STATE.display is None and not _STATE.elsewhere and silent > _patience():
                _STATE.display = _displayed(_STATE.text)


def _patience() -> float:
    if _STATE.printed:
        return REPEATED
    return PATIENCE if sys.stderr.isatty() else IN_A_FILE


def _displayed(text: str) -> RunDisplay:
    from contact_sim_pkg.cli.output.progress import RunDisplay  # not before somebody waits: it takes 0.1 s

    return RunDisplay(1.0, text, "step").__enter__()
