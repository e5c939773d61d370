"""Arrays that take a while to compute, kept on disk beside the compiled kernels
(``compiled/kernel_cache.py``).

A file is named by the hash of everything that its arrays follow from: a description and the sources
that compute them. It begins with the hash of its content; a file that does not match, or that
others own or can write to, is not taken: its arrays are computed again and written anew. Those of a kind
that were used last stay, up to `MOST_BYTES`.
"""

from __future__ import annotations

import hashlib
import io
import logging
import os
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.kernel_cache import (
    DamagedError,
    UntrustedError,
    cache_directory,
    read_kept,
    require_private,
    write_kept,
)

__all__ = ["Arrays", "kept_arrays"]

_log = logging.getLogger(__name__)
Arrays = dict[str, NDArray[Any]]
MOST_BYTES = 1_000_000_000
"""Of a kind: some hundred cushions, thousands of tires; a sweep comes back to each of its own."""


def kept_arrays(
    kind: str, description: str, sources: Iterable[str | Path], make: Callable[[], Mapping[str, Any]],
    directory: Path | None = None,
) -> Arrays:  # fmt: skip
    """The arrays that ``description`` stands for: read from disk where they were computed before,
    else made and kept.

    kind: name of their folder; description: everything that they follow from, exactly; sources:
    files that compute them; directory: None for that of the kernels. Without a directory that can be
    written they are computed at each start.
    """
    place = _directory(kind) if directory is None else directory
    if place is None:
        return {name: numpy.asarray(value) for name, value in make().items()}
    path = place / f"{_name(description, sources)}.npz"
    found = _read(path)
    if found is None:
        found = {name: numpy.asarray(value) for name, value in make().items()}
        _write(path, found)
    return found


def _directory(kind: str) -> Path | None:
    """Beside the kernels; None where they are not kept, or it cannot be made or trusted."""
    place = cache_directory()
    if place is None:
        return None
    try:
        (place / kind).mkdir(mode=0o700, parents=True, exist_ok=True)
        require_private(place / kind)
    except OSError as error:
        _log.warning("tables are not kept on disk (each start takes a second longer): %s", error)
        return None
    return place / kind


def _name(description: str, sources: Iterable[str | Path]) -> str:
    digest = hashlib.sha256(f"{numpy.__version__}\0{description}\0".encode())
    for source in sources:
        digest.update(Path(source).read_bytes())
    return digest.hexdigest()[:20]


def _read(path: Path) -> Arrays | None:
    """The arrays in a file; None where there is none, or one that is damaged or not to be trusted."""
    try:
        payload = read_kept(path)
    except (UntrustedError, DamagedError) as error:
        _log.warning("the kept table %s; it is computed again", error)
        return None
    except OSError:
        return None
    with suppress(OSError):
        os.utime(path)  # the date of last use, by which the oldest are removed
    with numpy.load(io.BytesIO(payload), allow_pickle=False) as arrays:
        return dict(arrays)


def _kept_in(place: Path) -> Iterator[tuple[float, int, Path]]:
    """Date of last use, bytes and path of each file; one that another process removes meanwhile is left out."""
    for each in place.glob("*.npz"):
        with suppress(FileNotFoundError):
            found = each.stat()
            yield found.st_mtime, found.st_size, each


def _write(path: Path, arrays: Arrays) -> None:
    """Write a file that appears whole or not at all, and remove the oldest beyond `MOST_BYTES`."""
    buffer = io.BytesIO()
    numpy.savez(buffer, **arrays)  # type: ignore[arg-type]
    try:
        write_kept(path, buffer.getvalue())
        left = MOST_BYTES
        for _used, size, each in sorted(_kept_in(path.parent), reverse=True):
            left -= size
            if left < 0:
                each.unlink(missing_ok=True)
    except OSError as error:
        _log.warning("a table is not kept on disk (each start takes a second longer): %s", error)
