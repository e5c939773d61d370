"""A new file that only grows, in a new directory; every error of the operating system is one
sentence.

A write that fails is undone, so the file always ends with a whole record. Nothing is buffered
here: what `write` returned from survives the death of the process, what `sync` returned from
survives the death of the machine.
"""

import errno
import fcntl
import os
from contextlib import suppress
from pathlib import Path

from contact_sim_pkg.bag.errors import BagError, BagWriteError

_FULL = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG}


class AppendFile:
    """An append-only file."""

    def __init__(self, descriptor: int, name: str) -> None:
        """Take over an open, empty file."""
        self._descriptor, self._name = descriptor, name
        self._size = self._synced = 0

    def write(self, data: bytes) -> int:
        """Append all of the data; BagWriteError with the file as it was before where that fails."""
        view, start = memoryview(data), self._size
        try:
            while view:
                written = os.pwrite(self._descriptor, view, self._size)
                self._size += written
                view = view[written:]
        except OSError as error:
            self._size = start
            with suppress(OSError):
                os.ftruncate(self._descriptor, start)
            cure = "free some space" if error.errno in _FULL else "check the disk"
            raise BagWriteError(f"{self._name} cannot grow beyond {start} bytes: {error.strerror}; {cure}") from None
        return len(data)

    def tell(self) -> int:
        """Bytes in the file."""
        return self._size

    def sync(self) -> None:
        """Force everything onto the disk; BagWriteError where that fails."""
        size = self._size
        if size == self._synced:
            return
        try:
            os.fdatasync(self._descriptor)
        except OSError as error:
            if error.errno not in (errno.EINVAL, errno.EROFS):  # a device or file system without sync
                raise BagWriteError(
                    f"{self._name} was not brought onto the disk: {error.strerror}; check the disk"
                ) from None
        self._synced = size

    def free_bytes(self) -> int:
        """Free bytes, for an ordinary user, of the file system of the file."""
        state = os.fstatvfs(self._descriptor)
        return state.f_bavail * state.f_frsize

    def close(self) -> None:
        """Close the file; BagWriteError where an earlier write has failed."""
        try:
            os.close(self._descriptor)
        except OSError as error:
            raise BagWriteError(f"{self._name} was not closed: {error.strerror}; check the disk") from None


def free_bytes_at(path: Path) -> int:
    """Free bytes, for an ordinary user, where the path is or would be created."""
    place = path.absolute()
    while not place.exists():
        place = place.parent
    state = os.statvfs(place)
    return state.f_bavail * state.f_frsize


def create_directory(directory: Path) -> None:
    """Create a directory that must not exist; its parents may. BagError where it exists or cannot
    be created.
    """
    try:
        directory.parent.mkdir(parents=True, exist_ok=True)
        directory.mkdir()
    except FileExistsError:
        raise BagError(
            f"{directory} exists already and is never overwritten; choose another name or remove it"
        ) from None
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        raise BagError(f"the bag directory {directory} cannot be created: {reason}; choose another place") from None
    sync_directory(directory.parent)


def create_file(directory: Path, name: str) -> AppendFile:
    """Create and lock a file that must not exist, without following a link; BagError where that
    fails.
    """
    flags = os.O_RDWR | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW | os.O_CLOEXEC
    try:
        descriptor = os.open(directory / name, flags, 0o644)
    except OSError as error:
        raise BagError(f"{directory / name} cannot be created: {error.strerror}; choose another place") from None
    with suppress(OSError):  # a file system without locks: creation was exclusive already
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    sync_directory(directory)
    return AppendFile(descriptor, name)


def is_being_written(path: Path) -> bool:
    """True while another process has the lock of a bag file; the lock ends with its process."""
    try:
        with path.open("rb") as file:
            fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except BlockingIOError:
        return True
    except OSError:
        return False
    return False


def write_whole(directory: Path, name: str, text: str) -> None:
    """Put a text file in place at once: all of it or nothing; BagWriteError where that fails."""
    draft = directory / f".{name}.new"
    try:
        with open(
            os.open(draft, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW, 0o644), "w", encoding="utf-8"
        ) as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
        draft.rename(directory / name)
    except OSError as error:
        with suppress(OSError):
            draft.unlink()
        raise BagWriteError(f"{name} was not written: {error.strerror}; free some space") from None
    sync_directory(directory)


def sync_directory(directory: Path) -> None:
    """Bring the entries of a directory onto the disk, where the file system can."""
    with suppress(OSError):
        descriptor = os.open(directory, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)
