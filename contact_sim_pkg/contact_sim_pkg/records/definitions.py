"""Message definitions: the fields of each `.msg` file, and the few standard types of ROS 2 Jazzy.

A `.msg` file alone defines the content of a message. These phrases in the comment of an array
count:

* `row-major, A x B`, or `length A`: the fields A and B are its sides; a number is the size of a
  side, an array is as long as the side,
* `empty without`: the array may be empty, and is where it is not given,
* `; kind K` at the end: what a requested accuracy bounds there, K one of `KINDS`; a column without
  is not judged. Of an array it needs the field `sample_period` or `period`.

Arrays without such sides, which are not a side themselves, have one length in a message.
"""

from __future__ import annotations

import re
from functools import cache
from importlib.resources import files
from typing import Any, NamedTuple

import numpy

PACKAGE = "contact_msgs_defs"
HEADER = "std_msgs/Header"
STANDARD = {
    "builtin_interfaces/msg/Time": "int32 sec\nuint32 nanosec\n",
    "std_msgs/msg/Header": "builtin_interfaces/Time stamp\nstring frame_id\n",
    "std_msgs/msg/String": "string data\n",
    "geometry_msgs/msg/Vector3": "float64 x\nfloat64 y\nfloat64 z\n",
    "geometry_msgs/msg/Wrench": "Vector3 force\nVector3 torque\n",
    "geometry_msgs/msg/WrenchStamped": "std_msgs/Header header\nWrench wrench\n",
    "rosgraph_msgs/msg/Clock": "builtin_interfaces/Time clock\n",
    "diagnostic_msgs/msg/KeyValue": "string key\nstring value\n",
    "diagnostic_msgs/msg/DiagnosticStatus": (
        "byte OK=0\nbyte WARN=1\nbyte ERROR=2\nbyte STALE=3\n"
        "byte level\nstring name\nstring message\nstring hardware_id\nKeyValue[] values\n"
    ),
    "diagnostic_msgs/msg/DiagnosticArray": "std_msgs/Header header\nDiagnosticStatus[] status\n",
}
"""Definitions of the standard types, without comments."""

_CONSTANT = re.compile(r"^\w+ +(?P<name>[A-Z]\w*) *= *(?P<value>-?\d+)$")
_FIELD = re.compile(r"^(?P<type>[\w/]+)(?P<array>\[\])? +(?P<name>[a-z]\w*)(?: +(?P<default>\S+))?$")
_SHAPE = re.compile(r"\brow-major, (\w+ x \w+)|\blength (\w+)$")
_KIND = re.compile(r"; kind (\w+)$")
_UNIT = re.compile(r"\[([^\],]+)")

KINDS = ("force", "motion", "peak", "area")
"""What `accuracy` bounds: contact forces, motion of bodies, peak pressure, contact area."""

RESOLVED = 0.1
"""Error of a component over its own largest value above which it is not resolved."""


class Field(NamedTuple):
    """One field of a message."""

    name: str
    type: str  # of an array that of its elements, such as float64, string or geometry_msgs/Vector3
    is_array: bool
    default: int | float | None  # of a number that may be left out
    shape: tuple[str, ...]  # of an array: the fields with its sides; empty where none is stated
    may_be_empty: bool
    comment: str
    kind: str = ""  # one of `KINDS`; empty: not judged

    @property
    def unit(self) -> str:
        """In the first brackets of the comment, such as `m/s^2`; empty where there are none."""
        found = _UNIT.search(self.comment)
        return found[1] if found else ""

    @property
    def has_default(self) -> bool:
        """Whether a record may be made without it."""
        return self.may_be_empty or self.default is not None

    @property
    def default_value(self) -> Any:
        """Value of the field in a record that is made without it: a number, or an array of no
        values.
        """
        if self.may_be_empty:
            return () if self.type == "string" else numpy.empty(0, self.type)
        return self.default


class Definition(NamedTuple):
    """Content of a message."""

    type_name: str  # package/msg/Name
    comment: str  # above the first field
    constants: dict[str, int]
    fields: tuple[Field, ...]

    @property
    def sides(self) -> frozenset[str]:
        """Names of the fields that an array has for a side."""
        return frozenset(side for field in self.fields for side in field.shape)

    @property
    def record_fields(self) -> tuple[Field, ...]:
        """Fields of a record: all but the header and the sizes in the shape of an array."""
        return tuple(
            field for field in self.fields if field.type != HEADER and (field.is_array or field.name not in self.sides)
        )


@cache
def texts() -> dict[str, str]:
    """Text of each definition by type name, ours with comments.

    Raises FileNotFoundError where ours are missing.
    """
    ours = {f"{PACKAGE}/msg/{name}": file.read_text(encoding="utf-8") for name, file in _files().items()}
    return {**STANDARD, **ours}


@cache
def _files() -> dict[str, Any]:
    """Our `.msg` files by the name of their message."""
    folder = files("contact_sim_pkg") / "msg"
    found = (
        {entry.name[:-4]: entry for entry in folder.iterdir() if entry.name.endswith(".msg")} if folder.is_dir() else {}
    )
    if not found:
        raise FileNotFoundError(
            f"the message definitions are missing in {folder}; install the package with its data again"
        )
    return found


@cache
def definition_of(name: str) -> Definition:
    """The definition of a message by its name without the package; KeyError where there is none."""
    for type_name, text in STANDARD.items():
        if type_name.endswith(f"/{name}"):
            return parsed(type_name, text)
    return parsed(f"{PACKAGE}/msg/{name}", _files()[name].read_text(encoding="utf-8"))


def parsed(type_name: str, text: str) -> Definition:
    """Definition in the text of a `.msg` file.

    Raises ValueError where a line is neither field nor constant, or a kind is unknown.
    """
    constants: dict[str, int] = {}
    fields: list[Field] = []
    above: list[str] = []
    # The comment lines above the first field describe the message
    for line in text.splitlines():
        statement, _mark, comment = (part.strip() for part in line.partition("#"))
        constant, field = _CONSTANT.match(statement), _FIELD.match(statement)
        if constant:
            constants[constant["name"]] = int(constant["value"])
        elif field:
            fields.append(_field(field, comment))
        elif statement:
            raise ValueError(f"{type_name}: {statement!r} is no field and no constant")
        elif not fields and not constants:
            above.append(comment)
    return Definition(type_name, "\n".join(above).strip(), constants, tuple(fields))


def _field(found: re.Match[str], comment: str) -> Field:
    kind = _kind(found["name"], comment)
    shape, given = _SHAPE.search(_KIND.sub("", comment)), found["default"]
    default: Any = None if given is None else float(given) if found["type"].startswith("float") else int(given)
    sides = tuple((shape[1] or shape[2]).split(" x ")) if shape else ()
    return Field(
        found["name"],
        found["type"],
        is_array=bool(found["array"]),
        default=default,
        shape=sides,
        may_be_empty="empty without" in comment,
        comment=comment,
        kind=kind,
    )


def _kind(name: str, comment: str) -> str:
    found = _KIND.search(comment)
    if found and found[1] not in KINDS:
        raise ValueError(f"{name}: kind {found[1]!r} is none of {', '.join(KINDS)}")
    return found[1] if found else ""
