"""Packages of others that machine code depends on: which they are, and a checksum of their sources.

A kernel of ours depends on ours alone, unless it is compiled for a type of another package, such as
the record of a plug-in's effect. A kernel of a plug-in depends on the plug-in and on what it
imports. So the same plug-in never makes our kernels cold, and no edit in any of its files leaves
one of its own as it was.
"""

# numba's types have no types.
# mypy: disallow-any-expr=False

from __future__ import annotations

import hashlib
import re
import sys
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

__all__ = ["digest_of_packages", "package_of", "packages_in"]

_IMPORT = re.compile(rb"^\s*(?:from|import) +([A-Za-z_]\w*)", re.MULTILINE)
_OWN = __name__.partition(".")[0]
LARGEST_FILE = 10_000_000
"""[bytes] of a file that counts: a larger one is data that no kernel is made from."""
_LIBRARIES = frozenset(
    {_OWN, "numba", "llvmlite", "numpy", "scipy", "mpmath", "matplotlib", "pandas", "click"}
) | frozenset(sys.stdlib_module_names)
"""Their versions, where code depends on them, are in the fingerprint of our own sources."""


def package_of(module: str) -> str:
    """Outermost package of a module that is not ours; empty for ours and for libraries."""
    name = module.partition(".")[0]
    return "" if name in _LIBRARIES else name


def packages_in(types: Iterable[Any]) -> frozenset[str]:
    """Packages of others in numba's ``types``: of named tuples, held ones too, of functions, in any depth."""
    return frozenset().union(*map(_packages_of_type, types))


@cache
def _packages_of_type(numba_type: Any) -> frozenset[str]:
    named = [type(numba_type).__module__]
    for attribute in ("instance_class", "typing_key"):
        named.append(getattr(getattr(numba_type, attribute, None), "__module__", None) or "")
    function = getattr(getattr(numba_type, "dispatcher", None), "py_func", None)
    named.append(getattr(function, "__module__", ""))
    fields = getattr(numba_type, "field_dict", {}).values()  # of what `compiled/held.py` holds
    inside = [*(getattr(numba_type, "types", None) or ()), *fields, getattr(numba_type, "type", None)]
    found = {package_of(module) for module in named} - {""}
    return frozenset(found).union(*(_packages_of_type(each) for each in inside if each is not None))


@cache
def digest_of_packages(names: frozenset[str]) -> str:
    """Checksum over all files of packages and of what they import by statements, as 64 hexadecimal
    digits. They have been imported; libraries are left out.
    """
    digest = hashlib.sha256()
    found: set[str] = set()
    ahead = sorted(names)
    while ahead:
        name = ahead.pop(0)
        if name in found:
            continue
        found.add(name)
        for place, text in _texts(name):
            digest.update(f"{name}/{place}\0".encode())
            digest.update(hashlib.sha256(text).digest())
            statements = _IMPORT.findall(text) if place.endswith(".py") or not place else []
            imported = {package_of(each.decode()) for each in statements} - {""}
            ahead += sorted(each for each in imported if each in sys.modules)
    return digest.hexdigest()


def _texts(name: str) -> Iterator[tuple[str, bytes]]:
    """Files of a package, its data included, or of a single module: path below it, content."""
    module = sys.modules.get(name)
    folders = [Path(folder) for folder in getattr(module, "__path__", ())]
    for folder in folders:
        for path in sorted(folder.rglob("*")):
            if path.is_file() and "__pycache__" not in path.parts and path.stat().st_size <= LARGEST_FILE:
                yield path.relative_to(folder).as_posix(), path.read_bytes()
    file = getattr(module, "__file__", None)
    if not folders and file:
        yield "", Path(file).read_bytes()
