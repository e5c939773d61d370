"""A computation in compiled code, and another thread that may end the run meanwhile: kernels
release the interpreter lock.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any, Generic, TypeVar

Result = TypeVar("Result")
Ended = TypeVar("Ended")


class Computing(Generic[Ended]):
    """Lets another thread end a run whose computation does not return: while it lasts, nothing is
    written.
    """

    def __init__(self) -> None:
        """Nothing is computed; `end` closes what is open once something is."""
        self._idle = threading.Lock()
        self._idle.acquire()
        self.end: Callable[[], Ended] | None = None

    def call(self, function: Callable[..., Result], *arguments: Any) -> Result:
        """``function(*arguments)``; does not return where another thread has ended the run
        meanwhile.
        """
        self._idle.release()
        try:
            return function(*arguments)
        finally:
            self._idle.acquire()

    def abandon(self) -> Ended | None:
        """From another thread: end the run, if it computes right now. None where it does not, or
        nothing is open yet.
        """
        if self.end is None or not self._idle.acquire(blocking=False):
            return None
        return self.end()
