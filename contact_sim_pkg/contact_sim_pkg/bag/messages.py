"""Records (`records/messages.py`) to the bytes of a message and back, by the names of their fields.

The bytes follow the definition; an array of two sides is sent row by row. Decoded arrays are
copies: writable, aligned, contiguous.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Sequence
from functools import cache
from math import prod
from operator import attrgetter
from typing import Any, TypeVar

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.bag.encoding import MessageLayout, deserialize, joined, stamp_of, stamped
from contact_sim_pkg.bag.errors import MessageError
from contact_sim_pkg.records import messages as records
from contact_sim_pkg.records.definitions import HEADER, Field, definition_of

__all__ = ["BENCH_FRAME", "decode", "encode", "record_of", "stamp_of"]

BENCH_FRAME = "bench"  # the bench's fixed frame

Record = TypeVar("Record")


def encode(record: Any, stamp_ns: int = 0, frame_id: str = BENCH_FRAME) -> bytes:
    """CDR bytes of a record with its stamp [ns] and frame; without a header it has neither.

    Raises MessageError where a value does not fit its field, or arrays do not fit each other.
    """
    return _codec(type(record).__name__).encode(record, stamp_ns, frame_id)


def decode(kind: type[Record], data: bytes) -> Record:
    """Record of a kind from its bytes.

    Raises MessageError where they do not hold one, or its arrays do not fit.
    """
    return record_of(kind, deserialize(_codec(kind.__name__).type_name, data))


def record_of(kind: type[Record], message: Any) -> Record:
    """The record of a message read by the definition of its bag.

    A field that the bag's definition does not know has its default. Raises MessageError where
    arrays do not fit each other, AttributeError where a field without a default is missing.
    """
    made: Record = kind._make(_codec(kind.__name__).values(message))  # type: ignore[attr-defined]
    return made


@cache
def _codec(name: str) -> _Codec:
    return _Codec(name)


class _Codec:
    """Encoder and decoder of one kind of message; fields have the places of its definition."""

    def __init__(self, name: str) -> None:
        definition = definition_of(name)
        fields, sides = definition.record_fields, definition.sides
        self.type_name, self._fields = definition.type_name, fields
        self._values_of = _values_of(tuple(field.name for field in fields))
        self._has_header = any(field.type == HEADER for field in definition.fields)
        self._kinds = [
            (place, numpy.dtype(field.type))
            for place, field in enumerate(fields)
            if field.is_array and field.type != "string"
        ]
        self._names = [place for place, field in enumerate(fields) if field.is_array and field.type == "string"]
        self._messages = [(place, _short(field.type)) for place, field in enumerate(fields) if _is_message(field)]
        self._shaped = [(place, field) for place, field in enumerate(fields) if field.shape]
        self._side_arrays = [(place, field.name) for place, field in enumerate(fields) if field.name in sides]
        self._columns = [
            (place, field.may_be_empty) for place, field in enumerate(fields)
            if field.is_array and not field.shape and field.name not in sides
        ]  # fmt: skip
        body = [field for field in definition.fields if field.type != HEADER]
        self._layout = MessageLayout(body)
        self._counts = [(place, field.name) for place, field in enumerate(body) if field not in fields]

    def encode(self, record: Any, stamp_ns: int, frame_id: str) -> bytes:
        """CDR bytes of a record; the numbers of rows, columns and samples are those of its arrays."""
        try:
            values = list(record)
            for place, kind in self._kinds:
                array = values[place]
                if not isinstance(array, numpy.ndarray) or array.dtype != kind:  # None equals the type of doubles
                    values[place] = numpy.asarray(array).astype(kind, "C", "same_kind")
            sizes = self._sizes(values) if self._shaped else {}
            if self._columns:
                self._refuse_uneven_columns(values)
            for place, name in self._counts:  # in the order of the definition, so that each finds its place
                values.insert(place, sizes[name])
            parts = [stamped(stamp_ns, frame_id)] if self._has_header else []
            at = self._layout.append(parts, len(parts[0]) if parts else 0, values)
        except (struct.error, TypeError, ValueError, AttributeError) as error:
            raise MessageError(f"a {self.type_name} cannot be encoded: {error}") from None
        return joined(parts, at)

    def _sizes(self, values: list[Any]) -> dict[str, int]:
        """The size of each side of an array; MessageError where two arrays disagree on it."""
        sizes = {name: len(values[place]) for place, name in self._side_arrays}
        for place, field in self._shaped:
            shape = values[place].shape
            if [sizes.setdefault(side, size) for side, size in zip(field.shape, shape, strict=False)] != [
                *shape
            ] or len(shape) != len(field.shape):
                shapes = (f"{each.name} {values[place].shape}" for place, each in self._shaped)
                wanted = " x ".join(f"{sizes.get(side, '?')} {side}" for side in field.shape)
                raise MessageError(
                    f"the arrays of a {self.type_name} do not fit each other: {', '.join(shapes)}; {field.name} must be {wanted}"
                )
        return sizes

    def _refuse_uneven_columns(self, values: Sequence[Any]) -> None:
        """MessageError where arrays that stand beside each other differ in length."""
        lengths = {
            len(values[place]) for place, may_be_empty in self._columns if not may_be_empty or len(values[place])
        }
        if len(lengths) > 1:
            found = ", ".join(f"{self._fields[place].name} has {len(values[place])}" for place, _empty in self._columns)
            raise MessageError(
                f"the arrays of a {self.type_name} differ in length: {found}; one value a sample is needed in each"
            )

    def values(self, message: Any) -> list[Any]:
        """Values of a record: arrays as copies, texts as tuples, messages as records."""
        try:
            values = list(self._values_of(message))
        except AttributeError:
            values = self._values_or_defaults(message)
        for place, _kind in self._kinds:
            values[place] = numpy.array(values[place])
        for place, field in self._shaped:
            values[place] = self._in_shape(field, message, values[place])
        for place in self._names:
            values[place] = tuple(values[place])
        for place, name in self._messages:
            values[place] = record_of(getattr(records, name), values[place])
        if self._columns:
            self._refuse_uneven_columns(values)
        return values

    def _values_or_defaults(self, message: Any) -> list[Any]:
        """As the message has them; AttributeError where it lacks a field that has no default."""
        defaults = {field.name: field.default_value for field in self._fields if field.has_default}
        return [
            getattr(message, field.name, defaults[field.name])
            if field.name in defaults
            else getattr(message, field.name)
            for field in self._fields
        ]

    def _in_shape(self, field: Field, message: Any, values: NDArray[Any]) -> NDArray[Any]:
        sides = [getattr(message, side) for side in field.shape]
        shape = [side if isinstance(side, int) else len(side) for side in sides]
        if prod(shape) != len(values):
            wanted = " x ".join(f"{size} {side}" for size, side in zip(shape, field.shape, strict=True))
            raise MessageError(
                f"block {message.block} of {self.type_name} has {len(values)} values of {field.name} for {wanted}"
            )
        return values.reshape(shape)


def _values_of(names: tuple[str, ...]) -> Callable[[Any], tuple[Any, ...]]:
    """Function that reads these fields of a record or a message, in one call of compiled code."""
    if len(names) == 1:
        return lambda holder: (getattr(holder, names[0]),)
    return attrgetter(*names)


def _is_message(field: Field) -> bool:
    return _short(field.type)[0].isupper()


def _short(type_name: str) -> str:
    return type_name.rpartition("/")[2]
