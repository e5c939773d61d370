"""Which of the processes that share a cache compiles a kernel, while the others wait for it.

A process that finds a kernel missing claims it. Another that needs it meanwhile waits and then reads
it, where both would spend the same seconds on it, and on a machine of two cores in each other's way.
It is a matter of time alone: whoever has waited for long, or cannot lock, compiles.

A claim is a lock on one byte of a file beside the cache's directories, at a place that follows from
the kernel's name: it ends with its process, however that ends. Nobody waits in a circle, for kernels
call each other in no circle, and a process claims only what it compiles, for as long as it does.
"""

from __future__ import annotations

import fcntl
import hashlib
import os
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

__all__ = ["claim", "given_back_on_failure", "release"]

LONGEST = 20.0  # [s] to wait: the other may have been suspended
_PERIOD = 0.005  # [s] between two looks
_NAME = ".claims"

_files: dict[Path, int] = {}  # descriptor of each cache's file; closing one would give back all its claims
_claimed: list[Path] = []  # callers first


def claim(path: Path) -> bool:
    """Claim the kernel that the cache keeps under ``path``; returns whether another process had it,
    which may have put it there by now.
    """
    waited, until = False, time.monotonic() + LONGEST
    _claimed.append(path)
    with suppress(OSError):  # a file system without locks
        while not _locks(path) and time.monotonic() < until:
            waited = True
            time.sleep(_PERIOD)
    return waited


def release(path: Path) -> None:
    """Give back the claim, and those made after it for what it calls."""
    if path in _claimed:
        _give_back(_claimed.index(path))


@contextmanager
def given_back_on_failure() -> Iterator[None]:
    """A block of code that compiles what was claimed last; where it fails nobody need wait for it."""
    first = len(_claimed) - 1
    try:
        yield
    except BaseException:
        _give_back(max(first, 0))
        raise


def _locks(path: Path) -> bool:
    root = path.parents[1]
    if root not in _files:
        _files[root] = os.open(root / _NAME, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC | os.O_NOFOLLOW, 0o600)
    try:
        fcntl.lockf(_files[root], fcntl.LOCK_EX | fcntl.LOCK_NB, 1, _place_of(path))
    except BlockingIOError:
        return False
    return True


def _give_back(first: int) -> None:
    while len(_claimed) > first:
        path = _claimed.pop()
        if path.parents[1] in _files:
            with suppress(OSError):
                fcntl.lockf(_files[path.parents[1]], fcntl.LOCK_UN, 1, _place_of(path))


def _place_of(path: Path) -> int:
    """A byte of a file that need not be that long."""
    return int(hashlib.sha256(f"{path.parent.name}/{path.name}".encode()).hexdigest()[:15], 16)
