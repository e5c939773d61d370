"""A second process that compiles kernels of the same scene while this one compiles others.

Python types and lowers on one core, whatever the number of threads. What the second process has
compiled this one finds in the cache on disk. It is a matter of time alone: what the other has not
got ready when it is needed is compiled here.
"""

from __future__ import annotations

import os
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from typing import IO

__all__ = ["accompanied", "begin"]

_PROGRAM = """
import sys
function, sys.path[:] = sys.argv[1], sys.argv[2:]
from contact_sim_pkg.python_process import disregard_current_folder
disregard_current_folder()
from contact_sim_pkg.compiled import companion
companion.serve(function, sys.stdin.buffer)
"""

_LENGTH_BYTES = 8  # in front of the argument

_awaiting: list[tuple[str, str]] = []  # what `begin` starts
_running: list[subprocess.Popen[bytes]] = []


@contextmanager
def accompanied(function: str, argument: str) -> Iterator[None]:
    """While the block of code lasts, the first compilation starts a process that calls ``function``
    (``module:name``) with ``argument``. It ends with the block; on a single core none is started.
    """
    if len(os.sched_getaffinity(0)) > 1:
        _awaiting.append((function, argument))
    try:
        yield
    finally:
        _awaiting.clear()
        while _running:
            process = _running.pop()
            process.kill()
            process.wait()


def begin() -> None:
    """Called at each compilation: starts what awaits the first."""
    while _awaiting:
        function, argument = _awaiting.pop()
        try:
            process = subprocess.Popen(
                [sys.executable, "-c", _PROGRAM, function, *sys.path],
                stdin=subprocess.PIPE,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                start_new_session=True,  # an interrupt from the keyboard is for this process; the other follows
            )
            _running.append(process)
            assert process.stdin is not None
            content = argument.encode()
            process.stdin.write(len(content).to_bytes(_LENGTH_BYTES, "little") + content)
            process.stdin.flush()
        except OSError:
            pass  # this process compiles all


def serve(function: str, requests: IO[bytes]) -> None:
    """In the second process: call ``function``; end at once where the first has ended."""
    from contact_sim_pkg.compiled import linking

    size = int.from_bytes(requests.read(_LENGTH_BYTES), "little")
    argument = requests.read(size).decode()
    threading.Thread(target=_end_with, args=(requests,), daemon=True).start()
    linking.make_at_once()
    module, _, name = function.partition(":")
    getattr(import_module(module), name)(argument)


def _end_with(requests: IO[bytes]) -> None:
    requests.read()
    os._exit(0)
