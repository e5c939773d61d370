"""The one way to open a file from outside and to make a file that a user asked for.

An input is a regular file of known size, so that no pipe, device or file of /proc makes a command wait for ever. An output is made
anew: nothing that exists is written over unasked, and what the command reads never is.
"""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO, Any, BinaryIO

__all__ = [
    "BAG_ENDINGS", "FileRefusedError", "RefusedError", "as_cell", "check_output", "new_file", "open_regular_file", "printable",
    "printable_lines", "read_regular_file", "wrong_name",
]  # fmt: skip

BAG_ENDINGS = (".mcap", ".db3", ".bag")
"""Of the file of a bag."""
FORMULA = ("=", "+", "-", "@", "\t", "\r")
"""A text that begins so is a formula to a spreadsheet."""
LONGEST_COMPONENT = 255  # bytes between two slashes, on every usual file system
LONGEST_PATH = 4095  # bytes
EXISTS = "exists already and is not written over; give another name or --overwrite"
_KINDS = (
    (stat.S_ISDIR, "is a directory"),
    (stat.S_ISFIFO, "is a named pipe"),
    (stat.S_ISCHR, "is a device"),
    (stat.S_ISBLK, "is a device"),
    (stat.S_ISSOCK, "is a socket"),
)


class RefusedError(Exception):
    """Bad input: the text is a sentence, or several, that says what is wrong, where, the value, what is allowed and the cure.
    Nothing has been started.
    """


class FileRefusedError(OSError):
    """A file that is not opened: `strerror` is what is wrong and the cure, `filename` the path; bad input, not a fault of a run."""

    def __init__(self, path: str | Path, reason: str, number: int = errno.EINVAL) -> None:
        """The error of a path; `number` is its errno, for who asks."""
        super().__init__(number, reason, str(path))


def printable(text: str, longest: int = 200) -> str:
    """A text from outside as it may stand in a sentence: on one line, without escape sequences, cut to `longest` characters."""
    shown = text if len(text) <= longest else text[: longest - 1] + "…"
    return shown if shown.isprintable() else "".join(each if each.isprintable() else repr(each)[1:-1] for each in shown)


def printable_lines(text: str) -> str:
    """A text of several lines from outside as it may be printed: whole, but without escape sequences that move a cursor."""
    return "\n".join(printable(line, longest=len(line)) for line in text.split("\n"))


def as_cell(value: Any) -> Any:
    """A value as a cell of a CSV: a text that a spreadsheet would compute stays one, by the apostrophe that spreadsheets know."""
    return f"'{value}" if isinstance(value, str) and value.startswith(FORMULA) else value


def wrong_name(path: Path) -> str:
    """Why a file or directory of this name is not made, with the cure; empty where nothing speaks against the name."""
    if not str(path).isprintable():
        return "has a line break or another control character in its name; give another name"
    longest = max(len(os.fsencode(part)) for part in path.absolute().parts)
    if longest > LONGEST_COMPONENT:
        return f"has {longest} bytes in one name, {LONGEST_COMPONENT} are possible; give a shorter one"
    whole = len(os.fsencode(path.absolute()))
    return f"has {whole} bytes, {LONGEST_PATH} are possible; give a shorter one" if whole > LONGEST_PATH else ""


def open_regular_file(path: str | Path) -> BinaryIO:
    """Open an existing file for reading bytes, without ever waiting for it.

    Raises:
        FileRefusedError: it is not there, may not be read, is a directory, pipe, device or socket, or has content but no size, as
            files of /proc have.
    """
    try:
        _refuse_kind(path, Path(path).stat().st_mode)  # before opening: that alone can act on a device
        descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_NOCTTY | os.O_CLOEXEC)
    except FileRefusedError:
        raise
    except (OSError, ValueError) as error:  # ValueError: a NUL in the name
        raise FileRefusedError(
            path, getattr(error, "strerror", None) or str(error), getattr(error, "errno", None) or errno.EINVAL
        ) from None
    try:
        status = os.fstat(descriptor)
        _refuse_kind(path, status.st_mode)
        if status.st_size == 0 and _has_content(descriptor):
            raise FileRefusedError(
                path, "has content but no size, as files of the system have; copy it to a plain file"
            )
        return os.fdopen(descriptor, "rb")
    except BaseException:
        os.close(descriptor)
        raise


def read_regular_file(path: str | Path, most: int, cure: str = "give a smaller file") -> bytes:
    """The whole content of an existing file of at most `most` bytes; FileRefusedError as above, or where it is larger."""
    with open_regular_file(path) as file:
        size = os.fstat(file.fileno()).st_size
        if size <= most:
            content = file.read(size + 1)  # one more: it may have grown
            size = max(size, len(content))
    if size > most:
        raise FileRefusedError(path, f"has {size} bytes; at most {most} bytes are read; {cure}", errno.EFBIG)
    return content


def check_output(
    path: Path,
    inputs: Iterable[Path | None] = (),
    *,
    overwrite: bool = False,
    ours: Callable[[Path], bool] | None = None,
) -> None:
    """Refuse a file to be made that exists, before any work is done for it.

    Args:
        path: the file to be made.
        inputs: files and bags that the command reads; none of them is written over, whatever `overwrite` says.
        overwrite: an existing regular file may be replaced.
        ours: whether an existing file is one that the same command made and may make again; None: no file is.

    Raises:
        FileRefusedError: it exists, is an input, its directory is not there, or it has no possible name.
    """
    if reason := wrong_name(path):
        raise FileRefusedError(path, reason)
    remade = ours is not None and path.is_file() and ours(path)
    for each in inputs:
        if each is not None and not remade and _belongs_to(path, each):
            raise FileRefusedError(path, f"is read by this command ({each}) and is not written over; give another name")
    try:
        mode = path.stat().st_mode if path.exists() else path.lstat().st_mode
    except FileNotFoundError:
        if not path.parent.is_dir():
            raise FileRefusedError(path, "cannot be written: its directory is not there; make it first") from None
        if not os.access(path.parent, os.W_OK | os.X_OK):
            raise FileRefusedError(path, "cannot be written: its directory is not writable", errno.EACCES) from None
        return
    except OSError as error:
        raise FileRefusedError(path, f"cannot be written: {error.strerror}", error.errno or errno.EINVAL) from None
    _refuse_kind(path, mode)
    if not stat.S_ISREG(mode):
        raise FileRefusedError(path, "is a link to nothing; remove it or give another name")
    if not overwrite and not remade:
        raise FileRefusedError(path, EXISTS, errno.EEXIST)


@contextmanager
def new_file(
    path: Path,
    inputs: Iterable[Path | None] = (),
    *,
    overwrite: bool = False,
    ours: Callable[[Path], bool] | None = None,
) -> Iterator[IO[bytes]]:
    """A file to write bytes into; it appears under its name whole, or not at all. Arguments and refusals: `check_output`.

    Raises:
        FileRefusedError: as `check_output`, also for what appeared in the meantime. OSError: it cannot be written.
    """
    check_output(path, inputs, overwrite=overwrite, ours=ours)
    target, replaces = path.resolve(), path.exists()
    draft = target.with_name(f".bench-{os.getpid()}.new")
    try:
        with open(draft, "xb") as file:
            yield file
        if replaces:
            draft.replace(target)
        else:
            _name_exclusively(draft, target)
    except OSError as error:  # a full disk does not say which
        error.filename = error.filename or str(path)
        raise
    finally:
        draft.unlink(missing_ok=True)


def _name_exclusively(draft: Path, target: Path) -> None:
    """Give the draft its name, unless there is a file of that name by now."""
    try:
        target.hardlink_to(draft)
    except FileExistsError:
        raise FileRefusedError(target, EXISTS, errno.EEXIST) from None
    except OSError:  # a file system without hard links
        with open(target, "xb") as file:
            file.write(draft.read_bytes())


def _belongs_to(path: Path, given: Path) -> bool:
    """Whether the existing file is `given`, or one of the files of the bag that it is."""
    with suppress(OSError):
        files = [*given.glob("*.mcap"), given / "metadata.yaml"] if given.is_dir() else [given]
        return any(file.exists() and path.samefile(file) for file in files)
    return False


def _refuse_kind(path: str | Path, mode: int) -> None:
    for is_kind, sentence in _KINDS:
        if is_kind(mode):
            raise FileRefusedError(path, f"{sentence}; a regular file is needed")


def _has_content(descriptor: int) -> bool:
    try:
        return bool(os.pread(descriptor, 1, 0))
    except OSError:  # nothing to read at this moment
        return True
