"""Messages of one type stacked into arrays, one column a field.

Messages of one layout lie at the same distances in memory, so their fields are read as columns, not
message by message.
"""

from collections.abc import Callable, Iterable, Iterator
from itertools import chain
from typing import Any, NamedTuple

import numpy
from rosbags.interfaces import Nodetype
from rosbags.typesys.store import Typestore

from contact_sim_pkg.bag.encoding import SECOND
from contact_sim_pkg.bag.errors import BagError

_TIME = "builtin_interfaces/msg/Time"
_HEADER = "header."
_ENCAPSULATION = 4  # bytes before the content of a message, from which its alignment counts
_KINDS = {
    "bool": "?", "byte": "u1", "char": "u1", "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2", "int32": "i4",
    "uint32": "u4", "int64": "i8", "uint64": "u8", "float32": "f4", "float64": "f8",
}  # fmt: skip
"""numpy's name of each number"""

Raw = tuple[int, bytes]
"""Log time [ns] of a message, and its bytes."""
Decode = Callable[[int, bytes], Any]
"""Message object of a raw message; BagError where it does not fit its definition."""
Getter = Callable[[Any], Any]


def stacked(
    messages: Iterable[Raw], store: Typestore, type_name: str, fields: tuple[str, ...] | None, decode: Decode
) -> dict[str, Any]:
    """Columns of the messages as `Bag.columns` describes them; BagError: unknown field, or a message
    that does not fit.
    """
    getters = dict(_getters(store, type_name, "", lambda message: message))
    derived = {"log_time", "time"} if "stamp" in getters else {"log_time"}
    unknown = set(fields or ()) - set(getters) - derived
    if unknown:
        raise BagError(f"{type_name} has no field {', '.join(sorted(unknown))}; it has {', '.join(getters)}")
    wanted = {name: getter for name, getter in getters.items() if fields is None or name in fields or name == "stamp"}
    rows = [*messages]
    parts = [*_parts(rows, store, type_name, wanted, decode)]
    columns = {"log_time": _column([log_time for log_time, _ in rows])}
    columns |= {name: _joined([part[name] for part in parts]) for name in wanted}
    if "stamp" in columns:
        columns["time"] = columns["stamp"] / SECOND
    return {name: column for name, column in columns.items() if fields is None or name in fields}


def _parts(
    rows: list[Raw], store: Typestore, type_name: str, wanted: dict[str, Getter], decode: Decode
) -> Iterator[dict[str, Any]]:
    """The wanted columns of neighbouring messages of one layout, and of single messages."""
    plain, start = _is_plain(store, type_name), 0
    while start < len(rows):
        message, stop = decode(*rows[start]), start + 1
        # The first message has been checked; those of its layout need no check
        layout = _Layout(rows[start][1], store, type_name) if plain else None
        while layout is not None and stop < len(rows) and layout.fits(rows[stop][1]):
            stop += 1
        if layout is None or stop == start + 1:
            yield {name: _column([getter(message)]) for name, getter in wanted.items()}
        else:
            content = b"".join(data for _, data in rows[start:stop])
            yield {name: layout.column(name, content) for name in wanted}
        start = stop


def _joined(parts: list[Any]) -> Any:
    if len({part.shape[1:] if isinstance(part, numpy.ndarray) else None for part in parts} | {None}) == 2:
        return numpy.concatenate(parts)
    return _column([*chain(*parts)])


def _column(rows: list[Any]) -> Any:
    """[messages] of scalars, [messages, length] of arrays of one length, else the list as it is."""
    if rows and isinstance(rows[0], (list, numpy.ndarray)) and len({len(row) for row in rows}) > 1:
        return rows
    if rows and isinstance(rows[0], list) and any(not isinstance(item, str) for item in rows[0]):
        return rows  # sub-messages stay objects
    return numpy.array(rows) if rows else numpy.empty(0)


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
        self._data, self._store = data, store
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
            return numpy.array([field] * messages)
        shape, strides = (messages, 1 if field.length is None else field.length), (len(self._data), field.kind.itemsize)
        values: Any = numpy.ndarray(shape, field.kind, content, field.offset, strides)
        # Scalars become what Python makes of them, as in messages read one by one
        return (
            numpy.array(values[:, 0].tolist()) if field.length is None else values.astype(field.kind.newbyteorder("="))
        )

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
            full = full.removeprefix(_HEADER)
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
        self._end = start + self._length()
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
            yield full.removeprefix(_HEADER), getter
        elif detail == _TIME:
            yield full.removeprefix(_HEADER), _nanoseconds(getter)
        else:
            yield from _getters(store, str(detail), f"{full}.", getter)


def _then(reach: Getter, name: str) -> Getter:
    return lambda message: getattr(reach(message), name)


def _nanoseconds(reach: Getter) -> Getter:
    def stamp(message: Any) -> int:
        time = reach(message)
        return int(time.sec * SECOND + time.nanosec)

    return stamp
