"""The temporary folder of a supervised run, which nothing leaves behind, not even a supervisor that
is killed. Without ROS.

The supervisor and each node have a shared lock on one file of the folder; the lock of a process
ends with it. The process that gets the lock alone is the last one: it removes the shared memory
that the run has used, and the folder.
"""

from __future__ import annotations

import fcntl
import os
import shutil
import tempfile
import time
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path
from types import TracebackType

from contact_sim_pkg.nodes.processes.shared_memory import mapped_segments, remove_unused

PREFIX = "contact_bench_"
LOCK = "lock"
TURN = "turn"
TURN_SECONDS = 3.0  # that an orphan waits for those before it
SEGMENTS = "segments"  # names of shared-memory segments, one a line

_locks: dict[Path, int] = {}  # folder -> descriptor of its lock, for the life of this process


class RunFolder:
    """The folder of a run that this process supervises; a context manager."""

    def __init__(self) -> None:
        """Remove what earlier runs left, create the folder and lock it."""
        root = Path(tempfile.gettempdir())
        for folder in root.glob(f"{PREFIX}*"):
            _remove_left(folder)
        self.path = Path(tempfile.mkdtemp(prefix=PREFIX))
        draft = self.path / f".{LOCK}"
        draft.touch(mode=0o600)
        join(self.path, draft)
        draft.rename(self.path / LOCK)  # a folder with a lock file is locked
        self._segments: set[str] = set()

    def keep_segments(self, names: Iterable[str]) -> None:
        """Store on disk which shared memory the run uses, for the process that ends last."""
        if not self._segments.issuperset(names):
            self._segments.update(names)
            _write_segments(self.path, self._segments)

    def __enter__(self) -> RunFolder:
        """The folder itself."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Remove the folder."""
        self.remove()

    def remove(self) -> None:
        """Remove the folder, at the end of the run."""
        os.close(_locks.pop(self.path))
        shutil.rmtree(self.path, ignore_errors=True)


def join(folder: Path, lock: Path | None = None) -> None:
    """Take part in the run of this folder for the life of the process; nothing where the folder is
    not one of a supervisor.
    """
    with suppress(OSError):
        if folder not in _locks:
            descriptor = os.open(lock or folder / LOCK, os.O_RDWR | os.O_NOFOLLOW | os.O_CLOEXEC)
            fcntl.flock(descriptor, fcntl.LOCK_SH)
            _locks[folder] = descriptor


def leave() -> None:
    """An orphan ends: where it is the last process of its run, it removes what is left.

    Orphans take turns, and each keeps its turn until the system ends it: a process uses its shared
    memory as long as it is there.
    """
    for folder, descriptor in _locks.items():
        with suppress(OSError):
            turn = os.open(folder / TURN, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_CLOEXEC, 0o600)
            limit = time.monotonic() + TURN_SECONDS
            while not _locked(turn) and time.monotonic() < limit:
                time.sleep(0.01)
            _remove_if_last(folder, descriptor, mapped_segments(os.getpid()))


def _remove_left(folder: Path) -> None:
    """Remove a folder that an earlier run of this user has left."""
    with suppress(OSError):  # no folder of a run, or gone meanwhile
        descriptor = os.open(folder / LOCK, os.O_RDWR | os.O_NOFOLLOW | os.O_CLOEXEC)
        try:
            if os.fstat(descriptor).st_uid == os.getuid():
                _remove_if_last(folder, descriptor)
        finally:
            os.close(descriptor)


def _remove_if_last(folder: Path, descriptor: int, more: Iterable[str] = ()) -> None:
    """Where nobody else has the lock, remove the segments that the folder names (and `more`) if
    nobody uses them, and it.
    """
    known = _read_segments(folder) | set(more)
    if _locked(descriptor):
        remove_unused(known)
        shutil.rmtree(folder, ignore_errors=True)
    else:
        _write_segments(folder, known)


def _locked(descriptor: int) -> bool:
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True


def _read_segments(folder: Path) -> set[str]:
    try:
        return set((folder / SEGMENTS).read_text(encoding="utf-8").split())
    except OSError:
        return set()


def _write_segments(folder: Path, names: set[str]) -> None:
    draft = folder / f".{SEGMENTS}.{os.getpid()}"
    with suppress(OSError):
        draft.write_text("\n".join(sorted(names)), encoding="utf-8")
        draft.replace(folder / SEGMENTS)
