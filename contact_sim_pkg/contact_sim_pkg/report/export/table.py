"""A topic of a bag as columns: one row a sample with its time, each column with its unit."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact_sim_pkg.bag.columns import own_name
from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.reader import Bag
from contact_sim_pkg.memory import refuse_above_limit
from contact_sim_pkg.records.definitions import HEADER, Field, definition_of, parsed

__all__ = [
    "PERIODS",
    "UNITS_OF_NAMES",
    "FieldsByUse",
    "Map",
    "NoTableError",
    "TopicColumn",
    "TopicTable",
    "has_columns",
    "is_flat",
    "maps_of",
    "sorted_fields",
    "table_of",
    "table_of_records",
    "time_of",
]

PERIODS = ("sample_period", "period")
"""Fields that hold the time between the samples of a message."""
UNITS_OF_NAMES = "units"
"""Field with a unit for each name."""
UNITS = {
    "force": "N", "torque": "N m", "linear_acceleration": "m/s^2", "angular_velocity": "rad/s", "accel.linear": "m/s^2",
    "accel.angular": "rad/s^2", "twist.linear": "m/s", "twist.angular": "rad/s",
}  # fmt: skip
"""Units of standard messages, which do not state them."""
BYTES_PER_MESSAGE, BYTES_PER_BYTE = 1024, 4
"""Memory of a message in a table: its object, its fields as they came, and its rows in columns."""
LONGEST_ROW = 16
"""Elements of an array of a foreign message that become columns of their own."""


class NoTableError(BagError):
    """A topic has nothing that a table can hold, such as markers alone."""


class TopicColumn(NamedTuple):
    """One column."""

    name: str
    unit: str
    values: Any
    """[rows]"""

    @property
    def header(self) -> str:
        """`normal [N]`."""
        return f"{self.name} [{self.unit}]" if self.unit else self.name


class Map(NamedTuple):
    """An array of two sides in each message, such as a pressure field."""

    name: str
    unit: str
    sides: tuple[str, str]
    """fields of its rows and columns"""
    cells: int = 0
    """of all messages together, where they have been read"""


class TopicTable(NamedTuple):
    """A topic."""

    topic: str
    columns: list[TopicColumn]
    maps: list[Map]


class FieldsByUse(NamedTuple):
    """Fields of a type by what becomes of them."""

    scalars: list[Field]
    arrays: list[Field]
    named: list[Field]
    """arrays with a row for each name of another field"""
    maps: list[Field]


def table_of(bag: Bag, topic: str) -> TopicTable:
    """The table of a topic.

    Samples of a block become rows, each with its own time; events and points of a message rows with
    the time of the message; scalars of a message are repeated on its rows. Arrays of two sides
    are `maps`.

    Raises:
        BagError: no such topic, or a message does not fit its definition.
        MemoryLimitError: the table is too large.
    """
    row = bag.topic(topic)
    fields = _fields_of(bag, row.name)
    if fields is None:
        return _foreign(bag, row.name)
    times, messages, cells = _kept(bag, row.name, fields)
    maps = [each._replace(cells=cells[each.name]) for each in maps_of(bag, row.name)]
    return TopicTable(row.name, _columns(times, messages, fields), maps)


def table_of_records(topic: str, times: Sequence[float], records: Sequence[Any]) -> TopicTable:
    """The same of records of one type that have not been written, which `has_columns`; ``times`` [s] of each; without maps and
    their sizes.
    """
    fields = sorted_fields(list(definition_of(type(records[0]).__name__).record_fields))
    return TopicTable(topic, _columns(np.asarray(times, np.float64), records, fields), [])


def has_columns(record: Any) -> bool:
    """Whether no field of a record is a message itself."""
    return _is_flat(type(record).__name__)


@cache
def _is_flat(name: str) -> bool:
    return is_flat(definition_of(name).fields)


def is_flat(fields: Sequence[Field]) -> bool:
    """Whether no field but the header is a message itself: the names of these have a capital, or their package in front."""
    return all(field.type == HEADER or (field.type.islower() and "/" not in field.type) for field in fields)


def maps_of(bag: Bag, topic: str) -> list[Map]:
    """The maps of a topic, by its definition; no message is read."""
    fields = _fields_of(bag, topic)
    return [] if fields is None else [Map(each.name, each.unit, (each.shape[0], each.shape[1])) for each in fields.maps]


def _fields_of(bag: Bag, topic: str) -> FieldsByUse | None:
    """None for a type with others in it, or with another syntax than ours."""
    row = bag.topic(topic)
    try:
        fields = list(parsed(row.type, row.definition.partition("\n====")[0]).fields)
    except ValueError:
        return None
    return sorted_fields(fields) if is_flat(fields) else None


def sorted_fields(fields: list[Field]) -> FieldsByUse:
    """Fields of a type, none a message but the header, by what becomes of them."""
    texts = {field.name for field in fields if field.is_array and field.type == "string"}
    plain = [field for field in fields if field.type != HEADER]
    two = [field for field in plain if len(field.shape) == 2]
    named = [field for field in two if field.shape[0] in texts]
    headers = {*(field.shape[0] for field in named), UNITS_OF_NAMES}  # of columns; other texts are a column
    arrays = [field for field in plain if field.is_array and field not in two and field.name not in texts & headers]
    scalars = [field for field in plain if not field.is_array and field.name not in (*PERIODS, "samples")]
    return FieldsByUse(scalars, arrays, named, [field for field in two if field not in named])


def _columns(times: NDArray[np.float64], messages: Sequence[Any], fields: FieldsByUse) -> list[TopicColumn]:
    if not messages:
        return []
    period = next((name for name in PERIODS if hasattr(messages[0], name)), "")
    long = [field for field in fields.arrays if any(len(getattr(each, field.name)) for each in messages)]
    counts = _counts(messages, long, fields.named)
    rows = int(counts.sum())
    number = np.arange(rows) - np.repeat(np.cumsum(counts) - counts, counts)
    if period:
        start = np.repeat(times, counts) + number * np.repeat(
            [float(getattr(each, period)) for each in messages], counts
        )
        found = [TopicColumn("time", "s", start)]
    else:
        found = [TopicColumn("time", "s", np.repeat(times, counts))]
        found += [TopicColumn("index", "", number)] if long or fields.named else []
    for field in fields.scalars:
        values = np.array([getattr(each, field.name) for each in messages])
        found.append(TopicColumn(own_name(field.name), field.unit, np.repeat(values, counts)))
    for field in long:
        found.append(
            TopicColumn(
                own_name(field.name), field.unit, _filled([getattr(each, field.name) for each in messages], counts)
            )
        )
    for field in fields.named:
        names = [str(each) for each in getattr(messages[0], field.shape[0])]
        units = getattr(messages[0], UNITS_OF_NAMES, [field.unit] * len(names))
        parts = [np.reshape(getattr(each, field.name), (len(names), -1)) for each in messages]
        for place, (name, unit) in enumerate(zip(names, units, strict=True)):
            found.append(
                TopicColumn(f"{field.name}.{name}", str(unit), _filled([part[place] for part in parts], counts))
            )
    return found


def time_of(log_time: int, message: Any) -> float:
    """Stamp [s] of a message; without a header its log time, given in [ns]."""
    if not hasattr(message, "header"):
        return log_time / 1e9
    return float((message.header.stamp.sec * 10**9 + message.header.stamp.nanosec) / 1e9)


def _counts(messages: Sequence[Any], long: Sequence[Field], named: Sequence[Field]) -> NDArray[np.int64]:
    """Rows of each message: its longest array, at least one where the type has none."""
    if not long and not named:
        return np.ones(len(messages), dtype=np.int64)
    sizes = [[len(getattr(each, field.name)) for each in messages] for field in long]
    sizes += [
        [np.size(getattr(each, field.name)) // max(1, len(getattr(each, field.shape[0]))) for each in messages]
        for field in named
    ]
    largest: NDArray[np.int64] = np.array(sizes, dtype=np.int64).max(axis=0)
    return largest


def _filled(parts: Sequence[Any], counts: NDArray[np.int64]) -> Any:
    """Arrays of all messages in one column; nan, or an empty text, behind an array that is shorter than its
    message's rows."""
    if all(len(part) == count for part, count in zip(parts, counts, strict=True)):
        return np.concatenate([np.asarray(part) for part in parts])
    is_text = any(isinstance(value, str) for part in parts for value in part[:1])
    column = np.full(int(counts.sum()), "" if is_text else np.nan, dtype=object if is_text else np.float64)
    for start, part in zip(np.cumsum(counts) - counts, parts, strict=True):
        column[start : start + len(part)] = part
    return column


def _kept(bag: Bag, topic: str, fields: FieldsByUse) -> tuple[NDArray[np.float64], list[Any], dict[str, int]]:
    """Times [s] and messages of a topic, these without their maps, which would not fit into memory together; cells of
    each map.
    """
    cells = {field.name: 0 for field in fields.maps}
    times: list[float] = []
    messages: list[Any] = []
    needed = 0
    for raw in bag.messages(topic):
        needed += BYTES_PER_MESSAGE + BYTES_PER_BYTE * len(raw.data)
        if not fields.maps:
            refuse_above_limit(needed, f"{bag.path}, {topic}: the table of its first {len(times) + 1} messages")
        message = bag.decode(raw)
        for field in fields.maps:
            values = np.asarray(getattr(message, field.name))
            cells[field.name] += values.size
            needed -= BYTES_PER_BYTE * values.nbytes
            setattr(message, field.name, ())
        refuse_above_limit(needed, f"{bag.path}, {topic}: the table of its first {len(times) + 1} messages")
        times.append(time_of(raw.log_time, message))
        messages.append(message)
    return np.array(times), messages, cells


def _foreign(bag: Bag, topic: str) -> TopicTable:
    """A topic of nested or foreign messages: a row a message, fields with dots, short arrays one column an element."""
    columns = bag.columns(topic)
    found = [TopicColumn("time", "s", columns["time"] if "time" in columns else columns["log_time"] * 1e-9)]
    for name, values in columns.items():
        if name in ("time", "log_time", "stamp") or isinstance(values, list):
            continue
        unit = next((unit for part, unit in UNITS.items() if f".{name}.".find(f".{part}.") >= 0), "")
        if values.ndim == 1:
            found.append(TopicColumn(name, unit, values))
        elif values.ndim == 2 and values.shape[1] <= LONGEST_ROW:
            found += [TopicColumn(f"{name}.{place}", unit, values[:, place]) for place in range(values.shape[1])]
    if len(found) == 1:
        raise NoTableError(f"{bag.path}: {topic} has no fields of numbers or texts to write into a table")
    return TopicTable(topic, found, [])
