"""Names that a package offers without importing what they come from before they are used."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from importlib import import_module
from types import ModuleType
from typing import Any

from contact_sim_pkg.requirements import packages_named

__all__ = ["let_call", "on_use"]


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


def let_call(module: str, place: str) -> None:
    """Let the package ``module`` be called as the function at ``module:name``, whose name is that of the package: `from
    contact_sim_pkg import run` gives the package where something has imported it before.
    """
    get = on_use(module, {"function": place})

    class Called(ModuleType):
        def __call__(self, *given: Any, **named: Any) -> Any:
            """As the function."""
            return get("function")(*given, **named)

    sys.modules[module].__class__ = Called
