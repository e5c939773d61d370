"""Tables of cushions kept on disk, beside the compiled kernels (``compiled/kernel_cache.py``).

A file is named by the hash of everything that the table follows from: the description of the
cushion and the sources that compute it. It begins with the hash of its content; a file that does
not match is computed again and written anew. The last `MOST_KEPT` used stay.
"""

from __future__ import annotations

import hashlib
import io
import logging
import os
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import numpy

from contact_sim_pkg.compiled.kernel_cache import cache_directory
from contact_sim_pkg.laws import foam_elastic
from contact_sim_pkg.pressure.cushion.force_table import ForceTable

__all__ = ["kept_table"]

_log = logging.getLogger(__name__)
MOST_KEPT = 32
_DIGEST_BYTES = hashlib.sha256().digest_size


def kept_table(description: str, make: Callable[[], ForceTable], directory: Path | None = None) -> ForceTable:
    """The table that ``description`` stands for: read from disk where it was computed before, else
    made and kept.

    description: everything that the table follows from, exactly; directory: None for that of the
    kernels. Without a directory that can be written the table is computed at each start.
    """
    place = _directory() if directory is None else directory
    if place is None:
        return make()
    path = place / f"{_name(description)}.npz"
    found = _read(path)
    if found is None:
        found = make()
        _write(path, found)
    return found


def _directory() -> Path | None:
    """Beside the kernels; None where they are not kept, or it cannot be made."""
    place = cache_directory()
    if place is None:
        return None
    with suppress(OSError):
        (place / "cushions").mkdir(mode=0o700, exist_ok=True)
    return place / "cushions"


def _name(description: str) -> str:
    digest = hashlib.sha256(f"{numpy.__version__}\0{description}\0".encode())
    for source in (*sorted(Path(__file__).parent.glob("*.py")), Path(foam_elastic.__file__)):
        digest.update(source.read_bytes())
    return digest.hexdigest()[:20]


def _read(path: Path) -> ForceTable | None:
    """The table in a file; None where there is none, or a damaged one."""
    try:
        content = path.read_bytes()
    except OSError:
        return None
    digest, payload = content[:_DIGEST_BYTES], content[_DIGEST_BYTES:]
    if hashlib.sha256(payload).digest() != digest:
        _log.warning("the kept table of a cushion %s is damaged; it is computed again", path)
        return None
    with suppress(OSError):
        os.utime(path)  # the date of last use, by which the oldest are removed
    with numpy.load(io.BytesIO(payload), allow_pickle=False) as arrays:
        spacing, cell_area = (float(value) for value in arrays["scalars"])
        force, strain, pressure = (arrays[name] for name in ("force", "largest_strain", "pressure"))
        return ForceTable(spacing, cell_area, force, strain, pressure, str(arrays["end"]))


def _write(path: Path, table: ForceTable) -> None:
    """Write a file that appears whole or not at all, and remove the oldest beyond `MOST_KEPT`."""
    buffer = io.BytesIO()
    scalars = numpy.array([table.spacing, table.cell_area])
    numpy.savez(
        buffer, scalars=scalars, force=table.force, largest_strain=table.largest_strain, pressure=table.pressure,
        end=numpy.array(table.end),
    )  # fmt: skip
    payload = buffer.getvalue()
    draft = path.with_name(f".{path.name}.{os.getpid()}.new")
    try:
        draft.write_bytes(hashlib.sha256(payload).digest() + payload)
        draft.replace(path)
        kept = sorted(path.parent.glob("*.npz"), key=lambda each: each.stat().st_mtime, reverse=True)
        for each in kept[MOST_KEPT:]:
            each.unlink(missing_ok=True)
    except OSError as error:
        _log.warning("the table of a cushion is not kept on disk (each start takes a second longer): %s", error)
        with suppress(OSError):
            draft.unlink(missing_ok=True)
