"""Source files that machine code depends on: modules with kernels and all that they import. Starts
no compiler.
"""

from __future__ import annotations

import hashlib
import os
import re
from collections.abc import Iterator
from pathlib import Path

__all__ = ["digest_of_sources", "kernel_sources"]

_IMPORT = re.compile(rb"^from ([\w.]+) import ([^\n(]+|\([^)]*\))", re.MULTILINE)
_NAME = re.compile(rb"\w+")
_KERNELS = "compiled.jit"


def kernel_sources(package: Path) -> list[Path]:
    """Modules below the folder ``package`` that import the decorators of kernels, and what these
    import, sorted.

    An edit of a report, a schema or a node changes no machine code and keeps the cache.
    """
    return sorted(_kernel_texts(package))


def digest_of_sources(package: Path) -> str:
    """Checksum over names and contents of `kernel_sources`, as 64 hexadecimal digits."""
    digest = hashlib.sha256()
    for path, text in sorted(_kernel_texts(package).items()):
        digest.update(str(path.relative_to(package)).encode() + b"\0")
        digest.update(hashlib.sha256(text).digest())
    return digest.hexdigest()


def _kernel_texts(package: Path) -> dict[Path, bytes]:
    """Each file is read once: every start of a process waits for this."""
    outside = len(str(package.parent)) + 1
    paths = {str(path)[outside:-3].replace(os.sep, "."): path for path in package.rglob("*.py")}
    texts = {name: path.read_bytes() for name, path in paths.items()}
    decorators = f"{package.name}.{_KERNELS} import".encode()
    own = f"{package.name}.compiled."  # imported by version of numba
    found: set[str] = set()
    ahead = [name for name, text in texts.items() if decorators in text or name.startswith(own)]
    while ahead:
        name = ahead.pop()
        if name not in found:
            found.add(name)
            ahead += [each for each in _imports(texts[name]) if each in texts]
    return {paths[name]: texts[name] for name in found}


def _imports(text: bytes) -> Iterator[str]:
    """Names that a module imports, each as a module and as one inside a package."""
    for module, names in _IMPORT.findall(text):
        place = module.decode()
        yield place
        yield from (f"{place}.{name.decode()}" for name in _NAME.findall(names))
