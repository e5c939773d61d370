"""Values to CDR bytes and bytes to message objects, without a word about the fields of any message.

The bytes are little-endian CDR with the header 00 01 00 00, filled up with zeros to a multiple of
4: what DDS delivers to a `raw` subscription when these bytes are given to
`publisher.publish(bytes)`. Alignment gaps hold zeros, so equal values give equal bytes.
"""

import struct
from collections.abc import Callable, Sequence
from itertools import groupby
from typing import Any

import numpy
from rosbags.serde import SerdeError

from contact_sim_pkg.bag.errors import MessageError
from contact_sim_pkg.bag.typestore import installed_types
from contact_sim_pkg.records.definitions import Field, definition_of

SECOND = 1_000_000_000  # [ns]
LAST_STAMP = 2**31 * SECOND - 1  # [ns]; the seconds of a ROS stamp are an int32
_FILL = (b"", b"\0\0\0", b"\0\0", b"\0")  # by length modulo 4
CDR_HEADER = b"\0\1\0\0"
_COUNT, _STAMP = struct.Struct("<I"), struct.Struct("<iII")
_CODES = {"b1": "?", "i4": "i", "u1": "B", "u4": "I", "i8": "q", "u8": "Q", "f4": "f", "f8": "d"}
_ZEROS = tuple(bytes(count) for count in range(8))

Step = Callable[[list[bytes], int, Sequence[Any]], int]


class MessageLayout:
    """Places of some fields in CDR; what does not depend on the values is worked out once."""

    def __init__(self, fields: Sequence[Field]) -> None:
        """Lay out fields in the order of their definition."""
        self._steps: list[tuple[slice, Step]] = []
        first = 0
        for is_number, group in groupby(fields, _is_number):
            some = list(group)
            steps = [_numbers(some)] if is_number else [_step(field) for field in some]
            for step in steps:
                last = first + len(some) // len(steps)
                self._steps.append((slice(first, last), step))
                first = last

    def append(self, parts: list[bytes], at: int, values: Sequence[Any]) -> int:
        """Append the bytes of one value a field behind `at` bytes; returns how many there are then.

        Raises struct.error, TypeError, ValueError or AttributeError where a value does not fit.
        """
        for place, step in self._steps:
            at = step(parts, at, values[place])
        return at


def _is_number(field: Field) -> bool:
    return not field.is_array and field.type != "string" and "/" not in field.type and field.type[0].islower()


def _numbers(fields: Sequence[Field]) -> Step:
    """Numbers in a row, each aligned to its size, packed in one call: a format for each place modulo
    8 where the first may stand.
    """
    kinds = [numpy.dtype(field.type) for field in fields]

    def form(at: int) -> struct.Struct:
        text = "<"
        for kind in kinds:
            text += "x" * (-at % kind.itemsize) + _CODES[kind.str[1:]]
            at += -at % kind.itemsize + kind.itemsize
        return struct.Struct(text)

    forms = [form(at) for at in range(8)]

    def append(parts: list[bytes], at: int, values: Sequence[Any]) -> int:
        parts.append(forms[at % 8].pack(*values))
        return at + len(parts[-1])

    return append


def _step(field: Field) -> Step:
    """What appends a text, an array, or a record of numbers."""
    if field.type == "string":
        return _texts if field.is_array else _text
    if not field.is_array:
        inner = MessageLayout(definition_of(field.type.rpartition("/")[2]).fields)
        return lambda parts, at, values: inner.append(parts, at, values[0])
    size = numpy.dtype(field.type).itemsize

    def append(parts: list[bytes], at: int, values: Sequence[Any]) -> int:
        (array,) = values
        at = _count(parts, at, array.size)
        gap = -at % size if array.size else 0
        parts += (_ZEROS[gap], array.tobytes())
        return int(at + gap + array.nbytes)

    return append


def _text(parts: list[bytes], at: int, values: Sequence[str]) -> int:
    data = values[0].encode() + b"\0"
    at = _count(parts, at, len(data))
    parts.append(data)
    return at + len(data)


def _texts(parts: list[bytes], at: int, values: Sequence[Sequence[str]]) -> int:
    at = _count(parts, at, len(values[0]))
    for text in values[0]:
        at = _text(parts, at, (text,))
    return at


def _count(parts: list[bytes], at: int, count: int) -> int:
    gap = -at % 4
    parts += (_ZEROS[gap], _COUNT.pack(count))
    return at + gap + 4


def stamped(stamp_ns: int, frame_id: str) -> bytes:
    """The bytes of a `std_msgs/Header` with a simulated time in [ns], 0 to 2^31 s; MessageError
    outside.
    """
    if not 0 <= stamp_ns <= LAST_STAMP:
        raise MessageError(f"a stamp of {stamp_ns} ns cannot be sent; allowed: 0 to {LAST_STAMP} ns")
    frame = frame_id.encode() + b"\0"
    return _STAMP.pack(*divmod(stamp_ns, SECOND), len(frame)) + frame


def joined(parts: list[bytes], at: int) -> bytes:
    """A message of the parts, which are `at` bytes long without its header."""
    return b"".join((CDR_HEADER, *parts, _FILL[at % 4]))


def deserialize(type_name: str, data: bytes) -> Any:
    """The decoded message; its arrays are views of the bytes. MessageError for other bytes."""
    try:
        return installed_types().deserialize_cdr(data, type_name)
    except (SerdeError, struct.error, ValueError, IndexError, AssertionError) as error:
        raise MessageError(f"{len(data)} bytes do not hold a {type_name}: {error}") from None


def stamp_of(data: bytes) -> int:
    """The stamp in [ns] of an encoded message whose first field is a header or a stamp: 8 bytes at
    offset 4.
    """
    if len(data) < 12 or data[:2] not in (b"\0\1", b"\0\0"):
        raise MessageError(f"{len(data)} bytes that begin with {data[:4].hex(' ') or 'nothing'} hold no stamp")
    seconds, nanoseconds = struct.unpack_from("<iI" if data[1] else ">iI", data, 4)
    return int(seconds * SECOND + nanoseconds)
