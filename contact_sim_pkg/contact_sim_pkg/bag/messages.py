"""Records (`records/messages.py`) to the bytes of a message and back, by the names of their fields.

The bytes follow the definition; an array of two sides is sent row by row. Decoded arrays are
copies: writable, aligned, contiguous.
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from functools import cache, lru_cache
from math import prod
from operator import attrgetter
from typing import Any, TypeVar

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.bag.encoding import (
    CDR_HEADER,
    Form,
    Shape,
    deserialize,
    form_of,
    leaves_of,
    stamp_of,
    stamp_values,
    to_bytes,
)
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
        self._kinds = [
            (place, numpy.dtype(field.type))
            for place, field in enumerate(fields)
            if field.is_array and field.type != "string"
        ]
        self._names = [place for place, field in enumerate(fields) if field.is_array and field.type == "string"]
        self._messages = [(place, _short(field.type)) for place, field in enumerate(fields) if _is_message(field)]
        self._shaped = [(place, field) for place, field in enumerate(fields) if field.shape]
        self._side_arrays = [field.name for field in fields if field.name in sides]
        self._columns = [field for field in fields if field.is_array and not field.shape and field.name not in sides]
        # Of the encoder: all leaves, and those that the record has, the header's in front
        self._leaves = [*leaves_of(definition.fields)]
        self._has_header = any(field.type == HEADER for field in definition.fields)
        given = [leaf for leaf in self._leaves if leaf.is_array or leaf.name not in sides]
        self._leaf_values = _values_of(tuple(leaf.name for leaf in given if not leaf.name.startswith("header.")))
        self._arrays = [(place, leaf.name, to_bytes(leaf)) for place, leaf in enumerate(given) if not leaf.is_number]
        self._form = lru_cache(maxsize=64)(self._form_of)  # the messages of a topic have few

    def encode(self, record: Any, stamp_ns: int, frame_id: str) -> bytes:
        """CDR bytes of a record; the numbers of rows, columns and samples are those of its arrays."""
        try:
            values = [*stamp_values(stamp_ns), frame_id] if self._has_header else []
            values += self._leaf_values(record)
            shapes = []
            for place, _name, converted in self._arrays:
                values[place], shape = converted(values[place])
                shapes.append(shape)
            form = self._form(tuple(shapes))
            for place, count in form.counts:
                values.insert(place, count)
            return form.packing.pack(CDR_HEADER, *values)
        except (struct.error, TypeError, ValueError, AttributeError) as error:
            raise MessageError(f"a {self.type_name} cannot be encoded: {error}") from None

    def _form_of(self, found: tuple[Shape, ...]) -> Form:
        """Form of messages with arrays and texts of these shapes; MessageError where arrays do not fit
        each other.
        """
        shapes = {name: shape for (_place, name, _to_bytes), shape in zip(self._arrays, found, strict=True)}
        sizes = self._sizes(shapes)
        self._refuse_uneven_columns({field.name: shapes[field.name][0] for field in self._columns})
        return form_of(self._leaves, shapes, sizes)

    def _sizes(self, shapes: dict[str, Shape]) -> dict[str, int]:
        """The size of each side of an array; MessageError where two arrays disagree on it."""
        sizes = {name: shapes[name][0] for name in self._side_arrays}
        for _place, field in self._shaped:
            shape = shapes[field.name]
            if [sizes.setdefault(side, size) for side, size in zip(field.shape, shape, strict=False)] != [
                *shape
            ] or len(shape) != len(field.shape):
                found = (f"{each.name} {shapes[each.name]}" for _place, each in self._shaped)
                wanted = " x ".join(f"{sizes.get(side, '?')} {side}" for side in field.shape)
                raise MessageError(
                    f"the arrays of a {self.type_name} do not fit each other: {', '.join(found)}; {field.name} must be {wanted}"
                )
        return sizes

    def _refuse_uneven_columns(self, lengths: dict[str, int]) -> None:
        """MessageError where arrays that stand beside each other differ in length."""
        if len({lengths[field.name] for field in self._columns if not field.may_be_empty or lengths[field.name]}) > 1:
            found = ", ".join(f"{name} has {length}" for name, length in lengths.items())
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
        given = dict(zip((field.name for field in self._fields), values, strict=True))
        self._refuse_uneven_columns({field.name: len(given[field.name]) for field in self._columns})
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
