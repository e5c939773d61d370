"""Messages of one type stacked into arrays, one column a field.

Messages of one layout lie at the same distances in memory, so their fields are read as columns, not
message by message. They are taken in batches: of a message no more is kept than the fields wanted.
"""

import sys
from collections.abc import Callable, Iterable
from itertools import chain
from typing import Any, NamedTuple

import numpy
from rosbags.interfaces import Nodetype
from rosbags.typesys.store import Typestore

from contact_sim_pkg.bag.encoding import SECOND
from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.memory import refuse_above_limit

_TIME = "builtin_interfaces/msg/Time"
_HEADER = "header."
_TIMES = ("time", "log_time")  # columns beside the fields of a message
_BATCH_MESSAGES, _BATCH_BYTES = 4096, 4 << 20
_LONGEST_TEXT = 16 << 20  # [bytes] of a text in a message
_ENCAPSULATION = 4  # bytes before the content of a message, from which its alignment counts
_KINDS = {
    "bool": "?", "byte": "u1", "char": "u1", "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2", "int32": "i4",
    "uint32": "u4", "int64": "i8", "uint64": "u8", "float32": "f4", "float64": "f8",
}  # fmt: skip
"""numpy's name of each number"""

Decode = Callable[[int, bytes], Any]
"""Message object of a raw message; BagError where it does not fit its definition."""
Getter = Callable[[Any], Any]


class Stack:
    """Columns of messages that come one by one; `Bag.columns` describes them."""

    def __init__(
        self, store: Typestore, type_name: str, fields: tuple[str, ...] | None, decode: Decode, where: str = ""
    ) -> None:
        """No message yet. BagError for a field that the type does not have.

        Args:
            store: with the type and those in it.
            type_name: of all messages.
            fields: columns wanted; all where it is None.
            decode: of the bag.
            where: name of the topic, for a refusal.
        """
        getters = dict(_getters(store, type_name, "", lambda message: message))
        derived = {*_TIMES} if "stamp" in getters else {"log_time"}
        unknown = set(fields or ()) - set(getters) - derived
        if unknown:
            raise BagError(f"{type_name} has no field {', '.join(sorted(unknown))}; it has {', '.join(getters)}")
        self._store, self._type_name, self._fields, self._decode = store, type_name, fields, decode
        self._wanted = {
            name: getter for name, getter in getters.items() if fields is None or name in fields or name == "stamp"
        }
        self._plain, self._where = _is_plain(store, type_name), where or type_name
        self._rows: list[tuple[int, bytes]] = []
        self._waiting = self._messages = self._kept = 0  # bytes in `rows`; messages and bytes in `parts`
        self._parts: list[dict[str, Any]] = []

    def add(self, log_time: int, data: bytes) -> None:
        """Take a message with its log time [ns].

        BagError where it does not fit its definition, MemoryLimitError where the columns become too large.
        """
        self._rows.append((log_time, data))
        self._waiting += len(data)
        if len(self._rows) >= _BATCH_MESSAGES or self._waiting >= _BATCH_BYTES:
            self._take()

    def columns(self) -> dict[str, Any]:
        """The columns of all messages taken; they are handed over, the stack is empty then. Errors as of `add`."""
        self._take()
        columns = {name: _joined([part.pop(name) for part in self._parts]) for name in ("log_time", *self._wanted)}
        if "stamp" in columns:
            columns["time"] = columns["stamp"] / SECOND
        return {name: column for name, column in columns.items() if self._fields is None or name in self._fields}

    def _take(self) -> None:
        """Turn the messages that wait into columns."""
        rows, self._rows, self._waiting, start = self._rows, [], 0, 0
        while start < len(rows):
            # The first message is checked; its neighbours of the same layout need no check
            message, stop = self._decode(*rows[start]), start + 1
            layout = _Layout(rows[start][1], self._store, self._type_name) if self._plain else None
            while layout is not None and stop < len(rows) and layout.fits(rows[stop][1]):
                stop += 1
            if layout is None or stop == start + 1:
                part = {name: _column([getter(message)]) for name, getter in self._wanted.items()}
            else:
                content = b"".join(data for _, data in rows[start:stop])
                part = {name: layout.column(name, content) for name in self._wanted}
            part["log_time"] = _column([log_time for log_time, _ in rows[start:stop]])
            self._keep(part, stop - start)
            start = stop

    def _keep(self, part: dict[str, Any], messages: int) -> None:
        self._messages += messages
        self._kept += sum(map(_size, part.values()))
        # Twice: a column and its parts are there together while they are joined
        refuse_above_limit(2 * self._kept, f"{self._where}: the table of its first {self._messages} messages")
        self._parts.append(part)


def _size(column: Any) -> int:
    """[bytes] of a column; equal texts of a layout are one object."""
    if isinstance(column, numpy.ndarray) and column.dtype != object:
        return column.nbytes
    rows = column.ravel().tolist() if isinstance(column, numpy.ndarray) else column
    return 8 * len(rows) + sum({id(row): _size_of(row) for row in rows}.values())


def _size_of(row: Any) -> int:
    if isinstance(row, numpy.ndarray):
        return int(row.nbytes)
    return sum(map(sys.getsizeof, row)) if isinstance(row, list) else sys.getsizeof(row)


def _joined(parts: list[Any]) -> Any:
    if len({part.shape[1:] if isinstance(part, numpy.ndarray) else None for part in parts} | {None}) != 2:
        return _column([*chain(*parts)])
    # Integers are signed or not as each part needs it, and together would become floats
    if len({part.dtype for part in parts}) > 1:
        return _column([*chain(*(part.tolist() for part in parts))])
    return numpy.concatenate(parts)


def _column(rows: list[Any]) -> Any:
    """[messages] of scalars, [messages, length] of arrays of one length, else the list as it is.

    Texts are objects: in an array of texts each would take the memory of the longest.
    """
    first = rows[0] if rows else None
    if isinstance(first, (list, numpy.ndarray)) and len({len(row) for row in rows}) > 1:
        return rows
    if isinstance(first, list) and any(not isinstance(item, str) for item in first):
        return rows  # sub-messages stay objects
    if isinstance(first, int) and max(rows) >= 2**63:
        return numpy.array(rows, dtype=numpy.uint64)
    return numpy.array(rows, dtype=object if isinstance(first, (list, str)) else None) if rows else numpy.empty(0)


class _Values(NamedTuple):
    """Place of a number, or of an array of numbers, in every message of a layout."""

    offset: int
    kind: numpy.dtype[Any]
    length: int | None
    """of an array; None for a number"""


class _Layout:
    """Where the fields of a message lie; the same in all that have its lengths and texts.

    CDR: numbers are aligned by their size, a sequence or text begins with its length.
    """

    def __init__(self, data: bytes, store: Typestore, type_name: str) -> None:
        """Layout of a message that is known to fit its definition, which is plain."""
        self._data, self._store, self._type_name = data, store, type_name
        self._order = "<" if data[1] else ">"
        self._end = _ENCAPSULATION
        self._same = [slice(0, 2)]
        self._fields: dict[str, _Values | str | list[str]] = {}
        self._add(type_name, "")
        self._expected = [(part, data[part]) for part in self._same]

    def fits(self, data: bytes) -> bool:
        """Whether a message has this layout."""
        return len(data) == len(self._data) and all(data[part] == expected for part, expected in self._expected)

    def column(self, name: str, content: bytes) -> Any:
        """A field of messages that have this layout, one behind the other in `content`."""
        messages = len(content) // len(self._data)
        if f"{name}.nanosec" in self._fields and name not in self._fields:
            seconds, nanoseconds = (self.column(f"{name}.{part}", content) for part in ("sec", "nanosec"))
            return seconds * SECOND + nanoseconds
        field = self._fields[name]
        if not isinstance(field, _Values):
            return _column([field] * messages)
        shape, strides = (messages, 1 if field.length is None else field.length), (len(self._data), field.kind.itemsize)
        values: Any = numpy.ndarray(shape, field.kind, content, field.offset, strides)
        # Scalars become what Python makes of them, as in messages read one by one
        return _column(values[:, 0].tolist()) if field.length is None else values.astype(field.kind.newbyteorder("="))

    def _add(self, type_name: str, prefix: str) -> None:
        definitions: Any = self._store.fielddefs[type_name][1]
        for name, (kind, detail) in definitions:
            full = f"{prefix}{name}"
            if kind is Nodetype.NAME:
                self._add(detail, f"{full}.")
                continue
            base, count = (detail, None) if kind is Nodetype.BASE else (detail[0][1], detail[1])
            if kind is Nodetype.SEQUENCE:
                count = self._length()
            full = _shown(full)
            if base[0] == "string":
                texts = [self._text() for _ in range(1 if count is None else count)]
                self._fields[full] = texts[0] if count is None else texts
            else:
                self._fields[full] = self._values(base[0], count)

    def _values(self, kind: str, count: int | None) -> _Values:
        values = numpy.dtype(self._order + _KINDS[kind])
        if count != 0:
            self._align(values.itemsize)
        offset = self._end
        self._end += values.itemsize * (1 if count is None else count)
        return _Values(offset, values, count)

    def _text(self) -> str:
        start = self._end + (-self._end % 4) + 4
        length = self._length()
        if length > _LONGEST_TEXT:
            raise BagError(f"a {self._type_name} holds a text of {length} bytes; at most {_LONGEST_TEXT} are read")
        self._end = start + length
        self._same.append(slice(start, self._end))
        return self._data[start : self._end - 1].decode()

    def _length(self) -> int:
        """The length that stands here, of a text or sequence."""
        self._align(4)
        place = slice(self._end, self._end + 4)
        self._same.append(place)
        self._end = place.stop
        return int.from_bytes(self._data[place], "little" if self._order == "<" else "big")

    def _align(self, size: int) -> None:
        self._end += (_ENCAPSULATION - self._end) % size


def _is_plain(store: Typestore, type_name: str) -> bool:
    """Whether all fields of a type are numbers, texts, and arrays of these."""
    for _, (kind, detail) in store.fielddefs[type_name][1]:
        if kind is Nodetype.NAME:
            if not _is_plain(store, str(detail)):
                return False
            continue
        node: Any = (kind, detail) if kind is Nodetype.BASE else detail[0]
        if node[0] is not Nodetype.BASE or node[1][0] not in (*_KINDS, "string"):
            return False
    return True


def _getters(store: Typestore, type_name: str, prefix: str, reach: Getter) -> Iterable[tuple[str, Getter]]:
    """Name and getter of each leaf; a header's leaves lose their prefix, a time is one integer in
    [ns].
    """
    for name, (kind, detail) in store.fielddefs[type_name][1]:
        full = f"{prefix}{name}"
        getter = _then(reach, name)
        if kind is not Nodetype.NAME:
            yield _shown(full), getter
        elif detail == _TIME:
            yield _shown(full), _nanoseconds(getter)
        else:
            yield from _getters(store, str(detail), f"{full}.", getter)


def own_name(field: str) -> str:
    """Column of a field of a message: `time_in_message` for its own `time`, beside the stamp in `time`."""
    return f"{field}_in_message" if field in _TIMES else field


def _shown(field: str) -> str:
    return own_name(field.removeprefix(_HEADER))


def _then(reach: Getter, name: str) -> Getter:
    return lambda message: getattr(reach(message), name)


def _nanoseconds(reach: Getter) -> Getter:
    def stamp(message: Any) -> int:
        time = reach(message)
        return int(time.sec * SECOND + time.nanosec)

    return stamp
