"""Tuples that stay in the hands of compiled code between two calls from Python.

An argument is taken apart at each call: a tuple of fifty arrays takes 10 us. `hold` hands it over
once; an entry that is given what it returned reads the tuple as `held.value`, as Python does.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Generic, NamedTuple, TypeVar

from contact_sim_pkg.compiled.tested import IS_TESTED

__all__ = ["Held", "hold"]

Value = TypeVar("Value")

if IS_TESTED or TYPE_CHECKING:
    from contact_sim_pkg.compiled.held_reference import Held, hold
else:

    class Held(NamedTuple, Generic[Value]):
        """A tuple under a name: numba takes it apart at each call."""

        value: Value

    def hold(value: Value) -> Held[Value]:
        """Put a tuple under the name."""
        return Held(value)
