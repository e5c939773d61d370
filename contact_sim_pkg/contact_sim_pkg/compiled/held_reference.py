"""Held tuples (`held.py`) as references, on numba's inside."""

# numba has no types.
# mypy: disallow-untyped-calls=False

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, Generic, TypeVar

from numba import config
from numba.core import types
from numba.experimental import structref
from numba.extending import intrinsic

from contact_sim_pkg.compiled.jit import entry

__all__ = ["Held", "hold"]

Value = TypeVar("Value")


@structref.register
class _HeldType(types.StructRef):
    """Type of what is held, by that of its value."""


class Held(structref.StructRefProxy, Generic[Value]):
    """A tuple that compiled code holds; its arrays are those of ``value``."""

    value: Value


structref.define_proxy(Held, _HeldType, ["value"])


def _empty_of(typing_context: Any, value: Any) -> Any:
    """What holds a value of this type; `Held(value)` would compile a constructor for each type."""
    held: Any = _HeldType([("value", value)])
    _, generate = structref.new._defn(typing_context, types.TypeRef(held))
    return held(value), generate


_empty: Any = intrinsic(_empty_of)


@entry
def _handed_over(value: Any) -> Any:
    held = _empty(value)
    held.value = value
    return held


def hold(value: Value) -> Held[Value]:
    """Hand a tuple over to compiled code."""
    is_plain = config.DISABLE_JIT  # type: ignore[attr-defined]  # set as numba reads its environment
    held: Any = SimpleNamespace() if is_plain else _handed_over(value)
    held.value = value
    return held  # type: ignore[no-any-return]
