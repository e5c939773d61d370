"""Code of others while it is imported: it does not print into an answer, end the process, or keep it waiting for ever."""

from __future__ import annotations

import io
import signal
import threading
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, redirect_stdout
from types import FrameType
from typing import Any

__all__ = ["LONGEST_IMPORT", "GuestError", "guest"]

LONGEST_IMPORT = 10.0
"""[s] for all that a package has imported to be looked at. Records and sections take a tenth of a second."""
_AGAIN = 1.0  # [s] to the next alarm, for code that goes on after the first

Handler = Callable[[int, FrameType | None], None]


class GuestError(Exception):
    """What code of others did in the place of being imported; a phrase."""


class _TimeIsUpError(BaseException):
    """Raised in the middle of an import: no `except Exception` of it shall answer."""


@contextmanager
def guest(seconds: float = 0.0) -> Iterator[io.StringIO]:
    """Meanwhile standard output leads into what this yields, and what would end Python is an error of the code inside.

    seconds: [s] after which it is broken off; 0: never. Signals reach the main thread alone, so that elsewhere there is no limit.

    Raises:
        GuestError: SystemExit, KeyboardInterrupt without a signal of the user's, all else that is no Exception, or time is up.
    """
    came: set[int] = set()

    def on_alarm(number: int, frame: FrameType | None) -> None:
        came.add(number)
        raise _TimeIsUpError

    def on_interrupt(number: int, frame: FrameType | None) -> None:
        came.add(number)
        interrupt(number, frame)

    interrupt: Any = signal.getsignal(signal.SIGINT)
    handlers: dict[int, Handler] = {signal.SIGINT: on_interrupt} if callable(interrupt) else {}
    if seconds:
        handlers[signal.SIGALRM] = on_alarm
    printed = io.StringIO()
    with _handling(handlers) as handled:
        try:
            if handled and seconds:
                signal.setitimer(signal.ITIMER_REAL, seconds, _AGAIN)
            try:
                with redirect_stdout(printed):
                    yield printed
            finally:
                if handled and seconds:
                    signal.setitimer(signal.ITIMER_REAL, 0.0)
        except BaseException as error:
            if signal.SIGALRM in came:
                raise GuestError(f"it did not end within {seconds:g} s") from error
            if isinstance(error, Exception) or came:
                raise
            raise GuestError(f"{type(error).__name__}: {error}".rstrip(": ")) from error


@contextmanager
def _handling(handlers: Mapping[int, Handler]) -> Iterator[bool]:
    """Meanwhile these handlers of signals; yields whether they are in place, which they are in the main thread alone."""
    if threading.current_thread() is not threading.main_thread():
        yield False
        return
    before = {number: signal.signal(number, handler) for number, handler in handlers.items()}
    try:
        yield True
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
