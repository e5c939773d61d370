"""Source files that machine code depends on: modules with kernels and all that they import. Starts
no compiler.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterator
from pathlib import Path

__all__ = ["digest_of_sources", "kernel_sources"]

_IMPORT = re.compile(r"^from ([\w.]+) import ([^\n(]+|\([^)]*\))", re.MULTILINE)
_KERNELS = "compiled.jit"


def kernel_sources(package: Path) -> list[Path]:
    """Modules below the folder ``package`` that import the decorators of kernels, and what these
    import, sorted.

    An edit of a report, a schema or a node changes no machine code and keeps the cache.
    """
    found: set[Path] = set()
    ahead = [path for path in package.rglob("*.py") if f"{package.name}.{_KERNELS} import" in path.read_text()]
    while ahead:
        path = ahead.pop()
        if path not in found:
            found.add(path)
            ahead += _imports(path, package)
    return sorted(found)


def _imports(path: Path, package: Path) -> Iterator[Path]:
    """Files of the package that a module imports by absolute names."""
    for module, names in _IMPORT.findall(path.read_text()):
        if module.split(".")[0] == package.name:
            place = package.parent.joinpath(*module.split("."))
            candidates = [place, *(place / name for name in re.findall(r"\w+", names))]
            yield from (each.with_suffix(".py") for each in candidates if each.with_suffix(".py").is_file())


def digest_of_sources(package: Path) -> str:
    """Checksum over names and contents of `kernel_sources`, as 64 hexadecimal digits."""
    digest = hashlib.sha256()
    for path in kernel_sources(package):
        digest.update(str(path.relative_to(package)).encode() + b"\0")
        digest.update(hashlib.sha256(path.read_bytes()).digest())
    return digest.hexdigest()
