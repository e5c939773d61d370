"""Shared-memory segments of the middleware: a process that is killed leaves them behind, so whoever
kills it removes them.
"""

from __future__ import annotations

import fcntl
import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path

FOLDER = Path("/dev/shm")  # noqa: S108  # where the system keeps shared memory; nothing is created here
PREFIXES = ("fastrtps_", "sem.fastrtps_", "fastdds_", "sem.fastdds_")
COMPANION_ENDINGS = ("", "_el")  # segment, and the lock that its owner holds


def mapped_segments(process: int) -> set[str]:
    """Names of the middleware's segments that a process has mapped or open; empty if it is gone."""
    names = {line.rsplit("/", 1)[-1] for line in _lines(Path(f"/proc/{process}/maps")) if str(FOLDER) in line}
    names |= {Path(target).name for target in _open_files(process) if target.startswith(str(FOLDER))}
    return {name for name in names if name.startswith(PREFIXES)}


def remove_unused(names: Iterable[str]) -> list[str]:
    """Remove those of the segments that no other living process has mapped or open; returns what
    was removed.

    This process does not count: the middleware keeps its mappings until the process ends, also
    after the last node.
    """
    wanted = {name + ending for name in names for ending in COMPANION_ENDINGS}
    if not wanted:
        return []
    # a segment and its lock file count as one: either in use keeps both
    others = [int(entry.name) for entry in Path("/proc").iterdir() if entry.name.isdigit()]
    used = set().union(*(mapped_segments(process) for process in others if process != os.getpid()))
    kept = {name.removesuffix("_el") for name in used}
    removed = []
    for name in sorted({name.removesuffix("_el") for name in wanted} - kept):
        with _owner_is_dead(FOLDER / f"{name}_el") as dead:
            for each in (name + ending for ending in COMPANION_ENDINGS):
                if dead and _is_ours(FOLDER / each):
                    (FOLDER / each).unlink(missing_ok=True)
                    removed.append(each)
    return removed


@contextmanager
def _owner_is_dead(lock: Path) -> Iterator[bool]:
    """Hold the lock that the owner of a segment holds as long as it lives; False where it does. No
    lock: nobody owns it.
    """
    try:
        descriptor = os.open(lock, os.O_RDWR | os.O_NOFOLLOW | os.O_CLOEXEC)
    except OSError:
        yield True
        return
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        yield True
    except BlockingIOError:
        yield False
    finally:
        os.close(descriptor)


def _is_ours(path: Path) -> bool:
    """Whether it is a segment of the middleware that this user has made."""
    try:
        return path.name.startswith(PREFIXES) and path.lstat().st_uid == os.getuid()
    except OSError:
        return False


def _lines(path: Path) -> list[str]:
    try:
        return path.read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        return []  # gone, or of another user


def _open_files(process: int) -> list[str]:
    targets = []
    try:
        for entry in Path(f"/proc/{process}/fd").iterdir():
            targets.append(str(entry.readlink()))
    except OSError:
        return targets  # gone meanwhile, or of another user
    return targets
