"""Says what the set-up does: a bar on a terminal, elsewhere a line every few seconds."""

import os
import select
import shutil
import subprocess
import time
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple, TextIO

from .errors import SetUpError

PERIOD = 3.0  # [s] between two lines where no terminal is
LOOK = 0.5  # [s] between two looks at a program that prints nothing
BAR = 16  # [columns]


class Count(NamedTuple):
    """How far a program has come."""

    done: int
    total: int
    items: str = ""


class Progress:
    """Lines that begin with the seconds since the start of the set-up."""

    def __init__(self, stream: TextIO, clock: Callable[[], float] = time.monotonic, look: float = LOOK) -> None:
        """Start counting seconds; nothing is shown yet."""
        self._stream, self._clock, self._look = stream, clock, look
        self._began = clock()
        self._printed = self._began - PERIOD
        self._redraws = stream.isatty()

    def say(self, sentence: str) -> None:
        """Print a line that stays."""
        self._printed = self._clock()
        self._write(f"{self._stamp()}{sentence}", "\n")

    def show(self, what: str, counted: Count | None = None) -> None:
        """Draw the bar again, or print a line where the last one is old."""
        of = "" if counted is None else f", {counted.done} of {counted.total} {counted.items}".rstrip()
        if self._redraws:
            filled = 0 if counted is None else BAR * counted.done // max(counted.total, 1)
            line = f"{self._stamp()}{'█' * filled}{'░' * (BAR - filled)} {what}{of}"
            self._write(line[: shutil.get_terminal_size().columns - 1], "")
        elif self._clock() - self._printed >= PERIOD:
            self.say(what + of)

    def run(
        self,
        command: list[str],
        what: str,
        *,
        environ: dict[str, str],
        cwd: Path,
        count: Callable[[str], Count | None] = lambda _: None,
    ) -> int:
        """Run a program and show how far it has come; returns its exit status.

        What it prints is read by `count`, line by line, and shown where the program fails.
        """
        self.say(what)
        output: list[str] = []
        counted: Count | None = None
        rest = b""
        # close_fds: the program holds the lock of the set-up too
        with subprocess.Popen(
            command, env=environ, cwd=cwd, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            close_fds=False,
        ) as program:  # fmt: skip
            assert program.stdout is not None
            while True:
                if select.select([program.stdout], [], [], self._look)[0]:
                    piece = os.read(program.stdout.fileno(), 65536)
                    if not piece:
                        break
                    *lines, rest = (rest + piece).split(b"\n")
                    for line in lines:
                        output.append(line.decode(errors="replace"))
                        counted = count(output[-1]) or counted
                self.show(what, counted)
        output.append(rest.decode(errors="replace"))
        if program.returncode:
            self._write("\n".join(output), "\n")
        return program.returncode

    def remove(self, *folders: Path) -> None:
        """Remove folders, of which any may be missing. Raises SetUpError where one stays."""
        there = [str(folder) for folder in folders if os.path.lexists(folder)]
        what = "removing the old " + ", ".join(folder.name for folder in folders)
        if there and self.run(["rm", "-rf", *there], what, environ=dict(os.environ), cwd=Path("/")):
            raise SetUpError(
                "what was made before could not be removed (the message stands above): change its permissions."
            )

    def _write(self, text: str, end: str) -> None:
        self._stream.write(("\r\x1b[K" if self._redraws else "") + text + end)
        self._stream.flush()

    def _stamp(self) -> str:
        return f"set-up [{self._clock() - self._began:3.0f} s]: "
