"""What tools see of the message records: writes `records/messages.pyi` from the `.msg` files.

    python -m tests.records.message_stub

A test holds the file and the definitions together.
"""

from pathlib import Path

from contact_sim_pkg.records import messages
from contact_sim_pkg.records.definitions import PACKAGE, Definition, Field, definition_of, texts

STUB = Path(messages.__file__).with_suffix(".pyi")
STANDARD = ("Time", "String", "Vector3", "Wrench", "WrenchStamped", "Clock")
"""Standard messages that the bench makes records of."""
HEAD = '''\
"""Written by `python -m tests.records.message_stub` from the `.msg` files; see `messages.py`."""

from dataclasses import dataclass
from typing import Any, ClassVar, Self

import numpy
from numpy.typing import NDArray

from .definitions import Definition

def made(definition: Definition) -> Any: ...

class _Record:
    _fields: ClassVar[tuple[str, ...]]
    def _replace(self, **values: Any) -> Self: ...
    def _asdict(self) -> dict[str, Any]: ...
'''
PLAIN = {"string": "str", "bool": "bool"}


def stub() -> str:
    """The text of the stub."""
    ours = sorted(name.rpartition("/")[2] for name in texts() if name.startswith(PACKAGE))
    return HEAD + "".join(_class(definition_of(name)) for name in (*STANDARD, *ours))


def _class(definition: Definition) -> str:
    name = definition.type_name.rpartition("/")[2]
    constants = [f"    {constant}: ClassVar[int]\n" for constant in definition.constants]
    fields = [f"    {field.name}: {_type(field)}{_default(field)}\n" for field in definition.record_fields]
    return f"\n@dataclass(frozen=True, kw_only=True)\nclass {name}(_Record):\n" + "".join(constants + fields)


def _type(field: Field) -> str:
    if field.is_array:
        return "tuple[str, ...]" if field.type == "string" else f"NDArray[numpy.{field.type}]"
    number = "float" if field.type.startswith("float") else "int" if field.type.lstrip("u").startswith("int") else ""
    return PLAIN.get(field.type) or number or field.type.rpartition("/")[2]


def _default(field: Field) -> str:
    return " = ..." if field.has_default else ""


if __name__ == "__main__":
    STUB.write_text(stub(), encoding="utf-8")
