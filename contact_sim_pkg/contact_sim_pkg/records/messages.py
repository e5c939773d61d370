"""Messages as records, such as `ContactForce(block=3, sample_period=1e-3, normal=...)`.

Each type is made from its `.msg` file on first use: a named tuple with the fields of the message,
its constants beside them. Values are given by name alone, so a field may move or be added without
an edit elsewhere. The header and the sizes of arrays are no fields: the encoder fills them in. Type
checkers read `messages.pyi`, which `python -m tests.records.message_stub` writes from the same
files.
"""

from __future__ import annotations

from collections import namedtuple
from typing import Any

from contact_sim_pkg.records.definitions import Definition, definition_of

__all__ = ["made"]


def made(definition: Definition) -> Any:
    """The class of a message's records."""
    names = [field.name for field in definition.record_fields]
    defaults = {field.name: field.default_value for field in definition.record_fields if field.has_default}
    name = definition.type_name.rpartition("/")[2]
    base: Any = namedtuple(name, names)  # type: ignore[misc]

    def by_name(cls: Any, /, **values: Any) -> Any:
        return base.__new__(cls, **{**defaults, **values})

    inside = {"__slots__": (), "__new__": by_name, "__module__": __name__, "__doc__": definition.comment}
    return type(name, (base,), {**inside, **definition.constants})


def __getattr__(name: str) -> Any:
    try:
        definition = definition_of(name)
    except KeyError:
        raise AttributeError(f"no message is called {name}") from None
    return globals().setdefault(name, made(definition))
