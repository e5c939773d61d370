"""A thread that notes, some hundred times a second, what the others of its process spent processor time on; only the standard
library, only Linux.

It counts by what a person would name: the kernel being compiled, the package being imported, or else the innermost function of
the bench. A process may be killed at any time, so the counts are written while it runs.
"""

from __future__ import annotations

import json
import os
import sys
import threading
import time
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from types import FrameType
from typing import Any

__all__ = ["FOLDER", "INTERVAL", "begin", "label"]

FOLDER = "CONTACT_LAB_SAMPLES"
"""Variable of the environment with the folder that the counts go to, a file a process."""
INTERVAL = 0.004
"""[s] between two samples"""
WRITTEN = 0.25  # [s] between two states of the file
NAME = "sampler"
OURS, BODY, COMPILATION = "contact_sim_", "<module>", "numba:compile"
_compiling: dict[int, list[str]] = {}  # by thread, the innermost last


def begin() -> None:
    """Start to sample the threads of this process; nothing without the variable."""
    folder = os.environ.get(FOLDER)
    if folder:
        threading.Thread(target=_sample, args=(Path(folder) / f"{os.getpid()}.json",), name=NAME, daemon=True).start()


def _sample(file: Path) -> None:
    counts: Counter[str] = Counter()
    spent: dict[int, float] = {}
    written = time.monotonic()
    listening = False
    while True:
        if not listening and "numba.core.event" in sys.modules:
            listening = _listen()
        frames = sys._current_frames()
        for thread in threading.enumerate():
            if thread.name == NAME or thread.ident not in frames or thread.native_id is None:
                continue
            now = _spent(thread.native_id)
            counts[label(frames[thread.ident], _compiling.get(thread.ident, ()))] += now - spent.get(
                thread.native_id, 0.0
            )  # type: ignore[assignment]  # seconds
            spent[thread.native_id] = now
        del frames
        if time.monotonic() - written > WRITTEN:
            written = time.monotonic()
            fresh = file.with_suffix(".new")
            fresh.write_text(json.dumps(counts), encoding="utf-8")
            fresh.rename(file)
        time.sleep(INTERVAL)


def _spent(thread: int) -> float:
    """Time of the processors that a thread has had, [s]; 0 for one that has ended."""
    try:
        return 1e-9 * int(Path(f"/proc/self/task/{thread}/schedstat").read_text(encoding="ascii").split()[0])
    except OSError:
        return 0.0


def _listen() -> bool:
    """Learn from numba which kernel each thread compiles; False while numba is still being imported."""
    event = sys.modules["numba.core.event"]
    try:
        register, listener = event.register, event.Listener
    except AttributeError:
        return False

    class Compilations(listener):  # type: ignore[misc,valid-type]
        def on_start(self, event: Any) -> None:
            function = event.data["dispatcher"].py_func
            _compiling.setdefault(threading.get_ident(), []).append(f"{function.__module__}.{function.__qualname__}")

        def on_end(self, event: Any) -> None:
            if names := _compiling.get(threading.get_ident()):
                names.pop()

    register(COMPILATION, Compilations())
    return True


def label(frame: FrameType | None, compiling: Sequence[str] = ()) -> str:
    """What a stack does: `compile KERNEL`, the innermost of those ``compiling``; `import PACKAGE`, the outermost of another
    than the bench; or the innermost `module.function` of the bench. ``frame``: the innermost.
    """
    if compiling:
        return f"compile {compiling[-1]}"
    ours = imported = ""
    while frame is not None:
        # not its local variables: they cannot be read of a frame that runs
        module, name = str(frame.f_globals.get("__name__", "")), frame.f_code.co_qualname
        if name == BODY and module != "__main__":
            package = module.partition(".")[0]
            imported = package if not imported or not package.startswith(OURS) else imported
        elif not ours and module.startswith(OURS):
            ours = f"{module}.{name}"
        frame = frame.f_back
    return f"import {imported}" if imported else ours or "start and end of Python"
