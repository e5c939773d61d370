"""Values to CDR bytes and bytes to message objects, without a word about the fields of any message.

The bytes are little-endian CDR with the header 00 01 00 00, filled up with zeros to a multiple of
4: what DDS delivers to a `raw` subscription when these bytes are given to
`publisher.publish(bytes)`. Alignment gaps hold zeros, so equal values give equal bytes.
"""

import struct
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import lru_cache
from math import prod
from typing import Any, NamedTuple

import numpy
from rosbags.serde import SerdeError

from contact_sim_pkg.bag.errors import MessageError
from contact_sim_pkg.bag.typestore import installed_types
from contact_sim_pkg.records.definitions import Field, definition_of

SECOND = 1_000_000_000  # [ns]
LAST_STAMP = 2**31 * SECOND - 1  # [ns]; the seconds of a ROS stamp are an int32
CDR_HEADER = b"\0\1\0\0"
_COUNT = struct.Struct("<I")
_CODES = {"b1": "?", "i4": "i", "u1": "B", "u4": "I", "i8": "q", "u8": "Q", "f4": "f", "f8": "d"}

Shape = tuple[int, ...]
"""Of an array its shape, of a text its bytes, of texts their number and bytes."""


class Leaf(NamedTuple):
    """A number, a text or an array of these, in a message or in a message within it."""

    name: str  # with a dot behind the name of each message that it lies in
    type: str
    is_array: bool

    @property
    def is_number(self) -> bool:
        """Whether it always takes the same number of bytes."""
        return not self.is_array and self.type != "string"


def leaves_of(fields: Sequence[Field], prefix: str = "") -> Iterator[Leaf]:
    """The leaves of fields in the order of their bytes."""
    for field in fields:
        kind = field.type.rpartition("/")[2]
        if kind[0].isupper():
            yield from leaves_of(definition_of(kind).fields, f"{prefix}{field.name}.")
        else:
            yield Leaf(prefix + field.name, kind, field.is_array)


class Form(NamedTuple):
    """Where the values of a message lie; the same in all with arrays and texts of the same shapes."""

    packing: struct.Struct  # of a whole message, the header in front
    counts: list[tuple[int, int]]  # places among the values, and what stands there


def form_of(leaves: Sequence[Leaf], shapes: Mapping[str, Shape], sizes: Mapping[str, int]) -> Form:
    """Form of a message: a text or an array takes two values, its count and its bytes.

    shapes: of the leaves that are no numbers; sizes: values of those that are sides of an array.
    """
    counts: list[tuple[int, int]] = []
    text, at, place = "<4s", 0, 0

    def add(code: str, size: int, alignment: int) -> None:
        nonlocal text, at, place
        gap = -at % alignment
        text, at, place = f"{text}{gap}x{code}", at + gap + size, place + 1

    for leaf in leaves:
        item = 1 if leaf.type == "string" else numpy.dtype(leaf.type).itemsize
        if leaf.is_number:
            if leaf.name in sizes:
                counts.append((place, sizes[leaf.name]))
            add(_CODES[numpy.dtype(leaf.type).str[1:]], item, item)
            continue
        shape = shapes[leaf.name]
        count, size = (shape[0], shape[-1]) if leaf.type == "string" else (prod(shape), prod(shape) * item)
        counts.append((place, count))
        add("I", 4, 4)
        add(f"{size}s", size, item if size else 1)
    return Form(struct.Struct(f"{text}{-at % 4}x"), counts)


def to_bytes(leaf: Leaf) -> Callable[[Any], tuple[bytes, Shape]]:
    """What makes bytes of a text or an array, and states its shape.

    It raises TypeError, ValueError or AttributeError for another value.
    """
    if leaf.type == "string":
        return (lambda values: _texts(tuple(values))) if leaf.is_array else _text
    kind = numpy.dtype(leaf.type)

    def array(value: Any) -> tuple[bytes, Shape]:
        if not isinstance(value, numpy.ndarray) or value.dtype != kind:  # None equals the type of doubles
            value = numpy.asarray(value).astype(kind, "C", "same_kind")
        return value.tobytes(), value.shape

    return array


@lru_cache(maxsize=256)  # frames and names are few, and come with every message
def _text(value: str) -> tuple[bytes, Shape]:
    data = value.encode() + b"\0"
    return data, (len(data),)


@lru_cache(maxsize=256)
def _texts(values: tuple[str, ...]) -> tuple[bytes, Shape]:
    data = b""
    for value in values:
        text, (size,) = _text(value)
        data += bytes(-len(data) % 4) + _COUNT.pack(size) + text
    return data, (len(values), len(data))


def stamp_values(stamp_ns: int) -> tuple[int, int]:
    """Seconds and nanoseconds of a simulated time in [ns], 0 to 2^31 s; MessageError outside."""
    if not 0 <= stamp_ns <= LAST_STAMP:
        raise MessageError(f"a stamp of {stamp_ns} ns cannot be sent; allowed: 0 to {LAST_STAMP} ns")
    return divmod(stamp_ns, SECOND)


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
