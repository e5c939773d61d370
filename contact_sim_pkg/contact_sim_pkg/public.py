"""Names that a package offers without importing what they come from before they are used."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any

from contact_sim_pkg.requirements import packages_named

__all__ = ["on_use"]


def on_use(package: str, places: Mapping[str, str]) -> Callable[[str], Any]:
    """The `__getattr__` of a package: its public names, each from ``module:name`` when it is used.
    Raises AttributeError for any other name, PackageError where it needs a package that is missing or too old.
    """

    def get(name: str) -> Any:
        if name not in places:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        module, _, attribute = places[name].partition(":")
        with packages_named():
            return getattr(import_module(module), attribute)

    return get
