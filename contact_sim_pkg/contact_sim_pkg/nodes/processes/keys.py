"""Keys pressed on the terminal of a node, without the return key; none where it has no terminal."""

from __future__ import annotations

import os
import select
import sys
import termios
import tty
from typing import Any


class Keys:
    """Sets the terminal of the standard input into single-key mode until `close`; Ctrl-C stays a
    signal.
    """

    def __init__(self) -> None:
        """Leave a terminal alone that belongs to another process group: this one runs in the
        background.
        """
        self._descriptor = -1
        self._before: Any = None
        try:
            number = sys.stdin.fileno()
            if os.isatty(number) and os.tcgetpgrp(number) == os.getpgrp():
                self._before = termios.tcgetattr(number)
                tty.setcbreak(number)
                self._descriptor = number
        except (OSError, ValueError, AttributeError, termios.error):  # closed, or replaced by something else
            self._before = None

    @property
    def is_terminal(self) -> bool:
        """Whether keys can be pressed at all."""
        return self._descriptor >= 0

    def pressed(self) -> str:
        """Keys pressed since the last call."""
        keys = ""
        while self._descriptor >= 0 and select.select([self._descriptor], [], [], 0.0)[0]:
            more = os.read(self._descriptor, 64)
            if not more:
                break
            keys += more.decode("utf-8", "replace")
        return keys

    def close(self) -> None:
        """Restore the terminal."""
        if self._before is not None:
            termios.tcsetattr(self._descriptor, termios.TCSADRAIN, self._before)
            self._descriptor, self._before = -1, None
